// bindings/python/solid_options.cpp: the keywords of a solid avatar as the library's options.
#include <array>
#include <limits>
#include <utility>

#include "bindings/python/query_options.h"
#include "bindings/python/solid.h"
#include "bindings/snake_case.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, FloorPolicy>, 2> kFloors{
    {{"lift", FloorPolicy::Lift}, {"hold", FloorPolicy::Hold}}};

/// {link: weight} over those by name.
std::vector<double> visibilityFrom(const py::object& given, const Avatar& avatar) {
  if (given.is_none()) return {};
  std::vector<double> visibility = visibilityByName(avatar);
  for (const auto& [key, value] : mapping(given, "visibility")) {
    const LinkId link = linkOf(avatar, key, "visibility");
    visibility[slotOf(link)] = number(value, "visibility['" + avatar.skeleton().name(link) + "']");
  }
  return visibility;
}

/// Links, by name or index; None: by their names.
std::vector<bool> feetFrom(const py::object& given, const Avatar& avatar) {
  if (given.is_none()) return {};
  std::vector<bool> feet(countOf(avatar.numLinks()), false);
  std::size_t place = 0;
  for (const py::object& link : items(given, "feet")) {
    feet[slotOf(linkOf(avatar, link, "feet[" + std::to_string(place++) + "]"))] = true;
  }
  return feet;
}

std::int32_t count(py::handle given, const char* what) {
  return static_cast<std::int32_t>(
      integer(given, what, 0, std::numeric_limits<std::int32_t>::max()));
}

}  // namespace

SolidOptions solidOptionsFrom(const GivenSolidOptions& given, const Avatar& avatar,
                              const Scene& scene) {
  SolidOptions options;
  options.skin = number(given.skin, "skin");
  options.tolerance = number(given.tolerance, "tolerance");
  options.catchUp = number(given.catchUp, "catch_up");
  options.visibility = visibilityFrom(given.visibility, avatar);
  options.floor = oneOf(given.floor, "floor", kFloors);
  options.feet = feetFrom(given.feet, avatar);
  options.up = point(given.up, "up");
  options.mostLift = number(given.mostLift, "most_lift");
  options.mostDeviation = number(given.mostDeviation, "most_deviation");
  options.mostLimbDeviation = number(given.mostLimbDeviation, "most_limb_deviation");
  options.patience = number(given.patience, "patience");
  options.maySnap = boolean(given.maySnap, "may_snap");
  options.snapNotice = number(given.snapNotice, "snap_notice");
  options.aroundPerTick = count(given.aroundPerTick, "around_per_tick");
  options.aroundInAll = count(given.aroundInAll, "around_in_all");
  options.placingReach = number(given.placingReach, "placing_reach");
  options.ignored = ignoredFrom(given.ignore, avatar, scene);
  options.self = rulesFrom(given.selfPairs, avatar);
  options.workBudget = static_cast<std::uint64_t>(
      integer(given.workBudget, "work_budget", 1, std::numeric_limits<std::int64_t>::max()));
  return options;
}

Error withKeywordsOfSolid(Error error) {
  error.file = snakeCase(error.file);
  if (error.file == "self") error.file = "self_pairs";
  if (error.file == "ignored") error.file = "ignore";
  if (error.file == "dt_s") error.file = "dt";
  return error;
}

}  // namespace foretouch::python
