// assets/model/model_links.h: which nodes of a model are links, and their rigid frames. Internal to
// model_avatar and model_clip.
//
// The rule. A node is a link if it owns triangles or LSS, is a bone of a skin, has a joint that is
// not free, or an animation moves it. So are all nodes above such ones, moving or not: another
// file's animation of the same rig may move them. FBX pivots (X_$AssimpFbx$_Rotation above X) that
// carry nothing are not links: an animation of one makes X a link. The frames of all other nodes
// are folded into the frames below them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/model/model.h"
#include "assets/model/model_ownership.h"

namespace foretouch::internal {

struct ModelLinks {
  Skeleton skeleton;
  std::vector<std::int32_t> nodeOfLink;  ///< Ascending.
  std::vector<LinkId> linkOfNode;        ///< kNoParent: the node is not a link.
  /// Per node: the link that a change of its frame moves against that link's parent; kNoParent: the
  /// node is neither a link nor a pivot of one.
  std::vector<LinkId> servedLink;
  /// Per link: the part of its node's frame in the world that is not rigid: world = (position,
  /// rotation * shape). The identity if nothing scales, shears or mirrors.
  std::vector<Eigen::Matrix3d> shape;
  std::vector<std::string> notes;
};

/// Refuses a model that breaks the rules of assets/model/model.h for indices, frames that are not
/// finite, and more or deeper joints than a skeleton may have.
[[nodiscard]] Result<Done> checkModel(const Model& model);

/// Precondition: checkModel().
[[nodiscard]] Result<ModelLinks> modelLinks(const Model& model, const ModelOwnership& ownership);

/// The pose in which the nodes have the given frames in their parents'; a link's rotation brings
/// its shape nearest to its node's frame. Raises `worstShear`, per link, to the relative distance
/// between the two if that is larger.
[[nodiscard]] Pose poseOfFrames(const Model& model, const ModelLinks& links,
                                const std::vector<Affine>& toParent,
                                std::vector<double>& worstShear);

/// "'a', 'b' and 7 more".
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace foretouch::internal
