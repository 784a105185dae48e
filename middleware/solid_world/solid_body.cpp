#include "middleware/solid_world/solid_body.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/solid/near_rows.h"
#include "middleware/solid/solid_way.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {
namespace {

double secondsOf(std::int64_t us) {
  return 1e-6 * static_cast<double>(us);
}

bool isAmong(const std::vector<HeldTool>& tools, BodyId body) {
  return std::any_of(tools.begin(), tools.end(),
                     [body](const HeldTool& tool) { return tool.body == body; });
}

/// Judges a place for an avatar that would stand there for a whole tick.
class StandingJudge final : public PlaceJudge {
 public:
  StandingJudge(PassageProver& prover, const Surroundings& around, std::int64_t fromUs,
                std::int64_t toUs)
      : prover_(prover), around_(around), fromUs_(fromUs), toUs_(toUs) {}
  [[nodiscard]] bool isFree(const Pose& place) override {
    const Passage passage = prover_.ask({place, place, fromUs_, toUs_}, around_);
    clearance_ = passage.clearance;
    return passage.isClear;
  }
  /// The clearance of the last place.
  [[nodiscard]] double clearance() const { return clearance_; }

 private:
  PassageProver& prover_;
  const Surroundings& around_;
  std::int64_t fromUs_, toUs_;
  double clearance_ = 0.0;
};

const AroundBody* find(const Surroundings& around, BodyId id) {
  for (const AroundBody* const body : around.bodies) {
    if (body->body == id) return body;
  }
  return nullptr;
}

}  // namespace

Result<std::unique_ptr<SolidBody::Outfit>> SolidBody::dress(const Avatar& avatar,
                                                            const Scene& still,
                                                            const SolidOptions& options,
                                                            const std::vector<HeldTool>& tools,
                                                            KindNumbers& numbers) {
  FORETOUCH_TRY(const Equipped whole, equipped(avatar, options, tools));
  FORETOUCH_TRY(auto solid, SolidAvatar::build(whole.avatar, still, whole.options));
  // Completed by it.
  const SolidOptions completed = solid.options();
  FORETOUCH_TRY(auto prover, PassageProver::build(whole.avatar, still, completed));
  FORETOUCH_TRY(auto controller, MovingController::build(whole.avatar, still, completed, prover));
  const std::int32_t number = tools.empty() ? numbers.ofAvatar(avatar.identity()) : numbers.next();
  AroundKind kind{number, whole.avatar.skeleton(), 0, prover.volumes(), std::nullopt, 0.0};
  for (const std::vector<Lss>& link : kind.volumes) {
    for (const Lss& lss : link) {
      kind.rho = std::max(kind.rho, std::max(lss.a.norm(), lss.b.norm()) + lss.radius);
    }
  }
  return std::make_unique<Outfit>(
      Outfit{std::move(kind), std::move(solid), std::move(prover), std::move(controller)});
}

Result<SolidBody> SolidBody::build(BodyId id, const Avatar& avatar, const Scene& still,
                                   const SolidOptions& options, KindNumbers& numbers) {
  if (options.maySnap) {
    return Error::in("maySnap", ErrorCode::Mismatch,
                     "expected false: on a timeline nobody appears somewhere else");
  }
  SolidBody body(id, avatar, still, options);
  FORETOUCH_TRY(body.outfit_, dress(avatar, still, options, {}, numbers));
  body.placing_ = std::make_unique<Placing>(avatar.skeleton(), options);
  return body;
}

Result<Done> SolidBody::checkTarget(const SolidBodyTarget& target) {
  proposed_ = *target.pose;
  FORETOUCH_CHECK(validate(avatar_.skeleton(), proposed_));
  proposedFlags_.clear();
  if (target.isTracked == nullptr) return Done{};
  if (target.isTracked->size() != countOf(avatar_.numLinks())) {
    return Error::in("isTracked", ErrorCode::Mismatch,
                     "expected one flag per joint: " + std::to_string(avatar_.numLinks()));
  }
  proposedFlags_ = *target.isTracked;
  return Done{};
}

void SolidBody::takeTarget() {
  std::swap(target_, proposed_);
  std::swap(flags_, proposedFlags_);
  hasTarget_ = true;
}

