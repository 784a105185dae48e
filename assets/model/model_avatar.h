// assets/model/model_avatar.h: a rigged model as an avatar: bones become links, every triangle goes
// to one link, and each link gets LSS that contain its triangles; its animations, or a robot's
// joint positions, as clips; and one with joints (a URDF's) as a robot that moves by joint
// coordinates. Metres, radians.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "articulated/robot.h"
#include "assets/model/model.h"
#include "lss/lss.h"

namespace foretouch {

struct ModelAvatarOptions {
  std::string meshFile;   ///< The avatar's MeshReference::file; empty: no references.
  int maxLssPerLink = 4;  ///< Splits a link's triangles among at most this many LSS.
};

/// Where the model's parts went. triangles = sum over all links; every lost part is counted.
struct ModelAvatarReport {
  std::size_t triangles = 0;         ///< Given to links.
  std::size_t droppedNonFinite = 0;  ///< A vertex with NaN, infinity or beyond kMaxCoordinate.
  std::size_t unweighted = 0;        ///< Given to their mesh's own node: no usable weight.
  std::size_t badWeights = 0;        ///< NaN, infinite, negative or of no vertex: ignored.
  std::size_t shared = 0;            ///< Triangles whose vertices several links move.
  /// Volume of the convex hulls of each LSS' points, a lower bound (lss/hull_volume.h), m^3.
  double hullVolume = 0.0;
  double excessVolume = 0.0;  ///< Volume of those LSS less hullVolume, m^3; >= 0.
  std::vector<std::string> bonesWithoutTriangles;
  std::vector<std::string> notes;  ///< Renamed duplicates, scaled joints, mirrored nodes, ...
};

struct ModelAvatar {
  Avatar avatar;
  /// Per link, in the link's frame L. Rounded to float, so that a GLB holds it exactly; the LSS
  /// contain the rounded triangles.
  std::vector<std::vector<Triangle>> surface;
  Skin skin;                             ///< The same triangles, in the same order link by link.
  std::vector<std::int32_t> nodeOfLink;  ///< Index into Model::nodes.
  ModelAvatarReport report;
};

/// Every triangle lies wholly in one of its link's LSS, rounding included (a test owns this).
/// docs/formats.md says which nodes become links, and how it reads frames, weights and scales.
/// Error if no node carries a triangle or an LSS, if an index is out of range, and beyond a
/// skeleton's limits.
[[nodiscard]] Result<ModelAvatar> avatarFromModel(const Model& model,
                                                  const ModelAvatarOptions& options = {});

struct ModelClipOptions {
  std::string animation;  ///< By name; empty: the first. Also its number, counted from 0.
  double rateHz = 30.0;   ///< Samples of the animation per second.
};

/// The animation sampled at a fixed rate, on a skeleton with the joints that avatarFromModel()
/// makes of the same model (names, order, frames), so that it drives that avatar directly. Error if
/// the model has no animation of that name.
[[nodiscard]] Result<Clip> clipFromModel(const Model& model, const ModelClipOptions& options = {});

/// Joint positions as a clip of the robot `model` (a URDF's). CSV text: a header `time` (seconds)
/// and joint names, then one row per instant, equally spaced; radians or metres. From each row to
/// the next the robot moves as EdgeQuery moves it: where a joint turns too far for the shorter arc,
/// poses are put in between (Clip::framesPerRow). Joints that the table does not name stay at zero,
/// or follow the one that they mimic; notes positions outside a joint's limits. With columns
/// root_x, root_y, root_z (m), root_qx, root_qy, root_qz, root_qw the root moves, too, in the frame
/// of the robot's file; or, where the root carries a floating joint, what hangs on it. Errors name
/// `name` as the file. Safe on hostile text.
[[nodiscard]] Result<Clip> clipFromJointPositions(const Model& model, std::string_view csv,
                                                  const std::string& name,
                                                  const JointTableOptions& options = {});

/// Poses at `samples` configurations of the robot `model`, drawn within its limits
/// (Robot::sampledPoses()), as a clip whose frames have no order. All its joints are named.
[[nodiscard]] Result<Clip> clipFromSampledJoints(const Model& model, std::int32_t samples,
                                                 std::uint64_t seed);

struct ModelRobot {
  Robot robot;
  std::vector<std::vector<Triangle>> surface;  ///< As ModelAvatar::surface; the LSS contain it.
  ModelAvatarReport report;
};

/// Links and LSS as by avatarFromModel(); a coordinate has the name of the file's joint, and its
/// limits. Errors: as avatarFromModel() and Robot::build(), a node without a joint (a floating one)
/// below another one, and triangles that are not finite.
[[nodiscard]] Result<ModelRobot> robotFromModel(const Model& model,
                                                const ModelAvatarOptions& options = {});

namespace internal {

struct JointTable;
/// As clipFromJointPositions(). Errors name no file.
[[nodiscard]] Result<Clip> clipOfTable(const Model& model, const JointTable& table);

/// The joints of a model's links, link by link, with those that follow others. One that is free
/// counts as fixed. `linkOfNode`: kNoParent, where a node is not a link.
[[nodiscard]] std::vector<RobotJoint> robotJoints(const Model& model,
                                                  const std::vector<LinkId>& linkOfNode,
                                                  std::size_t numLinks);

}  // namespace internal
}  // namespace foretouch
