#include "bench/person/reach_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/person/ahead_ways.h"
#include "bench/solid/cells.h"
#include "bench/solid/plain_body.h"
#include "bench/solid/stage.h"
#include "bench/timing.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Frames per given pose; how far all ways look ahead, and the times within which they warn (s).
constexpr std::size_t kEvery = 8;
constexpr double kHorizonS = 0.2;
constexpr std::array<double, 3> kLeadsS = {0.05, 0.1, 0.15};
/// How long the hand rests before and after it moves (s).
constexpr double kRestS = 0.1;

constexpr double kTopM = 0.75, kTableThickM = 0.04;
constexpr double kUpperArmM = 0.32, kForearmM = 0.27, kHandM = 0.18, kHandRadiusM = 0.03;

void addBox(const Vector3d& low, const Vector3d& high, RawScene& scene) {
  const auto corner = [&](unsigned i) {
    return Vector3d(i & 1U ? high.x() : low.x(), i & 2U ? high.y() : low.y(),
                    i & 4U ? high.z() : low.z());
  };
  constexpr unsigned kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : kFaces) {
    scene.triangles.push_back({corner(face[0]), corner(face[1]), corner(face[2])});
    scene.triangles.push_back({corner(face[0]), corner(face[2]), corner(face[3])});
  }
}

SolidStage tableStage() {
  RawScene raw;
  addBox({-0.8, 0.15, kTopM - kTableThickM}, {0.8, 0.95, kTopM}, raw);
  raw.objectNames = {"table"};
  raw.objectOf.assign(raw.triangles.size(), 0);
  return stageOf("table", std::move(raw));
}

/// Each part of the arm lies along y of its joint.
Avatar armAvatar() {
  RawSkeleton raw;
  raw.joints = {{"Spine", kNoParent, {0.0, 0.0, 1.2}},
                {"RightArm", 0},
                {"RightForeArm", 1, {0.0, kUpperArmM, 0.0}},
                {"RightHand", 2, {0.0, kForearmM, 0.0}}};
  const auto along = [](double length, double radius) {
    return std::vector<Lss>{Lss{Vector3d::Zero(), {0.0, length, 0.0}, radius}};
  };
  return Avatar::build(
             Skeleton::build(raw).value(),
             {{}, along(kUpperArmM, 0.05), along(kForearmM, 0.04), along(kHandM, kHandRadiusM)})
      .value();
}

/// Where a tip begins and ends, and how the elbow hangs.
struct Reach {
  Vector3d from, to;
  double seconds = 0.0, swivel = 0.0, lean = 0.0;
  bool isAimed = false;  ///< At the table.
};

class ReachDraw {
 public:
  explicit ReachDraw(const ReachRequest& request) : request_(request), random_(request.seed) {}

  Reach draw(int index) {
    const double above = kTopM + kHandRadiusM;
    Reach reach;
    reach.from = {uniform(-0.25, 0.25), uniform(0.2, 0.3), above + uniform(0.2, 0.3)};
    reach.to = {uniform(-0.25, 0.25), uniform(0.35, 0.5), above};
    reach.isAimed = index % 2 == 0;
    if (reach.isAimed) {
      reach.to.z() -= uniform(0.0, 0.1);
    } else if (index % 4 == 1) {
      reach.to.z() += uniform(0.01, 0.2);
    } else {
      reach.to.z() += uniform(0.01, 0.1);
      reach.from.z() = reach.to.z();
      reach.from.x() = reach.to.x() > 0.0 ? -0.25 : 0.25;
    }
    // With the least jerk, the greatest speed is 15/8 of the mean one.
    reach.seconds =
        15.0 / 8.0 * (reach.to - reach.from).norm() / (uniform(0.8, 1.2) * request_.speed);
    reach.swivel = uniform(0.1, 0.8);
    reach.lean = uniform(0.0, 0.08);
    return reach;
  }

 private:
  double uniform(double low, double high) {
    // Not std::uniform_real_distribution, which differs from library to library.
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }

  const ReachRequest& request_;
  std::mt19937_64 random_;
};

Quaternion alongY(const Vector3d& direction) {
  return Quaternion::FromTwoVectors(Vector3d::UnitY(), direction);
}

