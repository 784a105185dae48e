// assets/model/model_avatar.h: a rigged model as an avatar: bones become links, every triangle goes
// to one link, and each link gets LSS that contain its triangles. Metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skin.h"
#include "assets/model/model.h"
#include "lss/triangle.h"

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
  /// Of the convex hulls of the points of each LSS, a lower bound (lss/hull_volume.h), m^3.
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

}  // namespace foretouch