Result<Done> SolidBody::hold(bool isNew, const std::vector<HeldTool>& held,
                             const Surroundings& around, std::int64_t us, KindNumbers& numbers) {
  if (isNew) {
    std::vector<HeldTool> kept;
    std::vector<BodyId> dropped;
    for (const HeldTool& tool : worn_) {
      if (std::find(held.begin(), held.end(), tool) != held.end()) kept.push_back(tool);
    }
    for (const HeldTool& tool : held_) {
      if (!isAmong(held, tool.body)) dropped.push_back(tool.body);
    }
    held_ = held;
    if (kept.size() != worn_.size()) FORETOUCH_CHECK(wear(std::move(kept), numbers));
    for (const BodyId body : dropped) {
      const AroundBody* const at = find(around, body);
      if (at == nullptr) continue;
      FORETOUCH_CHECK(outfit_->prover.prepare(around));
      if (!outfit_->prover.at(shown_, *at, us).isClear) letGo_.push_back(body);
    }
  }
  // One that is held but touches something is tried per tick.
  if (worn_.size() == held_.size()) return Done{};
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const HeldTool& tool = held_[(tries_ + i) % held_.size()];
    if (isAmong(worn_, tool.body)) continue;
    FORETOUCH_TRY(const bool may, mayWear(tool, around, us, numbers));
    tries_ = may ? 0 : tries_ + i + 1;
    if (may) {
      putOn(std::move(next_));
      worn_.push_back(tool);
    }
    break;
  }
  return Done{};
}

Result<Done> SolidBody::wear(std::vector<HeldTool> tools, KindNumbers& numbers) {
  FORETOUCH_TRY(auto outfit, dress(avatar_, still_, options_, tools, numbers));
  putOn(std::move(outfit));
  worn_ = std::move(tools);
  next_.reset();
  return Done{};
}

void SolidBody::putOn(std::unique_ptr<Outfit> outfit) {
  outfit->solid.resume(shown_, &outfit_->solid);
  outfit_ = std::move(outfit);
}

/// Whether, with the tool as part of it, it would touch nothing where it is shown.
Result<bool> SolidBody::mayWear(const HeldTool& tool, const Surroundings& around, std::int64_t us,
                                KindNumbers& numbers) {
  if (!next_ || !(tried_ == tool)) {
    std::vector<HeldTool> tools = worn_;
    tools.push_back(tool);
    FORETOUCH_TRY(next_, dress(avatar_, still_, options_, tools, numbers));
    tried_ = tool;
  }
  PassageProver& prover = next_->prover;
  FORETOUCH_CHECK(prover.prepare(around));
  prover.beginTick(options_.workBudget);
  if (!prover.certifier().isClear(shown_, shown_)) return false;
  return std::all_of(around.bodies.begin(), around.bodies.end(),
                     [&](const AroundBody* body) { return prover.at(shown_, *body, us).isClear; });
}

void SolidBody::addTrace(const Pose& from, const Pose& to, std::int64_t fromUs, std::int64_t toUs) {
  AroundLeg& leg = trace_.addLeg();
  leg.beginUs = fromUs;
  leg.endUs = toUs;
  leg.kind = &outfit_->kind;
  leg.from = from;
  leg.to = to;
  leg.rounding = 0.0;
  trace_.settle();
}

void SolidBody::stand(std::int64_t fromUs, std::int64_t toUs) {
  trace_.begin(id_);
  trace_.isSolid = true;
  if (isPlaced_) addTrace(shown_, shown_, fromUs, toUs);
}

void SolidBody::leaveTrace(std::int64_t fromUs, std::int64_t toUs, const SolidTick& tick) {
  // Where it began, unless it appeared.
  before_ = trace_.numLegs() > 0 ? trace_.leg(0).from : shown_;
  trace_.begin(id_);
  trace_.isSolid = true;
  if (!isPlaced_) return;
  const Pose* from = tick.hasAppeared ? &tick.way[0] : &before_;
  std::int64_t beginUs = fromUs;
  for (std::size_t i = tick.hasAppeared ? 1 : 0; i < tick.numWay; ++i) {
    addTrace(*from, tick.way[i], beginUs, endsUs_[i]);
    from = &tick.way[i];
    beginUs = endsUs_[i];
  }
  if (beginUs < toUs) addTrace(*from, *from, beginUs, toUs);
}

