// examples/bvh_writer.cpp: see the header.
#include "examples/bvh_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "lss/index.h"

namespace foretouch::examples {
namespace {

using Eigen::Vector3d;
using Angles = std::array<double, 3>;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// Angles a, b, c with R = Rz(a) Rx(b) Ry(c), those of a and c nearest to `previous`.
Angles zxyDegrees(const Quaternion& rotation, const Angles& previous) {
  const Eigen::Matrix3d R = rotation.toRotationMatrix();
  Angles angles = {std::atan2(-R(0, 1), R(1, 1)) * kDegrees,
                   std::asin(std::clamp(R(2, 1), -1.0, 1.0)) * kDegrees,
                   std::atan2(-R(2, 0), R(2, 2)) * kDegrees};
  for (const std::size_t k : {0u, 2u}) {
    angles[k] += 360.0 * std::round((previous[k] - angles[k]) / 360.0);
  }
  return angles;
}

/// The value, rounded before it is printed: no "-0.0000".
double rounded(double value, double perUnit) {
  return std::round(value * perUnit) / perUnit + 0.0;
}

class HierarchyText {
 public:
  HierarchyText(const Skeleton& skeleton, const std::vector<Vector3d>& tips)
      : skeleton_(skeleton), tips_(tips) {}

  std::string operator()() {
    text_ = "HIERARCHY\n";
    std::vector<JointId> open;
    for (JointId joint = 0; joint < skeleton_.numJoints(); ++joint) {
      while (!open.empty() && open.back() != skeleton_.parent(joint)) {
        close(open);
      }
      openJoint(joint, open.size());
      open.push_back(joint);
      if (joint + 1 == skeleton_.numJoints() || skeleton_.parent(joint + 1) != joint) {
        endSite(tips_[slotOf(joint)], open.size());
      }
    }
    while (!open.empty()) {
      close(open);
    }
    return text_;
  }

 private:
  void line(std::size_t depth, const std::string& content) {
    text_ += std::string(2 * depth, ' ') + content + "\n";
  }
  void offset(std::size_t depth, const Vector3d& p) {
    line(depth, fmt::format("OFFSET {:.5f} {:.5f} {:.5f}", rounded(p.x(), 1e5), rounded(p.y(), 1e5),
                            rounded(p.z(), 1e5)));
  }
  void openJoint(JointId joint, std::size_t depth) {
    line(depth, (depth == 0 ? "ROOT " : "JOINT ") + skeleton_.name(joint));
    line(depth, "{");
    offset(depth + 1, skeleton_.restOffset(joint));
    line(depth + 1, depth == 0
                        ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
                        : "CHANNELS 3 Zrotation Xrotation Yrotation");
  }
  void endSite(const Vector3d& tip, std::size_t depth) {
    line(depth, "End Site");
    line(depth, "{");
    offset(depth + 1, tip);
    line(depth, "}");
  }
  void close(std::vector<JointId>& open) {
    open.pop_back();
    line(open.size(), "}");
  }

  const Skeleton& skeleton_;
  const std::vector<Vector3d>& tips_;
  std::string text_;
};

}  // namespace

std::string bvhText(const Skeleton& skeleton, const std::vector<Vector3d>& tips,
                    const std::vector<Pose>& frames, double frameTimeS) {
  std::string text = HierarchyText(skeleton, tips)();
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "MOTION\nFrames: {}\nFrame Time: {:.10f}\n", frames.size(), frameTimeS);
  std::vector<Angles> previous(countOf(skeleton.numJoints()), Angles{});
  for (const Pose& pose : frames) {
    const Vector3d& p = pose.translations.front();
    fmt::format_to(out, "{:.5f} {:.5f} {:.5f}", rounded(p.x(), 1e5), rounded(p.y(), 1e5),
                   rounded(p.z(), 1e5));
    for (std::size_t joint = 0; joint < previous.size(); ++joint) {
      previous[joint] = zxyDegrees(pose.rotations[joint], previous[joint]);
      for (const double angle : previous[joint]) {
        fmt::format_to(out, " {:.4f}", rounded(angle, 1e4));
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace foretouch::examples