/// The arm whose tip is at a place: the elbow by the law of cosines.
Pose armPose(const Skeleton& skeleton, const Vector3d& shoulder, const Vector3d& tip,
             double swivel) {
  constexpr double kLower = kForearmM + kHandM;
  const Vector3d way = tip - shoulder;
  const double length = std::min(way.norm(), 0.999 * (kUpperArmM + kLower));
  const Vector3d ahead = way.normalized();
  const double cosine =
      (kUpperArmM * kUpperArmM + length * length - kLower * kLower) / (2.0 * kUpperArmM * length);
  const Vector3d hangs(std::sin(swivel), 0.0, -std::cos(swivel));
  const Vector3d aside = (hangs - hangs.dot(ahead) * ahead).normalized();
  const Vector3d upper = cosine * ahead + std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) * aside;
  const Vector3d lower = (length * ahead - kUpperArmM * upper).normalized();
  Pose pose = restPose(skeleton);
  pose.translations[0] = shoulder;
  pose.rotations[1] = alongY(upper);
  pose.rotations[2] = alongY(upper).conjugate() * alongY(lower);
  return validatedPose(skeleton, pose).value();
}

/// 0 at 0 and 1 at 1, with the least jerk.
double leastJerk(double u) {
  return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
}

std::vector<Pose> posesOf(const Skeleton& skeleton, const Reach& reach, double frameS) {
  const Vector3d shoulder = skeleton.restOffset(0);
  std::vector<Pose> poses;
  const double end = reach.seconds + kRestS + kHorizonS;
  for (double s = -kRestS; s < end; s += frameS) {
    const double u = leastJerk(std::clamp(s / reach.seconds, 0.0, 1.0));
    poses.push_back(armPose(skeleton, shoulder + u * Vector3d(0.0, reach.lean, 0.0),
                            reach.from + u * (reach.to - reach.from), reach.swivel));
  }
  return poses;
}

/// A reach that goes on, and what is said about it.
struct Told {
  std::vector<Pose> frames;
  std::unique_ptr<HeldBack> held;
  std::unique_ptr<AheadPerson> ahead;
  std::optional<double> touchS;                           ///< The first touch of any link.
  std::vector<double> posesS;                             ///< The poses before it, or all.
  std::vector<double> distances;                          ///< Per pose, for the nearest link (m).
  std::array<std::vector<double>, kAheadWays> possibleS;  ///< Per pose; infinite: not in sight.
};

class ReachTrial {
 public:
  explicit ReachTrial(const ReachRequest& request)
      : request_(request),
        stage_(tableStage()),
        avatar_(armAvatar()),
        query_(BracketQuery::build(avatar_, stage_.scene, {}).value()),
        frameS_(1.0 / (request.rateHz * static_cast<double>(kEvery))) {}

  JudgedTable run() {
    makeReaches();
    for (const auto what : {AheadPerson::Learn::Speed, AheadPerson::Learn::Rest}) {
      for (const Told& reach : reaches_) reach.ahead->learn(what, bounds_);
    }
    for (Told& reach : reaches_) ask(reach);
    return {table(), late_};
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  void makeReaches() {
    ReachDraw draw(request_);
    const int frames = static_cast<int>(std::lround(kHorizonS / frameS_));
    for (int i = 0; i < request_.reaches; ++i) {
      Told reach;
      reach.frames = posesOf(avatar_.skeleton(), draw.draw(i), frameS_);
      std::vector<oracle::PlainPose> plain;
      for (const Pose& pose : reach.frames) plain.push_back(plainPose(pose));
      reach.held = std::make_unique<HeldBack>(stage_.judged, plainBody(avatar_), std::move(plain));
      reaches_.push_back(std::move(reach));
    }
    for (Told& reach : reaches_) {
      reach.ahead = std::make_unique<AheadPerson>(*reach.held, avatar_, reach.frames, query_,
                                                  AheadPerson::Horizon{frameS_, kEvery, frames});
    }
  }

  /// How far the nearest link is apart.
  [[nodiscard]] double apart(const Told& reach, const std::vector<HeldBack::Axis>& axes) const {
    constexpr double kFar = 1.0;
    double least = kFar;
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      if (!avatar_.lss(link).empty())
        least = std::min(least, reach.held->fromScene(axes, link, kFar));
    }
    return least;
  }

  void findTouch(Told& reach) const {
    constexpr int kPerStep = 4 * static_cast<int>(kEvery);
    for (const HeldBackStep& step : reach.held->steps(kEvery)) {
      for (int i = 0; i <= kPerStep; ++i) {
        const double u = static_cast<double>(i) / kPerStep;
        if (!(apart(reach, reach.held->truthAt(step, u)) < -kJudgeRounding)) continue;
        reach.touchS = (static_cast<double>(step.from) + u * static_cast<double>(kEvery)) * frameS_;
        return;
      }
    }
  }

