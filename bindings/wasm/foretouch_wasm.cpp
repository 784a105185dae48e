// bindings/wasm/foretouch_wasm.cpp: what the module foretouch.wasm exports. JavaScript
// (foretouch.ts beside it, which documents the calls) writes arguments into two buffers, calls, and
// reads the answer there. Handles are numbers above zero; 0, or false, says that the call failed,
// and ftw_error() why. One thread.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/motion.h"
#include "articulated/pose.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/bvh/bvh_avatar.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/certificate/certificate_writer.h"
#include "lss/index.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_avatar.h"
#include "tessellation/swept_surface.h"

#define FTW_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace foretouch {
namespace {

using Handle = std::int32_t;

/// Numbers of a contact of one link, and of one contact of a solid avatar (foretouch.ts).
constexpr std::size_t kContactNumbers = 18, kSolidContactNumbers = 13, kTickNumbers = 9;

struct MovedClip {
  Clip clip;
  JointMatch match;
  Handle avatar = 0;
};

/// An avatar in a scene, and what was asked last.
struct Asked {
  Query query;
  QueryScratch scratch;
  ChainMotion motion;
  StepContacts answer;
  bool hasAnswer = false;
};

struct Shown {
  SolidAvatar solid;
  SolidTick tick;
  std::vector<std::uint8_t> isTracked;
};

/// What JavaScript holds handles of.
template <typename T>
class Table {
 public:
  Handle add(T value) {
    const Handle handle = ++last_;
    values_.emplace(handle, std::make_unique<T>(std::move(value)));
    return handle;
  }
  [[nodiscard]] T* find(Handle handle) const {
    const auto found = values_.find(handle);
    return found == values_.end() ? nullptr : found->second.get();
  }
  void remove(Handle handle) { values_.erase(handle); }

 private:
  std::map<Handle, std::unique_ptr<T>> values_;
  Handle last_ = 0;
};

struct Module {
  Table<Scene> scenes;
  Table<Avatar> avatars;
  Table<MovedClip> clips;
  Table<Asked> queries;
  Table<Shown> solids;
  std::vector<double> numbers;
  std::vector<std::uint8_t> bytes;
  std::string text;   // the last answer in words
  std::string error;  // of the last call that failed
  Pose from, to;
};

Module& module() {
  static Module only;
  return only;
}

Handle fails(const Error& error) {
  module().error = describe(error);
  return 0;
}

Handle fails(const char* expectation) {
  module().error = expectation;
  return 0;
}

/// JavaScript is never thrown at: what happens when memory ends is an error, too.
template <typename Call>
Handle guarded(const Call& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    return fails("expected memory for this, found none left");
  } catch (const std::exception& exception) {
    return fails(exception.what());
  }
}

template <typename T>
T* needed(const Table<T>& table, Handle handle, const char* what) {
  T* const found = table.find(handle);
  if (found == nullptr) module().error = std::string("expected a handle of a ") + what;
  return found;
}

std::string_view textOfBytes(std::size_t length) {
  const auto& bytes = module().bytes;
  return {reinterpret_cast<const char*>(bytes.data()), std::min(length, bytes.size())};
}

/// The pose that begins at `at`: rotations w, x, y, z, then translations.
void readPose(std::size_t joints, const double* at, Pose& pose) {
  pose.rotations.resize(joints);
  pose.translations.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const double* const q = at + 4 * j;
    pose.rotations[j] = Quaternion(q[0], q[1], q[2], q[3]);
    pose.translations[j] = Eigen::Map<const Eigen::Vector3d>(at + 4 * joints + 3 * j);
  }
}

double* writePoint(const Eigen::Vector3d& p, double* at) {
  for (int axis = 0; axis < 3; ++axis) *at++ = p[axis];
  return at;
}

