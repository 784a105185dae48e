// bindings/c/world_options.cpp: ft_world_options and ft_body_options as the library's.
#include "bindings/c/sized_struct.h"
#include "bindings/c/world_handle.h"
#include "bindings/snake_case.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(WhenSilent::Wait) == FT_SILENT_WAIT);
static_assert(static_cast<int>(WhenSilent::HoldStill) == FT_SILENT_HOLD_STILL);
static_assert(static_cast<int>(WhenSilent::Undecided) == FT_SILENT_UNDECIDED);

ft_status readSilent(std::int32_t given, WhenSilent& silent) {
  if (given < FT_SILENT_WAIT || given > FT_SILENT_UNDECIDED) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "when_silent: expected one of FT_SILENT_*, found %d", given);
  }
  silent = static_cast<WhenSilent>(given);
  return FT_OK;
}

/// `avatar`: null for a mesh.
ft_status readSurface(std::int32_t fidelity, const AvatarParts* avatar, BodyOptions& options) {
  if (fidelity == FT_FIDELITY_LINK) return FT_OK;
  if (fidelity != FT_FIDELITY_EXACT) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "fidelity: expected FT_FIDELITY_LINK or _EXACT, found %d", fidelity);
  }
  if (avatar == nullptr) return FT_OK;  // a mesh touches by its triangles anyway
  if (!avatar->surface) {
    return failure(FT_ERROR_MISMATCH, kNoIndex,
                   "fidelity: expected triangles of the avatar beside FT_FIDELITY_EXACT");
  }
  options.surface = avatar->surface;
  return FT_OK;
}

}  // namespace

ft_status readTruth(std::int32_t given, const char* name, bool& truth) {
  if (given != 0 && given != 1) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "%s: expected 0 or 1, found %d", name, given);
  }
  truth = given == 1;
  return FT_OK;
}

ft_world_options defaultWorldOptions() {
  ft_world_options options{};
  options.size = sizeof options;
  options.asks_meshes = WorldOptions().askMeshes ? 1 : 0;
  options.tolerance = WorldOptions().tolerance;
  options.work_per_pair = WorldOptions().workPerPair;
  options.work_per_window = WorldOptions().workPerWindow;
  options.most_near = WorldOptions().mostNear;
  return options;
}

ft_body_options defaultBodyOptions() {
  const BodyOptions defaults;
  ft_body_options options{};
  options.size = sizeof options;
  options.group = defaults.group;
  options.when_silent = static_cast<std::int32_t>(defaults.whenSilent);
  options.fidelity = FT_FIDELITY_LINK;
  return options;
}

ft_status readWorldOptions(const ft_world_options* given, WorldOptions& options) {
  ft_world_options known = defaultWorldOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_world_options", known); s != FT_OK) return s;
  }
  options.tolerance = known.tolerance;
  options.workPerPair = known.work_per_pair;
  options.workPerWindow = known.work_per_window;
  options.mostNear = static_cast<std::size_t>(known.most_near);
  return readTruth(known.asks_meshes, "asks_meshes", options.askMeshes);
}

ft_status readBodyOptions(const ft_body_options* given, const AvatarParts* avatar,
                          BodyOptions& options) {
  ft_body_options known = defaultBodyOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_body_options", known); s != FT_OK) return s;
  }
  if (const auto s = readSurface(known.fidelity, avatar, options); s != FT_OK) return s;
  if (avatar != nullptr) options.skin = avatar->skin;
  options.group = known.group;
  if (const auto t = readSilent(known.when_silent, options.whenSilent); t != FT_OK) return t;
  if (known.self == nullptr) return FT_OK;
  if (const auto t = checked(known.self); t != FT_OK) return t;
  options.self = known.self->rules;
  return FT_OK;
}

ft_status worldFailure(Error error) {
  error.file = snakeCase(error.file);
  if (error.file == "utime") error.file = "utime_us";
  return failure(error);
}

}  // namespace foretouch::c

ft_status ft_world_options_init(ft_world_options* options, size_t size) {
  return foretouch::c::initStruct(__func__, options, size, "ft_world_options",
                                  foretouch::c::defaultWorldOptions());
}

ft_status ft_body_options_init(ft_body_options* options, size_t size) {
  return foretouch::c::initStruct(__func__, options, size, "ft_body_options",
                                  foretouch::c::defaultBodyOptions());
}
