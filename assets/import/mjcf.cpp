#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "assets/import/failure.h"
#include "assets/import/mjcf_model.h"
#include "assets/import/model.h"
#include "assets/import/text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// What libmujoco calls where it cannot go on (no memory): it expects no return, and no exception
/// may pass through it. The parent shows the last line of this.
void endOnError(const char* text) {
  std::fprintf(stderr, "libmujoco: %s\n", text);
  std::fflush(stderr);
  _exit(1);
}

/// Warnings of dynamics, which play no part here; without this, libmujoco writes them to a file.
void ignoreWarning(const char* /*text*/) {}

Vector3d vectorAt(const mjtNum* numbers, int index) {
  const mjtNum* v = numbers + 3 * static_cast<std::ptrdiff_t>(index);
  return {v[0], v[1], v[2]};
}

Affine shift(const Vector3d& by) {
  return {Eigen::Matrix3d::Identity(), by};
}

Affine turn(const Vector3d& axis, double angle) {
  return {Eigen::AngleAxisd(angle, axis).toRotationMatrix(), Vector3d::Zero()};
}

/// A polynomial that MuJoCo holds a joint to: of another joint's coordinate, or a constant.
struct JointRule {
  int leader = -1;
  double factor = 0.0, offset = 0.0;
  bool isSet = false;
};

class MjcfTreeBuilder {
 public:
  MjcfTreeBuilder(const ModelQuestion& question, const mjModel& from, ModelBuilder& builder)
      : question_(question),
        from_(from),
        builder_(builder),
        surface_(question, from, builder),
        rules_(countOf(from.njnt)),
        nodeOfJoint_(countOf(from.njnt), -1),
        nodeOfBody_(countOf(from.nbody), -1) {}

  void add() {
    readRules();
    addWorld();
    for (int body = 1; body < from_.nbody; ++body) addBody(body);
    addMimics();
  }

 private:
  [[nodiscard]] std::string jointTitle(int joint) const {
    const std::string name = mjName(from_, from_.name_jntadr[joint]);
    return (name.empty() ? "a joint" : "joint " + quotedName(name)) + " of body " +
           bodyName(from_, from_.jnt_bodyid[joint]);
  }
  [[nodiscard]] double referenceOf(int joint) const {
    return from_.qpos0[from_.jnt_qposadr[joint]];
  }

  void readRules() {
    for (int i = 0; i < from_.neq; ++i) {
      if (from_.eq_type[i] != mjEQ_JOINT || from_.eq_active[i] == 0) continue;
      const int joint = from_.eq_obj1id[i], leader = from_.eq_obj2id[i];
      const mjtNum* c = from_.eq_data + static_cast<std::ptrdiff_t>(mjNEQDATA) * i;
      JointRule& rule = rules_[slotOf(joint)];
      if (rule.isSet) refuse(jointTitle(joint) + " is held by two equalities");
      // Joint minus its reference is the polynomial of the leader minus its own.
      rule = {leader, leader < 0 ? 0.0 : c[1], referenceOf(joint) + c[0], true};
      if (leader >= 0) rule.offset -= c[1] * referenceOf(leader);
      const bool isStraight = leader < 0 || (c[2] == 0.0 && c[3] == 0.0 && c[4] == 0.0);
      if (!isStraight || !std::isfinite(rule.factor) || !std::isfinite(rule.offset)) {
        refuse(jointTitle(joint) +
               " follows by a polynomial; expected a constant and a factor of the first degree");
      }
    }
  }

  /// The world is a link where something hangs on it by a joint, or where several bodies do.
  void addWorld() {
    int children = 0, hanging = 0;
    for (int body = 1; body < from_.nbody; ++body) {
      if (from_.body_parentid[body] != 0 || isFreeOfWorld(body)) continue;
      ++children;
      hanging += from_.body_jntnum[body] > 0 ? 1 : 0;
    }
    if (hanging == 0 && children < 2) return;
    ModelNode world;
    world.name = "world";
    nodeOfBody_[0] = addNode(std::move(world));
  }

  /// Does a pose put the body anywhere (a free joint, or a body that follows a tracker)?
  [[nodiscard]] bool isFreeOfWorld(int body) const {
    return from_.body_mocapid[body] >= 0 ||
           (from_.body_jntnum[body] > 0 && from_.jnt_type[from_.body_jntadr[body]] == mjJNT_FREE);
  }

