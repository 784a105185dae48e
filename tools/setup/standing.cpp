#include "tools/setup/standing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/inputs/first_pose.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// A body is let down from this far above a floor (m): over small steps and carpets, below tables.
constexpr double kLift = 0.25;
/// Feet are put this far above what they would touch (m): more than a usual tolerance, and little,
/// so that they still meet the ground where they step.
constexpr double kGap = 0.002;
/// What carries a body touches it in the lowest part of its height.
constexpr double kLowestPart = 0.15;
/// How many spots of the level's floors to try.
constexpr std::size_t kSpots = 1500;
/// Floor counts as around a spot within this distance (m), at about its height.
constexpr double kAround = 3.0, kAboutItsHeight = 0.3;

/// The middle of a body's ground plan, at its lowest point.
Vector3d footOf(const Eigen::AlignedBox3d& box) {
  return {box.center().x(), box.min().y(), box.center().z()};
}

/// As far as any surface of the level can be.
double farAway(const Walker& walker) {
  const SceneAudit& audit = walker.level().scene().audit();
  return (audit.boxMax - audit.boxMin).norm() + 10.0;
}

void lookAround(const Walker& walker, const Vector3d& chest, Standing& standing) {
  const double reach = farAway(walker);
  std::size_t backs = 0;
  for (const Vector3d& way : {Vector3d(0, 1, 0), Vector3d(0, -1, 0), Vector3d(1, 0, 0),
                              Vector3d(-1, 0, 0), Vector3d(0, 0, 1), Vector3d(0, 0, -1)}) {
    const auto hit = walker.level().cast(chest, chest + reach * way);
    if (!hit) continue;
    ++standing.seen;
    backs += hit->isFront ? 0 : 1;
  }
  if (standing.seen == 0) return;
  standing.backs = static_cast<double>(backs) / static_cast<double>(standing.seen);
}

/// The whole clip at this place.
void walkThrough(const Walker& walker, Standing& standing) {
  standing.poses = walker.body().poses.size();
  std::vector<double> lowest;
  for (std::size_t i = 0; i < standing.poses; ++i) {
    const Pose pose = walker.poseAt(i, standing.place);
    bool isTrunkIn = false, isLimbIn = false;
    for (const Inside& inside : walker.insideAt(pose)) {
      isTrunkIn = isTrunkIn || walker.isTrunk(inside.link);
      isLimbIn = isLimbIn || !walker.isFoot(inside.link);
    }
    standing.trunkInside += isTrunkIn ? 1 : 0;
    standing.limbsInside += isLimbIn ? 1 : 0;
    const Eigen::AlignedBox3d box = boxInPose(walker.body().avatar, pose);
    lowest.push_back(box.min().y());
    const Vector3d middle = box.center();
    const double reach = 1.5 * box.sizes().y() + 0.5;
    standing.overVoid += walker.level().cast(middle, middle - Vector3d(0, reach, 0)) ? 0 : 1;
  }
  const double first = lowest.front();
  const auto median = lowest.begin() + static_cast<std::ptrdiff_t>(lowest.size() / 2);
  std::nth_element(lowest.begin(), median, lowest.end());
  standing.usualRise = *median - first;
}

/// How far the lowest point of the body is above a floor, or below one that it stands in.
void findFloor(const Walker& walker, const Pose& pose, const Eigen::AlignedBox3d& box,
               Standing& standing) {
  const double reach = farAway(walker);
  if (standing.inside.empty()) {
    const auto rest = walker.sink(pose, reach);
    if (rest) standing.floorBelow = rest->depth;
    return;
  }
  // From the middle of the body down: a floor between there and the feet is one that it is sunk in.
  const Vector3d middle = box.center();
  const auto hit = walker.level().cast(middle, middle - Vector3d(0, reach, 0));
  if (!hit) return;
  const double gap = hit->distance - 0.5 * box.sizes().y();
  (gap >= 0.0 ? standing.floorBelow : standing.floorAbove) = std::abs(gap);
}

/// The placement that brings the first pose's foot over `spot`, `above` it.
Placement placeOver(const Walker& walker, const Vector3d& spot, double yawDeg, double above) {
  const Pose turned = walker.poseAt(0, {false, Vector3d::Zero(), yawDeg});
  const Vector3d foot = footOf(boxInPose(walker.body().avatar, turned));
  return {false, spot - foot + Vector3d(0, above, 0), yawDeg};
}

/// Lets the body down on a spot. Nothing if it does not fit, or something else than its feet would
/// carry it.
std::optional<Placement> letDown(const Walker& walker, const Vector3d& spot, double yawDeg) {
  Placement place = placeOver(walker, spot, yawDeg, kLift);
  const Pose raised = walker.poseAt(0, place);
  const auto rest = walker.sink(raised, 2.0 * kLift);
  if (!rest || rest->depth <= kGap) return std::nullopt;
  const Eigen::AlignedBox3d box = boxInPose(walker.body().avatar, raised);
  const double lowest = box.min().y() - rest->depth;
  if (rest->p_W.y() > lowest + kLowestPart * box.sizes().y()) return std::nullopt;
  // Rounded to millimetres, as people write it; up, so that it stays free.
  place.origin.y() = std::ceil(1e3 * (place.origin.y() - rest->depth + kGap)) / 1e3;
  for (const int axis : {0, 2}) place.origin[axis] = std::round(1e3 * place.origin[axis]) / 1e3;
  return place;
}

