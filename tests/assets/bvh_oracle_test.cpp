// Differential oracle: assimp reads BVH with code of its own and in float. Joint positions in the
// world, composed here from its keys, must be those of our clips.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "assets/bvh/bvh_reader.h"
#include "tests/assets/bvh_samples.h"
#include "tests/support/shared_data.h"

namespace foretouch {
namespace {

// Float keys are off by 6e-8 each, and a chain of some ten joints adds them up.
constexpr double kFloatAgreement = 2e-6;  // of the largest coordinate

using Positions = std::map<std::string, Eigen::Vector3d>;

/// One animated scene of assimp's, with our own forward kinematics.
class AssimpClip {
 public:
  explicit AssimpClip(const std::string& text) {
    importer_.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    scene_ = importer_.ReadFileFromMemory(text.data(), text.size(), 0, "bvh");
    if (scene_ == nullptr || scene_->mNumAnimations != 1) return;
    const aiAnimation& animation = *scene_->mAnimations[0];
    for (unsigned i = 0; i < animation.mNumChannels; ++i) {
      channels_[animation.mChannels[i]->mNodeName.C_Str()] = animation.mChannels[i];
    }
  }
  [[nodiscard]] bool ok() const { return !channels_.empty(); }

  [[nodiscard]] Positions positionsAt(std::size_t frame) const {
    Positions positions;
    struct Item {
      const aiNode* node;
      Eigen::Isometry3d parent;
    };
    std::vector<Item> open = {{scene_->mRootNode, Eigen::Isometry3d::Identity()}};
    while (!open.empty()) {
      const Item item = open.back();
      open.pop_back();
      const Eigen::Isometry3d world = item.parent * localOf(*item.node, frame);
      positions[item.node->mName.C_Str()] = world.translation();
      for (unsigned i = 0; i < item.node->mNumChildren; ++i) {
        open.push_back({item.node->mChildren[i], world});
      }
    }
    return positions;
  }

 private:
  [[nodiscard]] Eigen::Isometry3d localOf(const aiNode& node, std::size_t frame) const {
    Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
    const auto found = channels_.find(node.mName.C_Str());
    if (found == channels_.end()) {
      const aiMatrix4x4& m = node.mTransformation;
      local.translation() = Eigen::Vector3d(m.a4, m.b4, m.c4);
      return local;
    }
    const aiNodeAnim& keys = *found->second;
    const auto at = [frame](unsigned count) {
      return static_cast<unsigned>(std::min<std::size_t>(frame, count - 1));
    };
    const aiVector3D& p = keys.mPositionKeys[at(keys.mNumPositionKeys)].mValue;
    const aiQuaternion& q = keys.mRotationKeys[at(keys.mNumRotationKeys)].mValue;
    local.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    local.translation() = Eigen::Vector3d(p.x, p.y, p.z);
    return local;
  }

  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  std::map<std::string, const aiNodeAnim*> channels_;
};

Positions positionsOf(const Clip& clip, std::size_t frame) {
  Positions positions;
  std::vector<Eigen::Isometry3d> world(static_cast<std::size_t>(clip.skeleton.numJoints()));
  for (JointId j = 0; j < clip.skeleton.numJoints(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
    local.linear() = clip.frames[frame].rotations[i].toRotationMatrix();
    local.translation() = clip.frames[frame].translations[i];
    const JointId parent = clip.skeleton.parent(j);
    world[i] = parent == kNoParent ? local : world[static_cast<std::size_t>(parent)] * local;
    positions[clip.skeleton.name(j)] = world[i].translation();
  }
  return positions;
}

/// The largest disagreement at one frame, relative to the largest coordinate.
double disagreement(const Clip& clip, const AssimpClip& other, std::size_t frame) {
  const Positions ours = positionsOf(clip, frame);
  const Positions theirs = other.positionsAt(frame);
  double largest = 0.0;
  double size = 0.0;
  for (const auto& [name, position] : ours) {
    const auto found = theirs.find(name);
    if (found == theirs.end()) return HUGE_VAL;
    largest = std::max(largest, (position - found->second).norm());
    size = std::max(size, position.norm());
  }
  return largest / size;
}

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(BvhOracle, JointPositionsOfRealClipsAgreeWithAssimp) {
  FORETOUCH_REQUIRE_SHARED(folder, "mocap");
  int compared = 0;
  double worst = 0.0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() != ".bvh") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const std::string text = contentOf(entry.path());
    const auto clip = parseBvh(text, entry.path().string());
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    const AssimpClip other(text);
    if (!other.ok()) {
      std::printf("assimp refuses %s\n", entry.path().filename().c_str());
      continue;
    }
    ++compared;
    const std::size_t last = clip.value().frames.size() - 1;
    for (const std::size_t frame : {std::size_t{0}, last / 3, last / 2, last}) {
      const double off = disagreement(clip.value(), other, frame);
      EXPECT_LT(off, kFloatAgreement) << "frame " << frame;
      worst = std::max(worst, off);
    }
  }
  std::printf("%d clips compared, worst disagreement %.2g of the size\n", compared, worst);
  EXPECT_GE(compared, 15);
  EXPECT_GT(worst, 0.0);  // float against double: none at all would mean nothing was compared
}

TEST(BvhOracle, ChannelOrdersAgreeWithAssimp) {
  const char* const orders[] = {"Xrotation Yrotation Zrotation", "Xrotation Zrotation Yrotation",
                                "Yrotation Xrotation Zrotation", "Yrotation Zrotation Xrotation",
                                "Zrotation Xrotation Yrotation", "Zrotation Yrotation Xrotation"};
  for (const char* order : orders) {
    SCOPED_TRACE(order);
    const std::string text = test::edited(
        test::plainBvh(), "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation",
        std::string("CHANNELS 6 Xposition Yposition Zposition ") + order);
    const auto clip = parseBvh(text, "t");
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    const AssimpClip other(text);
    ASSERT_TRUE(other.ok());
    EXPECT_LT(disagreement(clip.value(), other, 0), 1e-6);
    EXPECT_LT(disagreement(clip.value(), other, 1), 1e-6);
  }
}

TEST(BvhOracle, OracleNoticesAWrongOrder) {
  const AssimpClip other(test::plainBvh());
  const auto clip =
      parseBvh(test::edited(test::plainBvh(), "Zposition Zrotation Xrotation Yrotation",
                            "Zposition Xrotation Zrotation Yrotation"),
               "t");
  ASSERT_TRUE(other.ok() && clip.ok());
  EXPECT_GT(disagreement(clip.value(), other, 0), 0.01);
}

}  // namespace
}  // namespace foretouch
