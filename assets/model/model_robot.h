// assets/model/model_robot.h: a model with joints (a URDF's) as a robot that moves by joint
// coordinates. Metres, radians.
#pragma once

#include <cstddef>
#include <vector>

#include "articulated/result.h"
#include "articulated/robot.h"
#include "assets/model/model.h"
#include "assets/model/model_avatar.h"
#include "lss/triangle.h"

namespace foretouch {

struct ModelRobot {
  Robot robot;
  std::vector<std::vector<Triangle>> surface;  ///< As ModelAvatar::surface; the LSS contain it.
  ModelAvatarReport report;
};

/// Links and LSS as of avatarFromModel(); a coordinate has the name of the file's joint, and its
/// limits. Errors: as avatarFromModel() and Robot::build(), a node without a joint (a floating one)
/// below another one, and triangles that are not finite.
[[nodiscard]] Result<ModelRobot> robotFromModel(const Model& model,
                                                const ModelAvatarOptions& options = {});

namespace internal {

/// The joints of a model's links, link by link, with those that follow others. One that is free
/// counts as fixed. `linkOfNode`: kNoParent, where a node is no link.
[[nodiscard]] std::vector<RobotJoint> robotJoints(const Model& model,
                                                  const std::vector<LinkId>& linkOfNode,
                                                  std::size_t numLinks);

}  // namespace internal
}  // namespace foretouch