/// Square metres of floor around a point, up to a factor: how many spots are near it.
std::ptrdiff_t floorAround(const std::vector<FloorSpot>& spots, const Vector3d& p_W) {
  return std::count_if(spots.begin(), spots.end(), [&](const FloorSpot& spot) {
    const Vector3d way = spot.p_W - p_W;
    return std::hypot(way.x(), way.z()) <= kAround && std::abs(way.y()) <= kAboutItsHeight;
  });
}

/// Smaller is better, 0 best; a fault of one kind outweighs the next.
double faultsOf(const Standing& standing) {
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(standing.poses);
  };
  return 4.0 * standing.backs + 4.0 * share(standing.trunkInside) + 2.0 * share(standing.overVoid) +
         share(standing.limbsInside);
}

constexpr std::array<double, 4> kTurns = {0.0, 90.0, 180.0, 270.0};

class Search {
 public:
  Search(const Walker& walker, const Placement& wish)
      : walker_(walker),
        wish_(wish),
        wished_(boxInPose(walker.body().avatar, walker.poseAt(0, wish))),
        far_(farAway(walker)) {}

  std::optional<Standing> best() {
    const Standing own = standingAt(walker_, wish_);
    if (own.standsFree()) take(own, 0.0);
    spots_ = walker_.level().floorSpots(kSpots, kSteepestFloor);
    for (const FloorSpot& spot : spots_) around_.push_back(floorAround(spots_, spot.p_W));
    if (!around_.empty()) most_ = *std::max_element(around_.begin(), around_.end());
    tryOwnSpot();
    for (std::size_t i = 0; i < spots_.size(); ++i) tryAt(spots_[i].p_W, shareOf(around_[i]));
    return best_;
  }

 private:
  /// Half as much floor as anywhere is enough: then the nearest counts.
  [[nodiscard]] double shareOf(std::ptrdiff_t around) const {
    return std::min(1.0, 2.0 * static_cast<double>(around) / static_cast<double>(most_));
  }

  /// Where the wish itself has the body, up to the floor there.
  void tryOwnSpot() {
    const Vector3d middle = wished_.center();
    const auto hit = walker_.level().cast(middle, middle - Vector3d(0, far_, 0));
    if (!hit) return;
    const Vector3d spot(middle.x(), middle.y() - hit->distance, middle.z());
    tryAt(spot, shareOf(floorAround(spots_, spot)));
  }

  void tryAt(const Vector3d& spot, double floorShare) {
    const double distance = std::min(1.0, (spot - footOf(wished_)).norm() / far_);
    // Its cost is at least this: no need to look closer.
    const double least = 0.5 * (1.0 - floorShare) + 0.4 * distance;
    if (best_ && least >= bestCost_) return;
    for (const double turn : kTurns) {
      const auto place = letDown(walker_, spot, std::fmod(wish_.yawDeg + turn, 360.0));
      if (!place) continue;
      const Standing standing = standingAt(walker_, *place);
      if (!standing.standsFree()) continue;
      if (take(standing, least) <= least) return;  // another turn is no better
    }
  }

  /// Returns its cost.
  double take(const Standing& standing, double least) {
    const double cost = faultsOf(standing) + least;
    if (!best_ || cost < bestCost_) best_ = standing, bestCost_ = cost;
    return cost;
  }

  const Walker& walker_;
  const Placement& wish_;
  const Eigen::AlignedBox3d wished_;  ///< The first pose, where the wish has it.
  const double far_;                  ///< As far as any surface can be.
  std::vector<FloorSpot> spots_;
  std::vector<std::ptrdiff_t> around_;  ///< Per spot: how many others are near it.
  std::ptrdiff_t most_ = 1;             ///< Of these.
  std::optional<Standing> best_;
  double bestCost_ = std::numeric_limits<double>::max();
};

}  // namespace

Standing standingAt(const Walker& walker, const Placement& place) {
  Standing standing;
  standing.place = place;
  const Pose pose = walker.poseAt(0, place);
  const Eigen::AlignedBox3d box = boxInPose(walker.body().avatar, pose);
  const SceneAudit& audit = walker.level().scene().audit();
  const auto isBeside = [&](int axis) {
    return box.min()[axis] > audit.boxMax[axis] || box.max()[axis] < audit.boxMin[axis];
  };
  // Above it is no outside: ground may be flat, and sky open.
  standing.isOutside = isBeside(0) || isBeside(2) || box.max().y() < audit.boxMin.y();
  standing.inside = walker.insideAt(pose);
  findFloor(walker, pose, box, standing);
  // Two thirds up a standing body.
  lookAround(walker, footOf(box) + Vector3d(0, 0.67 * box.sizes().y(), 0), standing);
  walkThrough(walker, standing);
  return standing;
}

std::optional<Standing> bestStanding(const Walker& walker, const Placement& wish) {
  return Search(walker, wish).best();
}

}  // namespace foretouch::tools
