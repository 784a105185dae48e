// Oracle: walks on a floor that the test tilts and shifts by a rotation of its own.
#include "tools/floor/floor_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "lss/turn_between.h"
#include "tests/tools/feet/planted_walk.h"

namespace foretouch::tools {
namespace {

using test::Place;

constexpr double kStepS = 1.0 / 60.0;

/// A plane y = height + slopes * (x, z), and what is planted on it.
struct TiltedFloor {
  double height = 0.0, slopeX = 0.0, slopeZ = 0.0;

  [[nodiscard]] double at(double x, double z) const { return height + slopeX * x + slopeZ * z; }
};

/// The soles of both feet, pose by pose.
using Soles = std::array<std::vector<Place>, 2>;

class Recorder {
 public:
  Recorder(const TiltedFloor& floor, unsigned seed, double noise)
      : floor_(floor), random_(seed), ofRest_(0.0, noise), jitter_(0.0, 0.0002) {}

  /// Both feet stand, `above` the floor.
  void stand(double seconds, double x, double z, double above = 0.0) {
    const double offLeft = ofRest_(random_), offRight = ofRest_(random_);
    for (double t = 0.0; t < seconds; t += kStepS) {
      put(0, x, z, above + offLeft);
      put(1, x, z + 0.2, above + offRight);
    }
  }
  /// Both fly up and down again.
  void jump(double x, double z) {
    for (double t = 0.0; t < 0.6; t += kStepS) {
      const double above = 4.9 * t * (0.6 - t);
      put(0, x, z, above);
      put(1, x, z + 0.2, above);
    }
  }
  /// One foot steps on while the other one stands.
  void step(int foot, double fromX, double fromZ, double toX, double toZ) {
    const double off = ofRest_(random_);
    const Place& still = soles_[1 - foot].back();
    const Place kept = still;
    for (double t = 0.0; t < 0.5; t += kStepS) {
      const double share = test::eased(t / 0.5), arc = std::sin(3.14159265 * t / 0.5);
      put(foot, fromX + share * (toX - fromX), fromZ + share * (toZ - fromZ),
          0.12 * arc * arc + off);
      soles_[1 - foot].push_back(kept);
    }
    for (double t = 0.0; t < 0.3; t += kStepS) {
      put(foot, toX, toZ, off);
      soles_[1 - foot].push_back(kept);
    }
  }
  /// On hands and knees: in turn a foot drags its toes on, while the other one rests on its own.
  void crawl(int moves) {
    for (int i = 0; i < moves; ++i) {
      const double off = ofRest_(random_);
      for (double t = 0.0; t < 0.8; t += kStepS) {
        const double moved = 0.3 * test::eased(t / 0.5);
        for (const int foot : {0, 1}) {
          const double x = 0.3 * ((i + 1 - foot) / 2) + (i % 2 == foot ? moved : 0.0);
          put(foot, x, 0.25 * foot, off);
        }
      }
    }
  }
  /// Both feet never stop.
  void swim(double seconds) {
    for (double t = 0.0; t < seconds; t += kStepS) {
      put(0, t, 0.0, 0.3 + 0.2 * std::sin(6.0 * t));
      put(1, t, 0.2, 0.3 - 0.2 * std::sin(6.0 * t));
    }
  }
  [[nodiscard]] const Soles& soles() const { return soles_; }

