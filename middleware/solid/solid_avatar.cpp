#include "middleware/solid/solid_avatar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/solid/certifier.h"
#include "middleware/solid/floor_lift.h"
#include "middleware/solid/near_rows.h"
#include "middleware/solid/pace.h"
#include "middleware/solid/placing.h"
#include "middleware/solid/solid_checks.h"
#include "middleware/solid/solid_way.h"
#include "middleware/solid/still_controller.h"
#include "middleware/solid/stuck_watch.h"
#include "middleware/solid/target_pose.h"
#include "middleware/solid/tree_pose.h"
#include "middleware/solid/way_around.h"

namespace foretouch {
namespace {

constexpr double kLongestTick = 10.0;
/// Two places of one root are the same (m).
constexpr double kSamePlace = 1e-6;
/// Pieces of a way around in one tick: among narrow places it has many, and they cost.
constexpr int kMostPieces = 8;

}  // namespace

class SolidAvatar::Parts {
 public:
  Parts(const Avatar& avatar, SolidOptions options, internal::Certifier certifier,
        internal::StillController controller)
      : options_(std::move(options)),
        certifier_(std::move(certifier)),
        controller_(std::move(controller)),
        target_(avatar),
        lift_(avatar, options_),
        placing_(avatar.skeleton(), options_),
        around_(avatar, options_),
        stuck_(options_),
        pace_(avatar, controller_.body(), options_) {}

  Result<Done> follow(const SolidTarget& given, SolidTick& tick) {
    if (!(given.dtS > 0.0 && given.dtS <= kLongestTick)) {
      return Error::in("dtS", ErrorCode::OutOfRange, "expected more than 0 and at most 10 seconds");
    }
    FORETOUCH_CHECK(target_.take(given, isPlaced_ ? &shown_ : nullptr));
    if (phases_ != nullptr) phases_->begin();
    certifier_.beginTick(options_.workBudget);
    internal::beginTick(tick);
    isAround_ = false;
    if (!isPlaced_) place(tick);
    if (isPlaced_) move(given.dtS, tick);
    lift_.remember(controller_.rows());
    controller_.letGo();
    finish(given.dtS, tick);
    if (phases_ != nullptr) phases_->enter(internal::SolidPhase::Other);
    return Done{};
  }

  void reset() {
    isPlaced_ = wasEqual_ = isInside_ = false;
    forget();
    lift_.reset();
    target_.reset();
  }

  Result<Done> reset(const Pose& given) {
    Pose place = given;
    FORETOUCH_CHECK(inFile(validate(skeleton(), place), "place"));
    certifier_.beginTick(options_.workBudget);
    if (!certifier_.isClear(place, place)) {
      return Error::in("place", ErrorCode::Mismatch,
                       "expected a pose that touches nothing: the avatar begins there");
    }
    reset();
    shown_ = place;
    isPlaced_ = mustSayPlace_ = true;
    return Done{};
  }

  void watch(internal::SolidPhases* phases) {
    phases_ = phases;
    certifier_.watch(phases);
    controller_.watch(phases);
  }

  Result<Done> changeScene(const Scene& scene) {
    const Avatar& avatar = certifier_.avatar();
    FORETOUCH_TRY(auto certifier, internal::Certifier::build(avatar, scene, options_));
    FORETOUCH_TRY(auto controller,
                  internal::StillController::build(avatar, scene, options_, certifier));
    certifier_ = std::move(certifier);
    controller_ = std::move(controller);
    watch(phases_);
    forget();
    lift_.forgetFloors();
    wasEqual_ = false;
    if (!isPlaced_) return Done{};
    certifier_.beginTick(options_.workBudget);
    isInside_ = !certifier_.isClear(shown_, shown_);
    if (isInside_) isPlaced_ = false;
    return Done{};
  }

  [[nodiscard]] internal::TargetPose& target() { return target_; }

  void resume(const Pose& shown) {
    shown_ = shown;
    isPlaced_ = true;
    isInside_ = mustSayPlace_ = hasSnapped_ = false;
    wasEqual_ = internal::isSamePose(shown_, target_.pose());
    around_.takeBack();
    controller_.reset();
  }

  [[nodiscard]] const SolidOptions& options() const { return options_; }
  [[nodiscard]] internal::Certifier& certifier() { return certifier_; }
  [[nodiscard]] const internal::Certifier& certifier() const { return certifier_; }

 private:
  [[nodiscard]] const Skeleton& skeleton() const { return certifier_.avatar().skeleton(); }

  void forget() {
    controller_.reset();
    placing_.reset();
    around_.reset();
    around_.forgetTrail();
    pace_.rest();
    stuck_.reset();
    mustSayPlace_ = false;
  }

