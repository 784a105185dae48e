#include "tools/floor/floor_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "articulated/link_places.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "lss/turn_between.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Rests count by their time, up to this (s): one long stand is not a hundred steps.
constexpr double kMostWeightS = 1.0;
/// Rests this far below a floor (m) speak against it.
constexpr double kBelow = 0.03;
/// Planes through three rests that are tried: with a third of the rests on the floor, one of ten
/// thousand searches misses it.
constexpr int kTriples = 300;
/// Least time at rest on the floor (s), and share of all rests' time, that makes it one.
constexpr double kLeastOnFloorS = 0.2, kLeastShare = 0.3;
/// How level floors are, before anything is seen (radians; half a degree), how far one foot's rests
/// are from the other's by their markers (m), and how far on a good day. So a straight walk says
/// nothing about the floor's tilt across it.
constexpr double kUsualTilt = 0.0087, kMarkers = 0.004, kLeastSpread = 0.0015;
/// Spread of rests that are too few to show one (m).
constexpr double kUnknownSpread = 0.01;
constexpr std::size_t kFewRests = 4;

/// y = height + slopes * (x, z).
struct Plane {
  double height = 0.0, slopeX = 0.0, slopeZ = 0.0;

  [[nodiscard]] double above(const Vector3d& p) const {
    return p.y() - height - slopeX * p.x() - slopeZ * p.z();
  }
  [[nodiscard]] double slope() const { return std::hypot(slopeX, slopeZ); }
};

double weightOf(const FootRest& rest) {
  return std::min(rest.durationS, kMostWeightS);
}

/// The weight of a rest this far from the floor: 1 on it, 0 where it lies on something else.
double onFloor(double above) {
  const double share = above / kOnFloor;
  const double left = 1.0 - share * share;
  return left > 0.0 ? left * left : 0.0;
}

double scoreOf(const Plane& plane, const std::vector<FootRest>& rests) {
  double score = 0.0;
  for (const FootRest& rest : rests) {
    const double above = plane.above(rest.p_W);
    score += weightOf(rest) * (above < -kBelow ? -1.0 : onFloor(above));
  }
  return score;
}

/// False for planes that are not worth a try: steeper than a floor, or through points of one line.
bool isFloor(const Plane& plane) {
  return std::isfinite(plane.height) && plane.slope() <= std::tan(kMostTilt);
}

Plane planeThrough(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  Plane plane;
  plane.slopeX = -normal.x() / normal.y();
  plane.slopeZ = -normal.z() / normal.y();
  plane.height = a.y() - plane.slopeX * a.x() - plane.slopeZ * a.z();
  return plane;
}

/// The same numbers every time: a linear congruential generator of its own.
class Draws {
 public:
  std::size_t below(std::size_t count) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>((state_ >> 33) % count);
  }

 private:
  std::uint64_t state_ = 1;
};

/// The best of the level planes through a rest, and of some through three.
Plane bestPlane(const std::vector<FootRest>& rests) {
  Plane best;
  double bestScore = -1e300;
  const auto consider = [&](const Plane& plane) {
    if (!isFloor(plane)) return;
    // The leveller one of two that are equally good.
    const double score = scoreOf(plane, rests) * (1.0 - 0.5 * plane.slope());
    if (score > bestScore) best = plane, bestScore = score;
  };
  for (const FootRest& rest : rests) consider({rest.p_W.y(), 0.0, 0.0});
  if (rests.size() < kFewRests) return best;
  Draws draws;
  for (int i = 0; i < kTriples; ++i) {
    const auto drawn = [&]() -> const Vector3d& { return rests[draws.below(rests.size())].p_W; };
    const Vector3d &a = drawn(), &b = drawn(), &c = drawn();
    consider(planeThrough(a, b, c));
  }
  return best;
}

