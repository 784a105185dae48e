// middleware/events/span_sides.h: two bodies, or one and what it meets by itself, in one span of
// world time: the sides of each pair of links, and where all of it is in W. Not installed.
#pragma once

#include <vector>

#include "articulated/result.h"
#include "middleware/events/moving_sides.h"
#include "middleware/world/system_query.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// A body and another one; b is kStillScene, or a itself for own links.
struct BodyPair {
  BodyId a = 0, b = kStillScene;
};
[[nodiscard]] inline bool operator==(const BodyPair& x, const BodyPair& y) {
  return x.a == y.a && x.b == y.b;
}
[[nodiscard]] inline bool operator<(const BodyPair& x, const BodyPair& y) {
  return x.a != y.a ? x.a < y.a : x.b < y.b;
}
struct LinkPair {
  LinkId a = 0, b = 0;
};
[[nodiscard]] inline bool operator==(const LinkPair& x, const LinkPair& y) {
  return x.a == y.a && x.b == y.b;
}
[[nodiscard]] inline bool operator<(const LinkPair& x, const LinkPair& y) {
  return x.a != y.a ? x.a < y.a : x.b < y.b;
}

/// Whether one of them is a mesh, or the scene: each of its objects is met by itself.
[[nodiscard]] bool isOfObjects(const WorldParts& world, const BodyPair& bodies);

/// Errors: a world whose contacts cannot be followed: one that asks whether meshes meet.
[[nodiscard]] Result<Done> checkedSides(const WorldParts& world);

/// One thread's memory for spans.
struct SpanScratch {
  SystemScratch system;
  MotionEvaluator evaluator, ofOther;  // of the two chains
  MotionEvaluator ofSystem;            // that of what is seen from a mesh, in W
  std::vector<LinkState> states;
};

/// For one thread. What it refers to outlives it.
class SpanSides {
 public:
  SpanSides(const WorldParts& world, SystemPlans& plans, SpanScratch& scratch)
      : world_(world),
        scratch_(scratch.system),
        query_(world, plans, scratch.system),
        evaluator_(scratch.evaluator),
        ofOther_(scratch.ofOther),
        ofSystem_(scratch.ofSystem),
        states_(scratch.states) {}

  /// The two bodies, for spans to come. False: nothing of the two is asked.
  [[nodiscard]] bool begin(const BodyPair& bodies, std::int64_t fromUs, std::int64_t toUs);
  [[nodiscard]] SystemSpans& spans() { return scratch_.spans; }
  /// Readies the span that spans() is at. Null: nothing can touch. Errors: as
  /// SystemPlans::planOf().
  Result<const SystemPlan*> prepare();
  [[nodiscard]] bool isResolved() const { return query_.isResolved(); }
  /// No place is farther from its true one (m).
  [[nodiscard]] double off() const { return scratch_.poses.rounding; }
  /// The span in seconds.
  [[nodiscard]] double seconds() const {
    return 1e-6 * static_cast<double>(scratch_.spans.endUs() - scratch_.spans.beginUs());
  }

  /// False: the two links are not asked in this span. For a mesh or the scene: all its objects.
  [[nodiscard]] bool set(const LinkPair& links, MovingSides& sides);
  /// The sides' link is b's, and the other side is a.
  [[nodiscard]] bool isTurned() const { return isTurned_; }

  /// The frame that the sides are seen from, relative to origin() in W.
  [[nodiscard]] LinkState frameAt(double t);
  /// The same for a link of one of the two bodies, with what bounds its motion.
  /// Precondition: a body, and not the scene.
  [[nodiscard]] LinkState stateOf(BodyId body, LinkId link, double t);
  [[nodiscard]] MotionBounds boundsOf(BodyId body, LinkId link) const;
  /// All links of a body. Their number is that of its skeleton.
  void statesOf(BodyId body, double t, std::vector<LinkState>& states);
  [[nodiscard]] const Eigen::Vector3d& origin() const { return scratch_.origin; }

 private:
  [[nodiscard]] SystemQuestion questionOf(const BodyPair& bodies) const;
  [[nodiscard]] LinkId inSystem(BodyId body, LinkId link) const;
  [[nodiscard]] bool setPair(LinkId one, LinkId other, MovingSides& sides);
  [[nodiscard]] bool setMesh(LinkId link, MovingSides& sides);
  [[nodiscard]] LinkShape shapeOf(BodyId body, LinkId link) const;
  [[nodiscard]] MotionEvaluator& inWorld(BodyId body) const;

  const WorldParts& world_;
  SystemScratch& scratch_;
  SystemQuery query_;
  SystemQuestion question_ = SystemQuestion::Pair;
  BodyId one_ = 0, other_ = kStillScene;  // as they are asked
  bool isTurned_ = false;
  const SystemPlan* plan_ = nullptr;
  LinkId frame_ = kNoParent;
  MotionEvaluator &evaluator_, &ofOther_, &ofSystem_;
  std::vector<LinkState>& states_;
};

}  // namespace foretouch::internal
