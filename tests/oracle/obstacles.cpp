#include "tests/oracle/obstacles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/solid/figure.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using tools::addSheet;
using tools::rich;

/// How near to the first pose no obstacle is.
constexpr double kFreeBy = 0.01;
constexpr int kPlates = 8, kSpikes = 16, kTries = 20, kBars = 12, kHoops = 4;
constexpr double kBar = 0.015;

/// From a corner along three edges.
void addBox(RawScene& raw, const Vector3d& corner, const Vector3d& x, const Vector3d& y,
            const Vector3d& z) {
  for (const Vector3d& at : {Vector3d::Zero().eval(), z}) addSheet(raw, corner + at, x, y);
  for (const Vector3d& at : {Vector3d::Zero().eval(), y}) addSheet(raw, corner + at, x, z);
  for (const Vector3d& at : {Vector3d::Zero().eval(), x}) addSheet(raw, corner + at, y, z);
}

/// A bar with a square section.
void addBar(RawScene& raw, const Vector3d& from, const Vector3d& to) {
  const Vector3d along = to - from, x = kBar * along.unitOrthogonal(),
                 y = kBar * along.cross(x).normalized();
  addBox(raw, from - 0.5 * (x + y), along, x, y);
}

class ObstacleMaker {
 public:
  ObstacleMaker(const Avatar& avatar, const std::vector<Pose>& poses, std::uint64_t seed)
      : body_(tools::plainBody(avatar)), poses_(poses), random_(seed), places_(nothing_, body_) {}

  RawScene make(Obstacles obstacles) {
    RawScene all;
    if (obstacles == Obstacles::Cage) addCage(all);
    const bool arePlates = obstacles == Obstacles::Plates;
    const int count = arePlates ? kPlates : obstacles == Obstacles::Spikes ? kSpikes : 0;
    for (int i = 0; i < count; ++i) {
      for (int tries = 0; tries < kTries; ++tries) {
        RawScene one;
        arePlates ? addPlate(one) : addSpike(one);
        if (!isFree(one)) continue;
        for (const Triangle& triangle : one.triangles) all.triangles.push_back(triangle);
        break;
      }
    }
    return all;
  }

 private:
  using Ends = std::vector<std::array<oracle::Vec3d, 2>>;

  bool isFree(const RawScene& raw) {
    const oracle::Scene alone(tools::plain(raw.triangles));
    return oracle::WayJudge(alone, body_).at(tools::plainPose(poses_.front()), kFreeBy).link < 0;
  }

  /// Where some end of an LSS is at some instant.
  Vector3d anywhereOnItsWay() {
    const auto at = static_cast<std::size_t>(random_.below(static_cast<int>(poses_.size())));
    const Ends& ends = places_.endsAt(tools::plainPose(poses_[at]));
    const auto lss = static_cast<std::size_t>(random_.below(static_cast<int>(ends.size())));
    return rich(ends[lss][random_.chance(0.5) ? 1 : 0]);
  }

  void addPlate(RawScene& raw) {
    const Vector3d middle = anywhereOnItsWay(), n = random_.direction();
    const double aside = random_.uniform(-0.05, 0.05), thickness = random_.magnitude(1e-3, 0.02);
    const Vector3d x = random_.uniform(0.2, 0.8) * n.unitOrthogonal();
    const Vector3d y = random_.uniform(0.2, 0.8) * n.cross(x).normalized();
    addBox(raw, middle + aside * n - 0.5 * (x + y), x, y, thickness * n);
  }

  void addSpike(RawScene& raw) {
    const Vector3d point = anywhereOnItsWay(), away = random_.direction();
    const Vector3d tip = point + random_.uniform(-0.03, 0.05) * away;
    const Vector3d base = tip + random_.uniform(0.15, 0.5) * away;
    const Vector3d x = random_.uniform(0.005, 0.03) * away.unitOrthogonal();
    const Vector3d y = x.norm() * away.cross(x).normalized();
    const std::array<Vector3d, 4> corners{base + x, base + y, base - x, base - y};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      raw.triangles.push_back({{tip, corners[i], corners[(i + 1) % corners.size()]}});
    }
  }

  /// Bars all around the first pose, hoops about them, and bars across above it.
  void addCage(RawScene& raw) {
    const Ends& ends = places_.endsAt(tools::plainPose(poses_.front()));
    oracle::Box box;
    for (const auto& [one, other] : ends) {
      box.add(one);
      box.add(other);
    }
    const Vector3d middle = 0.5 * (rich(box.low) + rich(box.high));
    double radius = 0.0;
    for (const auto& lss : ends) {
      for (const oracle::Vec3d& end : lss) {
        radius = std::max(radius, std::hypot(end.x - middle.x(), end.z - middle.z()));
      }
    }
    const double apart = thickest() + kBar + kFreeBy + random_.uniform(0.0, 0.1);
    const double bottom = box.low.y - apart, top = box.high.y + apart;
    // A polygon's sides are nearer than its corners.
    addBars(raw, middle, (radius + apart) / std::cos(kPi / kBars), bottom, top);
  }

  void addBars(RawScene& raw, const Vector3d& middle, double radius, double bottom, double top) {
    const double turn = random_.uniform(0.0, kPi);
    const auto at = [&](int i, double y) {
      const double angle = turn + 2.0 * kPi * i / kBars;
      const double x = middle.x() + radius * std::cos(angle);
      return Vector3d(x, y, middle.z() + radius * std::sin(angle));
    };
    for (int i = 0; i < kBars; ++i) {
      addBar(raw, at(i, bottom), at(i, top));
      for (int hoop = 0; hoop < kHoops; ++hoop) {
        const double y = bottom + (top - bottom) * hoop / (kHoops - 1);
        addBar(raw, at(i, y), at(i + 1, y));
      }
      if (i < kBars / 2) addBar(raw, at(i, top), at(i + kBars / 2, top));
    }
  }

  [[nodiscard]] double thickest() const {
    double radius = 0.0;
    for (const auto& link : body_.capsules) {
      for (const oracle::Capsule& capsule : link) radius = std::max(radius, capsule.radius);
    }
    return radius;
  }

  const oracle::Scene nothing_{std::vector<oracle::Triangle>{}};
  oracle::WayBody body_;
  const std::vector<Pose>& poses_;
  Random random_;
  oracle::WayJudge places_;
};

}  // namespace

const char* toString(Obstacles obstacles) {
  constexpr std::array<const char*, kNumObstacles> kWords = {"none", "plates", "cage", "spikes"};
  return kWords[static_cast<std::size_t>(obstacles)];
}

tools::SolidStage withObstacles(const tools::SolidStage& stage, Obstacles obstacles,
                                const Avatar& avatar, const std::vector<Pose>& poses,
                                std::uint64_t seed) {
  RawScene raw = ObstacleMaker(avatar, poses, seed).make(obstacles);
  for (int i = 0; i < stage.judged.numTriangles(); ++i) {
    const oracle::Triangle& triangle = stage.judged.triangle(i);
    raw.triangles.push_back({{rich(triangle[0]), rich(triangle[1]), rich(triangle[2])}});
  }
  raw.objectNames = {stage.name};
  raw.objectOf.assign(raw.triangles.size(), 0);
  return tools::stageOf(stage.name + " with " + toString(obstacles), std::move(raw));
}

}  // namespace foretouch::test
