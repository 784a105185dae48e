#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "lss/index.h"
#include "middleware/surface/avatar_surface.h"
#include "middleware/surface/blend_table.h"
#include "middleware/surface/skin_parts.h"

namespace foretouch {
namespace {

/// Weights are normalised doubles; files that round to six digits are normalised by their reader.
constexpr double kWeightSumError = 1e-9;

Error skinError(ErrorCode code, const char* what, std::size_t index, const std::string& problem) {
  return Error::at(static_cast<std::int64_t>(index), code,
                   "skin " + std::string(what) + " " + std::to_string(index) + ": " + problem);
}

std::optional<Error> vertexProblem(const Avatar& avatar, const std::vector<SkinInfluence>& vertex,
                                   std::size_t index) {
  double sum = 0.0;
  for (const SkinInfluence& influence : vertex) {
    if (influence.link < 0 || influence.link >= avatar.numLinks()) {
      return skinError(ErrorCode::OutOfRange, "vertex", index, "expected a link of the avatar");
    }
    if (!(influence.weight > 0.0) || !influence.p_L.allFinite()) {
      return skinError(ErrorCode::NonFinite, "vertex", index,
                       "expected finite coordinates and weights above 0");
    }
    if (influence.p_L.cwiseAbs().maxCoeff() > kMaxCoordinate) {
      return skinError(ErrorCode::OutOfRange, "vertex", index, "expected coordinates within 1e7 m");
    }
    sum += influence.weight;
  }
  if (!(std::abs(sum - 1.0) <= kWeightSumError)) {
    return skinError(ErrorCode::OutOfRange, "vertex", index, "expected weights that sum to one");
  }
  return std::nullopt;
}

std::optional<Error> problemOf(const Avatar& avatar, const Skin& skin) {
  if (skin.triangles.empty() || skin.triangles.size() > kMaxSurfaceTriangles) {
    return Error::of(
        ErrorCode::LimitExceeded,
        "expected 1 to " + std::to_string(kMaxSurfaceTriangles) + " triangles of a skin");
  }
  for (std::size_t i = 0; i < skin.vertices.size(); ++i) {
    if (auto problem = vertexProblem(avatar, skin.vertices[i], i)) return problem;
  }
  const auto count = static_cast<std::int32_t>(skin.vertices.size());
  for (std::size_t i = 0; i < skin.triangles.size(); ++i) {
    for (const std::int32_t vertex : skin.triangles[i]) {
      if (vertex < 0 || vertex >= count) {
        return skinError(ErrorCode::OutOfRange, "triangle", i, "expected vertices of the skin");
      }
    }
  }
  return std::nullopt;
}

void addShares(internal::SkinParts& parts) {
  for (const std::vector<SkinInfluence>& vertex : parts.skin.vertices) {
    parts.firstShare.push_back(static_cast<std::int32_t>(parts.shares.size()));
    parts.mostShares = std::max(parts.mostShares, vertex.size());
    for (const SkinInfluence& influence : vertex) {
      parts.shares.push_back(
          internal::laneShare(influence.link, influence.weight, influence.p_L.data()));
    }
  }
  parts.firstShare.push_back(static_cast<std::int32_t>(parts.shares.size()));
}

}  // namespace

Result<SkinnedSurface> SkinnedSurface::build(const Avatar& avatar, Skin skin,
                                             const std::vector<std::size_t>& trianglesOfLink) {
  if (const auto problem = problemOf(avatar, skin)) return *problem;
  std::size_t total = 0;
  auto parts = std::make_shared<internal::SkinParts>();
  parts->firstOfLink.push_back(0);
  for (const std::size_t count : trianglesOfLink) {
    total += std::min(count, kMaxSurfaceTriangles + 1);
    if (total > skin.triangles.size()) break;
    parts->firstOfLink.push_back(static_cast<std::int32_t>(total));
  }
  if (trianglesOfLink.size() != countOf(avatar.numLinks()) || total != skin.triangles.size()) {
    return Error::of(ErrorCode::Mismatch,
                     "expected every link's number of triangles, together those of the skin");
  }
  parts->skin = std::move(skin);
  addShares(*parts);
  parts->avatarIdentity = avatar.identity();
  parts->blends = std::make_shared<const internal::BlendTable>(avatar, *parts);
  return SkinnedSurface(std::move(parts));
}

std::int32_t SkinnedSurface::numLinks() const {
  return static_cast<std::int32_t>(parts_->firstOfLink.size()) - 1;
}

std::size_t SkinnedSurface::numTriangles() const {
  return parts_->skin.triangles.size();
}

std::vector<LinkId> SkinnedSurface::linksMoving(LinkId link) const {
  std::set<LinkId> links;
  for (std::int32_t i = 0; i < parts_->numTriangles(link); ++i) {
    for (const std::int32_t vertex : parts_->triangle(link, i)) {
      for (const auto& influence : parts_->skin.vertices[slotOf(vertex)]) {
        links.insert(influence.link);
      }
    }
  }
  return {links.begin(), links.end()};
}

}  // namespace foretouch