  void ask(Told& reach) {
    findTouch(reach);
    for (const HeldBackStep& step : reach.ahead->steps()) {
      const double now = static_cast<double>(step.to) * frameS_;
      if (now >= reach.touchS.value_or(kNever)) break;
      reach.posesS.push_back(now);
      reach.distances.push_back(apart(reach, reach.held->posedAt(step.to)));
      for (std::size_t way = 0; way < kAheadWays; ++way) {
        double first = kNever;
        for (const auto& one : reach.ahead->told(static_cast<AheadWay>(way), step, bounds_, us_)) {
          first = std::min(first, one.value_or(kNever));
        }
        reach.possibleS[way].push_back(first);
        if (!reach.touchS) continue;
        const double truth = *reach.touchS - now;
        late_ += truth <= kHorizonS && first > truth ? 1 : 0;
      }
      ++poses_;
    }
  }

  /// How long before the touch the warning comes (s): by the first pose for which `says` is true;
  /// none: never.
  template <typename Says>
  static std::optional<double> warned(const Told& reach, const Says& says) {
    for (std::size_t i = 0; i < reach.posesS.size(); ++i) {
      if (says(i)) return reach.touchS.value_or(reach.posesS[i]) - reach.posesS[i];
    }
    return std::nullopt;
  }

  struct Warnings {
    std::vector<double> ms;
    std::uint64_t touched = 0, never = 0, others = 0, alarms = 0;
  };
  template <typename Says>
  [[nodiscard]] Warnings warnings(const Says& says) const {
    Warnings all;
    for (const Told& reach : reaches_) {
      const auto one = warned(reach, [&](std::size_t i) { return says(reach, i); });
      if (!reach.touchS) {
        ++all.others;
        all.alarms += one ? 1 : 0;
        continue;
      }
      ++all.touched;
      all.never += one ? 0 : 1;
      all.ms.push_back(1e3 * one.value_or(0.0));
    }
    return all;
  }

  /// The largest distance that warns no more than so many of the hands that do not touch.
  [[nodiscard]] double distanceFor(std::uint64_t alarms) const {
    std::vector<double> nearest;
    for (const Told& reach : reaches_) {
      if (reach.touchS) continue;
      nearest.push_back(*std::min_element(reach.distances.begin(), reach.distances.end()));
    }
    std::sort(nearest.begin(), nearest.end());
    constexpr double kJustBelow = 1.0 - 1e-9;
    return alarms < nearest.size() ? kJustBelow * nearest[alarms] : nearest.back();
  }

  [[nodiscard]] BenchTable table() const {
    BenchTable table{
        "reach",
        fmt::format("Warnings of {} reaches for a table at {:g} m/s, {:g} poses per second",
                    request_.reaches, request_.speed, request_.rateHz),
        {{"within_ms", "within ms", 0},
         {"by", "by"},
         {"touched", "touched"},
         {"never", "not warned"},
         {"warning_p50_ms", "warning p50 ms", 0},
         {"warning_least_ms", "the least ms", 0},
         {"alarms_percent", "false alarms %", 1},
         {"trigger_mm", "at mm", 0},
         {"us", "us per pose", 1}},
        {}};
    const auto addRow = [&](double leadS, const char* by, const Warnings& all, BenchCell atMm,
                            BenchCell us) {
      const double least = all.ms.empty() ? 0.0 : *std::min_element(all.ms.begin(), all.ms.end());
      table.rows.push_back({1e3 * leadS, std::string(by), cell(all.touched), cell(all.never),
                            percentilesOf(all.ms).p50, least, percent(all.alarms, all.others),
                            std::move(atMm), std::move(us)});
    };
    for (const double leadS : kLeadsS) {
      for (std::size_t way = 0; way < kAheadWays; ++way) {
        const Warnings all = warnings(
            [&](const Told& reach, std::size_t i) { return reach.possibleS[way][i] <= leadS; });
        const bool isOurs = way == 0;
        addRow(leadS, toString(static_cast<AheadWay>(way)), all, std::string(),
               isOurs ? BenchCell(us_ / static_cast<double>(std::max<std::uint64_t>(poses_, 1)))
                      : BenchCell(std::string()));
        if (!isOurs) continue;
        const double most = distanceFor(all.alarms);
        addRow(leadS, "a distance", warnings([&](const Told& reach, std::size_t i) {
                 return reach.distances[i] <= most;
               }),
               kMm * most, std::string());
      }
    }
    return table;
  }

  const ReachRequest& request_;
  SolidStage stage_;
  Avatar avatar_;
  BracketQuery query_;
  double frameS_;
  std::vector<Told> reaches_;
  AheadBounds bounds_;
  double us_ = 0.0;
  std::uint64_t poses_ = 0, late_ = 0;
};

}  // namespace

JudgedTable reachTable(const ReachRequest& request) {
  return ReachTrial(request).run();
}

}  // namespace foretouch::tools
