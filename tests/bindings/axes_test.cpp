// Engines' axes. The expected values turn points, not quaternions: a point that is turned by the
// engine and then converted is the point that is converted and then turned here.
#include <array>
#include <cfloat>
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tests/bindings/c_world.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

Vector3d converted(const Vector3d& engine, std::int32_t axes) {
  const std::array<float, 3> xyz = {static_cast<float>(engine.x()), static_cast<float>(engine.y()),
                                    static_cast<float>(engine.z())};
  Vector3d ours;
  EXPECT_EQ(ft_positions_from_floats(xyz.data(), 1, axes, ours.data()), FT_OK);
  return ours;
}

TEST(Axes, OfEnginesBecomeOurs) {
  EXPECT_EQ(converted({1, 2, 3}, FT_AXES_Y_UP_RIGHT), Vector3d(1, 2, 3));
  EXPECT_EQ(converted({1, 2, 3}, FT_AXES_Y_UP_LEFT), Vector3d(1, 2, -3));
  EXPECT_EQ(converted({100, 200, 300}, FT_AXES_Z_UP_LEFT), Vector3d(1, 3, 2));
}

TEST(Axes, TurnPointsAsTheEngineDoes) {
  for (const std::int32_t axes : {FT_AXES_Y_UP_RIGHT, FT_AXES_Y_UP_LEFT, FT_AXES_Z_UP_LEFT}) {
    for (int i = 0; i < 100; ++i) {
      Random random(static_cast<std::uint64_t>(i));
      // q v q* has one formula, whatever the handedness of the space that it is read in.
      const Eigen::Quaternionf engine =
          Eigen::Quaterniond(random.rotation()).cast<float>().normalized();
      const Vector3d point = random.inBox(100.0);
      const Vector3d turned = engine.cast<double>() * point.cast<float>().cast<double>();
      double wxyz[4];
      ASSERT_EQ(ft_rotations_from_floats(engine.coeffs().data(), 1, axes, wxyz), FT_OK);
      const Eigen::Quaterniond ours(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
      const Vector3d expected = converted(turned, axes);
      EXPECT_LT((ours * converted(point, axes) - expected).norm(), 1e-4 * (1 + expected.norm()));
    }
  }
}

TEST(Axes, ComeBackAsTheyWere) {
  for (const std::int32_t axes : {FT_AXES_Y_UP_RIGHT, FT_AXES_Y_UP_LEFT, FT_AXES_Z_UP_LEFT}) {
    const std::array<float, 8> rotations = {0.1f, -0.2f, 0.3f, 0.9f, -0.5f, 0.5f, 0.5f, -0.5f};
    const std::array<float, 6> positions = {1.5f, -2.25f, 3.125f, 1e6f, -1e-6f, 0.0f};
    std::array<double, 8> q{};
    std::array<double, 6> p{};
    std::array<float, 8> rotationsBack{};
    std::array<float, 6> positionsBack{};
    ASSERT_EQ(ft_rotations_from_floats(rotations.data(), 2, axes, q.data()), FT_OK);
    ASSERT_EQ(ft_rotations_to_floats(q.data(), 2, axes, rotationsBack.data()), FT_OK);
    ASSERT_EQ(ft_positions_from_floats(positions.data(), 2, axes, p.data()), FT_OK);
    ASSERT_EQ(ft_positions_to_floats(p.data(), 2, axes, positionsBack.data()), FT_OK);
    EXPECT_EQ(rotationsBack, rotations);
    EXPECT_EQ(positionsBack, positions);
  }
}

TEST(Axes, PassNonFiniteNumbersThrough) {
  const double wide[3] = {1e300, -1e300, std::nan("")};
  float xyz[3];
  ASSERT_EQ(ft_positions_to_floats(wide, 1, FT_AXES_Y_UP_RIGHT, xyz), FT_OK);
  EXPECT_EQ(xyz[0], std::numeric_limits<float>::infinity());
  EXPECT_EQ(xyz[1], -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(xyz[2]));
}

TEST(Axes, AreRefusedWhereTheyAreNone) {
  double out[4] = {7, 7, 7, 7};
  const float in[4] = {0, 0, 0, 1};
  test::expectRefused(ft_rotations_from_floats(in, 1, 3, out), FT_ERROR_OUT_OF_RANGE, {"axes"});
  test::expectRefused(ft_rotations_from_floats(in, 1, -1, out), FT_ERROR_OUT_OF_RANGE, {"axes"});
  test::expectRefused(ft_positions_from_floats(nullptr, 1, 0, out), FT_ERROR_NULL_ARGUMENT,
                      {"input"});
  test::expectRefused(ft_positions_from_floats(in, 1, 0, nullptr), FT_ERROR_NULL_ARGUMENT,
                      {"output"});
  test::expectRefused(ft_positions_from_floats(in, static_cast<std::size_t>(-1), 0, out),
                      FT_ERROR_LIMIT_EXCEEDED, {"input"});
  EXPECT_EQ(ft_positions_from_floats(nullptr, 0, 0, nullptr), FT_OK);
  EXPECT_EQ(out[0], 7);
}

}  // namespace
}  // namespace foretouch