/// The mean of the rests on the floor, by weight, and their spread about it.
struct Cloud {
  Vector3d center = Vector3d::Zero();
  double weight = 0.0;  ///< The weight of the mean.
  /// Sums over all rests on the floor alike, by their time.
  double times = 0.0, timesSquared = 0.0, squares = 0.0;
  std::size_t count = 0;

  /// How many rests of one length would say as much.
  [[nodiscard]] double effectiveCount() const {
    return timesSquared > 0.0 ? times * times / timesSquared : 0.0;
  }
};

Cloud cloudOn(const Plane& plane, const std::vector<FootRest>& rests) {
  Cloud cloud;
  for (const FootRest& rest : rests) {
    const double above = plane.above(rest.p_W), weight = weightOf(rest) * onFloor(above);
    if (!(weight > 0.0)) continue;
    cloud.center += weight * rest.p_W;
    cloud.weight += weight;
    cloud.times += weightOf(rest);
    cloud.timesSquared += weightOf(rest) * weightOf(rest);
    cloud.squares += weightOf(rest) * above * above;
    ++cloud.count;
  }
  if (cloud.weight > 0.0) cloud.center /= cloud.weight;
  return cloud;
}

double spreadOf(const Cloud& cloud) {
  if (cloud.count < kFewRests) return kUnknownSpread;
  constexpr double kOfPlane = 3.0;  // height and two slopes are taken from the same rests
  const double count = cloud.effectiveCount();
  const double free = count > kOfPlane + 1.0 ? count / (count - kOfPlane) : kOfPlane + 1.0;
  return std::max(kLeastSpread, std::sqrt(cloud.squares / cloud.times * free));
}

/// Least squares about the rests' middle, with what floors usually are as one more observation.
Plane refined(const Plane& plane, const std::vector<FootRest>& rests) {
  const Cloud cloud = cloudOn(plane, rests);
  if (!(cloud.weight > 0.0)) return plane;
  const double spread = std::max(kMarkers, spreadOf(cloud)), variance = spread * spread;
  const double mean = cloud.weight / static_cast<double>(cloud.count);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() / (kUsualTilt * kUsualTilt);
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const FootRest& rest : rests) {
    const double weight = weightOf(rest) * onFloor(plane.above(rest.p_W)) / (mean * variance);
    const Vector3d d = rest.p_W - cloud.center;
    const Eigen::Vector2d x(d.x(), d.z());
    normal += weight * x * x.transpose();
    right += weight * d.y() * x;
  }
  const Eigen::Vector2d slopes = normal.ldlt().solve(right);
  return {cloud.center.y() - slopes.x() * cloud.center.x() - slopes.y() * cloud.center.z(),
          slopes.x(), slopes.y()};
}

FloorFit fitOf(const Plane& plane, const std::vector<FootRest>& rests) {
  const Cloud cloud = cloudOn(plane, rests);
  FloorFit fit;
  fit.center_W = cloud.center;
  fit.height = cloud.center.y();
  fit.normal_W = Vector3d(-plane.slopeX, 1.0, -plane.slopeZ).normalized();
  fit.tilt = std::atan(plane.slope());
  fit.rests = rests.size();
  fit.onFloor = cloud.count;
  fit.spread = spreadOf(cloud);
  constexpr double kNinetyFive = 1.96;
  fit.uncertainty = kNinetyFive * fit.spread / std::sqrt(std::max(1.0, cloud.effectiveCount()));
  for (const FootRest& rest : rests) {
    fit.restS += rest.durationS;
    if (std::abs(plane.above(rest.p_W)) <= kOnFloor) fit.onFloorS += rest.durationS;
  }
  return fit;
}

/// The lowest point of each foot at each pose, for rests.
class RestFinder {
 public:
  RestFinder(const RestingBody& body, double stepS, std::vector<FootRest>& rests)
      : body_(body), stepS_(stepS), rests_(rests), runs_(body.limbs.size()) {}