double* writePose(const Pose& pose, double* at) {
  for (const Quaternion& q : pose.rotations) {
    for (const double number : {q.w(), q.x(), q.y(), q.z()}) *at++ = number;
  }
  for (const Eigen::Vector3d& p : pose.translations) at = writePoint(p, at);
  return at;
}

double* numbersFor(std::size_t count) {
  auto& numbers = module().numbers;
  if (numbers.size() < count) numbers.resize(count);
  return numbers.data();
}

double* writeContact(const LinkContact& contact, const Scene& scene, double* at) {
  *at++ = static_cast<double>(contact.verdict);
  *at++ = static_cast<double>(contact.reason);
  for (const double number :
       {contact.toi, contact.freeUntil, contact.separation, contact.penetration}) {
    *at++ = number;
  }
  *at++ = contact.triangle;
  *at++ = contact.triangle < 0 ? -1 : scene.object(contact.triangle);
  *at++ = contact.lss;
  at = writePoint(contact.p_WScene, at);
  at = writePoint(contact.p_WLink, at);
  at = writePoint(contact.nhat_SL_W, at);
  return at;
}

Handle madeAvatar(Result<Avatar> made) {
  if (!made.ok()) return fails(made.error());
  return module().avatars.add(std::move(made).value());
}

RawScene rawScene(std::size_t vertices, std::size_t triangles, std::size_t objects) {
  const double* const positions = module().numbers.data();
  const auto* const indices = reinterpret_cast<const std::uint32_t*>(module().bytes.data());
  RawScene raw;
  raw.triangles.resize(triangles);
  raw.objectOf.resize(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t vertex = indices[3 * t + corner];
      const double* const p = positions + 3 * std::min(vertex, vertices - 1);
      raw.triangles[t].vertices[corner] = Eigen::Map<const Eigen::Vector3d>(p);
    }
    raw.objectOf[t] = static_cast<ObjectId>(indices[3 * triangles + t]);
  }
  for (std::size_t object = 0; object < objects; ++object) {
    raw.objectNames.push_back("object " + std::to_string(object));
  }
  return raw;
}

}  // namespace
}  // namespace foretouch

using namespace foretouch;

FTW_EXPORT const char* ftw_version() {
  return FORETOUCH_VERSION;
}

/// Room for so many numbers, or bytes: where arguments are written, and answers read. They stay
/// there until room for more is asked for.
FTW_EXPORT double* ftw_numbers(std::size_t count) {
  try {
    return numbersFor(count);
  } catch (const std::bad_alloc&) {
    fails("expected memory for this, found none left");
    return nullptr;
  }
}
FTW_EXPORT std::uint8_t* ftw_bytes(std::size_t count) {
  try {
    auto& bytes = module().bytes;
    bytes.resize(count);
    return bytes.data();
  } catch (const std::bad_alloc&) {
    fails("expected memory for this, found none left");
    return nullptr;
  }
}
FTW_EXPORT const char* ftw_error() {
  return module().error.c_str();
}
FTW_EXPORT const char* ftw_text() {
  return module().text.c_str();
}

/// Numbers: x, y, z per vertex. Bytes: three 32-bit indices per triangle, then an object each.
FTW_EXPORT Handle ftw_scene(std::size_t vertices, std::size_t triangles, std::size_t objects) {
  return guarded([&]() -> Handle {
    const auto& [numbers, bytes] = std::tie(module().numbers, module().bytes);
    if (vertices == 0 || numbers.size() / 3 < vertices || bytes.size() / 16 < triangles) {
      return fails("expected three numbers per vertex and four integers per triangle");
    }
    auto built = Scene::build(rawScene(vertices, triangles, objects));
    if (!built.ok()) return fails(built.error());
    return module().scenes.add(std::move(built).value());
  });
}
FTW_EXPORT void ftw_scene_destroy(Handle scene) {
  module().scenes.remove(scene);
}

