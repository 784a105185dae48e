#include "middleware/solid_world/moving_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/pair/work_meter.h"
#include "middleware/solid/near_rows.h"
#include "middleware/solid/solid_way.h"

namespace foretouch::internal {
namespace {

// For this room (solid_world.md 5); what is not here is as in a still scene (near_rows.h).
constexpr int kCorrections = 3;
/// A tick has so many windows that no body near the avatar moves farther than this in one (m).
constexpr double kMostMove = 0.015;
constexpr int kMostWindows = 8;
/// Pieces of a tick's way: after that the avatar stays, or is crushed.
constexpr int kMostPieces = 32;
/// A motion that was cut is worth showing at once if it has this share of its window.
constexpr std::int64_t kWorthInverse = 4;
/// A surface that comes less than this (m) in a window does not push.
constexpr double kComes = 1e-7;

}  // namespace

Result<MovingController> MovingController::build(const Avatar& avatar, const Scene& scene,
                                                 const SolidOptions& options,
                                                 PassageProver& prover) {
  FORETOUCH_TRY(auto near, NearQuery::build(avatar, scene, options.ignored));
  return MovingController(avatar, options, std::move(near), prover);
}

MovingController::MovingController(const Avatar& avatar, const SolidOptions& options,
                                   NearQuery near, PassageProver& prover)
    : options_(options),
      step_(avatar, options.visibility),
      near_(std::move(near)),
      own_(prover.certifier().plan()),
      isAsked_(countOf(avatar.numLinks()), 1) {}

void MovingController::run(const YieldRequest& request, PassageProver& prover, Surroundings& around,
                           Pose& shown, SolidTick& tick, std::vector<std::int64_t>& endsUs,
                           std::vector<Crusher>& crushers) {
  Run run{request, prover, around, shown, tick, endsUs, crushers, request.beginUs, request.endUs};
  trust_ = std::clamp(kTrustOfStep * request.trackedStep, kLeastTrust, kMostTrust);
  left_ = request.budget;
  moves_ = 0.0;
  windowUs_ = request.endUs - request.beginUs;
  // How far bodies near it move in the whole tick says how many windows it has.
  step_.place(shown, here_);
  reach_.assign(isAsked_.size(), options_.skin + trust_ + kReachMore + kReachMargin);
  rows_.clear();
  around_.append(prover, around, request.beginUs, request.endUs, here_.states, reach_, rows_);
  const double windows = std::ceil(around_.farthestMove() / kMostMove);
  const auto numWindows = static_cast<std::int64_t>(std::clamp<double>(windows, 1, kMostWindows));
  moves_ = around_.farthestMove() / static_cast<double>(numWindows);
  windowUs_ = (windowUs_ + numWindows - 1) / numWindows;
  for (int piece = 0; run.atUs < request.endUs; ++piece) {
    run.untilUs = std::min(request.endUs, run.atUs + windowUs_);
    if (piece < kMostPieces) {
      step(run);
      continue;
    }
    run.untilUs = request.endUs;
    bestUs_ = run.atUs;
    if (!go(run, shown)) beCrushed(run);
  }
}

/// Shows one piece, or finds what crushes the avatar.
void MovingController::step(Run& run) {
  bestUs_ = run.atUs;
  blocker_ = nullptr;
  step_.place(run.shown, here_);
  step_.evaluate(run.request.target, run.request.wanted, run.shown, here_);
  gather(run);
  if (propose(run) && go(run, tried_)) return;
  if (isApproached()) {
    step_.pullLess(0.0);
    pulled_ = 0.0;
    setBounds(true);
    solveAndCorrect(run);
    if (go(run, tried_)) return;
    if (ride(run) && go(run, tried_)) return;
  }
  if (go(run, run.shown)) return;
  if (bestUs_ > run.atUs) {
    show(run, best_, bestUs_, bestClearance_);
  } else {
    beCrushed(run);
  }
}

/// The rows of what is near, and the pull of the target.
void MovingController::gather(Run& run) {
  rows_.clear();
  step_.aim(run.request.target, run.request.wanted, here_, run.shown);
  const double size = step_.sizeOfFree(here_);
  const double most = std::min(trust_, left_);
  const double share = size > most ? most / size : 1.0;
  if (share < 1.0) step_.pullLess(share);
  pulled_ = share * size;
  step_.farthestFree(here_, reach_);
  for (double& reach : reach_) {
    reach = reachFor(reach, trust_, options_.skin) + moves_;
  }
  near_.answer(here_.states, reach_, scratch_, features_);
  appendRows(features_, rows_);
  Certifier& certifier = run.prover.certifier();
  own_.append(certifier.plan(), {here_.states, run.request.states}, options_.skin, reach_, isAsked_,
              rows_);
  run.request.ranges.append(here_.states, trust_ / kTwistLever, rows_);
  numStill_ = rows_.size();
  around_.append(run.prover, run.around, run.atUs, run.untilUs, here_.states, reach_, rows_);
  if (isApproached()) letGoOfWishes();
  ++run.tick.counters.iterations;
  run.tick.counters.features += static_cast<std::uint32_t>(rows_.size());
  certifier.spend(kIterationWork + kRowWork * rows_.size() + WorkMeter::workOf(features_.counters));
}

/// What each row must keep, once its surface has come as far as it does.
void MovingController::setBounds(bool mayPushBack) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    ContactRow& row = rows_[i];
    row.bias = 0.0;
    row.bound = boundOf(row, options_.skin, mayPushBack);
    if (i >= numStill_) row.bound += around_.features()[i - numStill_].comes;
  }
}

