// assets/mesh/link_mesh.h: the triangles that an avatar file refers to. "mesh": {"file": F, "node":
// N} means, of model F in metres: the triangles of skinned meshes that bone N owns (by
// avatarFromModel()'s rule), at bind time, and those of unskinned meshes at node N, both in N's
// frame.
#pragma once

#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "assets/import/model_import.h"
#include "lss/lss.h"

namespace foretouch {

/// Per link, in its frame; links without a mesh get none. Relative files are relative to the folder
/// of `avatarPath`. Imports each file once, in the import child. If its frames scale or its
/// vertices are not floats, avatarFromModel()'s rule decides for unskinned meshes too. Error if a
/// file is unreadable, a node is missing or there twice, or it has no triangles or one that is not
/// finite: Error::index is the link.
[[nodiscard]] Result<std::vector<std::vector<Triangle>>> loadLinkMeshes(
    const Avatar& avatar, const std::string& avatarPath, const ModelImportOptions& options = {});

/// The same for these links only: the others get none, and files that only those refer to are not
/// read.
[[nodiscard]] Result<std::vector<std::vector<Triangle>>> loadLinkMeshes(
    const Avatar& avatar, const std::string& avatarPath, const std::vector<LinkId>& links,
    const ModelImportOptions& options = {});

/// Writes per-link triangles as a GLB that loadLinkMeshes() reads back bit for bit: one node per
/// link, placed by the skeleton's rest pose so that a viewer shows the body, with its mesh in the
/// link's frame. Precondition: coordinates are floats (avatarFromModel() rounds), because glTF has
/// no doubles.
[[nodiscard]] Result<Done> writeLinkMeshes(const Skeleton& skeleton,
                                           const std::vector<std::vector<Triangle>>& triangles,
                                           const std::string& path);

}  // namespace foretouch
