#include "middleware/solid/solid_checks.h"

#include <cmath>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

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

}  // namespace

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

}  // namespace foretouch::internal