/// An avatar that has to get out of the way bends as it must, and puts a thigh into the other.
void MovingController::letGoOfWishes() {
  const auto isWish = [](const ContactRow& row) { return row.isSoft; };
  const auto still = rows_.begin() + static_cast<std::ptrdiff_t>(numStill_);
  const auto kept = std::remove_if(rows_.begin(), still, isWish);
  numStill_ = static_cast<std::size_t>(kept - rows_.begin());
  rows_.erase(kept, still);
}

/// A pose for the window's end that is nearer to the target, or out of the way: tried_.
bool MovingController::propose(Run& run) {
  setBounds(true);
  solveAndCorrect(run);
  if (isPushed()) return true;
  if (!hasPushes() && VisualBody::farthest(here_.places, run.request.wanted) <= left_) {
    tried_ = run.request.target;
    return true;
  }
  if (findNearer(run)) return true;
  setBounds(false);
  solveAndCorrect(run);
  return findNearer(run);
}

/// Solves for the step; the next solution keeps away from what the surfaces' curvature takes of the
/// gaps at its end. The certificate cuts what still comes too near at the last one's end.
void MovingController::solveAndCorrect(Run& run) {
  step_.begin();
  for (int attempt = 0;; ++attempt) {
    run.tick.counters.rows += static_cast<std::uint32_t>(step_.solve(rows_));
    step_.move(here_, run.shown, 1.0, tried_);
    step_.place(tried_, there_);
    if (correct(run) || attempt == kCorrections) return;
  }
}

/// True: nothing to correct.
bool MovingController::correct(Run& run) {
  bool isKept = true;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    ContactRow& row = rows_[i];
    if (!(row.push > 0.0)) continue;
    const double aimed = row.isTurn ? 0.0 : kAimed * options_.skin - row.slack;
    const double wanted = std::min(row.gap, aimed);
    const double gap = gapThere(run, i);
    if (gap >= (wanted > 0.0 ? kKeptGap * wanted : wanted)) continue;
    row.bias += wanted - gap;
    isKept = false;
  }
  return isKept;
}

double MovingController::gapThere(const Run& run, std::size_t i) const {
  const ContactRow& row = rows_[i];
  if (i >= numStill_) {
    return around_.gapAtEnd(row, around_.features()[i - numStill_], run.prover.volumes(),
                            there_.states);
  }
  if (row.isTurn) return run.request.ranges.gapAt(there_.states, row);
  return gapOf(run.prover.certifier().plan(), row, there_.states);
}

