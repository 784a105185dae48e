// middleware/events/moving_sides.h: the two sides of one question in one step: the LSS of a link,
// and those of another link or the triangles of an object, in the frame in which their motion is
// bounded. Not installed.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/pair/pairs_asked.h"
#include "middleware/pair/side.h"
#include "middleware/scene/scene.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// No object of a scene: the other side is a link.
inline constexpr ObjectId kNoObject = -1;

/// An LSS of the link, and one of the other link or a triangle.
struct SidesPair {
  std::int32_t lss = -1, other = -1;
};
[[nodiscard]] inline bool operator==(const SidesPair& x, const SidesPair& y) {
  return x.lss == y.lss && x.other == y.other;
}

/// One side that moves with a link, and what it refers to.
struct LinkSide {
  MotionEvaluator* evaluator = nullptr;
  LinkId link = kNoParent;
  const std::vector<Lss>* lss = nullptr;
  LinkId frame = kNoParent;
  MotionBounds inFrame;
  std::vector<AxisBounds> bounds;  // per LSS
  std::int32_t first = 0;          // of its LSS in the numbers of radius shares

  [[nodiscard]] Side side() const {
    return {link, *lss, bounds, *evaluator, nullptr, nullptr, frame, &inFrame};
  }
};

/// For one thread; keeps its memory. What it refers to outlives the last look.
class MovingSides {
 public:
  /// Both are seen from `frame`.
  void begin(LinkId frame);
  /// A link of the motion that the evaluator has.
  void setLink(MotionEvaluator& evaluator, LinkId link, const std::vector<Lss>& lss);
  void setOther(MotionEvaluator& evaluator, LinkId link, const std::vector<Lss>& lss);
  /// Whose shares of radii count, with the number of each link's first LSS.
  void setShares(const PairsAsked& asked, std::int32_t first, std::int32_t firstOfOther);
  /// The triangles of the object, instead of another link; of all objects if it is kNoObject.
  void setScene(const Scene& scene, ObjectId object);

  [[nodiscard]] bool isScene() const { return scene_ != nullptr; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }

  /// The two parts at an instant. O(1) at the instant of the last look, else O(depth).
  [[nodiscard]] MovingPair at(const SidesPair& pair, double t);
  /// All pairs that may be within `reach` (m) of each other at some instant of [from, to], each
  /// once. They replace `pairs`.
  void collect(double from, double to, double reach, std::vector<SidesPair>& pairs);
  /// The object of a pair's triangle; kNoObject if the other side is a link.
  [[nodiscard]] ObjectId objectOf(const SidesPair& pair) const {
    return scene_ != nullptr ? scene_->object(pair.other) : kNoObject;
  }

  std::uint64_t looks = 0;  ///< Distances of two parts.
  /// In the units of QueryOptions::workBudget: done, and beyond which nothing more is looked at.
  std::uint64_t work = 0, mostWork = std::numeric_limits<std::uint64_t>::max();
  [[nodiscard]] bool isSpent() const { return work >= mostWork; }

 private:
  struct States {
    double t = std::numeric_limits<double>::quiet_NaN();
    LinkState one, other;
  };
  [[nodiscard]] const States& statesAt(double t);
  void setSide(LinkSide& side, MotionEvaluator& evaluator, LinkId link,
               const std::vector<Lss>& lss);
  [[nodiscard]] static Aabb sweptBoxOf(const LinkSide& side, std::size_t i, const LinkState& begin,
                                       const LinkState& end, double span, double reach);
  void collectLinks(const States& begin, const States& end, double reach,
                    std::vector<SidesPair>& pairs);
  void collectScene(const States& begin, const States& end, double reach,
                    std::vector<SidesPair>& pairs);

  LinkId frame_ = kNoParent;
  LinkSide one_, other_;
  const PairsAsked* asked_ = nullptr;
  const Scene* scene_ = nullptr;
  ObjectId object_ = kNoObject;
  States states_;
  std::vector<TriangleId> found_;
};

}  // namespace foretouch::internal
