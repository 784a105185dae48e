// MJCF and URDF: tools/colliders/collider_writers.h.
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "assets/file_frame.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/colliders/capsule_forms.h"
#include "tools/colliders/collider_writers.h"
#include "tools/html_text.h"

namespace foretouch::tools {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr internal::FrameChange kBackToZUp{1.0, internal::FrameChange::Turn::BackToZUp};

std::string vectorText(const Vector3d& v) {
  return numberText(v.x()) + ' ' + numberText(v.y()) + ' ' + numberText(v.z());
}

/// A link's rest in its parent's frame; a root's in a world with +Z up.
RigidPose restOf(const Skeleton& skeleton, LinkId link) {
  RigidPose rest{skeleton.restRotation(link), skeleton.restOffset(link)};
  if (skeleton.parent(link) != kNoParent) return rest;
  Matrix3d turn;
  for (int i = 0; i < 3; ++i) turn.col(i) = kBackToZUp.turned(Vector3d::Unit(i));
  return {Quaternion(turn) * rest.rotation, kBackToZUp.turned(rest.translation)};
}

std::vector<std::vector<LinkId>> childrenOf(const Skeleton& skeleton) {
  std::vector<std::vector<LinkId>> children(countOf(skeleton.numJoints()));
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    const LinkId parent = skeleton.parent(link);
    if (parent != kNoParent) children[slotOf(parent)].push_back(link);
  }
  return children;
}

std::string indent(int depth) {
  return std::string(2 * static_cast<std::size_t>(depth), ' ');
}

class Mjcf {
 public:
  explicit Mjcf(const Avatar& avatar) : avatar_(avatar), children_(childrenOf(avatar.skeleton())) {}

  std::string bodies() {
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      if (avatar_.skeleton().parent(link) == kNoParent) addBody(link, 2);
    }
    return std::move(text_);
  }

 private:
  /// As deep as a chain may be (kMaxChainDepth).
  void addBody(LinkId link, int depth) {  // NOLINT(misc-no-recursion)
    const std::string name = inHtml(avatar_.skeleton().name(link));
    const RigidPose rest = restOf(avatar_.skeleton(), link);
    const Quaternion& q = rest.rotation;
    text_ += fmt::format("{}<body name=\"{}\" pos=\"{}\" quat=\"{} {}\">\n", indent(depth), name,
                         vectorText(rest.translation), numberText(q.w()), vectorText(q.vec()));
    const bool isRoot = avatar_.skeleton().parent(link) == kNoParent;
    text_ += indent(depth + 1) + (isRoot ? "<freejoint/>\n" : "<joint type=\"ball\"/>\n");
    const auto& list = avatar_.lss(link);
    for (std::size_t i = 0; i < list.size(); ++i) addGeom(list[i], name, i, depth + 1);
    for (const LinkId child : children_[slotOf(link)]) addBody(child, depth + 1);
    text_ += indent(depth) + "</body>\n";
  }

  void addGeom(const Lss& lss, const std::string& link, std::size_t number, int depth) {
    const Lss held = byEnds(lss, HeldAs::Doubles);
    // Its middle, half length and turn are what MuJoCo makes of the two ends.
    const double radius = standing(lss, Vector3d::UnitZ(), HeldAs::Doubles).radius;
    const bool isSphere = held.a == held.b;
    text_ += fmt::format("{}<geom name=\"{}/{}\" ", indent(depth), link, number);
    text_ += isSphere ? fmt::format("type=\"sphere\" pos=\"{}\"", vectorText(held.a))
                      : fmt::format("type=\"capsule\" fromto=\"{} {}\"", vectorText(held.a),
                                    vectorText(held.b));
    text_ += fmt::format(" size=\"{}\"/>\n", numberText(isSphere ? held.radius : radius));
  }

  const Avatar& avatar_;
  std::vector<std::vector<LinkId>> children_;
  std::string text_;
};