  void add(std::int64_t step, const std::vector<LinkState>& before,
           const std::vector<LinkState>& now) {
    for (std::size_t limb = 0; limb < body_.limbs.size(); ++limb) {
      if (!body_.limbs[limb].isHand) add(step, limb, before, now);
    }
  }
  void finish() {
    for (std::size_t limb = 0; limb < runs_.size(); ++limb) close(limb);
  }

 private:
  struct Run {
    std::int64_t first = 0, last = -1;
    Vector3d sum = Vector3d::Zero();
  };

  void add(std::int64_t step, std::size_t limb, const std::vector<LinkState>& before,
           const std::vector<LinkState>& now) {
    const PartCorner* lowest = nullptr;
    double height = 0.0;
    for (const RestingPart& part : body_.parts) {
      if (part.limb != limb) continue;
      const LowestCorner found = lowestOf(part, now, Vector3d::UnitY());
      if (lowest == nullptr || found.height < height) {
        lowest = &part.corners[found.corner];
        height = found.height;
      }
    }
    if (lowest == nullptr) return;
    const Vector3d p = now[slotOf(lowest->link)].pointAt(lowest->center_L);
    const Vector3d was = before[slotOf(lowest->link)].pointAt(lowest->center_L);
    Run& run = runs_[limb];
    if ((p - was).norm() > kRestSpeed * stepS_) return close(limb);
    if (run.last < run.first) run = {step, step, Vector3d::Zero()};
    run.last = step;
    run.sum += Vector3d(p.x(), height, p.z());
  }

  void close(std::size_t limb) {
    Run& run = runs_[limb];
    const auto poses = static_cast<double>(run.last - run.first + 1);
    if (run.last >= run.first && poses * stepS_ >= kRestTimeS) {
      rests_.push_back({limb, run.first, run.last, poses * stepS_, run.sum / poses});
    }
    run = Run{};
  }

  const RestingBody& body_;
  double stepS_;
  std::vector<FootRest>& rests_;
  std::vector<Run> runs_;
};

}  // namespace

Eigen::Isometry3d FloorFit::levelledTo(double target) const {
  const Eigen::Quaterniond turn = turnBetween(normal_W, Vector3d::UnitY());
  Eigen::Isometry3d level = Eigen::Isometry3d::Identity();
  level.linear() = turn.toRotationMatrix();
  level.translation() = Vector3d(center_W.x(), target, center_W.z()) - level.linear() * center_W;
  return level;
}

Result<std::vector<FootRest>> footRestsOf(const RestingBody& body, std::int64_t steps, double stepS,
                                          const RestingPoses& poses) {
  std::vector<FootRest> rests;
  RestFinder finder(body, stepS, rests);
  std::vector<LinkState> before, now;
  for (std::int64_t step = 0; step <= steps; ++step) {
    FORETOUCH_TRY(const auto pose, poses(step));
    before.swap(now);
    placesAt(body.avatar.skeleton(), pose, now);
    if (step > 0) finder.add(step, before, now);
  }
  finder.finish();
  return rests;
}

Result<FloorFit> fitFloor(const std::vector<FootRest>& rests) {
  if (rests.empty()) {
    return Error::of(ErrorCode::Empty,
                     fmt::format("no foot rests: none is slower than {:g} m/s for {:g} s, so "
                                 "nothing shows where the floor is",
                                 kRestSpeed, kRestTimeS));
  }
  Plane plane = bestPlane(rests);
  for (int i = 0; i < 4; ++i) plane = refined(plane, rests);
  const FloorFit fit = fitOf(plane, rests);
  if (fit.onFloorS >= kLeastOnFloorS && fit.onFloorS >= kLeastShare * fit.restS) return fit;
  return Error::of(
      ErrorCode::Empty,
      fmt::format("feet rest {} times for {:.2g} s in all, but only {:.2g} s of it within {:g} mm "
                  "of one floor, at {:.3f} m: they rest on several heights, or not on a floor",
                  rests.size(), fit.restS, fit.onFloorS, 1e3 * kOnFloor, fit.height));
}

}  // namespace foretouch::tools
