// middleware/near/clearance_search.h: the least separation of motions from scenes, by spans of
// time: the one that may be nearest is looked at first, and halved where it is not proven to be
// farther than what has been found (clearance.md). Metres. Not installed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/chain_nodes.h"
#include "lss/separation.h"
#include "middleware/near/clearance.h"
#include "middleware/near/distance_cells.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/scene/nearest_walk.h"
#include "middleware/scene/scene_parts.h"
#include "tessellation/axis_curve.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

struct ClearancePlan {
  ClearancePlan(const Avatar& whose, const Scene& where, const ClearanceOptions& how);

  Avatar avatar;
  Scene scene;
  ClearanceOptions options;
  LssTable table;
  std::vector<std::int32_t> asked;      ///< LSS of the table.
  std::vector<IgnoredObjects> ignored;  ///< Per link.
  double extent;  ///< No coordinates of the scene add up to more, from its origin.
  DistanceCells cells;
};

/// A motion of which a search looks at a part.
struct ClearanceMotion {
  const ClearancePlan* plan;
  const ChainMotion* motion;
  double rounding = 0.0;            ///< No true place is farther from the motion's (m).
  double begin = 0.0, share = 1.0;  ///< Its t is begin + share * t of the whole.
  std::int32_t prop = -1;           ///< The prop whose scene it is.
};

struct ClearanceMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::Clearance;

  struct Curve {
    AxisCurve curve;
    std::int32_t lss;
    double radius, more;  ///< `more`: what is added to it for all that is not known exactly.
  };
  /// A curve over a span of its motion's t.
  struct Span {
    double bound;  ///< Nothing is nearer in it.
    double begin, end;
    std::int32_t curve;
    TriangleId near;         ///< One that was near in a span around it; -1: none is known.
    double ofQuarter = 0.0;  ///< The bound that cells give about a quarter of it, at its middle.
  };
  /// Where something was near.
  struct Place {
    double upper, t;
    LinkId link;
    Eigen::Vector3d nhat;
  };
  ChainNodes nodes;
  std::vector<Curve> curves;
  std::vector<Span> spans;  ///< A heap.
  std::vector<Place> places;
};

/// One answer, of one motion or of several one after the other.
class ClearanceSearch {
 public:
  ClearanceSearch(const ClearanceOptions& options, ClearanceMemory& memory);

  void look(const ClearanceMotion& motion);
  [[nodiscard]] Clearance finish();
  /// The prop whose scene has the nearest place.
  [[nodiscard]] std::int32_t prop() const { return prop_; }

 private:
  class Look;

  void addCurves();
  void boundByCells(ClearanceMemory::Span& span) const;
  void lookAt(const ClearanceMemory::Span& span);
  /// Takes a place of the motion at hand, at its own t.
  void take(const ClearanceMemory::Curve& curve, double t, const Separation& apart, TriangleId id);
  void push(ClearanceMemory::Span span);
  void settle(const ClearanceMemory::Curve& curve, const ClearanceMemory::Span& span);
  /// What is farther all through a span is of no account.
  [[nodiscard]] double floor() const { return std::min(within_, best_.upper - tolerance_); }

  const double tolerance_, within_;
  ClearanceMemory& memory_;
  ClearanceMotion motion_{};
  Clearance best_;
  double lowest_;           // that of spans too short to be halved
  std::int32_t prop_ = -1;  // that of the best
  bool isSettled_ = true;
};

}  // namespace foretouch::internal
