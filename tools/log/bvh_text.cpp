#include "tools/log/bvh_text.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// Degrees a, b, c with R = Rz(a) Rx(b) Ry(c). Computes each from the remainder of the ones before,
/// so that all three together are right even if b is near a quarter turn and a alone is arbitrary.
std::array<double, 3> zxyDegrees(const Quaternion& rotation) {
  const Eigen::Matrix3d R = rotation.toRotationMatrix();
  const double a = std::atan2(-R(0, 1), R(1, 1));
  const double sine = std::sin(a), cosine = std::cos(a);
  const Vector3d row0 = cosine * R.row(0) + sine * R.row(1);  // of Rx(b) Ry(c)
  const Vector3d row1 = cosine * R.row(1) - sine * R.row(0);
  const double b = std::atan2(R(2, 1), row1.y());
  const double c = std::atan2(row0.z(), row0.x());
  return {a * kDegrees, b * kDegrees, c * kDegrees};
}

/// Children of every joint, and last the roots.
std::vector<std::vector<JointId>> childrenOf(const Skeleton& skeleton) {
  std::vector<std::vector<JointId>> children(countOf(skeleton.numJoints()) + 1);
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    const JointId parent = skeleton.parent(joint);
    const JointId place = parent == kNoParent ? skeleton.numJoints() : parent;
    children[slotOf(place)].push_back(joint);
  }
  return children;
}

/// The hierarchy's text, and the order of its joints.
class Hierarchy {
 public:
  Hierarchy(const Skeleton& skeleton, const std::vector<bool>& hasTranslation)
      : skeleton_(skeleton), hasTranslation_(hasTranslation), children_(childrenOf(skeleton)) {
    std::vector<std::pair<JointId, std::size_t>> open;  // and how many children are written
    for (const JointId root : children_.back()) {
      begin(root, open.size());
      open.emplace_back(root, 0);
      while (!open.empty()) {
        auto& [joint, written] = open.back();
        const std::vector<JointId>& children = children_[slotOf(joint)];
        if (written < children.size()) {
          const JointId child = children[written++];
          begin(child, open.size());
          open.emplace_back(child, 0);
        } else {
          if (children.empty()) endSite(open.size());
          open.pop_back();
          line(open.size(), "}");
        }
      }
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<JointId>& order() const { return order_; }
  [[nodiscard]] bool hasPosition(JointId joint) const {
    return skeleton_.parent(joint) == kNoParent || hasTranslation_[slotOf(joint)];
  }

 private:
  void line(std::size_t depth, const std::string& content) {
    text_ += std::string(depth, '\t') + content + "\n";
  }
  void begin(JointId joint, std::size_t depth) {
    const Vector3d& p = skeleton_.restOffset(joint);
    line(depth, (depth == 0 ? "ROOT " : "JOINT ") + skeleton_.name(joint));
    line(depth, "{");
    line(depth + 1, fmt::format("OFFSET {} {} {}", p.x(), p.y(), p.z()));
    line(depth + 1, hasPosition(joint) ? "CHANNELS 6 Xposition Yposition Zposition Zrotation "
                                         "Xrotation Yrotation"
                                       : "CHANNELS 3 Zrotation Xrotation Yrotation");
    order_.push_back(joint);
  }
  void endSite(std::size_t depth) {
    line(depth, "End Site");
    line(depth, "{");
    line(depth + 1, "OFFSET 0 0 0");
    line(depth, "}");
  }

  const Skeleton& skeleton_;
  const std::vector<bool>& hasTranslation_;
  std::vector<std::vector<JointId>> children_;
  std::vector<JointId> order_;
  std::string text_ = "HIERARCHY\n";
};

void appendFrame(const Hierarchy& hierarchy, const Pose& pose, std::string& text) {
  const auto out = std::back_inserter(text);
  const char* separator = "";
  const auto append = [&](double value) {
    fmt::format_to(out, "{}{}", separator, value);
    separator = " ";
  };
  for (const JointId joint : hierarchy.order()) {
    const auto j = slotOf(joint);
    if (hierarchy.hasPosition(joint)) {
      for (int axis = 0; axis < 3; ++axis) append(pose.translations[j][axis]);
    }
    for (const double angle : zxyDegrees(pose.rotations[j])) append(angle);
  }
  text += '\n';
}

double turnBetween(const Quaternion& a, const Quaternion& b) {
  const Quaternion turn = a.conjugate() * b;
  return 2.0 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

Error cannotHold(const Skeleton& skeleton, JointId joint, const char* what) {
  return {ErrorCode::Mismatch, "", -1, joint,
          "a BVH file cannot hold the " + std::string(what) + " of joint " +
              inQuotes(skeleton.name(joint))};
}

/// Checks the header's promise by reading the text.
Result<Done> checkReadsBack(const std::string& text, const Skeleton& skeleton,
                            const Hierarchy& hierarchy, const std::vector<Pose>& poses) {
  const auto read = parseBvh(text, "");
  if (!read.ok()) return read.error();
  const Clip& clip = read.value();
  for (std::size_t i = 0; i < hierarchy.order().size(); ++i) {
    const JointId joint = hierarchy.order()[i];
    const auto found = static_cast<JointId>(i);
    if (found >= clip.skeleton.numJoints() || clip.skeleton.name(found) != skeleton.name(joint)) {
      return cannotHold(skeleton, joint, "name");
    }
    const auto j = slotOf(joint);
    for (std::size_t frame = 0; frame < poses.size() && frame < clip.frames.size(); ++frame) {
      const Pose& before = poses[frame];
      const Pose& after = clip.frames[frame];
      if (before.translations[j] != after.translations[i]) {
        return cannotHold(skeleton, joint, "translation");
      }
      if (turnBetween(before.rotations[j], after.rotations[i]) > kBvhTurn) {
        return cannotHold(skeleton, joint, "rotation");
      }
    }
  }
  if (clip.frames.size() == poses.size()) return Done{};
  return Error::of(ErrorCode::Mismatch, "the BVH file does not read back as written");
}

}  // namespace

Result<std::string> bvhText(const Skeleton& skeleton, const std::vector<bool>& hasTranslation,
                            const std::vector<Pose>& poses, double frameTimeS) {
  const Hierarchy hierarchy(skeleton, hasTranslation);
  std::string text = hierarchy.text();
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: {}\n", poses.size(), frameTimeS);
  for (const Pose& pose : poses) appendFrame(hierarchy, pose, text);
  FORETOUCH_CHECK(checkReadsBack(text, skeleton, hierarchy, poses));
  return text;
}

}  // namespace foretouch::tools
