// bindings/c/avatar.cpp: ft_avatar.
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/mesh/link_mesh.h"
#include "bindings/c/handles.h"
#include "bindings/c/import_options.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"

namespace foretouch::c {

ft_status writePose(const Pose& pose, double* rotations, double* translations, std::size_t capacity,
                    std::size_t* required) {
  const std::size_t count = pose.rotations.size();
  const void* const any = rotations != nullptr ? rotations : translations;
  const Room room = roomFor(count, any, capacity, required, "joints");
  if (room.status != FT_OK || room.isAsking) return room.status;
  for (std::size_t j = 0; rotations != nullptr && j < count; ++j) {
    const Quaternion& q = pose.rotations[j];
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(std::begin(wxyz), std::end(wxyz), rotations + 4 * j);
  }
  for (std::size_t j = 0; translations != nullptr && j < count; ++j) {
    Eigen::Map<Eigen::Vector3d>(translations + 3 * j) = pose.translations[j];
  }
  return FT_OK;
}

namespace {

ft_status checkedArrays(const ft_avatar_arrays& arrays) {
  if (const auto s = zero(arrays.reserved, "reserved"); s != FT_OK) return s;
  const std::size_t joints = arrays.joint_count;
  constexpr auto kMost = countOf(kMaxJoints);
  for (const auto& [array, name] : {std::pair<const void*, const char*>{arrays.names, "names"},
                                    {arrays.parents, "parents"},
                                    {arrays.offsets, "offsets"}}) {
    if (const auto s = neededArray(array, joints, kMost, name); s != FT_OK) return s;
  }
  constexpr std::size_t kMostLss = kMost * kMaxLssPerLink;
  for (const auto& [array, name] :
       {std::pair<const void*, const char*>{arrays.lss, "lss"}, {arrays.lss_links, "lss_links"}}) {
    if (const auto s = neededArray(array, arrays.lss_count, kMostLss, name); s != FT_OK) return s;
  }
  if (arrays.triangles == nullptr && arrays.triangle_count == 0) return FT_OK;
  for (const auto& [array, name] :
       {std::pair<const void*, const char*>{arrays.triangles, "triangles"},
        {arrays.triangle_links, "triangle_links"}}) {
    const auto s = neededArray(array, arrays.triangle_count, kMaxSurfaceTriangles, name);
    if (s != FT_OK) return s;
  }
  return FT_OK;
}

ft_status readSkeleton(const ft_avatar_arrays& arrays, RawSkeleton& raw) {
  raw.joints.resize(arrays.joint_count);
  for (std::size_t j = 0; j < arrays.joint_count; ++j) {
    RawJoint& joint = raw.joints[j];
    if (arrays.names[j] == nullptr) {
      return failure(FT_ERROR_NULL_ARGUMENT, static_cast<std::int64_t>(j),
                     "names: expected the name of joint %zu, found NULL", j);
    }
    joint.name = arrays.names[j];
    joint.parent = arrays.parents[j];
    joint.offset = Eigen::Map<const Eigen::Vector3d>(arrays.offsets + 3 * j);
    if (arrays.rotations == nullptr) continue;
    const double* const q = arrays.rotations + 4 * j;
    joint.rotation = Quaternion(q[0], q[1], q[2], q[3]);
  }
  return FT_OK;
}

/// The list of the link given by element `i` of `links`; null after a failure.
template <typename Element>
std::vector<Element>* listOf(const std::int32_t* links, std::size_t i, const char* name,
                             std::vector<std::vector<Element>>& lists) {
  const std::int32_t link = links[i];
  if (link >= 0 && slotOf(link) < lists.size()) {
    return &lists[slotOf(link)];
  }
  failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(i),
          "%s: element %zu names link %d; expected 0 to %zu", name, i, link, lists.size() - 1);
  return nullptr;
}

ft_status readLss(const ft_avatar_arrays& arrays, std::vector<std::vector<Lss>>& perLink) {
  perLink.resize(arrays.joint_count);
  for (std::size_t i = 0; i < arrays.lss_count; ++i) {
    auto* const list = listOf(arrays.lss_links, i, "lss_links", perLink);
    if (list == nullptr) return FT_ERROR_OUT_OF_RANGE;
    const ft_lss& lss = arrays.lss[i];
    list->push_back({Eigen::Map<const Eigen::Vector3d>(lss.a),
                     Eigen::Map<const Eigen::Vector3d>(lss.b), lss.radius});
  }
  return FT_OK;
}

ft_status readSurface(const ft_avatar_arrays& arrays, AvatarParts& parts) {
  if (arrays.triangles == nullptr) return FT_OK;
  std::vector<std::vector<Triangle>> perLink(arrays.joint_count);
  for (std::size_t i = 0; i < arrays.triangle_count; ++i) {
    auto* const list = listOf(arrays.triangle_links, i, "triangle_links", perLink);
    if (list == nullptr) return FT_ERROR_OUT_OF_RANGE;
    list->emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      list->back().vertices[corner] =
          Eigen::Map<const Eigen::Vector3d>(arrays.triangles[i].vertices + 3 * corner);
    }
  }
  FORETOUCH_TRY_OR(failure, auto surface, AvatarSurface::build(parts.avatar, std::move(perLink)));
  parts.surface = std::move(surface);
  return FT_OK;
}

