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

}  // namespace

ft_world_options defaultWorldOptions() {
  ft_world_options options{};
  options.size = sizeof options;
  options.tolerance = WorldOptions().tolerance;
  return options;
}

ft_body_options defaultBodyOptions() {
  const BodyOptions defaults;
  ft_body_options options{};
  options.size = sizeof options;
  options.group = defaults.group;
  options.when_silent = static_cast<std::int32_t>(defaults.whenSilent);
  return options;
}

ft_status readWorldOptions(const ft_world_options* given, WorldOptions& options) {
  ft_world_options known = defaultWorldOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_world_options", known); s != FT_OK) return s;
  }
  options.tolerance = known.tolerance;
  return zero(static_cast<std::uint32_t>(known.reserved), "reserved");
}

ft_status readBodyOptions(const ft_body_options* given, BodyOptions& options) {
  ft_body_options known = defaultBodyOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_body_options", known); s != FT_OK) return s;
  }
  const auto s = zero(static_cast<std::uint32_t>(known.reserved), "reserved");
  if (s != FT_OK) return s;
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
