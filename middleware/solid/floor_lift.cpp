#include "middleware/solid/floor_lift.h"

#include <algorithm>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// A surface that faces up by more than this cosine is a floor.
constexpr double kFloorCosine = 0.7;
constexpr double kWindowS = 1.0;
/// m/s: too slow for anybody to notice.
constexpr double kSpeed = 0.05;
/// How far from where a foot was held the floor is taken to go on (m), to the side.
constexpr double kFloorReach = 0.2;

}  // namespace

FloorLift::FloorLift(const Avatar& avatar, const SolidOptions& options)
    : avatar_(avatar),
      up_(options.up),
      skin_(options.skin),
      most_(options.mostLift),
      speed_(std::min(kSpeed, options.catchUp)) {
  if (options.floor != FloorPolicy::Lift) return;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (options.feet[slotOf(link)] && !avatar.lss(link).empty()) feet_.push_back(link);
  }
  reset();
}

void FloorLift::reset(double lift) {
  forgetFloors();
  lift_ = feet_.empty() ? 0.0 : lift;
}

void FloorLift::forgetFloors() {
  floors_.assign(feet_.size(), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), -1.0});
  asks_.clear();
}

bool FloorLift::isAny() const {
  return lift_ > 0.0 || isFloorKnown();
}

bool FloorLift::isFloorKnown() const {
  return std::any_of(floors_.begin(), floors_.end(),
                     [](const Floor& floor) { return floor.ageS >= 0.0; });
}

double FloorLift::asked(const std::vector<LinkState>& target) const {
  double most = 0.0;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const Floor& floor = floors_[i];
    if (floor.ageS < 0.0) continue;
    const LinkState& state = target[slotOf(feet_[i])];
    for (const Lss& lss : avatar_.lss(feet_[i])) {
      for (const Eigen::Vector3d& end : {lss.a, lss.b}) {
        const Eigen::Vector3d from = state.pointAt(end) - floor.y;
        if ((from - up_ * up_.dot(from)).norm() > kFloorReach) continue;
        const double missing = skin_ + lss.radius - floor.n.dot(from);
        const double lift = missing / floor.n.dot(up_);
        if (lift <= most_) most = std::max(most, lift);  // more is a step, not a calibration
      }
    }
  }
  // No lift begins for the skin alone.
  return lift_ > 0.0 || most > skin_ ? most : 0.0;
}

void FloorLift::grow(double dtS) {
  for (Floor& floor : floors_) {
    if (floor.ageS >= 0.0) floor.ageS += dtS;
    if (floor.ageS > kWindowS) floor.ageS = -1.0;
  }
  for (Ask& ask : asks_) ask.ageS += dtS;
  asks_.erase(std::remove_if(asks_.begin(), asks_.end(),
                             [](const Ask& ask) { return ask.ageS > kWindowS; }),
              asks_.end());
}

/// The median of the window: the depth of a foot that lands, or of one that leaves, says nothing.
/// Feet in the air ask for nothing, and what is lifted stays so while their floor is known.
double FloorLift::usualAsk() {
  if (asks_.empty()) return isFloorKnown() ? lift_ : 0.0;
  sorted_.clear();
  for (const Ask& ask : asks_) sorted_.push_back(ask.lift);
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
  std::nth_element(sorted_.begin(), middle, sorted_.end());
  return *middle;
}

double FloorLift::update(double asked, bool isFree, double dtS) {
  grow(dtS);
  if (isFree && asked > skin_) {
    forgetFloors();  // they end before where the foot is
  } else if (asked > 0.0) {
    asks_.push_back({0.0, isFree ? 0.0 : asked});
    // As long as the lifted feet stand on a floor, it stays known.
    for (Floor& floor : floors_) floor.ageS = std::min(floor.ageS, 0.0);
  }
  lift_ = std::clamp(usualAsk(), lift_ - speed_ * dtS, lift_ + speed_ * dtS);
  return lift_;
}

void FloorLift::remember(const std::vector<ContactRow>& rows) {
  for (const ContactRow& row : rows) {
    if (!(row.push > 0.0) || row.other != kNoParent || row.n.dot(up_) < kFloorCosine) continue;
    const auto foot = std::lower_bound(feet_.begin(), feet_.end(), row.link);
    if (foot == feet_.end() || *foot != row.link) continue;
    floors_[static_cast<std::size_t>(foot - feet_.begin())] = {row.y, row.n, 0.0};
  }
}

}  // namespace foretouch::internal
