// middleware/solid_world/moving_controller.h: one tick of a solid avatar among bodies that move:
// towards its target as far as they let it, out of their way where they come, and nowhere without
// proof. The algorithm: middleware/solid_world/solid_world.md 3. Metres in W. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/near/near_features.h"
#include "middleware/solid/contact_row.h"
#include "middleware/solid/joint_ranges.h"
#include "middleware/solid/own_features.h"
#include "middleware/solid/pulled_step.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_tick.h"
#include "middleware/solid_world/around_rows.h"
#include "middleware/solid_world/passage.h"

namespace foretouch::internal {

struct YieldRequest {
  const Pose& target;
  const std::vector<LinkState>& states;        ///< The links at the target.
  const std::vector<Eigen::Vector3d>& wanted;  ///< The body's points there.
  const JointRanges& ranges;                   ///< How far surfaces may turn joints.
  double trackedStep;                          ///< How far the target moved since the last tick.
  double budget;                               ///< How far the target may pull any point.
  std::int64_t beginUs, endUs;
};

/// From an instant on, nothing is proven of the avatar and this body.
struct Crusher {
  BodyId body = 0;
  LinkId link = 0;
  std::int64_t sinceUs = 0;
};

/// For one thread; keeps its memory.
class MovingController {
 public:
  static Result<MovingController> build(const Avatar& avatar, const Scene& scene,
                                        const SolidOptions& options, PassageProver& prover);

  /// Moves `shown` from the tick's begin to its end. Appends the way to the tick, with the instants
  /// at which its pieces end. A body that leaves no proven motion is added to `crushers`, and
  /// to those that `around` passes. Precondition: prover.prepare(around).
  void run(const YieldRequest& request, PassageProver& prover, Surroundings& around, Pose& shown,
           SolidTick& tick, std::vector<std::int64_t>& endsUs, std::vector<Crusher>& crushers);

  [[nodiscard]] const VisualBody& body() const { return step_.body(); }
  /// The rows of the last step, with their pushes: first of the scene and of own links, then of
  /// bodies, in the order of features().
  [[nodiscard]] const std::vector<ContactRow>& rows() const { return rows_; }
  [[nodiscard]] std::size_t numStill() const { return numStill_; }
  [[nodiscard]] const std::vector<AroundFeature>& features() const { return around_.features(); }
  /// What the last run() had no rows for: it was never near to anything.
  void forget() { rows_.clear(); }

 private:
  MovingController(const Avatar& avatar, const SolidOptions& options, NearQuery near,
                   PassageProver& prover);
  /// The run at hand.
  struct Run {
    const YieldRequest& request;
    PassageProver& prover;
    Surroundings& around;
    Pose& shown;
    SolidTick& tick;
    std::vector<std::int64_t>& endsUs;
    std::vector<Crusher>& crushers;
    std::int64_t atUs, untilUs;  // the window at hand
  };
  void step(Run& run);
  void gather(Run& run);
  void setBounds(bool mayPushBack);
  void letGoOfWishes();
  [[nodiscard]] bool propose(Run& run);
  void solveAndCorrect(Run& run);
  [[nodiscard]] bool findNearer(Run& run);
  [[nodiscard]] bool correct(Run& run);
  [[nodiscard]] double gapThere(const Run& run, std::size_t row) const;
  [[nodiscard]] bool isPushed() const;
  [[nodiscard]] bool isApproached() const;
  [[nodiscard]] bool hasPushes() const;
  [[nodiscard]] bool go(Run& run, const Pose& to);
  [[nodiscard]] bool ride(Run& run);
  void show(Run& run, const Pose& to, std::int64_t untilUs, double clearance);
  void beCrushed(Run& run);

  SolidOptions options_;
  PulledStep step_;
  NearQuery near_;
  OwnFeatures own_;
  AroundRows around_;
  Scratch scratch_;
  NearFeatures features_;
  BodyState here_, there_;
  std::vector<ContactRow> rows_;
  std::size_t numStill_ = 0;
  std::vector<double> reach_;
  std::vector<std::uint8_t> isAsked_;  // every link
  Pose tried_, reached_, best_;
  double trust_ = 0.0, left_ = 0.0, pulled_ = 0.0;
  std::int64_t windowUs_ = 0;
  double moves_ = 0.0;  // how far bodies near the avatar go in a window
  // For the step at hand.
  std::int64_t bestUs_ = 0;
  double bestClearance_ = 0.0;
  const AroundBody* blocker_ = nullptr;  // that of the last motion that was asked
  LinkId blocked_ = 0;
  JointId blockedBy_ = 0;
};

}  // namespace foretouch::internal