/// Bytes: an avatar file.
FTW_EXPORT Handle ftw_avatar(std::size_t length) {
  return guarded([&] { return madeAvatar(parseAvatar(textOfBytes(length), "avatar")); });
}
/// The avatar as a file: ftw_text().
FTW_EXPORT Handle ftw_avatar_file(Handle avatar) {
  return guarded([&]() -> Handle {
    const Avatar* const found = needed(module().avatars, avatar, "avatar");
    if (found == nullptr) return 0;
    module().text = formatAvatar(*found);
    return 1;
  });
}
FTW_EXPORT void ftw_avatar_destroy(Handle avatar) {
  module().avatars.remove(avatar);
}

/// Bytes: a BVH file. Avatar 0: one is made from the clip. Numbers: the avatar, frames, seconds
/// per frame.
FTW_EXPORT Handle ftw_clip(std::size_t length, double scale, Handle avatar) {
  return guarded([&]() -> Handle {
    BvhOptions options;
    options.scale = scale;
    auto read = parseBvh(textOfBytes(length), "clip", options);
    if (!read.ok()) return fails(read.error());
    MovedClip moved;
    moved.clip = std::move(read).value();
    moved.avatar = avatar != 0 ? avatar : madeAvatar(avatarFromClip(moved.clip));
    if (moved.avatar == 0) return 0;
    const Avatar* const body = needed(module().avatars, moved.avatar, "avatar");
    if (body == nullptr) return 0;
    auto match = matchJoints(body->skeleton(), moved.clip.skeleton);
    if (!match.ok()) {
      if (avatar == 0) module().avatars.remove(moved.avatar);
      return fails(match.error());
    }
    moved.match = std::move(match).value();
    double* const out = numbersFor(3);
    out[0] = moved.avatar;
    out[1] = static_cast<double>(moved.clip.frames.size());
    out[2] = moved.clip.frameTimeS;
    return module().clips.add(std::move(moved));
  });
}
/// Numbers: the frame as a pose of the clip's avatar.
FTW_EXPORT Handle ftw_clip_pose(Handle clip, std::size_t frame) {
  return guarded([&]() -> Handle {
    const MovedClip* const found = needed(module().clips, clip, "clip");
    if (found == nullptr) return 0;
    const Avatar* const body = needed(module().avatars, found->avatar, "avatar");
    if (body == nullptr) return 0;
    if (frame >= found->clip.frames.size()) return fails("expected a frame of the clip");
    const Skeleton& skeleton = body->skeleton();
    auto pose = validatedPose(skeleton, poseOfAvatar(skeleton, found->clip, found->match, frame));
    if (!pose.ok()) return fails(pose.error());
    writePose(pose.value(), numbersFor(7 * pose.value().rotations.size()));
    return 1;
  });
}
FTW_EXPORT void ftw_clip_destroy(Handle clip) {
  module().clips.remove(clip);
}