 private:
  void put(int foot, double x, double z, double above) {
    soles_[foot].push_back({x, floor_.at(x, z) + above + jitter_(random_), z});
  }
  TiltedFloor floor_;
  std::mt19937 random_;
  std::normal_distribution<double> ofRest_, jitter_;
  Soles soles_;
};

Avatar walker() {
  return parseAvatar(test::kWalkerAvatar, "walker.json").value();
}

/// Feet whose soles lie in the floor's slope, or whose heels are up by so much: their lowest point
/// is where the soles are.
Result<FloorFit> fitOf(const Soles& soles, const TiltedFloor& floor, double heelUpDeg = 0.0) {
  const Avatar avatar = walker();
  const RestingBody body = restingBodyOf(avatar).value();
  const Eigen::Vector3d normal = Eigen::Vector3d(-floor.slopeX, 1.0, -floor.slopeZ).normalized();
  const Eigen::Quaterniond turn =
      turnBetween(Eigen::Vector3d::UnitY(), normal) *
      Eigen::AngleAxisd(heelUpDeg * 0.0174532925, Eigen::Vector3d::UnitX());
  // As the avatar's text has them: where its LSS end in the ankle's frame, and their radius.
  double below = 0.0;
  for (const auto& [y, z, radius] : {std::array{-0.05, -0.05, 0.03},
                                     {-0.05, 0.12, 0.03},
                                     {-0.06, 0.15, 0.02},
                                     {-0.06, 0.2, 0.02}}) {
    below = std::max(below, radius - normal.dot(turn * Eigen::Vector3d(0.0, y, z)));
  }
  const auto poseAt = [&](std::int64_t step) -> Result<Pose> {
    Pose pose = restPose(avatar.skeleton());
    for (const int foot : {0, 1}) {
      const Place& sole = soles[foot][static_cast<std::size_t>(step)];
      const std::size_t ankle = foot == 0 ? 1 : 3;
      pose.translations[ankle] = Eigen::Vector3d(sole.x, sole.y, sole.z) + below * normal;
      pose.rotations[ankle] = Quaternion(turn);
    }
    return validatedPose(body.avatar.skeleton(), body.poseOf(std::move(pose)));
  };
  const auto steps = static_cast<std::int64_t>(std::min(soles[0].size(), soles[1].size())) - 1;
  const auto rests = footRestsOf(body, steps, kStepS, poseAt);
  EXPECT_TRUE(rests.ok());
  return fitFloor(rests.value());
}

TiltedFloor drawnFloor(std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.2, 0.2), tilt(0.0, std::tan(3.0 * 0.0174533)),
      angle(0.0, 6.2831853);
  const double slope = tilt(random), way = angle(random);
  return {shift(random), slope * std::cos(way), slope * std::sin(way)};
}

/// A T-pose 10 cm too high, a walk in a circle, a jump, and a stand on a box.
Soles usualClip(const TiltedFloor& floor, unsigned seed) {
  Recorder clip(floor, seed, 0.003);
  clip.stand(0.5, 0.0, 0.0, 0.1);
  clip.stand(0.5, 0.0, 0.0);
  double x = 0.0, z = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double way = 0.5 * i;
    const double toX = x + 0.6 * std::cos(way), toZ = z + 0.6 * std::sin(way);
    clip.step(i % 2, x, z, toX, toZ);
    x = toX;
    z = toZ;
  }
  clip.jump(x, z);
  clip.stand(0.6, x, z);
  clip.stand(0.8, x + 0.4, z, 0.35);
  return clip.soles();
}

TEST(FloorFit, FindsShiftedAndTiltedFloorsWithinFiveMillimetres) {
  constexpr unsigned kClips = 200;
  std::vector<double> errors, tilts;
  int within = 0;
  for (unsigned seed = 0; seed < kClips; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TiltedFloor floor = drawnFloor(random);
    const Soles soles = usualClip(floor, seed);
    const auto fit = fitOf(soles, floor);
    ASSERT_TRUE(fit.ok()) << describe(fit.error());
    const FloorFit& found = fit.value();
    // Of the height where the feet stand; and of the slope.
    const double error = found.height - floor.at(found.center_W.x(), found.center_W.z());
    errors.push_back(std::abs(error));
    within += std::abs(error) <= found.uncertainty ? 1 : 0;
    const Eigen::Vector3d normal = Eigen::Vector3d(-floor.slopeX, 1.0, -floor.slopeZ).normalized();
    tilts.push_back(std::acos(std::min(1.0, normal.dot(found.normal_W))));
  }
  std::sort(errors.begin(), errors.end());
  std::sort(tilts.begin(), tilts.end());
  const double p95 = errors[kClips * 95 / 100], tilt95 = tilts[kClips * 95 / 100];
  std::printf(
      "floors: height error p50 %.2f mm, p95 %.2f mm, most %.2f mm; tilt p95 %.2f degrees; "
      "%d of %u within the stated uncertainty\n",
      1e3 * errors[kClips / 2], 1e3 * p95, 1e3 * errors.back(), tilt95 / 0.0174533, within, kClips);
  EXPECT_LE(p95, 0.005);
  EXPECT_LE(tilt95, 0.0174533);
  EXPECT_GE(within, static_cast<int>(0.9 * kClips));
}