/// Those that are apart by now are asked again, the others not.
void SolidBody::partFromLetGo(Surroundings& around, std::int64_t us) {
  const auto isOver = [&](BodyId id) {
    const AroundBody* const body = find(around, id);
    return body == nullptr || outfit_->prover.at(shown_, *body, us).isClear;
  };
  letGo_.erase(std::remove_if(letGo_.begin(), letGo_.end(), isOver), letGo_.end());
  const auto isLetGo = [&](const AroundBody* body) {
    return std::find(letGo_.begin(), letGo_.end(), body->body) != letGo_.end();
  };
  around.bodies.erase(std::remove_if(around.bodies.begin(), around.bodies.end(), isLetGo),
                      around.bodies.end());
}

void SolidBody::endCrushes(const Surroundings& around, std::int64_t us, SolidBodyTick& tick) {
  const auto isOver = [&](const Crusher& crusher) {
    const AroundBody* const body = find(around, crusher.body);
    if (body != nullptr && !outfit_->prover.at(shown_, *body, us).isClear) return false;
    tick.crushes.push_back({crusher.body, crusher.link, crusher.sinceUs, true, 0.0});
    return true;
  };
  crushers_.erase(std::remove_if(crushers_.begin(), crushers_.end(), isOver), crushers_.end());
}

void SolidBody::move(std::int64_t fromUs, std::int64_t toUs, Surroundings& around,
                     SolidBodyTick& tick) {
  tick.body = id_;
  tick.contacts.clear();
  tick.crushes.clear();
  tick.isAssumed = around.isAssumed;
  endsUs_.clear();
  PassageProver& prover = outfit_->prover;
  prover.beginTick(options_.workBudget);
  around.passed.clear();
  around.endUs = toUs;
  // Those that have moved have proven that they meet none that stays.
  if (isPlaced_) around.fallback = shown_;
  if (!isPlaced_) around.fallback.rotations.clear();
  partFromLetGo(around, fromUs);
  endCrushes(around, fromUs, tick);
  for (const Crusher& crusher : crushers_) around.passed.push_back(crusher.body);
  for (const AroundBody* const body : around.bodies) {
    tick.isAssumed = tick.isAssumed || body->isAssumed;
  }
  const Result<Done> followed = outfit_->solid.follow(
      {target_, secondsOf(toUs - fromUs), flags_.empty() ? nullptr : &flags_}, tick.tick);
  FORETOUCH_ASSERT(followed.ok());  // the target was checked
  std::swap(wanted_, lastWanted_);
  placeLinks(avatar_.skeleton(), outfit_->solid.target(), targetStates_);
  outfit_->controller.body().place(targetStates_, wanted_);
  const bool isElsewhere = !isPlaced_ && appear(fromUs, toUs, around, tick.tick);
  if (isPlaced_) around.fallback = shown_;  // one that has just appeared may stay, too
  if (!isPlaced_) {
    stayUnplaced(tick.tick);
  } else if (isElsewhere || !crushers_.empty() || !takeWay(fromUs, toUs, around, tick.tick)) {
    yield(fromUs, toUs, around, tick);
  } else {
    outfit_->controller.forget();
    shown_ = tick.tick.shown;
    proven_ = tick.tick.clearance;
  }
  leaveTrace(fromUs, toUs, tick.tick);
  reportCrushes(around, toUs, tick);
  tick.tools.clear();
  tick.looseTools.clear();
  for (const HeldTool& tool : held_) {
    (isAmong(worn_, tool.body) ? tick.tools : tick.looseTools).push_back(tool.body);
  }
  tick.letGo = letGo_;
}

