// bindings/wasm/foretouch_wasm.cpp: what the module foretouch.wasm has beside functions of the C
// interface (bindings/c), which JavaScript calls by itself: files as texts in memory, as there are
// no others, and what C does not have. As there a status tells, and ft_last_error() why. One
// thread.
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bounds/bound_presets.h"
#include "assets/bounds/bounds_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/certificate/certificate_writer.h"
#include "bindings/c/handles.h"
#include "bindings/c/last_step.h"
#include "bindings/c/link_bounds.h"
#include "lss/index.h"
#include "lss/lss_cover.h"
#include "tessellation/swept_surface.h"

#define FTW_EXPORT extern "C" __attribute__((used, visibility("default")))

using namespace foretouch;
using namespace foretouch::c;

/// A surface in the module's memory: x, y, z per vertex, and three vertices per triangle.
struct ftw_swept {
  std::uint32_t vertex_count, triangle_count;
  const double* positions;
  const std::uint32_t* indices;
};

namespace {

Result<Clip> clipOf(const char* bvh, std::size_t length, double scale) {
  BvhOptions options;
  options.scale = scale;
  return parseBvh(std::string_view(bvh, length), "clip", options);
}

ft_status checkedLink(const ft_query* query, std::int32_t link) {
  if (const auto s = checkedStep(query); s != FT_OK) return s;
  const LinkId count = query->avatar->avatar.numLinks();
  if (link >= 0 && link < count) return FT_OK;
  return failure(FT_ERROR_OUT_OF_RANGE, link, "link: expected 0 to %d, found %d", count - 1, link);
}

/// Until the next text, surface or fit.
std::string lastText;
std::vector<double> lastPositions;
std::vector<std::uint32_t> lastIndices;

}  // namespace

/// LSS of which at least one contains each triangle, a, b and radius of each in `lss`. For the
/// triangles, nine finite numbers each, which JavaScript has checked.
FTW_EXPORT ft_status ftw_fit(const double* triangles, std::uint32_t count, std::int32_t most,
                             const double** lss, std::uint32_t* lssCount) {
  return guarded(__func__, [&]() -> ft_status {
    std::vector<Triangle> all(count);
    for (std::size_t i = 0; i < 3 * all.size(); ++i) {
      all[i / 3].vertices[i % 3] = Eigen::Map<const Eigen::Vector3d>(triangles + 3 * i);
    }
    lastPositions.clear();
    for (const auto& [p, q, radius] : coverTriangles(all, most)) {
      lastPositions.insert(lastPositions.end(), {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), radius});
    }
    *lss = lastPositions.data();
    *lssCount = static_cast<std::uint32_t>(lastPositions.size() / 7);
    return FT_OK;
  });
}

/// A BVH file as text.
FTW_EXPORT ft_status ftw_avatar_of_clip(const char* bvh, std::size_t length, double scale,
                                        ft_avatar** avatar) {
  return guarded(__func__, [&]() -> ft_status {
    FORETOUCH_TRY_OR(failure, const Clip clip, clipOf(bvh, length, scale));
    FORETOUCH_TRY_OR(failure, auto made, avatarFromClip(clip));
    auto parts = std::make_shared<const AvatarParts>(AvatarParts{std::move(made), std::nullopt});
    *avatar = new ft_avatar{ft_avatar::kMark, std::move(parts)};
    return FT_OK;
  });
}

FTW_EXPORT ft_status ftw_clip(const char* bvh, std::size_t length, double scale,
                              const ft_avatar* avatar, ft_clip** clip) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(avatar); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, Clip read, clipOf(bvh, length, scale));
    const Skeleton& skeleton = avatar->parts->avatar.skeleton();
    FORETOUCH_TRY_OR(failure, auto match, matchJoints(skeleton, read.skeleton));
    *clip =
        new ft_clip{ft_clip::kMark, avatar->parts, std::move(read), std::move(match), Placement()};
    return FT_OK;
  });
}

FTW_EXPORT ft_status ftw_avatar_file(const ft_avatar* avatar, const char** text) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(avatar); s != FT_OK) return s;
    lastText = formatAvatar(avatar->parts->avatar);
    *text = lastText.c_str();
    return FT_OK;
  });
}

/// As ft_bounds_read(), from a file's text or the name of a preset.
FTW_EXPORT ft_status ftw_bounds(const char* file, std::size_t length, const ft_avatar* avatar,
                                std::int32_t between, double rateHz, ft_link_bound* bounds,
                                std::size_t capacity, std::size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    const std::string text(file, length);
    const bool isName = text.rfind(kBoundPresetPrefix, 0) == 0;
    return writeBounds(isName ? readBounds(text) : parseBounds(text, "bounds"),
                       isName ? text : "bounds", avatar, between, rateHz, bounds, capacity,
                       required);
  });
}

/// For one link in the last step, spans and planes that show that it touches nothing, as
/// foretouch-verify reads them; empty where none were found.
FTW_EXPORT ft_status ftw_query_certificate(const ft_query* query, std::int32_t link,
                                           const char** text) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedLink(query, link); s != FT_OK) return s;
    CertificateWriter writer(query->question->avatar(), query->question->scene());
    lastText = writer.step(0, query->step.motion, {link});
    *text = lastText.c_str();
    return FT_OK;
  });
}

/// What one LSS sweeps on [0, end] of the last step, `error` metres too large at most.
FTW_EXPORT ft_status ftw_query_swept(const ft_query* query, std::int32_t link, std::int32_t lss,
                                     double end, double error, ftw_swept* swept) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedLink(query, link); s != FT_OK) return s;
    const std::vector<Lss>& ofLink = query->avatar->avatar.lss(link);
    if (lss < 0 || slotOf(lss) >= ofLink.size()) {
      return failure(FT_ERROR_OUT_OF_RANGE, link, "lss: expected one of the %zu LSS, found %d",
                     ofLink.size(), lss);
    }
    if (!(end > 0.0 && end <= 1.0)) {
      return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "end: expected one in (0, 1], found %g", end);
    }
    SweptSurfaceOptions options;
    options.error = error;
    options.bits = CoordinateBits::Single;
    options.maxTriangles = 1'000'000;
    FORETOUCH_TRY_OR(failure, auto builder,
                     SweptSurfaceBuilder::create(ofLink[slotOf(lss)], options));
    FORETOUCH_CHECK_OR(failure, builder.add(query->step.motion, link, {0.0, end, 0.0, end}));
    FORETOUCH_TRY_OR(failure, const auto surface, builder.finish());
    lastPositions.clear();
    for (const Eigen::Vector3d& vertex : surface.vertices) {
      lastPositions.insert(lastPositions.end(), vertex.data(), vertex.data() + 3);
    }
    lastIndices.clear();
    for (const auto& triangle : surface.triangles) {
      lastIndices.insert(lastIndices.end(), triangle.begin(), triangle.end());
    }
    *swept = {static_cast<std::uint32_t>(surface.vertices.size()),
              static_cast<std::uint32_t>(surface.triangles.size()), lastPositions.data(),
              lastIndices.data()};
    return FT_OK;
  });
}