/// Roll, pitch and yaw: turns about fixed x, then y, then z. Yaw first, so that at a pitch of a
/// right angle, where the others are one turn, it is exact, too.
Vector3d rollPitchYaw(const Matrix3d& turn) {
  const double yaw = std::atan2(turn(1, 0), turn(0, 0));
  const Matrix3d rest = Eigen::AngleAxisd(-yaw, Vector3d::UnitZ()) * turn;
  return {std::atan2(-rest(1, 2), rest(1, 1)), std::atan2(-rest(2, 0), rest(0, 0)), yaw};
}

std::string originText(const Vector3d& place, const Vector3d& turn) {
  return fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", vectorText(place), vectorText(turn));
}

std::string collision(const std::string& origin, const std::string& shape) {
  return fmt::format("    <collision>{}<geometry>{}</geometry></collision>\n", origin, shape);
}

std::string sphere(const Vector3d& middle, double radius) {
  return collision(originText(middle, Vector3d::Zero()),
                   fmt::format("<sphere radius=\"{}\"/>", numberText(radius)));
}

std::string collisionOf(const Lss& lss, UrdfCapsules capsules) {
  const StandingCapsule c = standing(lss, Vector3d::UnitZ(), HeldAs::Doubles);
  if (c.halfLength == 0.0) return sphere(c.middle, c.radius);
  const Vector3d along = lss.b - lss.a;
  const double pitch = std::atan2(std::hypot(along.x(), along.y()), along.z());
  const std::string origin = originText(c.middle, {0, pitch, std::atan2(along.y(), along.x())});
  const bool isWhole = capsules == UrdfCapsules::Capsules;
  const std::string tube = collision(
      origin, fmt::format("<{} radius=\"{}\" length=\"{}\"/>", isWhole ? "capsule" : "cylinder",
                          numberText(c.radius), numberText(2.0 * c.halfLength)));
  return isWhole ? tube : tube + sphere(lss.a, c.radius) + sphere(lss.b, c.radius);
}

/// A name that no link of the avatar has.
std::string worldNameFor(const Skeleton& skeleton) {
  std::string name = "world";
  while (skeleton.find(name)) name += '_';
  return name;
}

}  // namespace

std::string mjcfColliders(const Avatar& avatar, const std::string& name) {
  // Links without LSS have no mass of their own, which MuJoCo demands of what moves.
  return fmt::format(
      "<mujoco model=\"{}\">\n  <compiler boundmass=\"0.001\" boundinertia=\"1e-06\"/>\n"
      "  <worldbody>\n{}  </worldbody>\n</mujoco>\n",
      inHtml(name), Mjcf(avatar).bodies());
}

std::string urdfColliders(const Avatar& avatar, const std::string& name, UrdfCapsules capsules) {
  const Skeleton& skeleton = avatar.skeleton();
  const std::string world = inHtml(worldNameFor(skeleton));
  std::string text =
      fmt::format("<robot name=\"{}\"{}>\n  <link name=\"{}\"/>\n", inHtml(name),
                  capsules == UrdfCapsules::Capsules ? " version=\"1.1\"" : "", world);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const std::string own = inHtml(skeleton.name(link));
    text += fmt::format("  <link name=\"{}\">\n", own);
    for (const Lss& lss : avatar.lss(link)) text += collisionOf(lss, capsules);
    text += "  </link>\n";
    const LinkId parent = skeleton.parent(link);
    const RigidPose rest = restOf(skeleton, link);
    text += fmt::format(
        "  <joint name=\"to {}\" type=\"floating\">{}<parent link=\"{}\"/><child link=\"{}\"/>"
        "</joint>\n",
        own, originText(rest.translation, rollPitchYaw(rest.rotation.toRotationMatrix())),
        parent == kNoParent ? world : inHtml(skeleton.name(parent)), own);
  }
  return text + "</robot>\n";
}

}  // namespace foretouch::tools
