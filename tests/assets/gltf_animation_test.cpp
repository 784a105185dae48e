// Animations of glTF files that the test writes: between keys, by values computed otherwise.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/gltf_writer.h"
#include "tests/assets/model_files.h"
#include "tests/support/random_geometry.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

const std::vector<double> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

/// An arm on a root, with an animation of it whose sampler is to be given.
class GltfAnimation : public testing::Test {
 protected:
  /// The arm's pose at `rateHz`, from 0 s on.
  std::vector<Pose> posesOf(const std::string& path, const json& sampler, GltfWriter& writer,
                            double rateHz) {
    const std::size_t position = writer.accessor(kTriangle, 3);
    writer.node({{"name", "root"}, {"children", {1}}});
    writer.root["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", position}}}}}}}};
    writer.node({{"name", "arm"}, {"mesh", 0}}, false);
    writer.root["animations"] = {
        {{"samplers", {sampler}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", path}}}}}}}};
    const auto model = importModel(folder_.write("a.gltf", writer.gltf()), withModelImporter());
    EXPECT_TRUE(model.ok()) << describe(model.error());
    if (!model.ok()) return {};
    ModelClipOptions options;
    options.rateHz = rateHz;
    const auto clip = clipFromModel(model.value(), options);
    EXPECT_TRUE(clip.ok()) << describe(clip.error());
    if (!clip.ok()) return {};
    EXPECT_EQ(clip.value().skeleton.name(1), "arm");
    notes_ = clip.value().notes;
    return clip.value().frames;
  }

  TempFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(GltfAnimation, CamerasAndLightsAreNoJoints) {
  GltfWriter writer;
  const std::size_t input = writer.accessor({0, 1}, 1);
  const std::size_t output = writer.accessor({0, 0, 0, 1, 0, 0}, 3);
  writer.node({{"name", "bone"}});
  writer.node({{"name", "camera"}, {"camera", 0}});
  writer.node({{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  json channels = json::array();
  for (int node = 0; node < 3; ++node) {
    channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}});
  }
  writer.root["animations"] = {
      {{"samplers", {{{"input", input}, {"output", output}}}}, {"channels", channels}}};
  const auto model = importModel(folder_.write("a.gltf", writer.gltf()), withModelImporter());
  ASSERT_TRUE(model.ok()) << describe(model.error());
  const auto clip = clipFromModel(model.value(), {});
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  ASSERT_EQ(clip.value().skeleton.numJoints(), 2);  // and the root above all
  EXPECT_EQ(clip.value().skeleton.name(1), "bone");
}

/// A cubic by de Casteljau's construction: the Bezier points of a Hermite curve lie a third of its
/// tangents away from its ends.
Eigen::VectorXd casteljau(const Eigen::VectorXd& p, const Eigen::VectorXd& out,
                          const Eigen::VectorXd& q, const Eigen::VectorXd& in, double durationS,
                          double share) {
  std::vector<Eigen::VectorXd> points{p, p + durationS / 3 * out, q - durationS / 3 * in, q};
  for (; points.size() > 1; points.pop_back()) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      points[i] += share * (points[i + 1] - points[i]);
    }
  }
  return points[0];
}

Eigen::VectorXd part(const std::vector<double>& numbers, std::size_t at, std::size_t width) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data() + at * width,
                                           static_cast<Eigen::Index>(width));
}

TEST_F(GltfAnimation, FollowsCubicSplines) {
  constexpr double kRate = 20;
  const std::vector<double> times{0, 0.5, 2};
  Random random(3);
  for (const std::size_t width : {std::size_t{3}, std::size_t{4}}) {
    std::vector<double> values;  // per key: tangent in, value, tangent out
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Quaternion turn = random.rotation();
      const std::vector<double> key{turn.x(), turn.y(), turn.z(), turn.w()};
      for (int which = 0; which < 3; ++which) {
        for (std::size_t i = 0; i < width; ++i) {
          values.push_back(static_cast<float>(which == 1 ? key[i] : random.uniform(-1, 1)));
        }
      }
    }
    GltfWriter writer;
    const std::size_t input = writer.accessor(times, 1), output = writer.accessor(values, width);
    const auto poses = posesOf(
        width == 4 ? "rotation" : "translation",
        {{"input", input}, {"output", output}, {"interpolation", "CUBICSPLINE"}}, writer, kRate);
    ASSERT_EQ(poses.size(), 41U);
    for (std::size_t f = 0; f < poses.size(); ++f) {
      const double t = static_cast<double>(f) / kRate;
      const std::size_t k = t < 0.5 ? 0 : 1;
      const double duration = times[k + 1] - times[k];
      Eigen::VectorXd expected =
          casteljau(part(values, 3 * k + 1, width), part(values, 3 * k + 2, width),
                    part(values, 3 * k + 4, width), part(values, 3 * k + 3, width), duration,
                    std::min(1.0, (t - times[k]) / duration));
      if (width == 3) {
        EXPECT_LT((poses[f].translations[1] - Vector3d(expected)).norm(), 1e-12) << t;
      } else {
        expected.normalize();
        const double cosine = std::abs(poses[f].rotations[1].coeffs().dot(expected));
        EXPECT_NEAR(cosine, 1.0, 1e-12) << t;
      }
    }
  }
}