  /// The first place, or the nearest to where the scene has closed around it.
  void place(SolidTick& tick) {
    const Pose asked = isInside_ ? shown_ : target_.pose();
    Pose found;
    isPlaced_ = placing_.search(asked, certifier_, found);
    tick.counters.placingQueries = certifier_.queries();
    if (!isPlaced_) {
      if (isInside_) tick.limit = SolidLimit::Inside;
      return;
    }
    if (!std::exchange(isInside_, false)) beginLifted(asked, found, tick);
    shown_ = found;
    appear(tick);
  }

  /// A place above the asked one is where its feet stand, as a rule: so it does not sink first.
  void beginLifted(const Pose& asked, const Pose& found, SolidTick& tick) {
    const Eigen::Vector3d by = found.translations[0] - asked.translations[0];
    const double up = by.dot(options_.up);
    const bool isLift = up > 0.0 && up <= options_.mostLift + kSamePlace &&
                        (by - up * options_.up).norm() < kSamePlace;
    if (isLift && options_.floor == FloorPolicy::Lift) lift_.reset(std::min(up, options_.mostLift));
    tick.lift = lift_.lift();
  }

  void appear(SolidTick& tick) {
    tick.hasAppeared = true;
    internal::appendPiece(shown_, certifier_.clearanceAt(shown_), tick);
  }

  void move(double dtS, SolidTick& tick) {
    if (std::exchange(mustSayPlace_, false)) appear(tick);
    const double liftBefore = lift_.lift();
    if (lift_.isAny()) liftTarget(dtS, tick);
    const bool goesAlong = wasEqual_ && !target_.hasFound();
    if (goesAlong && !controller_.isAnyActive()) {
      pace_.rest();
      if (controller_.goStraight(target_.pose(), certifier_, shown_, tick)) {
        around_.rememberFree(controller_.body(), shown_, dtS);
        return;
      }
    }
    before_ = shown_;
    const internal::VisualBody& body = controller_.body();
    around_.rememberBegin(body, shown_, wasEqual_);
    body.place(target_.states(), wanted_);
    lastWanted_.clear();
    if (target_.hasLast()) body.place(target_.lastStates(), lastWanted_);
    internal::placeLinks(skeleton(), shown_, states_);
    body.place(states_, places_);
    pace_.begin(target_, {places_, wanted_, lastWanted_, goesAlong},
                std::abs(lift_.lift() - liftBefore), dtS);
    // Before the tick's work is spent on other questions: what is announced has to come.
    isTargetFree_ = stuck_.wantsSnapIn(dtS) && certifier_.isClear(target_.pose(), target_.pose());
    if (around_.isStale(places_, wanted_)) around_.reset();
    if (!(around_.hasWay() && walkAround(tick))) {
      const std::uint64_t kept = wantsAround() ? certifier_.keepBack(3 * internal::kSearchWork) : 0;
      controller_.follow({target_.pose(), target_.states(), wanted_, target_.ranges(), pace_},
                         certifier_, shown_, tick);
      certifier_.giveBack(kept);
      if (!internal::isSamePose(shown_, target_.pose())) lookFurther(dtS, tick);
    }
    for (std::size_t i = 0; i < tick.numWay; ++i) around_.remember(body, tick.way[i]);
    pace_.end();
  }

  void liftTarget(double dtS, SolidTick& tick) {
    const double asked = lift_.asked(target_.states());
    const Pose& target = target_.pose();
    const bool isFree = asked > 0.0 && certifier_.isClear(target, target);
    tick.lift = lift_.update(asked, isFree, dtS);
    target_.moveRoots(tick.lift * options_.up);
  }

  /// Goes on along the way that was found; false if it is no longer free.
  bool walkAround(SolidTick& tick) {
    const internal::PhaseScope scope(phases_, internal::SolidPhase::Around);
    isAround_ = true;
    around_.tighten(controller_.body(), shown_, target_.pose(), wanted_, certifier_);
    for (int i = 0; i < kMostPieces && around_.hasWay() && !pace_.isSpent(); ++i) {
      const double share = pace_.shareOf(shown_, around_.next(), towards_);
      if (!(share > 0.0)) break;
      const Pose& to = share < 1.0 ? towards_ : around_.next();
      const internal::Certified answer = certifier_.certify(shown_, to, reached_);
      if (!answer.isClear) {
        if (answer.isOverBudget) {
          tick.limit = SolidLimit::Budget;
          return true;
        }
        around_.reset();
        isAround_ = tick.numWay != 0;
        return isAround_;
      }
      pace_.spend(shown_, reached_);
      shown_ = reached_;
      internal::appendPiece(shown_, answer.clearance, tick);
      around_.arrived(shown_);
    }
    if (around_.hasWay()) tick.limit = SolidLimit::CatchUp;
    if (!around_.hasWay()) around_.reset();
    return true;
  }