  void addBody(int body) {
    const std::int32_t parent = nodeOfBody_[slotOf(from_.body_parentid[body])];
    const Affine toParent =
        mjFrame(from_.body_pos + 3 * body, from_.body_quat + 4 * body, bodyName(from_, body));
    std::int32_t node = -1;
    if (isFreeOfWorld(body)) {
      node = addFree(body, toParent);
    } else if (from_.body_jntnum[body] == 0) {
      ModelNode fixed;
      fixed.name = mjName(from_, from_.name_bodyadr[body]);
      fixed.parent = parent;
      fixed.toParent = toParent;
      if (parent >= 0) fixed.joint = ModelJointType::Fixed;
      node = addNode(std::move(fixed));
    } else {
      node = addJoints(body, parent, toParent);
    }
    nodeOfBody_[slotOf(body)] = node;
    surface_.add(body, node);
  }

  /// A root of its own. In a robot by coordinates it must be the only one: it stands where the file
  /// has it.
  std::int32_t addFree(int body, const Affine& toParent) {
    if (question_.isRobot) {
      int roots = 0;
      for (int i = 1; i < from_.nbody; ++i) roots += from_.body_parentid[i] == 0 ? 1 : 0;
      if (roots > 1) {
        refuse("body " + bodyName(from_, body) +
               " floats beside other bodies, where no joint coordinate puts it; expected the model "
               "of one robot");
      }
      builder_.note("body " + bodyName(from_, body) +
                    " floats: its place is the root's and no joint coordinate");
    }
    ModelNode free;
    free.name = mjName(from_, from_.name_bodyadr[body]);
    free.toParent = toParent;
    return addNode(std::move(free));
  }

  /// One node per joint, at its anchor, the last one the body's own; another one, fixed, where the
  /// last anchor is not the body's origin. Source: MuJoCo's documentation, "Computation", kinematic
  /// tree: joints of a body act in their order, each in the frame that the ones before left.
  std::int32_t addJoints(int body, std::int32_t parent, Affine pending) {
    const std::string name = mjName(from_, from_.name_bodyadr[body]);
    Vector3d at = Vector3d::Zero();  // where the node's origin is in the body's frame
    const int first = from_.body_jntadr[body], end = first + from_.body_jntnum[body];
    for (int joint = first; joint < end; ++joint) {
      ModelNode node;
      node.parent = parent;
      node.jointName = mjName(from_, from_.name_jntadr[joint]);
      const Vector3d anchor =
          from_.jnt_type[joint] == mjJNT_SLIDE ? at : vectorAt(from_.jnt_pos, joint);
      checkLength(anchor, joint);
      node.toParent = pending * shift(anchor - at);
      setJoint(joint, node);
      at = anchor;
      const bool isLast = joint + 1 == end && at.isZero(0.0);
      node.name = isLast ? name : name + "/" + node.jointName;
      nodeOfJoint_[slotOf(joint)] = parent = addNode(std::move(node));
      pending = Affine();
    }
    if (at.isZero(0.0)) return parent;
    ModelNode own;
    own.name = name;
    own.parent = parent;
    own.joint = ModelJointType::Fixed;
    own.toParent = shift(-at);
    return addNode(std::move(own));
  }

  void checkLength(const Vector3d& v, int joint) const {
    if (v.allFinite() && v.cwiseAbs().maxCoeff() <= kMaxCoordinate) return;
    refuse(jointTitle(joint) + " has an anchor that is not finite, or beyond " +
           std::to_string(static_cast<long>(kMaxCoordinate)) + " m");
  }

  /// A coordinate is MuJoCo's own (qpos): at its reference the body is where the file has it.
  void setJoint(int joint, ModelNode& node) {
    const int type = from_.jnt_type[joint];
    if (type == mjJNT_BALL) {
      if (!question_.isRobot) return;  // as the file has it; poses turn it freely
      refuse(jointTitle(joint) +
             " is a ball; a joint coordinate is one number: expected hinges and slides");
    }
    if (type == mjJNT_FREE) refuse(jointTitle(joint) + " is free below another body");
    const bool turns = type == mjJNT_HINGE;
    node.axis = vectorAt(from_.jnt_axis, joint).stableNormalized();
    if (!(std::abs(node.axis.norm() - 1.0) < 1e-6)) refuse(jointTitle(joint) + " has no axis");
    const JointRule& rule = rules_[slotOf(joint)];
    const bool isHeld = rule.isSet && rule.leader < 0;
    const double at = (isHeld ? rule.offset : 0.0) - referenceOf(joint);
    if (!(std::abs(at) <= kMaxCoordinate)) refuse(jointTitle(joint) + " has no finite reference");
    node.toParent = node.toParent * (turns ? turn(node.axis, at) : shift(at * node.axis));
    if (isHeld) {
      node.joint = ModelJointType::Fixed;
      return;
    }
    const bool isLimited = from_.jnt_limited[joint] != 0;
    node.joint = !turns      ? ModelJointType::Prismatic
                 : isLimited ? ModelJointType::Revolute
                             : ModelJointType::Continuous;
    if (isLimited) setLimits(joint, node);
  }

