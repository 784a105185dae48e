#include "tools/floor/in_place.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/link_places.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// People do not walk more slowly (m/s).
constexpr double kSlowestWalk = 0.3;
/// What bears goes one way: its mean velocity is at least this share of its mean speed. The body
/// comes by no more than the other share of that way.
constexpr double kOneWay = 0.7, kStays = 0.3;
/// Steps that are looked at, spread evenly, and seconds that a walk lasts at least.
constexpr std::int64_t kMostLooks = 2000;
constexpr double kLeastWalkS = 0.5;

Vector3d levelled(const Vector3d& v) {
  return {v.x(), 0.0, v.z()};
}

/// The lowest corner of all feet.
const PartCorner* bearing(const RestingBody& body, const std::vector<LinkState>& states) {
  const PartCorner* lowest = nullptr;
  double least = 0.0;
  for (const RestingPart& part : body.parts) {
    if (part.isHand()) continue;
    const LowestCorner low = lowestOf(part, states, Vector3d::UnitY());
    if (lowest != nullptr && low.height >= least) continue;
    least = low.height;
    lowest = &part.corners[low.corner];
  }
  return lowest;
}

/// Where the body is: roots of files may be nodes that stay.
Vector3d middleOfFeet(const RestingBody& body, const std::vector<LinkState>& states) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (const RestingLimb& limb : body.limbs) {
    if (limb.isHand) continue;
    sum += levelled(states[slotOf(limb.ankle)].p_WL);
    count += 1.0;
  }
  return sum / std::max(1.0, count);
}

}  // namespace

std::optional<double> walksInPlace(const RestingBody& body, std::int64_t steps, double stepS,
                                   const RestingPoses& poses) {
  if (static_cast<double>(steps) * stepS < kLeastWalkS) return std::nullopt;
  const std::int64_t looks = std::min(steps, kMostLooks);
  std::vector<LinkState> from, to;
  Vector3d sum = Vector3d::Zero(), least = sum, most = sum;
  double way = 0.0;
  for (std::int64_t i = 0; i < looks; ++i) {
    const std::int64_t step = i * steps / looks;
    const auto one = poses(step), next = poses(step + 1);
    if (!one.ok() || !next.ok()) return std::nullopt;
    placesAt(body.avatar.skeleton(), one.value(), from);
    placesAt(body.avatar.skeleton(), next.value(), to);
    const PartCorner* const low = bearing(body, from);
    if (low == nullptr) return std::nullopt;
    const Vector3d moved = levelled(to[slotOf(low->link)].pointAt(low->center_L) -
                                    from[slotOf(low->link)].pointAt(low->center_L));
    sum += moved;
    way += moved.norm();
    const Vector3d middle = middleOfFeet(body, from);
    least = i == 0 ? middle : Vector3d(least.cwiseMin(middle));
    most = i == 0 ? middle : Vector3d(most.cwiseMax(middle));
  }
  const double share = static_cast<double>(steps) / static_cast<double>(looks);
  const double speed = way / (static_cast<double>(looks) * stepS);
  const bool isOneWay = sum.norm() > kOneWay * way;
  const bool stays = (most - least).norm() < kStays * way * share;
  if (!(speed > kSlowestWalk) || !isOneWay || !stays) return std::nullopt;
  return speed;
}

}  // namespace foretouch::tools
