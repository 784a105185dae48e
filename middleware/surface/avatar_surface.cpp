#include "middleware/surface/avatar_surface.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/fit.h"
#include "lss/index.h"
#include "middleware/surface/link_surface.h"

namespace foretouch {
namespace {

using internal::LinkSurface;

/// How far (m) a triangle may lie outside its LSS. Below a quarter of the least tolerance, at which
/// advancement stops, so that a proof for an LSS still holds for its triangles.
constexpr double kContainmentSlack = 1e-10;

Error linkError(const Avatar& avatar, LinkId link, ErrorCode code, const std::string& what) {
  return Error::at(
      link, code,
      "link " + std::to_string(link) + " " + inQuotes(avatar.skeleton().name(link)) + ": " + what);
}

/// An LSS that contains triangles has one of them below it, even if all of them hang under other
/// LSS: an LSS with none below it is taken for a surface. A triangle may well hang under two.
void hangOneUnderTwins(const std::vector<Lss>& lss, const std::vector<Triangle>& triangles,
                       std::vector<std::vector<std::int32_t>>& idsOfLss) {
  for (std::size_t k = 0; k < lss.size(); ++k) {
    if (!idsOfLss[k].empty()) continue;
    const auto held = std::find_if(triangles.begin(), triangles.end(), [&](const Triangle& one) {
      return sticksOut(lss[k], one) <= kContainmentSlack;
    });
    if (held == triangles.end()) continue;
    idsOfLss[k].push_back(static_cast<std::int32_t>(held - triangles.begin()));
  }
}

/// The triangles below each LSS of the link: each triangle is below one that contains it.
Result<std::vector<std::vector<std::int32_t>>> assigned(const Avatar& avatar, LinkId link,
                                                        const std::vector<Triangle>& triangles) {
  const std::vector<Lss>& lss = avatar.lss(link);
  std::vector<std::vector<std::int32_t>> idsOfLss(lss.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::string name = "triangle " + std::to_string(i);
    if (!isFinite(triangles[i])) {
      return linkError(avatar, link, ErrorCode::NonFinite, name + " is not finite");
    }
    double least = lss.empty() ? kMaxCoordinate : sticksOut(lss[0], triangles[i]);
    std::size_t best = 0;
    for (std::size_t k = 1; k < lss.size() && least > 0.0; ++k) {
      const double distance = sticksOut(lss[k], triangles[i]);
      if (distance < least) {
        least = distance;
        best = k;
      }
    }
    if (!(least <= kContainmentSlack)) {
      char metres[32];
      std::snprintf(metres, sizeof metres, "%.3g", least);
      return linkError(avatar, link, ErrorCode::OutOfRange,
                       "expected every triangle inside one of the link's " +
                           std::to_string(lss.size()) + " LSS; " + name + " is " +
                           (lss.empty() ? "inside none" : std::string(metres) + " m outside"));
    }
    idsOfLss[best].push_back(static_cast<std::int32_t>(i));
  }
  hangOneUnderTwins(lss, triangles, idsOfLss);
  return idsOfLss;
}

template <std::size_t... kIndices>
std::array<HierarchyChild, sizeof...(kIndices)> filledWith(HierarchyChild part,
                                                           std::index_sequence<kIndices...>) {
  return {((void)kIndices, part)...};
}

}  // namespace

internal::PartsBelow::PartsBelow(const LssHierarchy& hierarchy, HierarchyChild node)
    : parts_(filledWith(node, std::make_index_sequence<std::size_t{1} << kPartLevels>())) {
  add(hierarchy, node, kPartLevels);
}

void internal::PartsBelow::add(const LssHierarchy& hierarchy, HierarchyChild part, int levels) {
  if (levels == 0 || part.isTriangle()) {
    parts_[count_++] = part;
    return;
  }
  for (const HierarchyChild child : hierarchy.node(part.index()).children) {
    add(hierarchy, child, levels - 1);
  }
}

void LinkSurface::prepare() const {
  std::call_once(built_, [this] {
    hierarchies_.resize(idsOfLss_.size());
    for (std::size_t i = 0; i < idsOfLss_.size(); ++i) {
      if (!idsOfLss_[i].empty()) hierarchies_[i].emplace(triangles_, idsOfLss_[i]);
    }
    prepareLanes();
  });
}

void LinkSurface::prepareWide() const {
  prepare();
  std::call_once(builtWide_, [this] {
    wideNodes_.resize(hierarchies_.size());
    for (std::size_t i = 0; i < hierarchies_.size(); ++i) {
      if (hierarchies_[i]) wideNodes_[i].emplace(*hierarchies_[i], laneTriangles_);
    }
  });
}

const std::vector<Eigen::Vector3d>& LinkSurface::cornerOfPieces() const {
  preparePieces();
  return corners_;
}

const std::vector<std::int32_t>& LinkSurface::pieceOf() const {
  preparePieces();
  return pieceOf_;
}

void LinkSurface::preparePieces() const {
  std::call_once(builtPieces_, [this] {
    // Triangles at a corner are joined with the first one that was there.
    std::vector<std::size_t> joined(triangles_.size());
    std::iota(joined.begin(), joined.end(), std::size_t{0});
    const auto rootOf = [&](std::size_t i) {
      while (joined[i] != i) i = joined[i] = joined[joined[i]];
      return i;
    };
    std::map<std::array<double, 3>, std::size_t> at;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      for (const Eigen::Vector3d& v : triangles_[i].vertices) {
        // -0 and 0 are one place.
        const auto [first, isNew] =
            at.emplace(std::array{v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}, i);
        if (!isNew) joined[rootOf(i)] = rootOf(first->second);
      }
    }
    pieceOf_.resize(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (rootOf(i) != i) continue;
      pieceOf_[i] = static_cast<std::int32_t>(corners_.size());
      corners_.push_back(triangles_[i].vertices[0]);
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i) pieceOf_[i] = pieceOf_[rootOf(i)];
  });
}

