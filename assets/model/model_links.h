// assets/model/model_links.h: which nodes of a model are links, and their rigid frames. Internal to
// model_avatar and model_clip.
//
// The rule. A node is a link of its own accord if it owns triangles or LSS, is a bone of a skin,
// has a joint that is not free, or is moved by an animation; so are all nodes above such ones,
// moving or not: another file's animation of the same rig may move them. FBX pivots
// (X_$AssimpFbx$_Rotation above X) that carry nothing are no links: what moves one makes X a link.
// All that is no link is folded into the frames below it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/pose.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/model/model.h"
#include "assets/model/model_ownership.h"

namespace foretouch::internal {

struct ModelLinks {
  Skeleton skeleton;
  std::vector<std::int32_t> nodeOfLink;  ///< Ascending.
  std::vector<LinkId> linkOfNode;        ///< kNoParent: the node is no link.
  /// Per node: which link a change of its frame moves against that link's parent; kNoParent: the
  /// node is no link and no pivot of one.
  std::vector<LinkId> servedLink;
  /// Per link: what of its node's frame in the world is not rigid: world = (position, rotation *
  /// shape). The identity where nothing scales, shears or mirrors.
  std::vector<Eigen::Matrix3d> shape;
  std::vector<std::string> notes;
};

/// Refuses a model that breaks what assets/model/model.h says of indices, frames that are not
/// finite, and more or deeper joints than a skeleton may have.
[[nodiscard]] Result<Done> checkModel(const Model& model);

/// Precondition: checkModel().
[[nodiscard]] Result<ModelLinks> modelLinks(const Model& model, const ModelOwnership& ownership);

/// The pose in which the nodes have the given frames in their parents'; a link's rotation is the
/// one that brings its shape nearest to its node's frame. `worstShear` becomes the largest relative
/// distance between the two, per link, where that is larger than it was.
[[nodiscard]] Pose poseOfFrames(const Model& model, const ModelLinks& links,
                                const std::vector<Affine>& toParent,
                                std::vector<double>& worstShear);

/// "'a', 'b' and 7 more".
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace foretouch::internal
