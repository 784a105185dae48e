#include "middleware/solid/still_controller.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/pair/work_meter.h"
#include "middleware/solid/near_rows.h"
#include "middleware/solid/solid_way.h"

namespace foretouch::internal {
namespace {

// Where each comes from: solid.md 7; what is not here, near_rows.h has.
constexpr int kMostIterations = 8, kMostFruitless = 4;
/// A tick ends with a step below this share of the tracked one, and at most this long (m): the rest
/// waits for the next tick. A still target is followed until the avatar rests.
constexpr double kEnoughOfStep = 0.2, kMostEnough = 1.5e-3;
/// The step that a second solution would take, as a rule: what the first one's circles about
/// joints so far away are off their tangents (m).
constexpr double kLever = 0.3;
constexpr std::uint8_t kActiveTicks = 8;
/// The share taken of a step that the pace allows to first order: the path is a little longer.
constexpr double kWithinPace = 0.99;
/// Where gathering costs more than this (evaluations in lanes), the next step is half as long, down
/// to `kLeastAmongMuch` (m); where it costs less than a quarter of it, twice as long again.
constexpr std::uint64_t kMuchNear = 6'000;
constexpr double kLeastAmongMuch = 5e-3;
constexpr int kDoublings = 3, kCorrections = 2;
/// What is not proven but wished for may be missed by so much in a step (m).
constexpr double kSoft = 5e-3;
/// No joint turns back for less (m, as the gaps of ranges).
constexpr double kSameTurn = 1e-4;
/// A row holds what is shown within this share of the skin.
constexpr double kHolds = 1.25;
/// Two faces are of one plane: a cosine, and metres, as where near features are reduced.
constexpr double kSamePlane = 1.0 - 1e-6, kInPlane = 1e-4;

}  // namespace

Result<StillController> StillController::build(const Avatar& avatar, const Scene& scene,
                                               const SolidOptions& options,
                                               const Certifier& certifier) {
  FORETOUCH_TRY(auto near, NearQuery::build(avatar, scene, options.ignored));
  return StillController(avatar, options, certifier, std::move(near));
}

StillController::StillController(const Avatar& avatar, const SolidOptions& options,
                                 const Certifier& certifier, NearQuery near)
    : options_(options),
      skeleton_(avatar.skeleton()),
      step_(avatar, options.visibility),
      near_(std::move(near)),
      own_(certifier.plan()) {
  activeFor_.assign(countOf(skeleton_.numJoints()), 0);
}

void StillController::reset() {
  isCaught_ = false;
  heldTicks_ = 0;
  mostTrust_ = kMostTrust;
  cutClearance_ = -1.0;
  std::fill(activeFor_.begin(), activeFor_.end(), std::uint8_t{0});
  rows_.clear();
}

bool StillController::isAnyActive() const {
  return std::any_of(activeFor_.begin(), activeFor_.end(), [](std::uint8_t t) { return t != 0; });
}

bool StillController::goStraight(const Pose& target, Certifier& certifier, Pose& shown,
                                 SolidTick& tick) {
  cutClearance_ = -1.0;
  if (isSamePose(shown, target)) {
    rows_.clear();
    return true;
  }
  const Certified answer = ask(shown, target, certifier, tick);
  if (!answer.isClear) {
    if (answer.share > 0.0) {
      cutClearance_ = answer.clearance;
      cutFrom_ = shown;
    }
    return false;
  }
  rows_.clear();
  appendPiece(reached_, answer.clearance, tick);
  std::swap(shown, reached_);
  return true;
}

void StillController::follow(const FollowRequest& request, Certifier& certifier, Pose& shown,
                             SolidTick& tick) {
  const double trackedStep = request.pace.trackedStep();
  trust_ = std::clamp(kTrustOfStep * trackedStep, kLeastTrust, kMostTrust);
  enough_ = std::clamp(kEnoughOfStep * trackedStep, kSettled, kMostEnough);
  fruitless_ = 0;
  hasMoved_ = false;
  rows_.clear();
  areRowsOld_ = false;
  hasDirectFailed_ = cutClearance_ >= 0.0 && isSamePose(shown, cutFrom_);
  isHere_ = isOfTried_ = false;
  if (hasDirectFailed_) {
    standHere(request, shown);
    (void)showCut(request, cutClearance_, shown, tick);
  }
  cutClearance_ = -1.0;
  isOver_ = isHeldBySelf_ = false;
  for (int i = 0; i < kMostIterations && !isOver_; ++i) {
    if (!iterate(request, certifier, shown, tick)) break;
  }
  if (areRowsOld_) moveRows(certifier.plan());
  keepActive();
  // No avatar is caught by itself: wishes that hold it for long are dropped until it is free.
  heldTicks_ = isHeldBySelf_ ? heldTicks_ + 1 : 0;
  isCaught_ = (isCaught_ || heldTicks_ > kActiveTicks) && !isSamePose(shown, request.target);
}

/// One step; false if the tick is over.
bool StillController::iterate(const FollowRequest& request, Certifier& certifier, Pose& shown,
                              SolidTick& tick) {
  rows_.clear();
  if (isSamePose(shown, request.target)) return false;
  if (certifier.workLeft() == 0) {
    tick.limit = SolidLimit::Budget;
    return false;
  }
  standHere(request, shown);
  if (!isAnyActive()) {
    const double share = shareOfDirect(request, shown);
    if (!warmOwn(request, certifier.plan(), share)) {
      return stepFreely(request, share, certifier, shown, tick);
    }
  }

  aim(request, shown);
  gather(request, certifier, tick);
  tries_ = 0;
  solved_ = 0;
  const bool hasStep = propose(request, certifier.plan(), shown, tick);
  certifier.spend(kTryWork * tries_ + solved_ / kCubesPerWork);
  if (!hasPushes() && (!hasDirectFailed_ || size_ <= trust_)) {
    return stepFreely(request, shareOfDirect(request, shown), certifier, shown, tick);
  }
  isHeldBySelf_ = !hasStep && hasPushes() && areAllSoft();
  if (hasPushes() && !hasDirectFailed_ && request.pace.mayGo(here_.places, request.wanted) &&
      shareOfDirect(request, shown) == 1.0 && isTargetApart(request, certifier)) {
    // What pushes is the skin, or a surface that the direct motion passes by.
    const Certified direct = ask(shown, request.target, certifier, tick);
    if (direct.isClear) {
      rows_.clear();
      appendPiece(reached_, direct.clearance, tick);
      std::swap(shown, reached_);
    }
    if (direct.isClear || isOver_) return false;
    hasDirectFailed_ = true;
  }
  if (!hasStep || (hasMoved_ && size_ < enough_ && isHeld(certifier.plan()))) return false;
  const bool isShort = mostShare_ < 1.0;
  const double moved = std::min(1.0, mostShare_) * size_;
  const Outcome outcome = show(request, tried_, certifier, shown, tick);
  if (outcome != Outcome::Clear) return ++fruitless_ < kMostFruitless;
  const bool isNearlyThere = moved * moved < 2.0 * kLever * enough_;
  if (isWhole_ && isNearlyThere && enough_ > kSettled) return !isHeld(certifier.plan());
  if (isShort && trust_ < size_) trust_ = std::min(2.0 * trust_, kMostTrust);
  if (!request.pace.isSpent()) return moved >= enough_;
  if (isShort) tick.limit = SolidLimit::CatchUp;
  return false;
}

/// How much of the direct motion the pace allows; part_ becomes the pose there, if it is not all.
double StillController::shareOfDirect(const FollowRequest& request, const Pose& shown) {
  return request.pace.shareOf(shown, request.target, part_);
}

/// Nothing holds the avatar: straight to the target, or to part_, as far as the pace allows.
bool StillController::stepFreely(const FollowRequest& request, double share, Certifier& certifier,
                                 Pose& shown, SolidTick& tick) {
  const bool isWhole = share == 1.0;
  if (!isWhole) {
    tick.limit = SolidLimit::CatchUp;
    if (!(share > 0.0) || request.pace.isSpent()) return false;
  }
  const Outcome outcome = show(request, isWhole ? request.target : part_, certifier, shown, tick);
  if (outcome == Outcome::Clear) return false;
  hasDirectFailed_ = true;
  trust_ = std::max(0.5 * trust_, 0.5 * kLeastTrust);
  return outcome == Outcome::Cut || ++fruitless_ < kMostFruitless;
}

Certified StillController::ask(const Pose& from, const Pose& to, Certifier& certifier,
                               SolidTick& tick) {
  const Certified answer = certifier.certify(from, to, reached_);
  if (answer.isOverBudget) tick.limit = SolidLimit::Budget;
  isOver_ = answer.isOverBudget || answer.isInside;
  if (answer.hasHit) {
    activeFor_[slotOf(answer.hit.link)] = kActiveTicks;
    if (answer.hit.other != kNoParent) activeFor_[slotOf(answer.hit.other)] = kActiveTicks;
  }
  return answer;
}

/// Certifies the motion, and shows what is proven of it, if that is nearer to the target.
StillController::Outcome StillController::show(const FollowRequest& request, const Pose& to,
                                               Certifier& certifier, Pose& shown, SolidTick& tick) {
  const Certified answer = ask(shown, to, certifier, tick);
  if (answer.isClear) {
    const bool isPlaced = &to == &tried_ && isOfTried_;
    if (!isPlaced) step_.place(reached_, there_);
    moveThere(request, answer.clearance, shown, tick);
    isHere_ = isPlaced;
    return Outcome::Clear;
  }
  if (!(answer.share > 0.0)) return Outcome::Stuck;
  return showCut(request, answer.clearance, shown, tick) ? Outcome::Cut : Outcome::Stuck;
}

/// A piece that was cut is part of a way on which the cost falls in the end, perhaps not at once.
bool StillController::showCut(const FollowRequest& request, double clearance, Pose& shown,
                              SolidTick& tick) {
  step_.place(reached_, there_);
  evaluate(request, reached_, there_);
  isOfTried_ = false;
  if (!(there_.cost < kFalls * here_.cost)) return false;
  moveThere(request, clearance, shown, tick);
  return true;
}

/// Shows what was reached, whose state is there_.
void StillController::moveThere(const FollowRequest& request, double clearance, Pose& shown,
                                SolidTick& tick) {
  request.pace.spend(shown, reached_, here_.places, there_.places);
  appendPiece(reached_, clearance, tick);
  std::swap(shown, reached_);
  std::swap(here_, there_);
  isOfTried_ = false;
  hasMoved_ = areRowsOld_ = true;
}

/// Rows that push go along with their links from there_ to here_: faces stay below them.
void StillController::moveRows(const QueryPlan& plan) {
  for (ContactRow& row : rows_) {
    if (!(row.push > 0.0) || row.isTurn) continue;
    const LinkState &from = there_.states[slotOf(row.link)], &to = here_.states[slotOf(row.link)];
    if (row.isFace && row.other == kNoParent) {
      const Lss& lss = plan.avatar.lss(row.link)[slotOf(row.lss)];
      const Eigen::Vector3d held = to.pointAt(lss.a + row.along * (lss.b - lss.a));
      const double height = row.n.dot(held - row.y);
      row.gap = height - lss.radius;
      row.x = held - lss.radius * row.n;
      row.y = held - height * row.n;
    } else {
      row.gap = gapOf(plan, row, here_.states);
      row.x = to.pointAt(from.R_WL.transpose() * (row.x - from.p_WL));
    }
  }
}

/// Makes here_ that of the shown pose, unless it is.
void StillController::standHere(const FollowRequest& request, const Pose& shown) {
  if (std::exchange(isHere_, true)) return;
  step_.place(shown, here_);
  evaluate(request, shown, here_);
}

void StillController::evaluate(const FollowRequest& request, const Pose& pose,
                               BodyState& state) const {
  step_.evaluate(request.target, request.wanted, pose, state);
}

/// How far to look for surfaces around each link, and around those that are in contact.
void StillController::findReach() {
  const std::size_t n = activeFor_.size();
  step_.farthestFree(here_, reach_);
  activeReach_.resize(n);
  for (std::size_t link = 0; link < n; ++link) {
    reach_[link] = reachFor(reach_[link], trust_, options_.skin);
    activeReach_[link] = activeFor_[link] != 0 ? reach_[link] : -1.0;
  }
}

void StillController::aim(const FollowRequest& request, const Pose& shown) {
  const PhaseScope scope(phases_, SolidPhase::Solve);
  step_.aim(request.target, request.wanted, here_, shown);
}

void StillController::gather(const FollowRequest& request, Certifier& certifier, SolidTick& tick) {
  const PhaseScope scope(phases_, SolidPhase::Gather);
  trust_ = std::min(trust_, mostTrust_);
  findReach();
  areRowsOld_ = false;
  near_.answer(here_.states, activeReach_, scratch_, features_);
  const std::uint64_t work = WorkMeter::workOf(features_.counters);
  trustBy(work);
  appendRows(features_, rows_);
  if (options_.self || !isCaught_) {
    own_.append(certifier.plan(), {here_.states, request.states}, options_.skin, reach_, activeFor_,
                rows_);
  }
  if (!isCaught_) request.ranges.append(here_.states, trust_ / kTwistLever, rows_);
  ++tick.counters.iterations;
  tick.counters.features += static_cast<std::uint32_t>(rows_.size());
  certifier.spend(kIterationWork + kRowWork * rows_.size() + work);
}

/// Where much is near, looking far around costs more than short steps do.
void StillController::trustBy(std::uint64_t gathering) {
  if (gathering > kMuchNear) {
    mostTrust_ = std::max(0.5 * mostTrust_, kLeastAmongMuch);
  } else if (4 * gathering < kMuchNear) {
    mostTrust_ = std::min(2.0 * mostTrust_, kMostTrust);
  }
}

void StillController::setBounds(bool mayPush) {
  for (ContactRow& row : rows_) {
    row.bias = 0.0;
    row.bound = boundOf(row, options_.skin, mayPush);
  }
}

/// Finds a step that brings the avatar nearer to the target and keeps the gaps that push: `tried_`.
/// False: there is none, or none worth a motion.
bool StillController::propose(const FollowRequest& request, const QueryPlan& plan,
                              const Pose& shown, SolidTick& tick) {
  const PhaseScope scope(phases_, SolidPhase::Try);
  step_.begin();
  setBounds(true);
  isWhole_ = false;
  for (int attempt = 0; attempt <= kCorrections; ++attempt) {
    solve(tick);
    if (size_ < kSettled) return false;
    double share = shareToTry(request);
    const bool isLast = attempt == kCorrections;
    if (halve(request, plan, shown, share, isLast ? kHalvings : 0)) {
      isWhole_ = attempt == 0 && share == 1.0;
      goFarther(request, plan, shown, share);
      return true;
    }
    if (!isLast) correctFor(request, plan, share);
  }
  setBounds(false);
  solve(tick);
  if (size_ < kSettled) return false;
  double share = shareToTry(request);
  return halve(request, plan, shown, share, kHalvings);
}

/// How much of the step that was solved for the trust region and the pace allow.
double StillController::shareToTry(const FollowRequest& request) {
  const double within = kWithinPace * request.pace.shareOf(step_.moveOf(here_, request.pace));
  mostShare_ = std::min(trust_ / size_, within);
  return std::min(1.0, mostShare_);
}

/// Tries the share, and its halves, until one is nearer to the target and keeps the gaps.
bool StillController::halve(const FollowRequest& request, const QueryPlan& plan, const Pose& shown,
                            double& share, int halvings) {
  for (int halving = 0;; ++halving) {
    bool isNearer = tryShare(request, shown, share);
    const double fits = fitOf(request, shown);
    if (fits < 1.0) {
      share *= kWithinPace * fits;
      isNearer = tryShare(request, shown, share);
    }
    if (isNearer && keepsGaps(request, plan)) return true;
    if (halving == halvings) return false;
    share *= 0.5;
  }
}

/// Where the target rests, steps of this method become shorter by a constant share: twice the step
/// is tried as long as that is nearer to the target.
void StillController::goFarther(const FollowRequest& request, const QueryPlan& plan,
                                const Pose& shown, double share) {
  // Doubled steps along the ends of ranges, which curve, would make much of what is off a little.
  const auto isEnd = [](const ContactRow& row) { return row.isTurn && row.push > 0.0; };
  if (enough_ > kSettled || std::any_of(rows_.begin(), rows_.end(), isEnd)) return;
  for (int doubling = 0; doubling < kDoublings; ++doubling) {
    if (2.0 * share > mostShare_) return;
    nearer_ = tried_;
    const double cost = there_.cost;
    const bool isNearer = tryShare(request, shown, 2.0 * share);
    if (!isNearer || there_.cost >= kFalls * cost || fitOf(request, shown) < 1.0 ||
        !keepsGaps(request, plan)) {
      tried_ = nearer_;
      isOfTried_ = false;
      return;
    }
    share *= 2.0;
  }
}

/// How much of the way to tried_ the pace allows.
double StillController::fitOf(const FollowRequest& request, const Pose& shown) const {
  return request.pace.shareOf(request.pace.measure(shown, tried_, here_.places, there_.places));
}

void StillController::solve(SolidTick& tick) {
  const PhaseScope scope(phases_, SolidPhase::Solve);
  const std::size_t taken = step_.solve(rows_);
  tick.counters.rows += static_cast<std::uint32_t>(taken);
  solved_ += taken * taken * taken;
  size_ = step_.size(here_);
}

bool StillController::tryShare(const FollowRequest& request, const Pose& shown, double share) {
  ++tries_;
  step_.move(here_, shown, share, tried_);
  step_.place(tried_, there_);
  evaluate(request, tried_, there_);
  isOfTried_ = true;
  return there_.cost < kFalls * here_.cost;
}

/// At the target, what pushes is apart, and so is its link from all else: perhaps nothing is in the
/// way. By the surface, not by the triangle alone, lest its neighbours are asked in vain.
bool StillController::isTargetApart(const FollowRequest& request, Certifier& certifier) {
  const PhaseScope scope(phases_, SolidPhase::Gather);
  const bool areApart = std::all_of(rows_.begin(), rows_.end(), [&](const ContactRow& row) {
    return !(row.push > 0.0) || row.isSoft || gapOf(certifier.plan(), row, request.states) > 0.0;
  });
  if (!areApart) return false;
  touchReach_.assign(activeFor_.size(), -1.0);
  for (const ContactRow& row : rows_) {
    if (row.push > 0.0) touchReach_[slotOf(row.link)] = 0.0;
  }
  near_.answer(request.states, touchReach_, scratch_, features_, NearDetail::Nearest);
  certifier.spend(WorkMeter::workOf(features_.counters));
  return std::all_of(features_.features.begin(), features_.features.end(),
                     [](const NearFeature& feature) { return feature.gap > 0.0; });
}

/// The row's gap; for a face, at the points on the axis that its plane holds, however it is cut.
double StillController::gapAt(const std::vector<LinkState>& states, const QueryPlan& plan,
                              const ContactRow& row) const {
  if (!row.isFace) return gapOf(plan, row, states);
  const Lss& lss = plan.avatar.lss(row.link)[slotOf(row.lss)];
  const LinkState& state = states[slotOf(row.link)];
  const auto isOfLss = [&](const ContactRow& other) {
    return other.link == row.link && other.lss == row.lss && other.other == kNoParent;
  };
  const ContactRow *first = &row, *const end = rows_.data() + rows_.size();
  while (first != rows_.data() && isOfLss(first[-1])) --first;
  double least = std::numeric_limits<double>::infinity();
  for (; first != end && isOfLss(*first); ++first) {
    if (!first->isFace || row.n.dot(first->n) < kSamePlane) continue;
    if (std::abs(row.n.dot(first->y - row.y)) > kInPlane) continue;
    const Eigen::Vector3d held = state.pointAt(lss.a + first->along * (lss.b - lss.a));
    least = std::min(least, row.n.dot(held - row.y) - lss.radius);
  }
  return least;
}

bool StillController::keepsGaps(const FollowRequest& request, const QueryPlan& plan) const {
  return std::all_of(rows_.begin(), rows_.end(), [&](const ContactRow& row) {
    if (row.isTurn) {  // at most kSoft beyond its end, or not farther than it is
      return request.ranges.gapAt(there_.states, row) >= std::min(row.gap - kSameTurn, -kSoft);
    }
    if (!(row.push > 0.0)) return true;
    const double gap = gapAt(there_.states, plan, row);
    if (row.isSoft) return gap >= std::min(row.gap, -row.slack) - kSoft;
    return gap >= std::min(kKeptGap * row.gap, kRest * options_.skin);
  });
}

/// Makes the next solution keep away from what the surfaces' curvature took of the gaps at the
/// share that was tried.
void StillController::correctFor(const FollowRequest& request, const QueryPlan& plan,
                                 double share) {
  for (ContactRow& row : rows_) {
    if (!(row.push > 0.0 || row.isTurn)) continue;
    const double aimed = row.isTurn ? 0.0 : kAimed * options_.skin - row.slack;
    const double wanted = std::min(row.gap, aimed);
    const double gap =
        row.isTurn ? request.ranges.gapAt(there_.states, row) : gapAt(there_.states, plan, row);
    if (gap < wanted) row.bias += (wanted - gap) / share;
  }
}

bool StillController::areAllSoft() const {
  return std::all_of(rows_.begin(), rows_.end(),
                     [](const ContactRow& row) { return !(row.push > 0.0) || row.isSoft; });
}

/// Straight on to part_, the body would dig into itself deeper than the target does: those links
/// are in contact. O(pairs of LSS).
bool StillController::warmOwn(const FollowRequest& request, const QueryPlan& plan, double share) {
  if (options_.self || isCaught_) return false;
  if (!(share > 0.0 && share < 1.0)) return false;  // the target is as it is
  placeLinks(skeleton_, part_, partStates_);
  const auto deeper =
      own_.findDeeper(plan, partStates_, {here_.states, request.states}, options_.skin);
  if (deeper.one == kNoParent) return false;
  activeFor_[slotOf(deeper.one)] = activeFor_[slotOf(deeper.other)] = kActiveTicks;
  return true;
}

bool StillController::holds(const ContactRow& row, double gap) const {
  return !row.isTurn && gap + row.slack <= kHolds * options_.skin;
}

/// Whether something that pushes is near enough to hold what is shown, or nothing pushes.
bool StillController::isHeld(const QueryPlan& plan) const {
  bool isPushed = false;
  for (const ContactRow& row : rows_) {
    if (!(row.push > 0.0) || row.isTurn) continue;
    if (holds(row, gapAt(here_.states, plan, row))) return true;
    isPushed = true;
  }
  return !isPushed;
}

bool StillController::hasPushes() const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [](const ContactRow& row) { return row.push > 0.0; });
}

void StillController::keepActive() {
  for (std::uint8_t& ticks : activeFor_)
    ticks = ticks != 0 ? static_cast<std::uint8_t>(ticks - 1) : ticks;
  for (const ContactRow& row : rows_) {
    if (!(row.push > 0.0) || row.isTurn) continue;
    activeFor_[slotOf(row.link)] = kActiveTicks;
    if (row.other != kNoParent) activeFor_[slotOf(row.other)] = kActiveTicks;
  }
}

void StillController::letGo() {
  for (ContactRow& row : rows_) {
    if (!holds(row, row.gap)) row.push = 0.0;
  }
}

}  // namespace foretouch::internal