ft_status makeAvatar(AvatarParts parts, ft_avatar** avatar) {
  auto shared = std::make_shared<const AvatarParts>(std::move(parts));
  *avatar = new ft_avatar{ft_avatar::kMark, std::move(shared)};
  return FT_OK;
}

ft_status loadMeshes(const std::string& path, const ft_import_options* meshes, AvatarParts& parts) {
  ModelImportOptions options;
  if (const auto s = readImportOptions(meshes, options.import); s != FT_OK) return s;
  FORETOUCH_TRY_OR(failure, auto triangles, loadLinkMeshes(parts.avatar, path, options));
  FORETOUCH_TRY_OR(failure, auto surface, AvatarSurface::build(parts.avatar, std::move(triangles)));
  parts.surface = std::move(surface);
  return FT_OK;
}

ft_status checkedJoint(const ft_avatar* avatar, std::int32_t joint) {
  if (const auto s = checked(avatar); s != FT_OK) return s;
  const std::int32_t count = avatar->parts->avatar.numLinks();
  if (joint >= 0 && joint < count) return FT_OK;
  return failure(FT_ERROR_OUT_OF_RANGE, joint, "joint: expected 0 to %d, found %d", count - 1,
                 joint);
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_avatar_arrays_init(ft_avatar_arrays* arrays, size_t size) {
  return initStruct(__func__, arrays, size, "ft_avatar_arrays", ft_avatar_arrays{});
}

ft_status ft_avatar_create(const ft_avatar_arrays* arrays, ft_avatar** avatar) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(avatar); s != FT_OK) return s;
    ft_avatar_arrays known{};
    if (const auto s = readStruct(arrays, "ft_avatar_arrays", known); s != FT_OK) return s;
    if (const auto s = checkedArrays(known); s != FT_OK) return s;
    RawSkeleton raw;
    if (const auto s = readSkeleton(known, raw); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto skeleton, Skeleton::build(raw));
    std::vector<std::vector<Lss>> lss;
    if (const auto s = readLss(known, lss); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto built, Avatar::build(std::move(skeleton), std::move(lss)));
    AvatarParts parts{std::move(built), std::nullopt};
    if (const auto s = readSurface(known, parts); s != FT_OK) return s;
    return makeAvatar(std::move(parts), avatar);
  });
}

ft_status ft_avatar_create_from_file(const char* path, const ft_import_options* meshes,
                                     ft_avatar** avatar) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(avatar); s != FT_OK) return s;
    if (const auto s = needed(path, "path"); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto read, readAvatarFile(path));
    AvatarParts parts{std::move(read), std::nullopt};
    if (meshes != nullptr) {
      if (const auto s = loadMeshes(path, meshes, parts); s != FT_OK) return s;
    }
    return makeAvatar(std::move(parts), avatar);
  });
}

ft_status ft_avatar_create_from_text(const char* text, size_t length, const char* name,
                                     ft_avatar** avatar) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(avatar); s != FT_OK) return s;
    if (const auto s = needed(text, "text"); s != FT_OK) return s;
    if (const auto s = needed(name, "name"); s != FT_OK) return s;
    if (const auto s = withinLimit(length, kMaxAvatarFileBytes, "bytes"); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto read, parseAvatar(std::string_view(text, length), name));
    return makeAvatar({std::move(read), std::nullopt}, avatar);
  });
}

ft_status ft_avatar_joint_count(const ft_avatar* avatar, size_t* count) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(count, "count"); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    *count = countOf(avatar->parts->avatar.numLinks());
    return FT_OK;
  });
}

ft_status ft_avatar_joint_name(const ft_avatar* avatar, int32_t joint, const char** name) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(name, "name"); s != FT_OK) return s;
    *name = nullptr;
    if (const auto s = checkedJoint(avatar, joint); s != FT_OK) return s;
    *name = avatar->parts->avatar.skeleton().name(joint).c_str();
    return FT_OK;
  });
}

ft_status ft_avatar_joint_parent(const ft_avatar* avatar, int32_t joint, int32_t* parent) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(parent, "parent"); s != FT_OK) return s;
    if (const auto s = checkedJoint(avatar, joint); s != FT_OK) return s;
    *parent = avatar->parts->avatar.skeleton().parent(joint);
    return FT_OK;
  });
}

ft_status ft_avatar_find_joint(const ft_avatar* avatar, const char* name, int32_t* joint) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(name, "name"); s != FT_OK) return s;
    if (const auto s = needed(joint, "joint"); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    const auto found = avatar->parts->avatar.skeleton().find(name);
    if (!found) {
      return failure(FT_ERROR_UNKNOWN_NAME, kNoIndex,
                     "name: expected the name of a joint of the avatar, found '%.64s'", name);
    }
    *joint = *found;
    return FT_OK;
  });
}

ft_status ft_avatar_rest_pose(const ft_avatar* avatar, double* rotations, double* translations,
                              size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(avatar); s != FT_OK) return s;
    return writePose(restPose(avatar->parts->avatar.skeleton()), rotations, translations, capacity,
                     required);
  });
}

void ft_avatar_destroy(ft_avatar* avatar) {
  destroy(__func__, avatar);
}
