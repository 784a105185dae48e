#include "middleware/solid/solid_avatar.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/solid/certifier.h"
#include "middleware/solid/follower.h"
#include "middleware/solid/solid_way.h"
#include "middleware/solid/target_pose.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch {
namespace {

constexpr double kLongestTick = 10.0;

Result<Done> inRange(const char* name, double value, double least, double most) {
  if (value >= least && value <= most) return Done{};
  const auto text = [](double x) {
    std::string number = std::to_string(x);
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number;
  };
  return Error::in(name, ErrorCode::OutOfRange,
                   "expected " + text(least) + " to " + text(most) + ", found " + text(value));
}

Result<Done> checkedVisibility(const Avatar& avatar, const std::vector<double>& visibility) {
  if (visibility.size() != countOf(avatar.numLinks())) {
    return Error::in("visibility", ErrorCode::Mismatch,
                     "expected none, or one per link of the avatar");
  }
  double sum = 0.0;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const double value = visibility[slotOf(link)];
    if (!(value >= 0.0 && value <= 1e6)) {
      return Error{ErrorCode::OutOfRange, "visibility", -1, link, "expected 0 to 1e6"};
    }
    if (!avatar.lss(link).empty()) sum += value;
  }
  if (sum > 0.0) return Done{};
  return Error::in("visibility", ErrorCode::OutOfRange,
                   "expected a link with LSS whose visibility is above 0");
}

Result<Done> checked(const Avatar& avatar, const SolidOptions& options) {
  FORETOUCH_CHECK(inRange("skin", options.skin, 1e-5, 0.1));
  FORETOUCH_CHECK(inRange("tolerance", options.tolerance, 1e-6, 0.5 * options.skin));
  FORETOUCH_CHECK(inRange("catchUp", options.catchUp, 1e-3, 1e3));
  FORETOUCH_CHECK(inRange("mostLift", options.mostLift, 0.0, 1.0));
  FORETOUCH_CHECK(inRange("mostDeviation", options.mostDeviation, 1e-3, 1e3));
  FORETOUCH_CHECK(inRange("mostLimbDeviation", options.mostLimbDeviation, 1e-3, 1e3));
  FORETOUCH_CHECK(inRange("patience", options.patience, 0.0, 1e3));
  FORETOUCH_CHECK(inRange("snapNotice", options.snapNotice, 0.0, 1e2));
  FORETOUCH_CHECK(inRange("aroundPerTick", options.aroundPerTick, 0.0, 1e5));
  FORETOUCH_CHECK(inRange("aroundInAll", options.aroundInAll, 0.0, 1e6));
  FORETOUCH_CHECK(inRange("placingReach", options.placingReach, 0.0, 1e2));
  FORETOUCH_CHECK(checkedVisibility(avatar, options.visibility));
  if (options.feet.size() != countOf(avatar.numLinks())) {
    return Error::in("feet", ErrorCode::Mismatch, "expected none, or one per link of the avatar");
  }
  if (!(std::abs(options.up.norm() - 1.0) < 1e-6)) {
    return Error::in("up", ErrorCode::OutOfRange, "expected a unit vector");
  }
  if (options.workBudget == 0) {
    return Error::in("workBudget", ErrorCode::OutOfRange, "expected at least 1");
  }
  return Done{};
}

SolidOptions completed(const Avatar& avatar, SolidOptions options) {
  if (options.visibility.empty()) options.visibility = visibilityByName(avatar);
  if (options.feet.empty()) options.feet = feetByName(avatar);
  return options;
}

}  // namespace

class SolidAvatar::Parts {
 public:
  Parts(const Avatar& avatar, SolidOptions options, internal::Certifier certifier)
      : options_(std::move(options)),
        certifier_(std::move(certifier)),
        target_(avatar),
        follower_(avatar, options_) {}

  Result<Done> follow(const SolidTarget& given, SolidTick& tick) {
    if (!(given.dtS > 0.0 && given.dtS <= kLongestTick)) {
      return Error::in("dtS", ErrorCode::OutOfRange, "expected more than 0 and at most 10 seconds");
    }
    FORETOUCH_CHECK(target_.take(given, isPlaced_ ? &shown_ : nullptr));
    certifier_.beginTick(options_.workBudget);
    internal::beginWay(tick);
    tick.contacts.clear();
    tick.limit = SolidLimit::None;
    tick.snapInS = -1.0;
    tick.counters = {};
    if (!isPlaced_) place();
    if (isPlaced_) {
      follower_.follow(target_.pose(), budgetFor(given.dtS), given.dtS, certifier_, shown_, tick);
    }
    finish(tick);
    return Done{};
  }

  void reset() {
    isPlaced_ = false;
    follower_.reset();
    target_.reset();
  }

  [[nodiscard]] const SolidOptions& options() const { return options_; }
  [[nodiscard]] internal::Certifier& certifier() { return certifier_; }
  [[nodiscard]] const internal::Certifier& certifier() const { return certifier_; }

 private:
  void place() {
    if (!certifier_.isClear(target_.pose(), target_.pose())) return;
    shown_ = target_.pose();
    isPlaced_ = true;
  }

  [[nodiscard]] double budgetFor(double dtS) const {
    return target_.largestStep() + options_.catchUp * dtS;
  }

  void finish(SolidTick& tick) {
    tick.shown = isPlaced_ ? shown_ : target_.pose();
    tick.isCertified = isPlaced_;
    if (!isPlaced_) tick.clearance = 0.0;
    if (!isPlaced_) {
      tick.state = SolidState::Placing;
    } else if (internal::isSamePose(shown_, target_.pose())) {
      tick.state = SolidState::Equal;
    } else {
      tick.state = tick.numWay == 0 ? SolidState::Held : SolidState::Following;
    }
    tick.times.resize(tick.numWay);
    for (std::size_t i = 0; i < tick.numWay; ++i) {
      tick.times[i] = static_cast<double>(i + 1) / static_cast<double>(tick.numWay);
    }
    tick.counters.queries = certifier_.queries();
    tick.counters.work = certifier_.workDone();
    tick.linkDeviation.assign(countOf(certifier_.avatar().numLinks()), 0.0);
    tick.joints.assign(countOf(certifier_.avatar().numLinks()), SolidJointState::Free);
  }

  SolidOptions options_;
  internal::Certifier certifier_;
  internal::TargetPose target_;
  internal::Follower follower_;
  Pose shown_;
  bool isPlaced_ = false;
};

Result<SolidAvatar> SolidAvatar::build(const Avatar& avatar, const Scene& scene,
                                       const SolidOptions& options) {
  SolidOptions whole = completed(avatar, options);
  FORETOUCH_CHECK(checked(avatar, whole));
  FORETOUCH_TRY(auto certifier, internal::Certifier::build(avatar, scene, whole));
  return SolidAvatar(std::make_unique<Parts>(avatar, std::move(whole), std::move(certifier)));
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

Result<Done> SolidAvatar::reset(const Pose& /*place*/) {
  return Done{};
}

Result<Done> SolidAvatar::changeScene(const Scene& /*scene*/) {
  return Done{};
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
