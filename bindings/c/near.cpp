// bindings/c/near.cpp: ft_near, what links are near to at one pose.
#include <cmath>
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "bindings/c/handles.h"
#include "bindings/c/query_options.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

ft_status readDetail(std::int32_t given, NearDetail& detail) {
  switch (given) {
    case FT_NEAR_REDUCED: detail = NearDetail::Reduced; return FT_OK;
    case FT_NEAR_ALL: detail = NearDetail::All; return FT_OK;
    case FT_NEAR_NEAREST: detail = NearDetail::Nearest; return FT_OK;
    default: break;
  }
  return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "detail: expected one of FT_NEAR_*, found %d",
                 given);
}

ft_status readReach(const double* given, std::size_t count, std::size_t links,
                    std::vector<double>& reach) {
  if (const auto s = needed(given, "reach"); s != FT_OK) return s;
  if (count != links) {
    return failure(FT_ERROR_MISMATCH, kNoIndex,
                   "reach: expected one per link, %zu of them, found %zu", links, count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (given[i] <= kMaxCoordinate) continue;  // NaN is not
    return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(i),
                   "reach: expected at most 1e7 metres, found %g", given[i]);
  }
  reach.assign(given, given + count);
  return FT_OK;
}

ft_near_feature nearFeatureOf(const NearFeature& feature, const Scene& scene) {
  ft_near_feature f{};
  f.link = feature.link;
  f.lss = feature.lss;
  f.triangle = feature.triangle;
  f.object = scene.object(feature.triangle);
  f.feature = static_cast<std::int32_t>(feature.feature);
  f.along = feature.along;
  f.gap = feature.gap;
  Eigen::Map<Eigen::Vector3d>(f.point_scene) = feature.p_WScene;
  Eigen::Map<Eigen::Vector3d>(f.point_link) = feature.p_WLink;
  Eigen::Map<Eigen::Vector3d>(f.normal) = feature.nhat_SL_W;
  return f;
}

ft_status checkedAnswer(const ft_near* query) {
  if (const auto s = checked(query); s != FT_OK) return s;
  if (query->hasAnswer) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected an answered ft_near_ask()");
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_near_options_init(ft_near_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_near_options", ft_near_options{});
}

ft_status ft_near_create(const ft_scene* scene, const ft_avatar* avatar,
                         const ft_near_options* options, ft_near** near_query) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(near_query); s != FT_OK) return s;
    if (const auto s = checked(scene); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    ft_near_options known{};
    if (options != nullptr) {
      if (const auto s = readStruct(options, "ft_near_options", known); s != FT_OK) return s;
    }
    NearDetail detail{};
    if (const auto s = readDetail(known.detail, detail); s != FT_OK) return s;
    std::vector<IgnoredPair> ignored;
    if (const auto s = readIgnored(known.ignored, known.ignored_count, ignored); s != FT_OK) {
      return s;
    }
    FORETOUCH_TRY_OR(failure, auto question,
                     NearQuery::build(avatar->parts->avatar, scene->scene, ignored));
    *near_query = new ft_near{
        ft_near::kMark, avatar->parts, std::move(question), detail, {}, {}, {}, {}, {}, {}, false};
    return FT_OK;
  });
}

ft_status ft_near_ask(ft_near* near_query, const ft_pose* pose, const double* reach,
                      size_t reach_count) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(near_query); s != FT_OK) return s;
    ft_near& query = *near_query;
    const Avatar& avatar = query.avatar->avatar;
    const auto links = countOf(avatar.numLinks());
    if (const auto s = readPose(pose, "pose", avatar.skeleton(), query.pose); s != FT_OK) return s;
    if (const auto s = readReach(reach, reach_count, links, query.reach); s != FT_OK) return s;
    query.hasAnswer = false;
    query.still.assign(avatar.skeleton(), query.pose, query.pose);
    query.still.statesAt(0.0, query.states);
    query.question.answer(query.states, query.reach, query.scratch, query.near, query.detail);
    query.hasAnswer = true;
    return FT_OK;
  });
}

ft_status ft_near_features(const ft_near* near_query, ft_near_feature* features, size_t capacity,
                           size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedAnswer(near_query); s != FT_OK) return s;
    const auto& found = near_query->near.features;
    const Room room = roomFor(found.size(), features, capacity, required, "features");
    if (room.status != FT_OK || room.isAsking || found.empty()) return room.status;
    const auto feature = [&](std::size_t i) {
      return nearFeatureOf(found[i], near_query->question.scene());
    };
    return writeStructs("ft_near_feature", found.size(), feature, features);
  });
}

ft_status ft_near_ranges(const ft_near* near_query, ft_near_range* ranges, size_t capacity,
                         size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedAnswer(near_query); s != FT_OK) return s;
    const auto& links = near_query->near.links;
    const Room room = roomFor(links.size(), ranges, capacity, required, "ranges");
    if (room.status != FT_OK || room.isAsking) return room.status;
    for (std::size_t i = 0; i < links.size(); ++i) {
      ranges[i] = {links[i].first, links[i].count, links[i].hadMore ? 1 : 0, 0};
    }
    return FT_OK;
  });
}

void ft_near_destroy(ft_near* near_query) {
  destroy(__func__, near_query);
}