/// Crawling rests on toes, and drags them: the floor is where they rest.
TEST(FloorFit, FindsTheFloorOfWhoCrawls) {
  std::vector<double> errors;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TiltedFloor floor = drawnFloor(random);
    Recorder clip(floor, seed, 0.003);
    clip.crawl(12);
    const auto fit = fitOf(clip.soles(), floor, 75.0);
    ASSERT_TRUE(fit.ok()) << describe(fit.error());
    const Eigen::Vector3d& at = fit.value().center_W;
    errors.push_back(std::abs(fit.value().height - floor.at(at.x(), at.z())));
  }
  std::sort(errors.begin(), errors.end());
  std::printf("crawling: height error p95 %.2f mm\n", 1e3 * errors[38]);
  EXPECT_LE(errors[38], 0.005);
}

TEST(FloorFit, RefusesWhatDoesNotRest) {
  Recorder clip({}, 1, 0.0);
  clip.swim(5.0);
  const auto fit = fitOf(clip.soles(), {});
  ASSERT_FALSE(fit.ok());
  EXPECT_NE(fit.error().message.find("no foot rests"), std::string::npos) << fit.error().message;
}

TEST(FloorFit, RefusesStairsThatHaveNoFloor) {
  Recorder clip({}, 1, 0.0);
  for (int i = 0; i < 10; ++i) clip.stand(0.3, 0.3 * i, 0.0, 0.17 * i);
  const auto fit = fitOf(clip.soles(), {});
  ASSERT_FALSE(fit.ok());
  EXPECT_NE(fit.error().message.find("several heights"), std::string::npos) << fit.error().message;
}

TEST(FloorFit, LevelsItsOwnFloor) {
  const TiltedFloor floor{0.15, 0.03, -0.02};
  const FloorFit fit = fitOf(usualClip(floor, 7), floor).value();
  const Eigen::Isometry3d level = fit.levelledTo(0.0);
  for (const auto& [x, z] : {std::pair{0.0, 0.0}, {2.0, 1.0}, {-1.0, 2.0}}) {
    EXPECT_NEAR((level * Eigen::Vector3d(x, floor.at(x, z), z)).y(), 0.0, 0.02);
  }
}

TEST(RestingBody, CutsFeetInTheMiddleAndKeepsWhatTheyWere) {
  const Avatar avatar = walker();
  const RestingBody body = restingBodyOf(avatar).value();
  ASSERT_EQ(body.limbs.size(), 2u);
  ASSERT_EQ(body.parts.size(), 6u);
  EXPECT_EQ(body.nameOf(body.parts[0]), "LeftFoot heel");
  EXPECT_EQ(body.nameOf(body.parts[1]), "LeftFoot ball");
  EXPECT_EQ(body.nameOf(body.parts[2]), "LeftFoot toe");
  const Lss &heel = body.avatar.lss(body.parts[0].links[0])[0],
            &ball = body.avatar.lss(body.parts[1].links[0])[0];
  EXPECT_NEAR(heel.a.z(), -0.05, 1e-12);
  EXPECT_NEAR(heel.b.z(), 0.035, 1e-12);
  EXPECT_NEAR(ball.a.z(), 0.035, 1e-12);
  EXPECT_NEAR(ball.b.z(), 0.12, 1e-12);
}

TEST(RestingBody, RefusesABodyWithoutFeetByName) {
  const Avatar arm = parseAvatar(R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"Base","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,1,0],"radius":0.1}]}]})",
                                 "arm.json")
                         .value();
  const auto body = restingBodyOf(arm);
  ASSERT_FALSE(body.ok());
  EXPECT_NE(body.error().message.find("no joint is called a foot"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::tools
