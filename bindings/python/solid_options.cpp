// bindings/python/solid_options.cpp: the keywords of a solid avatar as the library's options.
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string>
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

GivenSolidOptions solidKeywords(const py::kwargs& given) {
  using Given = GivenSolidOptions;
  static constexpr std::pair<const char*, py::object Given::*> kKeywords[] = {
      {"skin", &Given::skin},
      {"tolerance", &Given::tolerance},
      {"catch_up", &Given::catchUp},
      {"visibility", &Given::visibility},
      {"floor", &Given::floor},
      {"feet", &Given::feet},
      {"up", &Given::up},
      {"most_lift", &Given::mostLift},
      {"most_deviation", &Given::mostDeviation},
      {"most_limb_deviation", &Given::mostLimbDeviation},
      {"patience", &Given::patience},
      {"may_snap", &Given::maySnap},
      {"snap_notice", &Given::snapNotice},
      {"around_per_tick", &Given::aroundPerTick},
      {"around_in_all", &Given::aroundInAll},
      {"placing_reach", &Given::placingReach},
      {"ignore", &Given::ignore},
      {"self_pairs", &Given::selfPairs},
      {"work_budget", &Given::workBudget}};
  GivenSolidOptions options;
  for (const auto& [key, value] : given) {
    const std::string name = py::str(key);
    const auto* const found =
        std::find_if(std::begin(kKeywords), std::end(kKeywords),
                     [&](const auto& keyword) { return keyword.first == name; });
    if (found == std::end(kKeywords)) {
      throw py::type_error("add() got an unexpected keyword argument '" + name + "'");
    }
    options.*found->second = py::reinterpret_borrow<py::object>(value);
  }
  return options;
}

SolidOptions solidOptionsFrom(const GivenSolidOptions& given, const Avatar& avatar,
                              const Scene& scene) {
  SolidOptions options;
  const auto set = [](auto& option, const py::object& keyword, const auto& read) {
    if (keyword) option = read(keyword);
  };
  const auto numberOf = [](const char* name) {
    return [name](const py::object& keyword) { return number(keyword, name); };
  };
  const auto countOfTries = [](const char* name) {
    return [name](const py::object& keyword) { return count(keyword, name); };
  };
  using Object = const py::object&;
  set(options.skin, given.skin, numberOf("skin"));
  set(options.tolerance, given.tolerance, numberOf("tolerance"));
  set(options.catchUp, given.catchUp, numberOf("catch_up"));
  set(options.visibility, given.visibility, [&](Object v) { return visibilityFrom(v, avatar); });
  set(options.floor, given.floor, [](Object v) { return oneOf(v, "floor", kFloors); });
  set(options.feet, given.feet, [&](Object v) { return feetFrom(v, avatar); });
  set(options.up, given.up, [](Object v) { return point(v, "up"); });
  set(options.mostLift, given.mostLift, numberOf("most_lift"));
  set(options.mostDeviation, given.mostDeviation, numberOf("most_deviation"));
  set(options.mostLimbDeviation, given.mostLimbDeviation, numberOf("most_limb_deviation"));
  set(options.patience, given.patience, numberOf("patience"));
  set(options.maySnap, given.maySnap, [](Object v) { return boolean(v, "may_snap"); });
  set(options.snapNotice, given.snapNotice, numberOf("snap_notice"));
  set(options.aroundPerTick, given.aroundPerTick, countOfTries("around_per_tick"));
  set(options.aroundInAll, given.aroundInAll, countOfTries("around_in_all"));
  set(options.placingReach, given.placingReach, numberOf("placing_reach"));
  set(options.ignored, given.ignore, [&](Object v) { return ignoredFrom(v, avatar, scene); });
  set(options.self, given.selfPairs, [&](Object v) { return rulesFrom(v, avatar); });
  set(options.workBudget, given.workBudget, [](Object v) {
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    return static_cast<std::uint64_t>(integer(v, "work_budget", 1, kMost));
  });
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