  /// How far the shown pose is from the target; `farthest`: the point that is farthest off.
  [[nodiscard]] internal::Deviation deviation(std::size_t& farthest) {
    const internal::VisualBody& body = controller_.body();
    internal::placeLinks(skeleton(), shown_, states_);
    internal::Deviation found;
    farthest = 0;
    for (std::size_t k = 0; k < body.points().size(); ++k) {
      const auto& point = body.points()[k];
      const double off = (states_[slotOf(point.link)].pointAt(point.p_L) - wanted_[k]).norm();
      if (off > found.far) {
        found.far = off;
        farthest = k;
      }
    }
    found.wanted = wanted_[farthest];
    const std::vector<JointId>& parents = skeleton().parents();
    for (std::size_t j = 0; j < parents.size(); ++j) {
      if (parents[j] != kNoParent) continue;
      const double off = (states_[j].p_WL - target_.states()[j].p_WL).norm();
      found.farOfRoots = std::max(found.farOfRoots, off);
    }
    found.moved = body.farthestMove(skeleton(), before_, shown_, statesBefore_, states_);
    return found;
  }

  [[nodiscard]] bool wantsAround() const {
    return options_.aroundPerTick > 0 && !around_.hasFailed() &&
           (around_.isSearching() || stuck_.wantsAround());
  }

  /// Held away from the target: is there a way around, or has the time come to snap?
  void lookFurther(double dtS, SolidTick& tick) {
    std::size_t farthest = 0;
    stuck_.look(deviation(farthest), dtS);
    const bool looks = wantsAround(), wantsSnap = stuck_.wantsSnap();
    if (!looks && !wantsSnap) return;
    const internal::PhaseScope scope(phases_, internal::SolidPhase::Around);
    const std::uint32_t before = certifier_.queries();
    // Where a snap may come, that was asked as the tick began.
    const bool isFree =
        isTargetFree_ || (!wantsSnap && certifier_.isClear(target_.pose(), target_.pose()));
    if (!isFree) {
      stuck_.foundInside();
      return;
    }
    if (looks) {
      const internal::VisualBody& body = controller_.body();
      around_.search(body, shown_, target_.pose(), wanted_, body.points()[farthest].link,
                     stuck_.isCaught(), certifier_);
    }
    tick.counters.aroundQueries += certifier_.queries() - before;
    if (!wantsSnap || around_.hasWay()) return;
    tick.snapInS = stuck_.snapInS();
    if (tick.snapInS > 0.0) return;
    shown_ = target_.pose();
    forget();
    lift_.forgetFloors();
    tick.numWay = 0;
    tick.clearance = std::numeric_limits<double>::infinity();
    hasSnapped_ = true;
    appear(tick);
  }

  void finish(double dtS, SolidTick& tick) {
    tick.shown = isPlaced_ || isInside_ ? shown_ : target_.pose();
    tick.isCertified = isPlaced_;
    wasEqual_ = isPlaced_ && internal::isSamePose(shown_, target_.pose());
    if (!isPlaced_) tick.clearance = 0.0;
    tick.state = stateOf(tick);
    internal::spreadTimes(tick);
    tick.counters.queries = certifier_.queries();
    tick.counters.work = certifier_.workDone();
    report(dtS, tick);
  }

  [[nodiscard]] SolidState stateOf(const SolidTick& tick) {
    if (!isPlaced_) return SolidState::Placing;
    if (std::exchange(hasSnapped_, false)) return SolidState::Snapped;
    if (wasEqual_) return SolidState::Equal;
    if (isAround_) return SolidState::Around;
    if (tick.numWay == 0) return SolidState::Held;
    return controller_.hasPushes() ? SolidState::Sliding : SolidState::Following;
  }

