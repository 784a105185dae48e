#include "tools/glb/avatar_animation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// The dot product as the motion's definition computes it: in the order w, x, y, z.
double dotOf(const Quaternion& p, const Quaternion& q) {
  return p.w() * q.w() + p.x() * q.x() + p.y() * q.y() + p.z() * q.z();
}

Quaternion negative(const Quaternion& q) {
  return {-q.w(), -q.x(), -q.y(), -q.z()};
}

/// Slerp's middle of unit quaternions whose dot product is not negative.
Quaternion middleOf(const Quaternion& p, const Quaternion& q) {
  return Quaternion(p.coeffs() + q.coeffs()).normalized();
}

bool areEqual(const Quaternion& p, const Quaternion& q) {
  return p.coeffs() == q.coeffs();
}

std::vector<float> rowsOf(const RotationKeys& keys) {
  std::vector<float> rows;
  const auto append = [&](const Quaternion& q) {
    for (const double x : {q.x(), q.y(), q.z(), q.w()}) rows.push_back(static_cast<float>(x));
  };
  for (std::size_t i = 0; i < keys.values.size(); ++i) {
    if (i > 0 && keys.haveMiddles) append(middleOf(keys.values[i - 1], keys.values[i]));
    append(keys.values[i]);
  }
  return rows;
}

std::vector<float> timesOf(const std::vector<double>& timesS, bool haveMiddles) {
  std::vector<float> times;
  for (std::size_t i = 0; i < timesS.size(); ++i) {
    if (i > 0 && haveMiddles) {
      times.push_back(static_cast<float>(0.5 * (timesS[i - 1] + timesS[i])));
    }
    times.push_back(static_cast<float>(timesS[i]));
  }
  return times;
}

/// The accessors of key times, each added on first use.
class KeyTimes {
 public:
  KeyTimes(const std::vector<double>& timesS, GlbContent& content)
      : timesS_(timesS), content_(content) {}
  std::size_t accessor(bool haveMiddles) {
    auto& known = accessors_[haveMiddles ? 1 : 0];
    if (!known) known = content_.addRows(timesOf(timesS_, haveMiddles), 1);
    return *known;
  }

 private:
  const std::vector<double>& timesS_;
  GlbContent& content_;
  std::optional<std::size_t> accessors_[2];
};

struct TranslationKeys {
  std::vector<float> rows;
  bool areConstant = true;
};

TranslationKeys translationKeys(const std::vector<Pose>& poses, JointId joint,
                                const Vector3d& origin) {
  const auto index = slotOf(joint);
  TranslationKeys keys;
  for (const Pose& pose : poses) {
    keys.areConstant =
        keys.areConstant && pose.translations[index] == poses.front().translations[index];
    for (const double x : Vector3d(pose.translations[index] - origin)) {
      keys.rows.push_back(static_cast<float>(x));
    }
  }
  return keys;
}

json nodeOf(const Skeleton& skeleton, JointId joint, const Quaternion& rotation,
            const Vector3d& translation, std::size_t mesh) {
  json node = {{"name", skeleton.name(joint)},
               {"translation", gltfVector(translation)},
               {"rotation", json::array({rotation.x(), rotation.y(), rotation.z(), rotation.w()})}};
  if (mesh != kNoMesh) node["mesh"] = mesh;
  return node;
}

}  // namespace

RotationKeys rotationKeys(const std::vector<Pose>& poses, JointId joint) {
  // Beyond a third of a turn; up to there floats are far from the other arc.
  constexpr double kLeastDot = 0.5;
  const auto index = slotOf(joint);
  RotationKeys keys;
  keys.areConstant = true;
  bool isNegative = false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Quaternion& next = poses[i].rotations[index];
    if (i > 0) {
      // By the original poses: negated ones would turn a zero into the other arc.
      const double dot = dotOf(poses[i - 1].rotations[index], next);
      keys.haveMiddles = keys.haveMiddles || std::abs(dot) < kLeastDot;
      isNegative = isNegative != (dot < 0.0);
    }
    keys.values.push_back(isNegative ? negative(next) : next);
    keys.areConstant = keys.areConstant && areEqual(keys.values.back(), keys.values.front());
  }
  return keys;
}

void GlbAnimation::add(std::size_t node, const char* path, std::size_t input, std::size_t output,
                       const char* interpolation) {
  entry_["samplers"].push_back(
      {{"input", input}, {"output", output}, {"interpolation", interpolation}});
  entry_["channels"].push_back(
      {{"sampler", samplers_++}, {"target", {{"node", node}, {"path", path}}}});
}

void GlbAnimation::finish(GltfDocument& document) {
  if (samplers_ > 0) document.add("animations", entry_);
}

Result<Done> checkTimes(const std::vector<double>& timesS) {
  const std::vector<float> times = timesOf(timesS, true);
  const auto late = std::adjacent_find(times.begin(), times.end(),
                                       [](float earlier, float later) { return later <= earlier; });
  if (late == times.end()) return Done{};
  return Error::in(
      "--glb", ErrorCode::OutOfRange,
      fmt::format("times in a GLB are floats, which do not tell the poses after {} s apart",
                  *late));
}

std::size_t addAvatar(const AvatarTrack& track, const std::vector<std::size_t>& meshes,
                      std::size_t parent, const Vector3d& origin, GlbContent& content,
                      GlbAnimation& animation) {
  const Skeleton& skeleton = track.skeleton;
  GltfDocument& document = content.document();
  KeyTimes times(track.timesS, content);
  std::size_t first = 0;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    const bool isRoot = skeleton.parent(joint) == kNoParent;
    const Vector3d shift = isRoot ? origin : Vector3d(Vector3d::Zero());
    const RotationKeys rotations = rotationKeys(track.poses, joint);
    const TranslationKeys translations = translationKeys(track.poses, joint, shift);
    const auto index = slotOf(joint);
    const std::size_t node = document.add(
        "nodes", nodeOf(skeleton, joint, rotations.values.front(),
                        track.poses.front().translations[index] - shift, meshes[index]));
    if (joint == 0) first = node;
    const std::size_t above =
        isRoot ? parent : first + static_cast<std::size_t>(skeleton.parent(joint));
    document.at("nodes", above)["children"].push_back(node);
    if (!rotations.areConstant) {
      const std::size_t input = times.accessor(rotations.haveMiddles);
      animation.add(node, "rotation", input, content.addRows(rowsOf(rotations), 4), "LINEAR");
    }
    if (!translations.areConstant) {
      const std::size_t input = times.accessor(false);
      animation.add(node, "translation", input, content.addRows(translations.rows, 3), "LINEAR");
    }
  }
  return first;
}

}  // namespace foretouch::tools
