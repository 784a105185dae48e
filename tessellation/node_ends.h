// tessellation/node_ends.h: the ends of every LSS's axis at the nodes of a span, as floats around
// the body, for tests that need nothing but places. sweptBoxes() makes them on its way. Metres. Not
// installed.
#pragma once

#include <vector>

#include "articulated/chain_nodes.h"
#include "tessellation/lss_table.h"

namespace foretouch {

/// Places are relative to `origin`, which is near the body, and that to the nodes' origin. Each
/// coordinate is off by at most a unit roundoff of float of itself, and besides that the place by
/// `roundings`. Keeps its memory.
struct NodeEnds {
  struct alignas(64) Axis {
    float a[3][kNodes], b[3][kNodes];
  };
  std::vector<Axis> axes;        ///< Per LSS of the table.
  std::vector<float> extents;    ///< Per LSS: no end's coordinates add up to more. Rounded up.
  std::vector<float> roundings;  ///< Per LSS, of both ends in double. Rounded up.
  double origin[3] = {0.0, 0.0, 0.0};

  /// Makes room for the table's LSS, and places the origin at the first of them.
  void placeAround(const LssTable& table, const ChainNodes& nodes);
};

}  // namespace foretouch
