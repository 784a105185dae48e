// bindings/c/skin.cpp: ft_skin, the triangles that bend with an avatar's links.
#include <foretouch/ask.h>
#include <utility>

#include "articulated/try.h"
#include "bindings/c/handles.h"
#include "bindings/c/sized_struct.h"
#include "bindings/skin_triangles.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

constexpr std::size_t kMostCorners = 3 * kMaxSurfaceTriangles;

ft_status checkedArrays(const ft_skin& skin) {
  if (const auto s = zero(skin.reserved, "reserved"); s != FT_OK) return s;
  const auto vertices =
      neededArray(skin.first_share, skin.vertex_count, kMostCorners, "first_share");
  if (vertices != FT_OK) return vertices;
  const std::size_t triangles = skin.triangle_count;
  const auto corners = neededArray(skin.triangles, triangles, kMaxSurfaceTriangles, "triangles");
  if (corners != FT_OK) return corners;
  const auto owners =
      neededArray(skin.triangle_links, triangles, kMaxSurfaceTriangles, "triangle_links");
  if (owners != FT_OK) return owners;
  const std::int32_t shares = skin.vertex_count == 0 ? 0 : skin.first_share[skin.vertex_count];
  if (shares <= 0) return FT_OK;
  for (const auto& [array, name] :
       {std::pair<const void*, const char*>{skin.share_links, "share_links"},
        {skin.share_weights, "share_weights"},
        {skin.share_points, "share_points"}}) {
    if (const auto s = needed(array, name); s != FT_OK) return s;
  }
  return FT_OK;
}

ft_status readVertices(const ft_skin& given, Skin& skin) {
  skin.vertices.resize(given.vertex_count);
  for (std::size_t v = 0; v < given.vertex_count; ++v) {
    const std::int32_t first = v == 0 ? 0 : given.first_share[v], last = given.first_share[v + 1];
    if (given.first_share[0] != 0 || first >= last) {
      return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(v),
                     "first_share: expected 0 first, and more for each vertex, found %d to %d of "
                     "vertex %zu",
                     given.first_share[v], last, v);
    }
    for (auto i = slotOf(first); i < slotOf(last); ++i) {
      skin.vertices[v].push_back({given.share_links[i], given.share_weights[i],
                                  Eigen::Map<const Eigen::Vector3d>(given.share_points + 3 * i)});
    }
  }
  return FT_OK;
}

ft_status readTriangles(const ft_skin& given, std::vector<std::size_t>& ofLink, Skin& skin) {
  std::vector<LinkTriangle> triangles;
  for (std::size_t i = 0; i < given.triangle_count; ++i) {
    const std::int32_t* const v = given.triangles + 3 * i;
    triangles.push_back({given.triangle_links[i], {v[0], v[1], v[2]}});
  }
  const auto bad = addTriangles(triangles, ofLink, skin);
  if (!bad) return FT_OK;
  return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(*bad),
                 "triangle_links: element %zu names link %d; expected 0 to %zu", *bad,
                 given.triangle_links[*bad], ofLink.size() - 1);
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_avatar_set_skin(ft_avatar* avatar, const ft_skin* skin) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(avatar); s != FT_OK) return s;
    ft_skin known{};
    if (const auto s = readStruct(skin, "ft_skin", known); s != FT_OK) return s;
    if (const auto s = checkedArrays(known); s != FT_OK) return s;
    Skin read;
    if (const auto s = readVertices(known, read); s != FT_OK) return s;
    std::vector<std::size_t> ofLink(countOf(avatar->parts->avatar.numLinks()));
    if (const auto s = readTriangles(known, ofLink, read); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto built,
                     SkinnedSurface::build(avatar->parts->avatar, std::move(read), ofLink));
    AvatarParts parts = *avatar->parts;
    parts.skin = std::move(built);
    avatar->parts = std::make_shared<const AvatarParts>(std::move(parts));
    return FT_OK;
  });
}
