// importModel() against the glTF itself: a small reader of the JSON and its accessors, which shares
// no code with the importer, says what nodes, skins and animations of real files are.
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assets/import/model_import.h"
#include "tests/assets/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Matrix4d;
using nlohmann::json;

struct Glb {
  json root;
  std::string binary;

  explicit Glb(const std::string& path) {
    const std::string bytes = contentOf(path);
    const std::uint32_t length = word(bytes, 12);
    root = json::parse(bytes.substr(20, length));
    if (bytes.size() > 28 + length) binary = bytes.substr(28 + length);
  }
  static std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }
  /// Element `i` of a float accessor of `width` numbers.
  [[nodiscard]] std::vector<double> numbers(std::size_t accessor, std::size_t i,
                                            std::size_t width) const {
    const json& a = root["accessors"][accessor];
    EXPECT_EQ(a["componentType"], 5126);
    const json& view = root["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t start = view.value("byteOffset", std::size_t{0}) +
                              a.value("byteOffset", std::size_t{0}) +
                              i * view.value("byteStride", 4 * width);
    std::vector<double> out;
    for (std::size_t k = 0; k < width; ++k) {
      float value = 0;
      std::memcpy(&value, binary.data() + start + 4 * k, sizeof value);
      out.push_back(value);
    }
    return out;
  }
  [[nodiscard]] std::string name(std::size_t node) const {
    return root["nodes"][node].value("name", "");
  }
};

Matrix4d localOf(const json& node) {
  if (node.contains("matrix")) {
    return Eigen::Map<const Matrix4d>(node["matrix"].get<std::vector<double>>().data());
  }
  const auto t = node.value("translation", std::vector<double>{0, 0, 0});
  const auto r = node.value("rotation", std::vector<double>{0, 0, 0, 1});
  const auto s = node.value("scale", std::vector<double>{1, 1, 1});
  Eigen::Affine3d local = Eigen::Affine3d::Identity();
  local.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  local.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]));
  local.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  return local.matrix();
}

Matrix4d matrixOf(const Affine& affine) {
  Matrix4d matrix = Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = affine.linear;
  matrix.topRightCorner<3, 1>() = affine.translation;
  return matrix;
}

class GltfFiles : public testing::TestWithParam<const char*> {};

TEST_P(GltfFiles, ComeWithTheirNodesSkinsAndAnimations) {
  FORETOUCH_REQUIRE_SHARED(path, std::string("avatars/") + GetParam());
  const Glb glb(*path);
  const auto result = importModel(*path, withModelImporter());
  ASSERT_TRUE(result.ok()) << describe(result.error());
  const Model& model = result.value();

  std::map<std::string, int> uses;
  std::map<std::size_t, std::size_t> parents;
  const json& nodes = glb.root["nodes"];
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    ++uses[glb.name(i)];
    for (const std::size_t child : nodes[i].value("children", std::vector<std::size_t>{})) {
      parents[child] = i;
    }
  }
  int compared = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (glb.name(i).empty() || uses[glb.name(i)] > 1) continue;
    const ModelNode& node = model.nodes[nodeNamed(model, glb.name(i))];
    EXPECT_LT((matrixOf(node.toParent) - localOf(nodes[i])).cwiseAbs().maxCoeff(),
              1e-5 * (1 + localOf(nodes[i]).cwiseAbs().maxCoeff()))
        << glb.name(i);
    if (parents.count(i) != 0 && !glb.name(parents[i]).empty()) {
      ASSERT_GE(node.parent, 0);
      EXPECT_EQ(model.nodes[node.parent].name, glb.name(parents[i]));
    }
    ++compared;
  }
  EXPECT_GT(compared, 10);

  std::map<std::string, std::size_t> bindOf;  // of skin 0; all skins of these files agree
  if (glb.root.contains("skins")) {
    const json& skin = glb.root["skins"][0];
    for (std::size_t j = 0; j < skin["joints"].size(); ++j) {
      bindOf[glb.name(skin["joints"][j])] = j;
    }
  }
  for (const ModelMesh& mesh : model.meshes) {
    if (mesh.bones.empty()) continue;
    EXPECT_EQ(mesh.bones.size(), bindOf.size());
    for (const ModelBone& bone : mesh.bones) {
      ASSERT_EQ(bindOf.count(bone.name), 1U) << bone.name;
      EXPECT_EQ(model.nodes[bone.node].name, bone.name);
      const auto bind =
          glb.numbers(glb.root["skins"][0]["inverseBindMatrices"], bindOf[bone.name], 16);
      const Matrix4d expected = Eigen::Map<const Matrix4d>(bind.data());
      EXPECT_LT((matrixOf(bone.meshToBone) - expected).cwiseAbs().maxCoeff(), 1e-6) << bone.name;
    }
  }

  const json animations = glb.root.value("animations", json::array());
  ASSERT_EQ(model.animations.size(), animations.size());
  int channels = 0;
  for (std::size_t a = 0; a < animations.size(); ++a) {
    EXPECT_EQ(model.animations[a].name, animations[a].value("name", ""));
    for (const json& channel : animations[a]["channels"]) {
      const json& sampler = animations[a]["samplers"][channel["sampler"].get<std::size_t>()];
      const std::string what = channel["target"]["path"];
      const std::string name = glb.name(channel["target"]["node"]);
      if (uses[name] > 1 || what != "rotation") continue;
      const std::size_t input = sampler["input"], output = sampler["output"];
      const std::size_t count = glb.root["accessors"][input]["count"];
      for (const ModelTrack& track : model.animations[a].tracks) {
        if (model.nodes[track.node].name != name) continue;
        ++channels;
        // A step takes two keys: the value that holds, and the one that takes over.
        const std::size_t each = sampler.value("interpolation", "LINEAR") == "STEP" ? 2 : 1;
        ASSERT_EQ(track.rotations.size(), each * (count - 1) + 1) << name;
        for (const std::size_t k : {std::size_t{0}, count / 2, count - 1}) {
          const auto q = glb.numbers(output, k, 4);
          EXPECT_NEAR(track.rotations[each * k].timeS, glb.numbers(input, k, 1)[0], 1e-5);
          EXPECT_TRUE(track.rotations[each * k].value.coeffs().isApprox(
              Eigen::Vector4d(q[0], q[1], q[2], q[3]), 1e-6));
        }
      }
    }
  }
  EXPECT_GT(channels, 20);
}

INSTANTIATE_TEST_SUITE_P(SharedData, GltfFiles,
                         testing::Values("Fox.glb", "greenman.glb", "robot_expressive.glb",
                                         "kaykit_manny/Med_CombatMelee.glb",
                                         "kaykit_manny/Med_MovementAdvanced.glb"));

}  // namespace
}  // namespace foretouch::test