/// The place that it has in the still scene, if nothing that moves comes there in this tick; else
/// the nearest one of which that is true: then `tick` is no longer what it would do in a still
/// scene, and this returns true.
bool SolidBody::appear(std::int64_t fromUs, std::int64_t toUs, const Surroundings& around,
                       SolidTick& tick) {
  StandingJudge judge(outfit_->prover, around, fromUs, toUs);
  if (tick.state != SolidState::Placing && judge.isFree(tick.way[0])) {
    shown_ = tick.way[0];
    isPlaced_ = true;
    placing_->reset();
    tick.clearance = std::min(tick.clearance, judge.clearance());
    return false;
  }
  outfit_->solid.reset();
  Certifier& certifier = outfit_->prover.certifier();
  isPlaced_ = placing_->search(target_, certifier, before_, &judge);
  tick.counters.placingQueries += certifier.queries();
  if (!isPlaced_) return false;
  shown_ = before_;
  outfit_->solid.resume(shown_);
  beginTick(tick);
  tick.hasAppeared = true;
  appendPiece(shown_, std::min(certifier.clearanceAt(shown_), judge.clearance()), tick);
  return true;
}

void SolidBody::stayUnplaced(SolidTick& tick) {
  isPlaced_ = false;
  beginTick(tick);
  tick.shown = target_;
  tick.state = SolidState::Placing;
  tick.isCertified = false;
  tick.clearance = 0.0;
  spreadTimes(tick);
}

/// What it would do in a still scene, if that is proven among the bodies.
bool SolidBody::takeWay(std::int64_t fromUs, std::int64_t toUs, const Surroundings& around,
                        SolidTick& tick) {
  const std::size_t first = tick.hasAppeared ? 1 : 0;
  const auto pieces = static_cast<std::int64_t>(tick.numWay - std::min(first, tick.numWay));
  if (pieces > toUs - fromUs) return false;
  double clearance = tick.clearance;
  endsUs_.clear();
  if (first > 0) endsUs_.push_back(fromUs);
  const Pose* from = &shown_;
  for (std::int64_t i = 1; i <= std::max<std::int64_t>(pieces, 1); ++i) {
    const Pose* const to = pieces > 0 ? &tick.way[first + static_cast<std::size_t>(i) - 1] : from;
    const std::int64_t beginUs = endsUs_.empty() ? fromUs : endsUs_.back();
    const std::int64_t endUs = pieces > 0 ? fromUs + (toUs - fromUs) * i / pieces : toUs;
    const Passage passage = outfit_->prover.askPart({*from, *to, beginUs, endUs}, around);
    if (!passage.isClear) return false;
    clearance = std::min(clearance, passage.clearance);
    if (pieces > 0) endsUs_.push_back(endUs);
    from = to;
  }
  tick.clearance = tick.numWay > 0 ? clearance : tick.clearance;
  for (std::size_t i = 0; i < tick.numWay; ++i) {
    tick.times[i] = shareOf(fromUs, toUs, endsUs_[i]);
  }
  return true;
}

void SolidBody::yield(std::int64_t fromUs, std::int64_t toUs, Surroundings& around,
                      SolidBodyTick& tick) {
  SolidTick& own = tick.tick;
  const bool hasAppeared = own.hasAppeared;
  const double lift = own.lift;
  const SolidCounters counters = own.counters;
  const double clearance = own.clearance;
  beginTick(own);
  own.lift = lift;
  own.counters = counters;
  endsUs_.clear();
  if (hasAppeared) {
    own.hasAppeared = true;
    own.numWay = 1;
    own.clearance = clearance;
    endsUs_.push_back(fromUs);
  }
  MovingController& controller = outfit_->controller;
  const double step =
      lastWanted_.size() == wanted_.size() ? VisualBody::farthest(wanted_, lastWanted_) : 0.0;
  const double budget = step + options_.catchUp * secondsOf(toUs - fromUs);
  controller.run({outfit_->solid.target(), targetStates_, wanted_, outfit_->solid.ranges(), step,
                  budget, fromUs, toUs},
                 outfit_->prover, around, shown_, own, endsUs_, crushers_);
  finishYield(fromUs, toUs, tick);
  outfit_->solid.resume(shown_);
}