/// Whether something comes, and the step goes out of its way: it may lead away from the target.
bool MovingController::isPushed() const {
  for (std::size_t i = numStill_; i < rows_.size(); ++i) {
    if (!(rows_[i].push > 0.0)) continue;
    if (around_.features()[i - numStill_].comes > kComes || rows_[i].gap < 0.0) return true;
  }
  return false;
}

/// Whether something near comes.
bool MovingController::isApproached() const {
  const std::vector<AroundFeature>& features = around_.features();
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features[i].comes > kComes || rows_[numStill_ + i].gap < 0.0) return true;
  }
  return false;
}

bool MovingController::hasPushes() const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [](const ContactRow& row) { return row.push > 0.0; });
}

/// The step, or a half of a half of it, until it is nearer to the target.
bool MovingController::findNearer(Run& run) {
  if (step_.size(here_) < kSettled) return false;
  double share = 1.0;
  for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5) {
    step_.move(here_, run.shown, share, tried_);
    step_.place(tried_, there_);
    step_.evaluate(run.request.target, run.request.wanted, tried_, there_);
    if (there_.cost < kFalls * here_.cost) return true;
  }
  return false;
}

/// Moves the whole avatar as if it were fixed to what is in its way: tried_.
bool MovingController::ride(Run& run) {
  const AroundRows::Placed* const at = blocker_ == nullptr ? nullptr : around_.placed(blocker_);
  if (at == nullptr) return false;
  const JointId joint = blockedBy_ + at->atBegin->kind->first;
  const LinkState& from = at->begin[slotOf(joint)];
  const LinkState& to = at->end[slotOf(joint + at->atEnd->kind->first - at->atBegin->kind->first)];
  const Eigen::Matrix3d turn = to.R_WL * from.R_WL.transpose();
  const Quaternion by(turn);
  tried_ = run.shown;
  for (std::size_t j = 0; j < tried_.rotations.size(); ++j) {
    if (step_.skeleton().parents()[j] != kNoParent) continue;
    tried_.rotations[j] = (by * tried_.rotations[j]).normalized();
    tried_.translations[j] = to.p_WL + turn * (tried_.translations[j] - from.p_WL);
  }
  pulled_ = 0.0;
  return true;
}

/// Asks the motion to a pose in the window at hand, and shows it if enough of it is proven.
bool MovingController::go(Run& run, const Pose& to) {
  std::int64_t reachedUs = 0;
  const Passage passage =
      run.prover.advance({run.shown, to, run.atUs, run.untilUs}, run.around, reached_, reachedUs);
  if (passage.isOverBudget) run.tick.limit = SolidLimit::Budget;
  if (!passage.isClear && passage.blocker != nullptr) {
    blocker_ = passage.blocker;
    blocked_ = passage.link;
    blockedBy_ = passage.other;
  }
  if (reachedUs > bestUs_) {
    bestUs_ = reachedUs;
    bestClearance_ = passage.clearance;
    std::swap(best_, reached_);
    if ((reachedUs - run.atUs) * kWorthInverse >= run.untilUs - run.atUs) {
      show(run, best_, bestUs_, bestClearance_);
      return true;
    }
  }
  return false;
}

void MovingController::show(Run& run, const Pose& to, std::int64_t untilUs, double clearance) {
  appendPiece(to, clearance, run.tick);
  run.endsUs.push_back(untilUs);
  left_ = std::max(0.0, left_ - pulled_);
  run.shown = to;
  run.atUs = untilUs;
  run.around.fallback = run.shown;  // the proof of the motion was one of this, too
}

/// Not even staying is proven: from here on, nothing is claimed of the avatar and what is in its
/// way.
void MovingController::beCrushed(Run& run) {
  // An avatar that stays is blocked by a body alone.
  FORETOUCH_ASSERT(blocker_ != nullptr);
  run.crushers.push_back({blocker_->body, blocked_, run.atUs});
  run.around.passed.push_back(blocker_->body);
}

}  // namespace foretouch::internal