  void setLimits(int joint, ModelNode& node) const {
    node.lowerLimit = from_.jnt_range[2 * joint];
    node.upperLimit = from_.jnt_range[2 * joint + 1];
    if (!(node.lowerLimit < node.upperLimit) || !std::isfinite(node.lowerLimit) ||
        !std::isfinite(node.upperLimit)) {
      refuse(jointTitle(joint) + " has limits that are equal, not finite or the wrong way round");
    }
  }

  std::int32_t addNode(ModelNode node) {
    ModelSize more;
    more.nodes = 1;
    more.nameBytes = node.name.size() + node.jointName.size();
    builder_.count(more);
    builder_.model.nodes.push_back(std::move(node));
    return static_cast<std::int32_t>(builder_.model.nodes.size()) - 1;
  }

  void addMimics() {
    for (int joint = 0; joint < from_.njnt; ++joint) {
      const JointRule& rule = rules_[slotOf(joint)];
      if (!rule.isSet || rule.leader < 0) continue;
      ModelSize more;
      more.mimics = 1;
      builder_.count(more);
      builder_.model.mimics.push_back({nodeOfJoint_[slotOf(joint)],
                                       nodeOfJoint_[slotOf(rule.leader)], rule.factor,
                                       rule.offset});
      builder_.note(jointTitle(joint) + " follows " + jointTitle(rule.leader) +
                    ": a pose may move it by itself");
    }
  }

  const ModelQuestion& question_;
  const mjModel& from_;
  ModelBuilder& builder_;
  MjcfSurface surface_;
  std::vector<JointRule> rules_;           // per joint
  std::vector<std::int32_t> nodeOfJoint_;  // -1: a free one
  std::vector<std::int32_t> nodeOfBody_;   // -1: the world, where it is not a link
};

}  // namespace

std::string bodyName(const mjModel& model, int body) {
  const std::string name = mjName(model, model.name_bodyadr[body]);
  return name.empty() ? "number " + std::to_string(body) : quotedName(name);
}

Affine mjFrame(const mjtNum* position, const mjtNum* quaternion, const std::string& owner) {
  const Quaternion q(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
  const Vector3d p(position[0], position[1], position[2]);
  const double norm = q.norm();
  if (!(norm > 0.0) || !std::isfinite(norm) || !p.allFinite() ||
      !(p.cwiseAbs().maxCoeff() <= kMaxCoordinate)) {
    refuse(owner + " has a frame that is not finite, or beyond " +
           std::to_string(static_cast<long>(kMaxCoordinate)) + " m");
  }
  return {q.normalized().toRotationMatrix(), p};
}

MjModelPointer compileMjcf(const MjcfText& text) {
  mju_user_error = endOnError;
  mju_user_warning = ignoreWarning;
  constexpr char kName[] = "model.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(text.xml.size())) != 0) {
    refuse("libmujoco takes no text of " + std::to_string(text.xml.size()) + " bytes");
  }
  const int place = mj_findFileVFS(files.get(), kName);
  std::memcpy(files->filedata[place], text.xml.data(), text.xml.size());
  std::array<char, 1024> report{};
  MjModelPointer model(
      mj_loadXML(kName, files.get(), report.data(), static_cast<int>(report.size())));
  mj_deleteVFS(files.get());
  if (model == nullptr) refuse(text.placed(report.data()));
  return model;
}

Model readMjcf(const ModelQuestion& question) {
  const MjcfText text = readMjcfText(question);
  const MjModelPointer compiled = compileMjcf(text);
  ModelBuilder builder;
  for (const std::string& note : text.notes) builder.note(note);
  MjcfTreeBuilder(question, *compiled, builder).add();
  return builder.take();
}

}  // namespace foretouch::internal