void SolidBody::finishYield(std::int64_t fromUs, std::int64_t toUs, SolidBodyTick& tick) {
  SolidTick& own = tick.tick;
  const std::size_t first = own.hasAppeared ? 1 : 0;
  const Pose& before = own.hasAppeared ? own.way[0] : trace_.leg(0).from;
  const bool hasMoved = std::any_of(own.way.begin() + static_cast<std::ptrdiff_t>(first),
                                    own.way.begin() + static_cast<std::ptrdiff_t>(own.numWay),
                                    [&](const Pose& pose) { return !isSamePose(pose, before); });
  if (!hasMoved) {
    own.numWay = first;
    endsUs_.resize(first);
  }
  own.times.resize(own.numWay);
  for (std::size_t i = 0; i < own.numWay; ++i) own.times[i] = shareOf(fromUs, toUs, endsUs_[i]);
  own.shown = shown_;
  proven_ = own.clearance;
  own.isCertified = crushers_.empty();
  if (!own.isCertified) own.clearance = 0.0;
  own.counters.queries += outfit_->prover.certifier().queries() + outfit_->prover.questions();
  own.counters.work += outfit_->prover.certifier().workDone();
  placeLinks(avatar_.skeleton(), before, statesBefore_);
  report(secondsOf(toUs - fromUs), tick);
  const bool isPushed = std::any_of(own.joints.begin(), own.joints.end(), [](SolidJointState s) {
    return s == SolidJointState::Held || s == SolidJointState::Sliding;
  });
  own.state = isSamePose(shown_, outfit_->solid.target()) ? SolidState::Equal
              : !hasMoved                                 ? SolidState::Held
              : isPushed                                  ? SolidState::Sliding
                                                          : SolidState::Following;
}

void SolidBody::report(double lengthS, SolidBodyTick& tick) {
  SolidTick& own = tick.tick;
  const MovingController& controller = outfit_->controller;
  const std::size_t n = countOf(avatar_.numLinks());
  own.linkDeviation.assign(n, 0.0);
  own.joints.assign(n, SolidJointState::Free);
  own.deviation = 0.0;
  placeLinks(avatar_.skeleton(), shown_, states_);
  controller.body().place(states_, places_);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto link = slotOf(controller.body().points()[k].link);
    const double off = (places_[k] - wanted_[k]).norm();
    own.linkDeviation[link] = std::max(own.linkDeviation[link], off);
    own.deviation = std::max(own.deviation, off);
  }
  for (std::size_t j = 0; j < n && !flags_.empty(); ++j) {
    if (flags_[j] == 0) own.joints[j] = SolidJointState::Lost;
  }
  const auto state = own.numWay == 0 ? SolidJointState::Held : SolidJointState::Sliding;
  const std::vector<ContactRow>& rows = controller.rows();
  const auto slipOf = [&](const ContactRow& row, const Eigen::Vector3d& surfaceV_W) {
    const LinkState &now = states_[slotOf(row.link)], &then = statesBefore_[slotOf(row.link)];
    const Eigen::Vector3d p_L = now.R_WL.transpose() * (row.x - now.p_WL);
    const Eigen::Vector3d v_W = (now.pointAt(p_L) - then.pointAt(p_L)) / lengthS - surfaceV_W;
    return (v_W - row.n * row.n.dot(v_W)).norm();
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ContactRow& row = rows[i];
    if (!(row.push > 0.0) || row.isTurn) continue;
    for (const LinkId link : {row.link, row.other}) {
      if (link != kNoParent && own.joints[slotOf(link)] == SolidJointState::Free) {
        own.joints[slotOf(link)] = state;
      }
    }
    if (i < controller.numStill()) {
      SolidContact contact = contactOf(row);
      contact.slipSpeed = slipOf(row, Eigen::Vector3d::Zero());
      own.contacts.push_back(contact);
      continue;
    }
    const AroundFeature& feature = controller.features()[i - controller.numStill()];
    tick.contacts.push_back({feature.body->body, row.link, row.lss, feature.triangle, row.y, row.n,
                             row.gap, row.push, slipOf(row, feature.velocity_W)});
  }
}

void SolidBody::reportCrushes(const Surroundings& around, std::int64_t us, SolidBodyTick& tick) {
  for (const Crusher& crusher : crushers_) {
    SolidCrush crush{crusher.body, crusher.link, crusher.sinceUs, false, 0.0};
    const AroundBody* const body = find(around, crusher.body);
    if (body != nullptr) {
      const PairAnswer at = outfit_->prover.at(shown_, *body, us);
      if (at.isInside) {
        crush.link = at.link;
        crush.depth = at.penetration;
      }
    }
    tick.crushes.push_back(crush);
  }
}

}  // namespace foretouch::internal