const internal::ObjectRoom& LinkSurface::room() const {
  std::call_once(builtRoom_, [this] {
    std::vector<std::int32_t> ids(triangles_.size());
    std::iota(ids.begin(), ids.end(), 0);
    room_ = internal::objectRooms(triangles_.data(), ids, nullptr, 1).front();
  });
  return room_;
}

void LinkSurface::prepareLanes() const {
  laneTriangles_.reserve(triangles_.size());
  for (const Triangle& triangle : triangles_)
    laneTriangles_.push_back(internal::lanePart(triangle));
  laneNodes_.resize(hierarchies_.size());
  for (std::size_t i = 0; i < hierarchies_.size(); ++i) {
    if (!hierarchies_[i]) continue;
    const auto numNodes = static_cast<std::int32_t>(hierarchies_[i]->numNodes());
    laneNodes_[i].reserve(static_cast<std::size_t>(numNodes));
    for (std::int32_t k = 0; k < numNodes; ++k) {
      laneNodes_[i].push_back({internal::lanePart(hierarchies_[i]->node(k).lss),
                               internal::PartsBelow(*hierarchies_[i], HierarchyChild::node(k))});
    }
  }
}

const LssHierarchy& LinkSurface::hierarchy(std::int32_t lss) const {
  FORETOUCH_ASSERT(hasTriangles(lss));
  prepare();
  return *hierarchies_[slotOf(lss)];
}

Result<AvatarSurface> AvatarSurface::build(const Avatar& avatar,
                                           std::vector<std::vector<Triangle>> trianglesPerLink) {
  if (trianglesPerLink.size() != countOf(avatar.numLinks())) {
    return Error::of(ErrorCode::Mismatch, "expected triangles for " +
                                              std::to_string(avatar.numLinks()) + " links, found " +
                                              std::to_string(trianglesPerLink.size()));
  }
  auto parts = std::make_shared<internal::SurfaceParts>();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    std::vector<Triangle>& triangles = trianglesPerLink[slotOf(link)];
    FORETOUCH_TRY(auto idsOfLss, assigned(avatar, link, triangles));
    parts->numTriangles += triangles.size();
    if (parts->numTriangles > kMaxSurfaceTriangles) {
      return linkError(avatar, link, ErrorCode::LimitExceeded,
                       "expected at most " + std::to_string(kMaxSurfaceTriangles) +
                           " triangles on all links together");
    }
    parts->links.push_back(
        std::make_shared<const LinkSurface>(std::move(triangles), std::move(idsOfLss)));
  }
  return AvatarSurface(std::move(parts));
}

std::int32_t AvatarSurface::numLinks() const {
  return static_cast<std::int32_t>(parts_->links.size());
}

const std::vector<Triangle>& AvatarSurface::triangles(LinkId link) const {
  return parts_->links[slotOf(link)]->triangles();
}

void AvatarSurface::prepare() const {
  for (const auto& link : parts_->links) link->prepare();
}

std::size_t AvatarSurface::numTriangles() const {
  return parts_->numTriangles;
}

}  // namespace foretouch
