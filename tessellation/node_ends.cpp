#include "tessellation/node_ends.h"

#include "lss/index.h"
#include "lss/single.h"

namespace foretouch {
void NodeEnds::placeAround(const LssTable& table, const ChainNodes& nodes) {
  axes.resize(countOf(table.size()));
  extents.resize(axes.size());
  roundings.resize(axes.size());
  if (table.size() == 0) return;
  constexpr int kMiddle = kNodes / 2;
  const LinkNodes& first = nodes.link(table[0].link);
  for (int axis = 0; axis < 3; ++axis) origin[axis] = nearestFloat(first.p[axis][kMiddle]);
}

}  // namespace foretouch
