// Pieces of a constant rate stay as near to the cubic as they say: by the cubic itself, looked at
// at many instants.
#include "tools/inputs/pose_curve.h"

#include <vector>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "middleware/bracket/axis_places.h"
#include "tests/middleware/random_scene.h"

namespace foretouch::tools {
namespace {

constexpr double kStepS = 0.1;

struct Walk {
  Avatar avatar;
  std::vector<Pose> poses;
};

Walk walk(int seed) {
  test::Random random(static_cast<std::uint64_t>(seed));
  test::RandomBody body = test::bodyInClutter(random, 6, Eigen::Vector3d::Zero());
  Walk walk{body.avatar, {body.from}};
  for (int i = 0; i < 5; ++i) {
    Pose next = walk.poses.back();
    for (Quaternion& rotation : next.rotations) {
      rotation = (rotation * random.turn(0.4)).normalized();
    }
    next.translations[0] += random.inBox(0.1);
    walk.poses.push_back(next);
  }
  return walk;
}

PosedStep stepOf(const std::vector<Pose>& poses, std::size_t i) {
  const auto poseOf = [&](std::size_t k) { return k < poses.size() ? &poses[k] : nullptr; };
  return {i > 0 ? &poses[i - 1] : nullptr,
          poseOf(i),
          poseOf(i + 1),
          poseOf(i + 2),
          kStepS,
          kStepS,
          kStepS};
}

TEST(PoseCurve, PiecesStayAsNearToTheCubicAsTheySay) {
  constexpr double kAllowed = 1e-4;
  constexpr int kLooks = 64;
  double most = 0.0;
  for (int seed = 0; seed < 6; ++seed) {
    const Walk one = walk(seed);
    const auto made = poseCurve(one.avatar, one.poses, kStepS, MotionModel::CubicLate, 3, kAllowed);
    ASSERT_TRUE(made.ok()) << describe(made.error());
    const PoseCurve& curve = made.value();
    EXPECT_LE(curve.offM, kAllowed);
    EXPECT_EQ(curve.pieces % 3, 0);
    ASSERT_EQ(curve.poses.size(), 5 * static_cast<std::size_t>(curve.pieces) + 1);
    AxisPlacer placer(one.avatar);
    AxisPlaces places, truth;
    std::vector<double> apart;
    for (std::size_t step = 0; step < 5; ++step) {
      ModelMotion cubic;
      const PosedStep posed = stepOf(one.poses, step);
      cubic.assign(one.avatar.skeleton(), posed, MotionModel::CubicLate);
      for (int i = 0; i < kLooks; ++i) {
        const double t = (i + 0.5) / kLooks, at = t * static_cast<double>(curve.pieces);
        const auto piece = static_cast<std::size_t>(at);
        const std::size_t first = step * static_cast<std::size_t>(curve.pieces) + piece;
        Pose pose, modelled;
        ChainMotion(one.avatar.skeleton(), curve.poses[first], curve.poses[first + 1])
            .poseAt(at - static_cast<double>(piece), pose);
        cubic.poseAt(t, modelled);
        placer.place(pose, places);
        placer.place(modelled, truth);
        placer.differences(places, truth, apart);
        for (const double off : apart) {
          EXPECT_LE(off, curve.offM);
          most = std::max(most, off);
        }
      }
      EXPECT_EQ(curve.poses[step * static_cast<std::size_t>(curve.pieces)].rotations[1].coeffs(),
                one.poses[step].rotations[1].coeffs());
    }
  }
  EXPECT_GT(most, 0.02 * kAllowed);  // or the claim says nothing
}

TEST(PoseCurve, RefusesWhatWouldTakeTooManyPieces) {
  const Walk one = walk(1);
  const auto made = poseCurve(one.avatar, one.poses, kStepS, MotionModel::Cubic, 1, 1e-9);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().code, ErrorCode::LimitExceeded);
  EXPECT_NE(describe(made.error()).find("--between: expected a --tolerance"), std::string::npos)
      << describe(made.error());
}

}  // namespace
}  // namespace foretouch::tools
