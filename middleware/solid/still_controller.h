// middleware/solid/still_controller.h: one tick of a solid avatar that has its place, where nothing
// else moves: from the pose shown before towards the target, by certified motions. The algorithm:
// middleware/solid/solid.md 5. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/near/near_features.h"
#include "middleware/solid/certifier.h"
#include "middleware/solid/contact_row.h"
#include "middleware/solid/joint_ranges.h"
#include "middleware/solid/near_rows.h"
#include "middleware/solid/own_features.h"
#include "middleware/solid/pace.h"
#include "middleware/solid/pulled_step.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_phases.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch::internal {

/// What a tick is asked to do.
struct FollowRequest {
  const Pose& target;
  const std::vector<LinkState>& states;        ///< The links at the target.
  const std::vector<Eigen::Vector3d>& wanted;  ///< The body's points there.
  const JointRanges& ranges;                   ///< How far surfaces may turn joints.
  Pace& pace;                                  ///< How far the avatar may move in this tick.
};

/// For one thread; keeps its memory.
class StillController {
 public:
  static Result<StillController> build(const Avatar& avatar, const Scene& scene,
                                       const SolidOptions& options, const Certifier& certifier);

  /// Moves `shown` as near to the target as it gets in this tick. Appends the way to the tick.
  void follow(const FollowRequest& request, Certifier& certifier, Pose& shown, SolidTick& tick);
  /// Asks the whole motion to the target, as the first thing in a tick that touches nothing; true:
  /// it is clear, and shown. If false, follow() goes on from there.
  [[nodiscard]] bool goStraight(const Pose& target, Certifier& certifier, Pose& shown,
                                SolidTick& tick);
  /// Lets only those rows push from now on that hold the shown pose: a step may have been cut
  /// short of what would have stopped the whole of it.
  void letGo();
  /// Forgets contacts.
  void reset();
  /// Null, or what times the phases of ticks; must outlive them.
  void watch(SolidPhases* phases) { phases_ = phases; }

  [[nodiscard]] const VisualBody& body() const { return step_.body(); }
  /// The rows of the tick's last step, by link and LSS, with their pushes; places of those that
  /// push are at the shown pose. Empty if nothing was near.
  [[nodiscard]] const std::vector<ContactRow>& rows() const { return rows_; }
  /// Whether one of them pushes.
  [[nodiscard]] bool hasPushes() const;
  /// Whether links were in contact lately, so that follow() will look around them.
  [[nodiscard]] bool isAnyActive() const;

 private:
  StillController(const Avatar& avatar, const SolidOptions& options, const Certifier& certifier,
                  NearQuery near);

  enum class Outcome : std::uint8_t { Clear, Cut, Stuck };
  [[nodiscard]] Outcome show(const FollowRequest& request, const Pose& to, Certifier& certifier,
                             Pose& shown, SolidTick& tick);
  [[nodiscard]] Certified ask(const Pose& from, const Pose& to, Certifier& certifier,
                              SolidTick& tick);
  [[nodiscard]] bool showCut(const FollowRequest& request, double clearance, Pose& shown,
                             SolidTick& tick);
  [[nodiscard]] bool iterate(const FollowRequest& request, Certifier& certifier, Pose& shown,
                             SolidTick& tick);
  [[nodiscard]] double shareOfDirect(const FollowRequest& request, const Pose& shown);
  [[nodiscard]] bool stepFreely(const FollowRequest& request, double share, Certifier& certifier,
                                Pose& shown, SolidTick& tick);
  void evaluate(const FollowRequest& request, const Pose& pose, BodyState& state) const;
  void standHere(const FollowRequest& request, const Pose& shown);
  void moveThere(const FollowRequest& request, double clearance, Pose& shown, SolidTick& tick);
  void moveRows(const QueryPlan& plan);
  void findReach();
  void aim(const FollowRequest& request, const Pose& shown);
  void gather(const FollowRequest& request, Certifier& certifier, SolidTick& tick);
  [[nodiscard]] bool areAllSoft() const;
  /// Whether its surface is so near, at this gap, that it holds what is shown.
  [[nodiscard]] bool holds(const ContactRow& row, double gap) const;
  [[nodiscard]] bool isHeld(const QueryPlan& plan) const;
  [[nodiscard]] bool warmOwn(const FollowRequest& request, const QueryPlan& plan, double share);
  void trustBy(std::uint64_t gathering);
  void setBounds(bool mayPush);
  [[nodiscard]] bool propose(const FollowRequest& request, const QueryPlan& plan, const Pose& shown,
                             SolidTick& tick);
  [[nodiscard]] double shareToTry(const FollowRequest& request);
  [[nodiscard]] double fitOf(const FollowRequest& request, const Pose& shown) const;
  [[nodiscard]] bool halve(const FollowRequest& request, const QueryPlan& plan, const Pose& shown,
                           double& share, int halvings);
  void goFarther(const FollowRequest& request, const QueryPlan& plan, const Pose& shown,
                 double share);
  void solve(SolidTick& tick);
  [[nodiscard]] bool tryShare(const FollowRequest& request, const Pose& shown, double share);
  [[nodiscard]] bool keepsGaps(const FollowRequest& request, const QueryPlan& plan) const;
  void correctFor(const FollowRequest& request, const QueryPlan& plan, double share);
  [[nodiscard]] bool isTargetApart(const FollowRequest& request, Certifier& certifier);
  [[nodiscard]] double gapAt(const std::vector<LinkState>& states, const QueryPlan& plan,
                             const ContactRow& row) const;
  void keepActive();

  SolidOptions options_;
  Skeleton skeleton_;
  PulledStep step_;
  NearQuery near_;
  OwnFeatures own_;
  Scratch scratch_;
  NearFeatures features_;
  SolidPhases* phases_ = nullptr;

  // What is shown, and what may be next.
  BodyState here_, there_;
  bool isHere_ = false;     // here_ is that of the shown pose
  bool isOfTried_ = false;  // there_ is that of tried_

  // For the current iteration.
  std::vector<double> reach_, activeReach_, touchReach_;
  std::vector<ContactRow> rows_;
  std::vector<LinkState> partStates_;
  bool areRowsOld_ = false;  // here_ was there_ when they were gathered
  Pose tried_, nearer_, reached_, part_;
  double size_ = 0.0;         // that of the whole step that was solved for
  std::uint64_t tries_ = 0;   // shares of it that were tried
  std::uint64_t solved_ = 0;  // sum of the cubes of the rows that its solutions took up
  bool isWhole_ = false;      // all of it is tried, as it was solved for at first

  // For the current tick.
  double trust_ = 0.0, enough_ = 0.0;
  double mostTrust_ = kMostTrust;  // less where much is near
  double mostShare_ = 0.0;         // share of the step that trust and pace allow
  bool hasDirectFailed_ = false, hasMoved_ = false, isOver_ = false;
  // Where goStraight() was cut: the clearance of the motion to reached_; < 0: it was not.
  double cutClearance_ = -1.0;
  Pose cutFrom_;
  int fruitless_ = 0;

  bool isHeldBySelf_ = false;  // by wishes alone
  bool isCaught_ = false;      // has been so for long: no more wishes
  int heldTicks_ = 0;
  std::vector<std::uint8_t> activeFor_;  // per link: ticks for which it counts as in contact
};

}  // namespace foretouch::internal