FTW_EXPORT Handle ftw_query(Handle scene, Handle avatar, double tolerance) {
  return guarded([&]() -> Handle {
    const Scene* const around = needed(module().scenes, scene, "scene");
    const Avatar* const body = needed(module().avatars, avatar, "avatar");
    if (around == nullptr || body == nullptr) return 0;
    QueryOptions options;
    options.tolerance = tolerance;
    auto built = Query::build(*body, *around, options);
    if (!built.ok()) return fails(built.error());
    return module().queries.add({std::move(built).value(), {}, {}, {}, false});
  });
}
/// Numbers: two poses; then a contact per link.
FTW_EXPORT Handle ftw_query_step(Handle query) {
  return guarded([&]() -> Handle {
    Asked* const asked = needed(module().queries, query, "query");
    if (asked == nullptr) return 0;
    const Skeleton& skeleton = asked->query.avatar().skeleton();
    const std::size_t joints = countOf(skeleton.numJoints());
    Pose& from = module().from;
    Pose& to = module().to;
    const double* const given = numbersFor(14 * joints);
    readPose(joints, given, from);
    readPose(joints, given + 7 * joints, to);
    if (auto done = inFile(validate(skeleton, from), "from"); !done.ok())
      return fails(done.error());
    if (auto done = inFile(validate(skeleton, to), "to"); !done.ok()) return fails(done.error());
    asked->motion.assign(skeleton, from, to);
    asked->query.answer(asked->motion, asked->scratch, asked->answer);
    asked->hasAnswer = true;
    double* at = numbersFor(kContactNumbers * joints);
    for (const LinkContact& contact : asked->answer.links) {
      at = writeContact(contact, asked->query.scene(), at);
    }
    return 1;
  });
}
/// Of the last step, for one link: spans and planes that show that it touches nothing, as
/// foretouch-verify reads them: ftw_text(), empty where none were found.
FTW_EXPORT Handle ftw_query_certificate(Handle query, std::int32_t link) {
  return guarded([&]() -> Handle {
    const Asked* const asked = needed(module().queries, query, "query");
    if (asked == nullptr) return 0;
    if (!asked->hasAnswer || link < 0 || link >= asked->query.avatar().numLinks()) {
      return fails("expected a link of the avatar, and a step before");
    }
    CertificateWriter writer(asked->query.avatar(), asked->query.scene());
    module().text = writer.step(0, asked->motion, {link});
    return 1;
  });
}
/// Of the last step: what one LSS sweeps on [0, end], `error` metres too large at most. Numbers:
/// vertices, triangles, then x, y, z per vertex; bytes: three 32-bit indices per triangle.
FTW_EXPORT Handle ftw_query_swept(Handle query, std::int32_t link, std::int32_t lss, double end,
                                  double error) {
  return guarded([&]() -> Handle {
    const Asked* const asked = needed(module().queries, query, "query");
    if (asked == nullptr) return 0;
    const Avatar& avatar = asked->query.avatar();
    if (!asked->hasAnswer || link < 0 || link >= avatar.numLinks() || lss < 0 ||
        slotOf(lss) >= avatar.lss(link).size() || !(end > 0.0 && end <= 1.0)) {
      return fails("expected an LSS of the avatar, an end in (0, 1], and a step before");
    }
    SweptSurfaceOptions options;
    options.error = error;
    options.bits = CoordinateBits::Single;
    options.maxTriangles = 1'000'000;
    auto builder = SweptSurfaceBuilder::create(avatar.lss(link)[slotOf(lss)], options);
    if (!builder.ok()) return fails(builder.error());
    const auto added = builder.value().add(asked->motion, link, {0.0, end, 0.0, end});
    if (!added.ok()) return fails(added.error());
    const auto surface = builder.value().finish();
    if (!surface.ok()) return fails(surface.error());
    const auto& [vertices, triangles] =
        std::tie(surface.value().vertices, surface.value().triangles);
    double* at = numbersFor(2 + 3 * vertices.size());
    *at++ = static_cast<double>(vertices.size());
    *at++ = static_cast<double>(triangles.size());
    for (const Eigen::Vector3d& vertex : vertices) at = writePoint(vertex, at);
    module().bytes.resize(12 * triangles.size());
    std::memcpy(module().bytes.data(), triangles.data(), 12 * triangles.size());
    return 1;
  });
}
FTW_EXPORT void ftw_query_destroy(Handle query) {
  module().queries.remove(query);
}

