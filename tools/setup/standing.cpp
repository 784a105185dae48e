#include "tools/setup/standing.h"

#include <algorithm>
#include <array>
#include <cmath>

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
/// How many spots of the floor to look at, and at how many places to let the body down.
constexpr std::size_t kSpots = 2000, kPlaces = 160;
/// A pose may be this far above the floor in a jump, and this far below on a step (shares of the
/// body's height).
constexpr double kJump = 0.6, kStep = 0.17;
/// Floor is level around a spot if it is so high there, give or take (share of the height).
constexpr double kLevel = 0.06;
/// A wish this far away (m) is as good as none.
constexpr double kFar = 50.0;

/// The middle of a body's ground plan, at its lowest point.
Vector3d footOf(const Eigen::AlignedBox3d& box) {
  return {box.center().x(), box.min().y(), box.center().z()};
}

Eigen::AlignedBox3d boxAt(const Walker& walker, std::size_t index, const Placement& place) {
  return boxInPose(walker.body().avatar, walker.poseAt(index, place));
}

/// A length as far as any surface of the level can be.
double farAway(const Walker& walker) {
  const SceneAudit& audit = walker.level().scene().audit();
  return (audit.boxMax - audit.boxMin).norm() + 10.0;
}

/// Whether floor is below a foot that may be in a jump or on a step; true if it is not known.
bool isOverFloor(const Walker& walker, const Vector3d& foot) {
  const WalkableFloor* const floor = walker.floor();
  if (floor == nullptr) return true;
  const double height = floor->room().height, up = kStep * height, down = kJump * height;
  if (!walker.on().empty() && floor->isAskedAt(foot, up, down)) return true;
  return floor->kindAt(foot, up, down) == FloorKind::Main;
}

/// Checks the whole clip at this place.
void walkThrough(const Walker& walker, Standing& standing) {
  standing.poses = walker.body().poses.size();
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
    const Vector3d middle = box.center();
    const double reach = 1.5 * box.sizes().y() + 0.5;
    standing.overVoid += walker.level().cast(middle, middle - Vector3d(0, reach, 0)) ? 0 : 1;
    standing.offFloor += isOverFloor(walker, footOf(box)) ? 0 : 1;
  }
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

/// What kind of floor the foot is on.
void nameFloor(const Walker& walker, const Vector3d& foot, Standing& standing) {
  const WalkableFloor* const floor = walker.floor();
  if (floor == nullptr) return;
  const double reach = kStep * floor->room().height;
  standing.floor = floor->kindAt(foot, reach, reach);
  standing.isOnAsked = !walker.on().empty() && floor->isAskedAt(foot, reach, reach);
}

/// The placement that brings the standing pose's foot over `spot`, `above` it.
Placement placeOver(const Walker& walker, const Vector3d& spot, double yawDeg, double above) {
  const Vector3d foot = footOf(boxAt(walker, walker.standing(), {false, Vector3d::Zero(), yawDeg}));
  return {false, spot - foot + Vector3d(0, above, 0), yawDeg};
}

/// Lets the body down on a spot. Nothing if it does not fit, or something other than its feet
/// would carry it.
std::optional<Placement> letDown(const Walker& walker, const Vector3d& spot, double yawDeg) {
  Placement place = placeOver(walker, spot, yawDeg, kLift);
  // Rounded to millimetres, as people write it; up, so that it stays free.
  for (const int axis : {0, 2}) place.origin[axis] = std::round(1e3 * place.origin[axis]) / 1e3;
  const Pose raised = walker.poseAt(walker.standing(), place);
  const auto rest = walker.sink(raised, 2.0 * kLift);
  if (!rest || rest->depth <= kGap) return std::nullopt;
  const Eigen::AlignedBox3d box = boxInPose(walker.body().avatar, raised);
  const double lowest = box.min().y() - rest->depth;
  if (rest->p_W.y() > lowest + kLowestPart * box.sizes().y()) return std::nullopt;
  place.origin.y() = std::ceil(1e3 * (place.origin.y() - rest->depth + kGap)) / 1e3;
  return place;
}

/// Smaller is better, 0 best; worse kinds of faults weigh more.
double faultsOf(const Standing& standing) {
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(standing.poses);
  };
  return 4.0 * share(standing.trunkInside) + 4.0 * share(standing.offFloor) +
         2.0 * share(standing.overVoid) + share(standing.limbsInside);
}

constexpr std::array<double, 8> kTurns = {0, 90, 180, 270, 45, 135, 225, 315};

class Search {
 public:
  Search(const Walker& walker, const Placement& wish)
      : walker_(walker), wish_(wish), wished_(footOf(boxAt(walker, walker.standing(), wish))) {
    for (std::size_t i = 0; i < walker.body().poses.size(); ++i) {
      feet_.push_back(footOf(boxAt(walker, i, wish)) - wished_);
    }
  }