  /// What holds each joint, and how far it is from where its tracker says.
  void report(double dtS, SolidTick& tick) {
    const std::size_t n = countOf(certifier_.avatar().numLinks());
    tick.linkDeviation.assign(n, 0.0);
    tick.joints.assign(n, SolidJointState::Free);
    tick.deviation = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      if (target_.isLost(static_cast<JointId>(j))) tick.joints[j] = SolidJointState::Lost;
    }
    if (!isPlaced_ || wasEqual_) return;
    internal::placeLinks(skeleton(), shown_, states_);
    const auto& points = controller_.body().points();
    for (const internal::VisualBody::Point& point : points) {
      const auto link = slotOf(point.link);
      const double off =
          (states_[link].pointAt(point.p_L) - target_.states()[link].pointAt(point.p_L)).norm();
      tick.linkDeviation[link] = std::max(tick.linkDeviation[link], off);
      tick.deviation = std::max(tick.deviation, off);
    }
    if (!controller_.hasPushes()) return;
    internal::placeLinks(skeleton(), before_, statesBefore_);
    for (const internal::ContactRow& row : controller_.rows()) {
      if (row.push > 0.0) reportRow(row, dtS, tick);
    }
  }

  void reportRow(const internal::ContactRow& row, double dtS, SolidTick& tick) {
    SolidContact contact = internal::contactOf(row);
    const LinkState &now = states_[slotOf(row.link)], &then = statesBefore_[slotOf(row.link)];
    const Eigen::Vector3d p_L = now.R_WL.transpose() * (row.x - now.p_WL);
    Eigen::Vector3d slip = now.pointAt(p_L) - then.pointAt(p_L);
    slip -= row.n * row.n.dot(slip);
    contact.slipSpeed = slip.norm() / dtS;
    tick.contacts.push_back(contact);
    const auto state = tick.numWay == 0 ? SolidJointState::Held : SolidJointState::Sliding;
    for (const LinkId link : {row.link, row.other}) {
      if (link != kNoParent && tick.joints[slotOf(link)] == SolidJointState::Free) {
        tick.joints[slotOf(link)] = state;
      }
    }
  }

  SolidOptions options_;
  internal::Certifier certifier_;
  internal::StillController controller_;
  internal::TargetPose target_;
  internal::FloorLift lift_;
  internal::Placing placing_;
  internal::WayAround around_;
  internal::StuckWatch stuck_;
  internal::Pace pace_;
  internal::SolidPhases* phases_ = nullptr;
  Pose shown_, before_, towards_, reached_;
  std::vector<LinkState> states_, statesBefore_;
  std::vector<Eigen::Vector3d> wanted_, lastWanted_, places_;
  bool isAround_ = false, hasSnapped_ = false;
  bool isInside_ = false;      // the scene that was changed has shown_ inside
  bool mustSayPlace_ = false;  // shown_ was given as a place, and no tick has said so yet
  bool isTargetFree_ = false;  // in this tick, where a snap may come
  bool isPlaced_ = false;
  bool wasEqual_ = false;  // shown_ is the last target, bit for bit
};

Result<SolidAvatar> SolidAvatar::build(const Avatar& avatar, const Scene& scene,
                                       const SolidOptions& options) {
  SolidOptions whole = internal::completed(avatar, options);
  FORETOUCH_CHECK(internal::checked(avatar, whole));
  FORETOUCH_TRY(auto certifier, internal::Certifier::build(avatar, scene, whole));
  FORETOUCH_TRY(auto controller, internal::StillController::build(avatar, scene, whole, certifier));
  return SolidAvatar(std::make_unique<Parts>(avatar, std::move(whole), std::move(certifier),
                                             std::move(controller)));
}

SolidAvatar::SolidAvatar(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SolidAvatar::~SolidAvatar() = default;
SolidAvatar::SolidAvatar(SolidAvatar&&) noexcept = default;
SolidAvatar& SolidAvatar::operator=(SolidAvatar&&) noexcept = default;

Result<Done> SolidAvatar::follow(const SolidTarget& target, SolidTick& tick) {
  return parts_->follow(target, tick);
}

void SolidAvatar::reset() {
  parts_->reset();
}

Result<Done> SolidAvatar::reset(const Pose& place) {
  return parts_->reset(place);
}

Result<Done> SolidAvatar::changeScene(const Scene& scene) {
  return parts_->changeScene(scene);
}

const Pose& SolidAvatar::target() const {
  return parts_->target().pose();
}

void SolidAvatar::resume(const Pose& shown, const SolidAvatar* before) {
  if (before != nullptr) parts_->target().remember(before->ranges());
  parts_->resume(shown);
}

const internal::JointRanges& SolidAvatar::ranges() const {
  return parts_->target().ranges();
}

void SolidAvatar::watch(internal::SolidPhases* phases) {
  parts_->watch(phases);
}

const Avatar& SolidAvatar::avatar() const {
  return parts_->certifier().avatar();
}

const Scene& SolidAvatar::scene() const {
  return parts_->certifier().scene();
}

const SolidOptions& SolidAvatar::options() const {
  return parts_->options();
}

}  // namespace foretouch
