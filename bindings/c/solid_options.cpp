// bindings/c/solid_options.cpp: ft_solid_options as the library's.
#include "bindings/c/query_options.h"
#include "bindings/c/sized_struct.h"
#include "bindings/c/solid_handle.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(FloorPolicy::Lift) == FT_SOLID_FLOOR_LIFT);
static_assert(static_cast<int>(FloorPolicy::Hold) == FT_SOLID_FLOOR_HOLD);

ft_status readFloor(std::int32_t given, FloorPolicy& floor) {
  if (given != FT_SOLID_FLOOR_LIFT && given != FT_SOLID_FLOOR_HOLD) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "floor: expected one of FT_SOLID_FLOOR_*, found %d", given);
  }
  floor = static_cast<FloorPolicy>(given);
  return FT_OK;
}

ft_status readMaySnap(std::int32_t given, bool& maySnap) {
  if (given != 0 && given != 1) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "may_snap: expected 0 or 1, found %d", given);
  }
  maySnap = given == 1;
  return FT_OK;
}

/// Numbers that the library checks.
void readNumbers(const ft_solid_options& given, SolidOptions& options) {
  options.skin = given.skin;
  options.tolerance = given.tolerance;
  options.catchUp = given.catch_up;
  options.up = Eigen::Map<const Eigen::Vector3d>(given.up);
  options.mostLift = given.most_lift;
  options.mostDeviation = given.most_deviation;
  options.mostLimbDeviation = given.most_limb_deviation;
  options.patience = given.patience;
  options.snapNotice = given.snap_notice;
  options.placingReach = given.placing_reach;
  options.aroundPerTick = given.around_per_tick;
  options.aroundInAll = given.around_in_all;
  options.workBudget = given.work_budget;
}

ft_status readArrays(const ft_solid_options& given, SolidOptions& options) {
  constexpr auto kMost = countOf(kMaxJoints);
  auto s = neededArray(given.visibility, given.visibility_count, kMost, "visibility");
  if (s != FT_OK) return s;
  s = neededArray(given.feet, given.feet_count, kMost, "feet");
  if (s != FT_OK) return s;
  options.visibility.assign(given.visibility, given.visibility + given.visibility_count);
  for (std::size_t link = 0; link < given.feet_count; ++link) {
    options.feet.push_back(given.feet[link] != 0);
  }
  return readIgnored(given.ignored, given.ignored_count, options.ignored);
}

}  // namespace

ft_solid_options defaultSolidOptions() {
  const SolidOptions defaults;
  ft_solid_options options{};
  options.size = sizeof options;
  options.floor = static_cast<std::int32_t>(defaults.floor);
  options.skin = defaults.skin;
  options.tolerance = defaults.tolerance;
  options.catch_up = defaults.catchUp;
  Eigen::Map<Eigen::Vector3d>(options.up) = defaults.up;
  options.most_lift = defaults.mostLift;
  options.most_deviation = defaults.mostDeviation;
  options.most_limb_deviation = defaults.mostLimbDeviation;
  options.patience = defaults.patience;
  options.snap_notice = defaults.snapNotice;
  options.placing_reach = defaults.placingReach;
  options.may_snap = defaults.maySnap ? 1 : 0;
  options.around_per_tick = defaults.aroundPerTick;
  options.around_in_all = defaults.aroundInAll;
  options.work_budget = defaults.workBudget;
  return options;
}

ft_status readSolidOptions(const ft_solid_options* given, SolidOptions& options) {
  ft_solid_options known = defaultSolidOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_solid_options", known); s != FT_OK) return s;
  }
  if (const auto s = zero(static_cast<std::uint32_t>(known.reserved), "reserved"); s != FT_OK) {
    return s;
  }
  if (const auto s = readFloor(known.floor, options.floor); s != FT_OK) return s;
  if (const auto s = readMaySnap(known.may_snap, options.maySnap); s != FT_OK) return s;
  if (const auto s = readArrays(known, options); s != FT_OK) return s;
  readNumbers(known, options);
  if (known.self == nullptr) return FT_OK;
  if (const auto s = checked(known.self); s != FT_OK) return s;
  options.self = known.self->rules;
  return FT_OK;
}

}  // namespace foretouch::c

ft_status ft_solid_options_init(ft_solid_options* options, size_t size) {
  return foretouch::c::initStruct(__func__, options, size, "ft_solid_options",
                                  foretouch::c::defaultSolidOptions());
}
