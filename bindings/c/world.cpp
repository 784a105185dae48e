// bindings/c/world.cpp: ft_world: its bodies, where they are, and what carries what.
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "bindings/c/sized_struct.h"
#include "bindings/c/world_handle.h"
#include "lss/index.h"

namespace foretouch::c {

const Skeleton& skeletonOfMesh() {
  static const Skeleton one = [] {
    RawSkeleton raw;
    raw.joints = {{"mesh", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
    return Skeleton::build(raw).value();
  }();
  return one;
}

ft_status checkedBody(const ft_world& world, std::int32_t body) {
  if (body >= 0 && static_cast<std::size_t>(body) < world.bodies.size()) return FT_OK;
  return failure(FT_ERROR_UNKNOWN_NAME, body,
                 "body: expected one of the %zu that were added, found %d", world.bodies.size(),
                 body);
}

ft_status copyBodyPose(const ft_world& world, std::int32_t body, const ft_pose* given, Pose& pose) {
  if (const auto s = checkedBody(world, body); s != FT_OK) return s;
  const auto& avatar = world.bodies[slotOf(body)].avatar;
  const Skeleton& skeleton = avatar ? avatar->avatar.skeleton() : skeletonOfMesh();
  return copyPose(given, "pose", skeleton, pose);
}

namespace {

ft_status ended(const Result<Done>& done, const char* place = "") {
  return done.ok() ? ft_status{FT_OK} : worldFailure(inFile(done, place).error());
}

/// Adds an avatar's or a mesh's body.
template <typename Shape>
ft_status add(ft_world& world, const Shape& shape, const ft_body_options* given,
              ft_world::Body body, std::int32_t* number) {
  if (const auto s = needed(number, "body"); s != FT_OK) return s;
  BodyOptions options;
  if (const auto s = readBodyOptions(given, body.avatar.get(), options); s != FT_OK) return s;
  return addBody(world, std::move(body), number, [&] { return world.world.add(shape, options); });
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_world_create(const ft_scene* still, const ft_world_options* options,
                          ft_world** world) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(world); s != FT_OK) return s;
    std::optional<Scene> scene;
    if (still != nullptr) {
      if (const auto s = checked(still); s != FT_OK) return s;
      scene = still->scene;
    }
    WorldOptions read;
    if (const auto s = readWorldOptions(options, read); s != FT_OK) return s;
    FORETOUCH_TRY_OR(worldFailure, auto made, World::build(scene, read));
    *world = new ft_world(std::move(scene), std::move(made));
    return FT_OK;
  });
}

ft_status ft_world_add_avatar(ft_world* world, const ft_avatar* avatar,
                              const ft_body_options* options, int32_t* body) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    return add(*world, avatar->parts->avatar, options, {avatar->parts, std::nullopt}, body);
  });
}

ft_status ft_world_add_mesh(ft_world* world, const ft_scene* mesh, const ft_body_options* options,
                            int32_t* body) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = needed(mesh, "mesh"); s != FT_OK) return s;
    if (const auto s = checked(mesh); s != FT_OK) return s;
    return add(*world, mesh->scene, options, {nullptr, mesh->scene}, body);
  });
}

ft_status ft_world_body_count(const ft_world* world, size_t* count) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = needed(count, "count"); s != FT_OK) return s;
    *count = world->bodies.size();
    return FT_OK;
  });
}

ft_status ft_world_ask(ft_world* world, int32_t group, int32_t other, int32_t is_asked) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    bool isAsked = false;
    if (const auto s = readTruth(is_asked, "is_asked", isAsked); s != FT_OK) return s;
    return ended(world->world.ask(group, other, isAsked));
  });
}

ft_status ft_world_ask_still(ft_world* world, int32_t group, int32_t is_asked) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    bool isAsked = false;
    if (const auto s = readTruth(is_asked, "is_asked", isAsked); s != FT_OK) return s;
    return ended(world->world.askStill(group, isAsked));
  });
}

ft_status ft_world_push(ft_world* world, int32_t body, int64_t utime_us, const ft_pose* pose) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = copyBodyPose(*world, body, pose, world->given); s != FT_OK) return s;
    return ended(world->world.push(body, utime_us, world->given), "pose");
  });
}

ft_status ft_world_attach(ft_world* world, int32_t body, const ft_carrier* carrier,
                          int64_t utime_us, const ft_pose* pose) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    ft_carrier known{};
    if (const auto s = readStruct(carrier, "ft_carrier", known); s != FT_OK) return s;
    Carrier by{known.body, known.link, false};
    const auto t = readTruth(known.moves_in_frame, "moves_in_frame", by.movesInFrame);
    if (t != FT_OK) return t;
    if (const auto s = copyBodyPose(*world, body, pose, world->given); s != FT_OK) return s;
    return ended(world->world.attach(body, by, utime_us, world->given), "pose");
  });
}

ft_status ft_world_detach(ft_world* world, int32_t body, int64_t utime_us, const ft_pose* pose) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = copyBodyPose(*world, body, pose, world->given); s != FT_OK) return s;
    return ended(world->world.detach(body, utime_us, world->given), "pose");
  });
}

ft_status ft_world_known_until(const ft_world* world, int64_t* utime_us, int32_t* waits_for) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    const auto known = world->world.knownUntilUs();
    if (!known) return failure(FT_ERROR_EMPTY, kNoIndex, "expected a pose of some body before");
    if (utime_us != nullptr) *utime_us = *known;
    if (waits_for != nullptr) *waits_for = world->world.waitsFor().value_or(-1);
    return FT_OK;
  });
}

ft_status ft_world_forget_before(ft_world* world, int64_t utime_us) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    world->world.forgetBefore(utime_us);
    return FT_OK;
  });
}

ft_status ft_world_forget_beyond(ft_world* world, size_t bytes, int64_t* utime_us) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    const std::int64_t us = world->world.forgetBeyond(bytes);
    if (utime_us != nullptr) *utime_us = us;
    return FT_OK;
  });
}

ft_status ft_world_pose_bytes(const ft_world* world, size_t* bytes) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = needed(bytes, "bytes"); s != FT_OK) return s;
    *bytes = world->world.poseBytes();
    return FT_OK;
  });
}

ft_status ft_world_thin_before(ft_world* world, int64_t utime_us, double metres) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    return ended(world->world.thinBefore(utime_us, metres), "metres");
  });
}

void ft_world_destroy(ft_world* world) {
  destroy(__func__, world);
}
