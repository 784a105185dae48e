#include <cstdint>
#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/model/model_avatar.h"
#include "lss/index.h"

namespace foretouch {
namespace {

Error refused(std::size_t node, ErrorCode code, const ModelNode& of, const std::string& what) {
  return Error::at(static_cast<std::int64_t>(node), code, "link " + inQuotes(of.name) + " " + what);
}

RobotJointKind kindOf(ModelJointType type) {
  switch (type) {
    case ModelJointType::Revolute: return RobotJointKind::Revolute;
    case ModelJointType::Continuous: return RobotJointKind::Continuous;
    case ModelJointType::Prismatic: return RobotJointKind::Prismatic;
    case ModelJointType::Planar: return RobotJointKind::Planar;
    case ModelJointType::Free:
    case ModelJointType::Fixed: break;
  }
  return RobotJointKind::Fixed;
}

RobotJoint jointOf(const ModelNode& node) {
  RobotJoint joint;
  if (node.parent < 0) return joint;
  joint.kind = kindOf(node.joint);
  joint.name = node.jointName;
  joint.axis = node.axis;
  if (node.lowerLimit != node.upperLimit) {
    joint.lower = node.lowerLimit;
    joint.upper = node.upperLimit;
  }
  return joint;
}

/// Every joint must be one of the robot's: a link that moves in a way that no coordinate gives
/// would be proven free where it is not.
Result<Done> checkJoints(const Model& model, const std::vector<LinkId>& linkOfNode) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    if (node.parent < 0) continue;
    if (node.joint == ModelJointType::Free) {
      return refused(i, ErrorCode::BadHierarchy, node,
                     "hangs on no joint, or on a floating one; expected one that is fixed, "
                     "revolute, continuous, prismatic or planar");
    }
    if (linkOfNode[i] == kNoParent || linkOfNode[slotOf(node.parent)] == kNoParent) {
      return refused(i, ErrorCode::BadHierarchy, node, "is no link of its own");
    }
  }
  return Done{};
}

}  // namespace

std::vector<RobotJoint> internal::robotJoints(const Model& model,
                                              const std::vector<LinkId>& linkOfNode,
                                              std::size_t numLinks) {
  std::vector<RobotJoint> joints(numLinks);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (linkOfNode[i] != kNoParent) joints[slotOf(linkOfNode[i])] = jointOf(model.nodes[i]);
  }
  for (const ModelMimic& mimic : model.mimics) {
    const LinkId link = linkOfNode[slotOf(mimic.node)];
    const LinkId leader = linkOfNode[slotOf(mimic.leader)];
    if (link == kNoParent || leader == kNoParent) continue;
    joints[slotOf(link)].mimicOf = leader;
    joints[slotOf(link)].mimicFactor = mimic.factor;
    joints[slotOf(link)].mimicOffset = mimic.offset;
  }
  return joints;
}

Result<ModelRobot> robotFromModel(const Model& model, const ModelAvatarOptions& options) {
  FORETOUCH_TRY(auto made, avatarFromModel(model, options));
  if (made.report.droppedNonFinite > 0) {
    return Error::of(ErrorCode::NonFinite, "expected finite triangles, found " +
                                               std::to_string(made.report.droppedNonFinite) +
                                               " that are not: they would be left out");
  }
  std::vector<LinkId> linkOfNode(model.nodes.size(), kNoParent);
  for (std::size_t link = 0; link < made.nodeOfLink.size(); ++link) {
    linkOfNode[slotOf(made.nodeOfLink[link])] = static_cast<LinkId>(link);
  }
  FORETOUCH_CHECK(checkJoints(model, linkOfNode));
  auto joints = internal::robotJoints(model, linkOfNode, made.nodeOfLink.size());
  FORETOUCH_TRY(auto robot, Robot::build(std::move(made.avatar), std::move(joints)));
  return ModelRobot{std::move(robot), std::move(made.surface), std::move(made.report)};
}

}  // namespace foretouch
