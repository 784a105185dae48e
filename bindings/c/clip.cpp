// bindings/c/clip.cpp: ft_clip.
#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/clip/clip_file.h"
#include "bindings/c/handles.h"
#include "bindings/c/import_options.h"
#include "bindings/c/sized_struct.h"

namespace foretouch::c {
namespace {

ft_clip_options defaultClipOptions() {
  ft_clip_options options{};
  options.size = sizeof options;
  options.up = FT_UP_FILE;
  return options;
}

/// The highest rate of a clip: its rows are at least a microsecond apart.
constexpr double kMostRowsPerSecond = 1e6;

/// How to read a clip, and its placement.
struct ClipReading {
  ClipFileOptions file;
  Placement placement;
};

/// What the formats of motion research want beside their file.
ft_status readMotionOptions(const ft_clip_options& known, ClipFileOptions& options) {
  if (known.skeleton != nullptr) options.skeleton = known.skeleton;
  if (!(known.row_rate_hz >= 0.0 && known.row_rate_hz <= kMostRowsPerSecond)) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "row_rate_hz: expected 0 to 1e6, found %g",
                   known.row_rate_hz);
  }
  if (known.row_rate_hz > 0.0) options.table.rateHz = known.row_rate_hz;
  return FT_OK;
}

ft_status readClipOptions(const ft_clip_options* given, ClipReading& reading) {
  ft_clip_options known = defaultClipOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_clip_options", known); s != FT_OK) return s;
  }
  std::optional<UpAxis> up;
  if (const auto s = readUpAxis(known.up, up); s != FT_OK) return s;
  if (const auto s = readImportOptions(nullptr, reading.file.import); s != FT_OK) return s;
  if (known.scale != 0.0) reading.file.import.scale = known.scale;
  reading.file.import.up = up;
  reading.placement.motionUpZ = up == UpAxis::Z;
  reading.placement.yawDeg = known.yaw_deg;
  reading.placement.origin = Eigen::Map<const Eigen::Vector3d>(known.origin);
  if (!(std::abs(known.yaw_deg) <= kMaxBvhAngleDeg)) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "yaw_deg: expected at most 1e6, found %g",
                   known.yaw_deg);
  }
  if (!(reading.placement.origin.cwiseAbs().array() <= kMaxCoordinate).all()) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "origin: expected coordinates within 1e7 m");
  }
  return readMotionOptions(known, reading.file);
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_clip_options_init(ft_clip_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_clip_options", defaultClipOptions());
}

ft_status ft_clip_create_from_file(const char* path, const ft_avatar* avatar,
                                   const ft_clip_options* options, ft_clip** clip) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(clip); s != FT_OK) return s;
    if (const auto s = needed(path, "path"); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    ClipReading reading;
    if (const auto s = readClipOptions(options, reading); s != FT_OK) return s;
    const ClipFormat format = clipFormatOf(path);
    if (!reading.file.skeleton.empty() && format != ClipFormat::Acclaim) {
      return failure(FT_ERROR_MISMATCH, kNoIndex,
                     "skeleton: expected NULL: only an .amc has one in another file");
    }
    FORETOUCH_TRY_OR(failure, auto read, readClipFile(path, reading.file));
    if (read.isUpright) reading.placement.motionUpZ = false;
    FORETOUCH_TRY_OR(
        failure, auto match,
        inFile(matchJoints(avatar->parts->avatar.skeleton(), read.clip.skeleton), path));
    *clip = new ft_clip{ft_clip::kMark, avatar->parts, std::move(read.clip), std::move(match),
                        reading.placement};
    return FT_OK;
  });
}

ft_status ft_clip_get_info(const ft_clip* clip, ft_clip_info* info) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(clip); s != FT_OK) return s;
    const auto& driver = clip->match.clipJointOf;
    ft_clip_info known{};
    known.matched_joints = static_cast<std::int32_t>(
        std::count_if(driver.begin(), driver.end(), [](JointId j) { return j != kNoParent; }));
    known.frame_count = clip->clip.frames.size();
    known.frame_time_s = clip->clip.frameTimeS;
    return writeStruct(info, "ft_clip_info", known);
  });
}

ft_status ft_clip_pose(const ft_clip* clip, size_t frame, double* rotations, double* translations,
                       size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(clip); s != FT_OK) return s;
    const std::size_t frames = clip->clip.frames.size();
    if (frame >= frames) {
      return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "frame: expected 0 to %zu, found %zu",
                     frames - 1, frame);
    }
    const Skeleton& skeleton = clip->avatar->avatar.skeleton();
    FORETOUCH_TRY_OR(
        failure, auto pose,
        validatedPose(skeleton,
                      placed(skeleton, poseOfAvatar(skeleton, clip->clip, clip->match, frame),
                             clip->placement)));
    return writePose(pose, rotations, translations, capacity, required);
  });
}

void ft_clip_destroy(ft_clip* clip) {
  destroy(__func__, clip);
}