/// `liftsFeet`: whether feet below the floor lift the whole target.
FTW_EXPORT Handle ftw_solid(Handle scene, Handle avatar, double skin, double tolerance,
                            bool liftsFeet) {
  return guarded([&]() -> Handle {
    const Scene* const around = needed(module().scenes, scene, "scene");
    const Avatar* const body = needed(module().avatars, avatar, "avatar");
    if (around == nullptr || body == nullptr) return 0;
    SolidOptions options;
    options.skin = skin;
    options.tolerance = tolerance;
    options.floor = liftsFeet ? FloorPolicy::Lift : FloorPolicy::Hold;
    auto built = SolidAvatar::build(*body, *around, options);
    if (!built.ok()) return fails(built.error());
    return module().solids.add({std::move(built).value(), {}, {}});
  });
}
/// Numbers: the tracked pose, then one per joint, 0 if its tracker lost it. Then: what SolidTick
/// says (kTickNumbers), the shown pose, a state and a deviation per joint, and the contacts.
FTW_EXPORT Handle ftw_solid_follow(Handle solid, double seconds) {
  return guarded([&]() -> Handle {
    Shown* const shown = needed(module().solids, solid, "solid avatar");
    if (shown == nullptr) return 0;
    const std::size_t joints = countOf(shown->solid.avatar().numLinks());
    const double* const given = numbersFor(8 * joints);
    Pose& tracked = module().to;
    readPose(joints, given, tracked);
    shown->isTracked.resize(joints);
    for (std::size_t j = 0; j < joints; ++j) shown->isTracked[j] = given[7 * joints + j] != 0.0;
    const auto done = shown->solid.follow({tracked, seconds, &shown->isTracked}, shown->tick);
    if (!done.ok()) return fails(done.error());
    const SolidTick& tick = shown->tick;
    double* at =
        numbersFor(kTickNumbers + 9 * joints + kSolidContactNumbers * tick.contacts.size());
    for (const double number :
         {static_cast<double>(tick.state), static_cast<double>(tick.limit),
          tick.isCertified ? 1.0 : 0.0, tick.hasAppeared ? 1.0 : 0.0, tick.deviation, tick.lift,
          tick.clearance, static_cast<double>(tick.numWay),
          static_cast<double>(tick.contacts.size())}) {
      *at++ = number;
    }
    at = writePose(tick.shown, at);
    for (std::size_t j = 0; j < joints; ++j) {
      *at++ = static_cast<double>(tick.joints[j]);
      *at++ = tick.linkDeviation[j];
    }
    for (const SolidContact& contact : tick.contacts) {
      *at++ = contact.link;
      *at++ = contact.lss;
      *at++ = contact.triangle;
      *at++ = contact.triangle < 0 ? -1 : shown->solid.scene().object(contact.triangle);
      at = writePoint(contact.p_W, at);
      at = writePoint(contact.nhat_W, at);
      *at++ = contact.gap;
      *at++ = contact.push;
      *at++ = contact.slipSpeed;
    }
    return 1;
  });
}
/// Piece `index` of the last tick's way. Numbers: when it is reached, then the pose it ends with.
FTW_EXPORT Handle ftw_solid_way(Handle solid, std::size_t index) {
  return guarded([&]() -> Handle {
    const Shown* const shown = needed(module().solids, solid, "solid avatar");
    if (shown == nullptr) return 0;
    if (index >= shown->tick.numWay) return fails("expected a piece of the way");
    double* const at = numbersFor(1 + 7 * shown->tick.shown.rotations.size());
    *at = shown->tick.times[index];
    writePose(shown->tick.way[index], at + 1);
    return 1;
  });
}
FTW_EXPORT Handle ftw_solid_change_scene(Handle solid, Handle scene) {
  return guarded([&]() -> Handle {
    Shown* const shown = needed(module().solids, solid, "solid avatar");
    const Scene* const around = needed(module().scenes, scene, "scene");
    if (shown == nullptr || around == nullptr) return 0;
    const auto done = shown->solid.changeScene(*around);
    return done.ok() ? 1 : fails(done.error());
  });
}
FTW_EXPORT void ftw_solid_reset(Handle solid) {
  Shown* const shown = module().solids.find(solid);
  if (shown != nullptr) shown->solid.reset();
}
FTW_EXPORT void ftw_solid_destroy(Handle solid) {
  module().solids.remove(solid);
}
