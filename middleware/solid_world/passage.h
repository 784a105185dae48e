// middleware/solid_world/passage.h: proves a motion of a solid avatar clear of everything around it
// that moves at the same time, and of the scene, or says how far it is. Metres in W, world time in
// microseconds. Not installed.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "articulated/result.h"
#include "middleware/solid/certifier.h"
#include "middleware/solid_world/around_body.h"
#include "middleware/solid_world/around_plan.h"

namespace foretouch::internal {

/// A motion of the avatar: from one pose to another between two instants.
struct TimedMotion {
  const Pose& from;
  const Pose& to;
  std::int64_t beginUs, endUs;
};

struct Passage {
  bool isClear = false;
  std::int64_t freeUntilUs = 0;                                ///< Proven until here.
  double clearance = std::numeric_limits<double>::infinity();  ///< Until there.
  const AroundBody* blocker = nullptr;  ///< What it meets first; null: the scene, or own links.
  LinkId link = 0;
  JointId other = 0;      ///< On the blocker's own chain, without what carries it.
  bool isInside = false;  ///< It touches the blocker at its begin.
  bool isOverBudget = false;
};

/// The bodies around one avatar in one tick.
struct Surroundings {
  std::vector<const AroundBody*> bodies;  ///< By body.
  std::vector<BodyId> passed;             ///< Those that are not asked: they crush it already.
  bool isAssumed = false;  ///< Another one was silent all the time, and taken to be nowhere.
  std::int64_t endUs = 0;  ///< The tick's end.
  /// Where it may stay until then: no solid avatar that moves meets it there, which is proven.
  Pose fallback;

  [[nodiscard]] bool isPassed(BodyId body) const;
};

/// For one avatar and one thread; keeps its memory.
class PassageProver {
 public:
  static Result<PassageProver> build(const Avatar& avatar, const Scene& scene,
                                     const SolidOptions& options);

  /// Begins a tick, with so much work to spend on questions about the scene.
  void beginTick(std::uint64_t work);
  [[nodiscard]] Certifier& certifier() { return *certifier_; }
  /// What is asked about bodies of the kind. Makes it where it is not known yet.
  Result<const AroundPlan*> planOf(const AroundKind& kind);
  /// Drops what is known of the kind: it is not needed any more.
  void forget(std::int32_t kindNumber);
  /// Makes the plans for all legs of the bodies, so that ask() need not. Errors: as AroundPlan.
  Result<Done> prepare(const Surroundings& around);

  /// Asks the scene, then the bodies. Beyond the motion itself, an avatar that ends it before the
  /// tick ends must be able to stay there without another solid avatar meeting it. Preconditions:
  /// prepare() was called; validated poses.
  [[nodiscard]] Passage ask(const TimedMotion& motion, const Surroundings& around);
  /// For a part of a way that is shown as a whole or not at all, and that the scene leaves free.
  [[nodiscard]] Passage askPart(const TimedMotion& motion, const Surroundings& around);
  /// As ask(). If it is not clear, goes as far as is proven, with room to what it meets: `reached`
  /// then is a pose of the motion, `reachedUs` its instant, and the motion until there is proven.
  /// reachedUs is the motion's begin if nothing is. Precondition: `reached` is neither pose.
  Passage advance(const TimedMotion& motion, const Surroundings& around, Pose& reached,
                  std::int64_t& reachedUs);
  /// The answer for the avatar and a body at one instant. isClear: they are apart.
  [[nodiscard]] PairAnswer at(const Pose& place, const AroundBody& body, std::int64_t us);
  /// Those about bodies, since beginTick().
  [[nodiscard]] std::uint32_t questions() const { return questions_; }
  /// Per link.
  [[nodiscard]] const std::vector<std::vector<Lss>>& volumes() const { return volumes_; }

 private:
  PassageProver(const Avatar& avatar, Certifier certifier, const SolidOptions& options);
  void askScene(const TimedMotion& motion, Passage& passage);
  void askBodies(const TimedMotion& motion, const Surroundings& around, Passage& passage);
  void askBody(const TimedMotion& motion, const AroundBody& body, Passage& passage);
  void askLeg(const TimedMotion& motion, const AroundBody& body, const AroundLeg& leg,
              Passage& passage);
  void askToStay(const TimedMotion& motion, const Surroundings& around, Passage& passage);
  [[nodiscard]] const AroundPlan& known(const AroundKind& kind) const;

  Avatar avatar_;
  std::unique_ptr<Certifier> certifier_;
  double tolerance_, rho_ = 0.0;
  std::vector<std::vector<Lss>> volumes_;
  std::vector<std::unique_ptr<AroundPlan>> plans_;  // by the kind's number
  AroundScratch scratch_;
  ChainMotion whole_;
  PartOfMotion ofOne_, ofOther_;
  Pose reachedInScene_, part_;
  std::vector<LinkState> states_;
  std::uint32_t questions_ = 0;
};

}  // namespace foretouch::internal