TEST_F(GltfAnimation, TurnsByTheStatedAngleOnASplineWithoutTangents) {
  const double half = std::sqrt(0.5);
  GltfWriter writer;
  const std::size_t input = writer.accessor({0, 1}, 1);
  const std::size_t output = writer.accessor(
      {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, half, half, 0, 0, 0, 0}, 4);
  const auto poses =
      posesOf("rotation", {{"input", input}, {"output", output}, {"interpolation", "CUBICSPLINE"}},
              writer, 4);
  ASSERT_EQ(poses.size(), 5U);
  // s = 3 t^2 - 2 t^3 of each component, made unit.
  const double s = 0.15625;
  const double angle = 2 * std::atan2(s * half, 1 - s * (1 - half));
  EXPECT_NEAR(angle * 180 / kPi, 13.209, 1e-3);
  EXPECT_NEAR(Eigen::AngleAxisd(poses[1].rotations[1]).angle(), angle, 1e-6);
}

TEST_F(GltfAnimation, SaysWhichRateKeepsASplineWithinAMillimetre) {
  const auto notesAt = [&](double rate) {
    GltfWriter writer;
    const std::size_t input = writer.accessor({0, 1}, 1);
    // x = t^2 m, by its tangents 0 and 2 m/s: p'' is 2 m/s^2 all along, the chord's error h^2 / 4.
    const std::size_t output =
        writer.accessor({0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0, 0}, 3);
    posesOf("translation", {{"input", input}, {"output", output}, {"interpolation", "CUBICSPLINE"}},
            writer, rate);
    return notes_;
  };
  const auto coarse = notesAt(10);
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_EQ(coarse[0],
            "the animation follows curves: between its poses at 10 Hz the clip leaves them by up "
            "to 2.5 mm; 16 Hz would keep within 1 mm");
  EXPECT_TRUE(notesAt(16).empty());
}

TEST_F(GltfAnimation, HoldsStepsUntilTheNextKey) {
  GltfWriter writer;
  const std::size_t input = writer.accessor({0, 0.5, 1}, 1);
  const std::size_t output = writer.accessor({1, 0, 0, 2, 0, 0, 3, 0, 0}, 3);
  const auto poses = posesOf(
      "translation", {{"input", input}, {"output", output}, {"interpolation", "STEP"}}, writer, 8);
  ASSERT_EQ(poses.size(), 9U);
  const std::vector<double> expected{1, 1, 1, 1, 2, 2, 2, 2, 3};
  for (std::size_t f = 0; f < expected.size(); ++f) {
    EXPECT_EQ(poses[f].translations[1].x(), expected[f]) << f;
  }
}

TEST_F(GltfAnimation, ReadsRotationsStoredAsIntegers) {
  const double half = std::sqrt(0.5);
  for (const Stored type : {Stored::Byte, Stored::Short, Stored::Float}) {
    GltfWriter writer;
    const std::size_t input = writer.accessor({0, 1}, 1);
    const std::size_t output =
        writer.accessor({0, 0, 0, 1, 0, 0, half, half}, 4, {type, type != Stored::Float});
    const auto poses = posesOf(
        "rotation", {{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}, writer, 4);
    ASSERT_EQ(poses.size(), 5U);
    for (std::size_t f = 0; f < 5; ++f) {
      EXPECT_NEAR(Eigen::AngleAxisd(poses[f].rotations[1]).angle() * 180 / kPi,
                  22.5 * static_cast<double>(f), type == Stored::Byte ? 0.3 : 1e-3);
    }
  }
}

TEST_F(GltfAnimation, RefusesKeysWithoutTheirValues) {
  GltfWriter writer;
  const std::size_t input = writer.accessor({0, 0.5, 1}, 1);
  const std::size_t output = writer.accessor({1, 0, 0, 2, 0, 0, 3, 0, 0}, 3);
  writer.meshNode({{"attributes", {{"POSITION", writer.accessor(kTriangle, 3)}}}});
  writer.root["animations"] = {
      {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", "CUBICSPLINE"}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  const auto model = importModel(folder_.write("a.gltf", writer.gltf()), withModelImporter());
  ASSERT_FALSE(model.ok());
  EXPECT_NE(model.error().message.find("animations[0].samplers[0].output: expected 9 elements for "
                                       "the 3 keys of its input, found 3"),
            std::string::npos)
      << model.error().message;
}

}  // namespace
}  // namespace foretouch::test
