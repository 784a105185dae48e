#include "tools/setup/placement_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "tools/inputs/played_clip.h"
#include "tools/settings/plain_figures.h"

namespace foretouch::tools {
namespace {

/// Feet that are farther from the floor than a step is high.
constexpr double kStepHigh = 0.3;
/// A clip's first pose stands this much higher or lower than the clip at most (m).
constexpr double kFirstRise = 0.04;

std::string linksIn(const Walker& walker, const std::vector<Inside>& inside) {
  const Skeleton& skeleton = walker.body().avatar.skeleton();
  // The trunk first: a person would name it.
  const auto trunk = std::find_if(inside.begin(), inside.end(),
                                  [&](const Inside& i) { return walker.isTrunk(i.link); });
  const Inside& first = trunk == inside.end() ? inside.front() : *trunk;
  std::string text = inQuotes(skeleton.name(first.link));
  if (inside.size() > 1) {
    text += fmt::format(" and {} more link{}", inside.size() - 1, inside.size() > 2 ? "s" : "");
  }
  return text;
}

std::string objectsOf(const Walker& walker, const std::vector<Inside>& inside) {
  std::vector<std::string> names;
  for (const Inside& i : inside) {
    const std::string& name =
        walker.level().scene().objectNames()[static_cast<std::size_t>(i.object)];
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return firstOf(names);
}

/// A T-pose, or a body in the air: the height of the place does not come from it.
std::string firstPoseInWords(const Standing& standing) {
  if (std::abs(standing.firstRise) <= kFirstRise) return "";
  return fmt::format(
      "the first pose is {} m {} than the clip stands: a T-pose (--skip-t-pose leaves "
      "it out), or in the air",
      plainFigures(std::abs(standing.firstRise)), standing.firstRise > 0 ? "higher" : "lower");
}

PlacementCheck startCheck(const Walker& walker, const Standing& standing) {
  const std::vector<Inside>& inside = standing.insideAtFirst;
  const std::string odd = firstPoseInWords(standing);
  if (inside.empty()) {
    return {"start", odd.empty() ? CheckState::Good : CheckState::Doubt,
            odd.empty() ? "the first pose is free" : odd, ""};
  }
  const bool isTrunkIn = std::any_of(inside.begin(), inside.end(),
                                     [&](const Inside& i) { return walker.isTrunk(i.link); });
  return {"start", isTrunkIn ? CheckState::Bad : CheckState::Doubt,
          fmt::format("at the first pose, {} start{} inside {}{}", linksIn(walker, inside),
                      inside.size() > 1 ? "" : "s", objectsOf(walker, inside),
                      odd.empty() ? "" : "; " + odd),
          ""};
}

/// `knowsFloor`: the scene has one.
PlacementCheck floorCheck(const Standing& standing, bool knowsFloor) {
  if (standing.floorAbove) {
    return {"floor", *standing.floorAbove > kStandsWithin ? CheckState::Bad : CheckState::Doubt,
            "its lowest point is " + plainFigures(*standing.floorAbove) + " m below the floor", ""};
  }
  if (!standing.floorBelow) {
    return {"floor", knowsFloor ? CheckState::Bad : CheckState::Doubt,
            "no floor is below it: straight down there is nothing", ""};
  }
  const double gap = *standing.floorBelow;
  const CheckState state = gap <= kStandsWithin              ? CheckState::Good
                           : gap <= kStepHigh || !knowsFloor ? CheckState::Doubt
                                                             : CheckState::Bad;
  return {"floor", state, "its lowest point is " + plainFigures(gap) + " m above the floor", ""};
}

/// What is wrong with a level in which no body of this height could walk; empty: nothing.
std::string whyNoFloor(const Walker& walker) {
  const WalkableFloor* const floor = walker.floor();
  if (floor == nullptr) return walker.floorDoubt();
  if (floor->hasMain()) return "";
  const double height = floor->room().height;
  if (floor->lowHeadroom()) {
    return fmt::format(
        "the body is taller than the room: it is {} m high, and the scene's "
        "floors have about {} m above them; is a unit wrong (--scene-scale, "
        "--clip-scale)?",
        plainFigures(height), plainFigures(*floor->lowHeadroom()));
  }
  std::string text =
      "the scene has no floor on which a body of " + plainFigures(height) + " m could walk";
  if (floor->lookedWithin()) {
    text += fmt::format(" within {:.3g} m of the place; --place X,Y,Z,YAW looks elsewhere",
                        *floor->lookedWithin());
  }
  if (floor->hasAny()) text += ", but a roof or a thing (setup --on OBJECT stands on it)";
  return text;
}

/// True if no floor to walk on is known: what is below the body says little.
bool isWithoutFloor(const Walker& walker) {
  const WalkableFloor* const floor = walker.floor();
  return floor == nullptr || (!floor->hasMain() && !floor->lowHeadroom());
}

/// What happens along the clip in some poses: its trunk inside things, no floor below it.
std::string pathInWords(const Standing& standing) {
  std::string text;
  const auto add = [&](const char* what, std::size_t count) {
    if (count == 0) return;
    if (!text.empty()) text += ", and ";
    text += fmt::format("{} in {} of {} poses", what, count, standing.poses);
  };
  add("its trunk is inside the scene's surfaces", standing.trunkInside);
  add("nothing is below it", standing.overVoid);
  if (standing.offFloor > standing.overVoid) add("it leaves the floor", standing.offFloor);
  return text;
}

/// `knowsFloor`: there is one that could be left.
PlacementCheck pathCheck(Standing standing, bool knowsFloor) {
  if (!knowsFloor) standing.offFloor = standing.overVoid = 0;
  if (std::string text = pathInWords(standing); !text.empty()) {
    const std::size_t most = std::max({standing.trunkInside, standing.overVoid, standing.offFloor});
    return {"path", 2 * most > standing.poses ? CheckState::Bad : CheckState::Doubt,
            text + "; foretouch view shows where", ""};
  }
  return {
      "path", CheckState::Good,
      standing.poses == 1
          ? std::string("its trunk is free in its one pose")
          : fmt::format("its trunk stays free in all {} poses that were looked at", standing.poses),
      ""};
}

/// The scene's origin, where a body can be there; empty: it cannot.
std::string originAdvice(const Walker& walker) {
  const Standing there = standingAt(walker, originPlace(walker));
  const bool isBad =
      there.isOutside ||
      !areUsable({startCheck(walker, there), floorCheck(there, true), pathCheck(there, false)});
  return isBad || !there.standsFree() ? "" : "--place " + textOf(there.place);
}

PlacementCheck onMainFloor(const Walker& walker) {
  const WalkableFloor& floor = *walker.floor();
  if (floor.showsBack()) {
    return {"level", CheckState::Doubt,
            "it stands on surfaces that show it their backs: turned over, or the outside of a room",
            ""};
  }
  if (floor.isOnTop()) {
    return {"level", CheckState::Doubt,
            "nothing of the scene is above what it stands on, and much is below: is it a roof?",
            originAdvice(walker)};
  }
  if (floor.isSmall()) {
    return {"level", CheckState::Doubt,
            "what it stands on has " + plainFigures(floor.area()) +
                " square metres with room for it, and the scene has no larger floor: is it a "
                "thing?",
            originAdvice(walker)};
  }
  return {"level", CheckState::Good,
          "it stands on the scene's own floor: " + plainFigures(floor.area()) +
              " square metres with room for it",
          ""};
}

/// Whether the body is where a person would stand.
PlacementCheck levelCheck(const Walker& walker, const Standing& standing) {
  const std::string why = whyNoFloor(walker);
  if (standing.isOutside && why.empty()) {
    return {"level", CheckState::Bad, "it stands outside the scene", ""};
  }
  if (!why.empty() && !standing.isOnAsked) {
    return {"level", isWithoutFloor(walker) ? CheckState::Doubt : CheckState::Bad, why, ""};
  }
  if (standing.isOnAsked && standing.floor != FloorKind::Main) {
    return {"level", CheckState::Doubt,
            "it stands on " + inQuotes(walker.on()) +
                ", as you said, and nobody reaches that from the scene's own floor",
            ""};
  }
  switch (standing.floor) {
    case FloorKind::Main: return onMainFloor(walker);
    case FloorKind::Over:
      return {"level", CheckState::Doubt,
              "what it stands on lies over other floor and cannot be reached from it: a roof, a "
              "beam, furniture",
              ""};
    case FloorKind::Apart:
      return {"level", CheckState::Doubt,
              "what it stands on cannot be reached from the scene's own floor", ""};
    case FloorKind::None: break;
  }
  return {"level", CheckState::Doubt,
          "nobody could walk where it stands: an edge, a slope, or too little room", ""};
}

/// Users would not move a body by less.
bool isSamePlace(const Placement& a, const Placement& b) {
  constexpr double kWorthAMove = 5e-3;  // metres
  return (a.origin - b.origin).norm() < kWorthAMove && a.yawDeg == b.yawDeg;
}

}  // namespace

bool areUsable(const std::vector<PlacementCheck>& checks) {
  return std::none_of(checks.begin(), checks.end(),
                      [](const PlacementCheck& check) { return check.state == CheckState::Bad; });
}

bool isWrong(const Standing& standing) {
  return !standing.standsFree() || standing.isOutside || !standing.isOnFloor() ||
         standing.trunkInside + standing.overVoid + standing.offFloor > 0;
}

std::string textOf(const Placement& place) {
  // Adding zero turns -0 into 0.
  return fmt::format("{:g},{:g},{:g},{:g}", place.origin.x() + 0.0, place.origin.y() + 0.0,
                     place.origin.z() + 0.0, place.yawDeg + 0.0);
}

std::vector<PlacementCheck> checksOf(const Walker& walker, const Standing& standing,
                                     const Standing* better) {
  const bool knowsFloor = !isWithoutFloor(walker);
  std::vector<PlacementCheck> checks = {
      startCheck(walker, standing), floorCheck(standing, knowsFloor), levelCheck(walker, standing),
      pathCheck(standing, knowsFloor)};
  if (better == nullptr || isSamePlace(better->place, standing.place)) return checks;
  // Once: all of them are about the same place.
  const auto first = std::find_if(checks.begin(), checks.end(), [](const PlacementCheck& check) {
    return check.state != CheckState::Good;
  });
  if (first != checks.end() && first->tryThis.empty())
    first->tryThis = "--place " + textOf(better->place);
  return checks;
}

}  // namespace foretouch::tools
