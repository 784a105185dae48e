// middleware/events/moving_sides.h: the two sides of one question in one step: the surface of a
// link (its LSS, or its triangles), and that of another link or the triangles of an object, in the
// frame in which their motion is bounded. Not installed.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/events/swept_tube.h"
#include "middleware/pair/growth.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/pair/pairs_asked.h"
#include "middleware/pair/side.h"
#include "middleware/scene/scene.h"
#include "middleware/surface/link_surface.h"
#include "tessellation/aabb.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// No object of a scene: the other side is a link.
inline constexpr ObjectId kNoObject = -1;

/// A piece of a side's surface: a triangle, with the LSS that holds it if a link's; or an LSS.
struct SidePiece {
  std::int32_t lss = -1, triangle = -1;
};
[[nodiscard]] inline bool operator==(const SidePiece& x, const SidePiece& y) {
  return x.lss == y.lss && x.triangle == y.triangle;
}
/// One of the link, and one of the other side.
struct SidesPair {
  SidePiece one, other;
  [[nodiscard]] bool isNone() const { return one.lss < 0; }
};
[[nodiscard]] inline bool operator==(const SidesPair& x, const SidesPair& y) {
  return x.one == y.one && x.other == y.other;
}

/// One side that moves with a link, and what it refers to.
struct LinkSide {
  MotionEvaluator* evaluator = nullptr;
  LinkId link = kNoParent;
  const std::vector<Lss>* lss = nullptr;
  const LinkSurface* surface = nullptr;  // null: its LSS
  LinkId frame = kNoParent;
  MotionBounds inFrame;
  std::vector<AxisBounds> bounds;  // per LSS
  std::int32_t first = 0;          // its first LSS in the numbers of radius shares

  [[nodiscard]] Side side() const {
    return {link, *lss, bounds, *evaluator, surface, nullptr, frame, &inFrame};
  }
  /// As Side::hullAt().
  [[nodiscard]] MovingHull hullAt(const SidePiece& piece, const LinkState& state) const;
};

/// What a link has: LSS, and the triangles that touch in their place, if it has any.
struct LinkShape {
  const std::vector<Lss>& lss;
  const LinkSurface* surface = nullptr;
};

/// For one thread; keeps its memory. What it refers to outlives the last look.
class MovingSides {
 public:
  /// Both are seen from `frame`.
  void begin(LinkId frame);
  /// A link of the motion that the evaluator has.
  void setLink(MotionEvaluator& evaluator, LinkId link, const LinkShape& shape);
  void setOther(MotionEvaluator& evaluator, LinkId link, const LinkShape& shape);
  /// Sets whose shares of radii count, with the number of each link's first LSS.
  void setShares(const PairsAsked& asked, std::int32_t first, std::int32_t firstOfOther);
  /// The triangles of the object, instead of another link; of all objects if it is kNoObject.
  void setScene(const Scene& scene, ObjectId object);

  /// Objects of the scene that are passed over; null: none. Until setScene().
  void ignore(const IgnoredObjects* ignored) { ignored_ = ignored; }
  /// Adds the growth to the sum of the radii from now on, or takes it off: `sign` is 1 or -1. Until
  /// begin().
  void grow(const Growth& growth, double sign) {
    growth_ = growth;
    growthSign_ = sign;
  }
  /// collect() looks among these pairs alone, until begin(); `areNear`: it takes them all, whatever
  /// it is asked.
  void limitTo(const std::vector<SidesPair>& pairs, bool areNear = false) {
    limited_ = &pairs;
    areNear_ = areNear;
  }
  [[nodiscard]] const std::vector<SidesPair>* limit() const { return limited_; }
  /// The motion backwards in time, or forwards again: t is then 1 at its begin. Until begin().
  void turnBack(bool isBackward) { isBackward_ = isBackward; }

  [[nodiscard]] bool isScene() const { return scene_ != nullptr; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }

  /// The two parts at an instant. O(1) at the instant of the last look, else O(depth).
  [[nodiscard]] MovingPair at(const SidesPair& pair, double t);
  /// All pairs that may be within `reach` (m) of each other at some instant of [from, to], each
  /// once. They replace `pairs`.
  void collect(double from, double to, double reach, std::vector<SidesPair>& pairs);
  /// The object of a pair's triangle; kNoObject if the other side is a link.
  [[nodiscard]] ObjectId objectOf(const SidesPair& pair) const {
    return scene_ != nullptr ? scene_->object(pair.other.triangle) : kNoObject;
  }

  std::uint64_t looks = 0;  ///< Distances of two parts.
  /// In the units of QueryOptions::workBudget: done, and beyond which nothing more is looked at.
  std::uint64_t work = 0, mostWork = std::numeric_limits<std::uint64_t>::max();
  [[nodiscard]] bool isSpent() const { return work >= mostWork; }
  /// Adds the work of a caller that looks among boxes instead.
  void addBoxes(std::size_t count);

 private:
  struct States {
    double t = std::numeric_limits<double>::quiet_NaN();
    LinkState one, other;
  };
  /// A part of a link, and what it sweeps.
  struct Swept {
    std::int32_t lss;
    Part part;
    Aabb box;
  };
  /// A time, and the pairs that are found in it.
  struct Collecting {
    States begin, end;
    double span, reach;
    std::vector<SidesPair>& pairs;
  };
  [[nodiscard]] const States& statesAt(double t);
  [[nodiscard]] MovingPair pairAt(const SidesPair& pair, double t);
  void grow(MovingHull& one, double t) const;
  void setSide(LinkSide& side, MotionEvaluator& evaluator, LinkId link, const LinkShape& shape);
  [[nodiscard]] static Swept sweptOf(const LinkSide& side, std::int32_t lss, Part part,
                                     const LinkState& begin, const LinkState& end, double span,
                                     double reach);
  [[nodiscard]] Swept sweptOfOne(const Collecting& in, std::int32_t lss, Part part) const;
  [[nodiscard]] Swept sweptOfOther(const Collecting& in, std::int32_t lss, Part part) const;
  void collectAmong(Collecting& in) const;
  [[nodiscard]] SweptTube tubeOf(const Collecting& in, std::int32_t index) const;
  void collectLinks(Collecting& in);
  void collectParts(Collecting& in, const Swept& one, const Swept& other);
  void collectScene(Collecting& in, const Swept& one);
  void addTriangles(Collecting& in, const Swept& one);

  LinkId frame_ = kNoParent;
  LinkSide one_, other_;
  const PairsAsked* asked_ = nullptr;
  const Scene* scene_ = nullptr;
  ObjectId object_ = kNoObject;
  const IgnoredObjects* ignored_ = nullptr;
  Growth growth_;
  double growthSign_ = 0.0;
  bool isBackward_ = false, areNear_ = false;
  const std::vector<SidesPair>* limited_ = nullptr;
  States states_;  // those of the motion as it goes
  std::vector<TriangleId> found_;
};

}  // namespace foretouch::internal