  std::optional<Standing> best() {
    const Standing own = standingAt(walker_, wish_);
    if (isWhereWanted(own) && faultsOf(own) == 0.0) return own;
    if (walker_.floor() == nullptr) return std::nullopt;
    for (const Candidate& candidate : candidates()) {
      if (best_ && candidate.cost >= bestCost_) break;
      const auto place = letDown(walker_, candidate.spot, candidate.yawDeg);
      if (!place) continue;
      const Standing standing = standingAt(walker_, *place);
      if (isWhereWanted(standing)) take(standing, candidate);
    }
    return best_;
  }

 private:
  /// True if it is free on the main floor, or on what was asked and nowhere else.
  [[nodiscard]] bool isWhereWanted(const Standing& standing) const {
    return standing.standsFree() &&
           (walker_.on().empty() ? standing.floor == FloorKind::Main : standing.isOnAsked);
  }

  struct Candidate {
    Vector3d spot;
    double yawDeg = 0.0, cost = 0.0;
    double nearness = 0.0;  ///< The part of the cost that is about the spot alone.
  };

  /// Spots and turns, the most promising first: by the grid, before the engine is asked.
  [[nodiscard]] std::vector<Candidate> candidates() const {
    const WalkableFloor& floor = *walker_.floor();
    const bool onAsked = !walker_.on().empty();
    std::vector<Vector3d> spots = floor.spots(kSpots, onAsked);
    if (!onAsked) {
      for (const Vector3d& spot : floor.spotsAlong(wished_)) spots.push_back(spot);
    }
    std::vector<Candidate> all;
    for (const Vector3d& spot : spots) {
      const double distance = std::min(1.0, (spot - wished_).norm() / kFar);
      const double nearness = 0.5 * (1.0 - levelShare(floor, spot)) + 0.4 * distance;
      for (const double turn : kTurns) {
        all.push_back({spot, std::fmod(wish_.yawDeg + turn, 360.0),
                       4.0 * offShare(spot, turn) + nearness, nearness});
      }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    all.resize(std::min(all.size(), kPlaces));
    return all;
  }

  /// The share of the clip that would leave the floor.
  [[nodiscard]] double offShare(const Vector3d& spot, double turnDeg) const {
    const Eigen::AngleAxisd turn(turnDeg * std::acos(-1.0) / 180.0, Vector3d::UnitY());
    const auto off = std::count_if(feet_.begin(), feet_.end(), [&](const Vector3d& foot) {
      return !isOverFloor(walker_, spot + turn * foot);
    });
    return static_cast<double>(off) / static_cast<double>(feet_.size());
  }

  /// The share of the surroundings of a spot that is floor as high as it.
  [[nodiscard]] static double levelShare(const WalkableFloor& floor, const Vector3d& spot) {
    const double height = floor.room().height, level = kLevel * height;
    constexpr int kWays = 8;
    int found = 0;
    for (int i = 0; i < kWays; ++i) {
      const double angle = 2.0 * std::acos(-1.0) * i / kWays;
      for (const double reach : {0.4 * height, 0.8 * height}) {
        const Vector3d way(reach * std::cos(angle), 0.0, reach * std::sin(angle));
        found += floor.kindAt(spot + way, level, level) == FloorKind::Main ? 1 : 0;
      }
    }
    return static_cast<double>(found) / (2 * kWays);
  }

  void take(const Standing& standing, const Candidate& candidate) {
    const double cost = faultsOf(standing) + candidate.nearness;
    if (best_ && cost >= bestCost_) return;
    best_ = standing;
    bestCost_ = cost;
  }

  const Walker& walker_;
  const Placement& wish_;
  const Vector3d wished_;       ///< The standing pose's foot, where the wish has it.
  std::vector<Vector3d> feet_;  ///< Those of all poses, from there.
  std::optional<Standing> best_;
  double bestCost_ = 0.0;
};

}  // namespace

Standing standingAt(const Walker& walker, const Placement& place) {
  Standing standing;
  standing.place = place;
  const Pose pose = walker.poseAt(walker.standing(), place);
  const Eigen::AlignedBox3d box = boxInPose(walker.body().avatar, pose);
  const SceneAudit& audit = walker.level().scene().audit();
  const auto isBeside = [&](int axis) {
    return box.min()[axis] > audit.boxMax[axis] || box.max()[axis] < audit.boxMin[axis];
  };
  // Above it is not outside: ground may be flat, and sky open.
  standing.isOutside = isBeside(0) || isBeside(2) || box.max().y() < audit.boxMin.y();
  standing.inside = walker.insideAt(pose);
  standing.insideAtFirst = walker.insideAt(walker.poseAt(0, place));
  standing.firstRise = boxAt(walker, 0, place).min().y() - box.min().y();
  findFloor(walker, pose, box, standing);
  nameFloor(walker, footOf(box), standing);
  walkThrough(walker, standing);
  return standing;
}

std::optional<Standing> bestStanding(const Walker& walker, const Placement& wish) {
  return Search(walker, wish).best();
}

Placement originPlace(const Walker& walker) {
  const double lowest = boxAt(walker, walker.standing(), Placement()).min().y();
  return {false, {0.0, std::ceil(-1e3 * lowest) / 1e3, 0.0}, 0.0};
}

}  // namespace foretouch::tools
