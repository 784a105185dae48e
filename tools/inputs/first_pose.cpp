#include "tools/inputs/first_pose.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/motion.h"
#include "assets/bvh/bvh_reader.h"
#include "lss/index.h"
#include "tools/settings/frame_settings.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

std::vector<LinkState> statesOf(const Skeleton& skeleton, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
  return states;
}

/// The axis with which the head would be above the feet, if one of the two does it.
std::optional<UpAxis> axisThatStands(const Stance& stance, UpAxis readWith) {
  const UpAxis other = readWith == UpAxis::Y ? UpAxis::Z : UpAxis::Y;
  const Vector3d& v = stance.headFromFeet;
  const Stance turned{other == UpAxis::Z ? Vector3d(v.x(), v.z(), -v.y())
                                         : Vector3d(v.x(), -v.z(), v.y())};
  if (turned.isUpright()) return other;
  return std::nullopt;
}

}  // namespace

Eigen::AlignedBox3d boxInPose(const Avatar& avatar, const Pose& pose) {
  const std::vector<LinkState> states = statesOf(avatar.skeleton(), pose);
  Eigen::AlignedBox3d box;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      for (const Vector3d& end : {lss.a, lss.b}) {
        const Vector3d p_W = states[slotOf(link)].pointAt(end);
        box.extend(Vector3d(p_W.array() - lss.radius));
        box.extend(Vector3d(p_W.array() + lss.radius));
      }
    }
  }
  return box;
}

std::optional<Stance> stanceOf(const Skeleton& skeleton, const Pose& pose) {
  const HeadAndFeet joints = headAndFeetOf(skeleton);
  if (joints.head == kNoParent || joints.feet.empty()) return std::nullopt;
  const std::vector<LinkState> states = statesOf(skeleton, pose);
  Vector3d feet = Vector3d::Zero();
  for (const JointId foot : joints.feet) feet += states[slotOf(foot)].p_WL;
  feet /= static_cast<double>(joints.feet.size());
  return Stance{states[slotOf(joints.head)].p_WL - feet};
}

std::optional<std::string> remarkOnFirstPose(const Avatar& avatar, const Pose& pose,
                                             const FileFrame& frame,
                                             const std::string& motionPath) {
  const auto stance = stanceOf(avatar.skeleton(), pose);
  if (!stance || stance->isUpright()) return std::nullopt;
  const Vector3d sides = boxInPose(avatar, pose).sizes();
  const bool isHeadDown = -stance->headFromFeet.y() >= 0.5 * stance->headFromFeet.norm();
  std::string text = fmt::format("{}: the first pose {}: {:.3g} m long, {:.3g} m high. ",
                                 motionPath, isHeadDown ? "has its head below its feet" : "lies",
                                 std::max(sides.x(), sides.z()), sides.y());
  const auto axis = axisThatStands(*stance, frame.up);
  return text + (axis ? fmt::format("It would stand with --clip-up {}, unless it is meant to lie",
                                    wordOf(*axis))
                      : "It stands with neither --clip-up y nor z: is it meant to lie?");
}

std::optional<std::string> remarkOnFrame(const FileFrame& frame, const FrameOptions& options,
                                         const std::string& path) {
  const DeclaredFrame& declared = frame.declared;
  if (declared.isOfFormat) return std::nullopt;
  std::string text;
  if (frame.isUpAsked && declared.up) {
    const char* const word = wordOf(frame.up);
    text = *declared.up == frame.up
               ? fmt::format("says itself that {} is up, so {} {} changes nothing", word,
                             options.up, word)
               : fmt::format("says that {} is up, and is read as {} {} says", wordOf(*declared.up),
                             options.up, word);
  }
  if (frame.isUnitAsked && declared.metresPerUnit) {
    const double asked = frame.metresPerUnit;
    text += text.empty() ? "" : "; ";
    text += *declared.metresPerUnit == asked
                ? fmt::format("says itself that a unit is {:g} m, so {} {:g} changes nothing",
                              asked, options.scale, asked)
                : fmt::format("says that a unit is {:g} m, and is read as {} {:g} says",
                              *declared.metresPerUnit, options.scale, asked);
  }
  if (text.empty()) return std::nullopt;
  return path + ": " + text;
}

}  // namespace foretouch::tools
