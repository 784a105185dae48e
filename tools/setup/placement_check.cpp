#include "tools/setup/placement_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

/// More than half of what the chest sees shows its back: the body is in a solid or behind a wall.
constexpr double kMostlyBacks = 0.5;
/// Feet that are farther from the floor than a step is high.
constexpr double kStepHigh = 0.3;
/// A clip's usual pose stands this much higher or lower than its first at most (m).
constexpr double kUsualRise = 0.04;

std::string linksIn(const Walker& walker, const std::vector<Inside>& inside) {
  const Skeleton& skeleton = walker.body().avatar.skeleton();
  // The trunk first: it is what a person would name.
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

PlacementCheck startCheck(const Walker& walker, const Standing& standing) {
  if (standing.inside.empty()) {
    return {"start", CheckState::Good, "the first pose is free", ""};
  }
  const bool isTrunkIn =
      std::any_of(standing.inside.begin(), standing.inside.end(),
                  [&](const Inside& inside) { return walker.isTrunk(inside.link); });
  return {"start", isTrunkIn ? CheckState::Bad : CheckState::Doubt,
          fmt::format("at the first pose, {} start{} inside {}", linksIn(walker, standing.inside),
                      standing.inside.size() > 1 ? "" : "s", objectsOf(walker, standing.inside)),
          ""};
}

PlacementCheck floorCheck(const Standing& standing) {
  if (standing.floorAbove) {
    return {"floor", *standing.floorAbove > kStandsWithin ? CheckState::Bad : CheckState::Doubt,
            fmt::format("its lowest point is {:.3g} m below the floor", *standing.floorAbove), ""};
  }
  if (!standing.floorBelow) {
    return {"floor", CheckState::Bad, "no floor is below it: straight down there is nothing", ""};
  }
  const double gap = *standing.floorBelow;
  const CheckState state = gap <= kStandsWithin ? CheckState::Good
                           : gap <= kStepHigh   ? CheckState::Doubt
                                                : CheckState::Bad;
  return {"floor", state, fmt::format("its lowest point is {:.3g} m above the floor", gap), ""};
}

/// Whether the body is in the level's free space at all.
PlacementCheck levelCheck(const Standing& standing) {
  if (standing.isOutside) {
    return {"level", CheckState::Bad, "it stands outside the scene", ""};
  }
  if (standing.seen > 0 && standing.backs > kMostlyBacks) {
    return {"level", CheckState::Bad,
            fmt::format("most surfaces around it ({:.0f} %) show it their backs: it is inside a "
                        "solid, or behind the level's walls",
                        100.0 * standing.backs),
            ""};
  }
  if (standing.seen == 0) {
    return {"level", CheckState::Doubt, "no surface is in sight of it along any axis", ""};
  }
  return {"level", CheckState::Good, "it stands in the scene's free space", ""};
}

PlacementCheck pathCheck(const Standing& standing) {
  const auto of = [&](std::size_t count) {
    return fmt::format("in {} of {} poses", count, standing.poses);
  };
  if (2 * standing.trunkInside > standing.poses) {
    return {"path", CheckState::Bad,
            "its trunk is inside the scene's surfaces " + of(standing.trunkInside), ""};
  }
  if (2 * standing.overVoid > standing.poses) {
    return {"path", CheckState::Bad, "no floor is below it " + of(standing.overVoid), ""};
  }
  if (standing.trunkInside + standing.overVoid > 0) {
    std::string text = standing.trunkInside == 0
                           ? ""
                           : "its trunk is inside the scene's surfaces " + of(standing.trunkInside);
    if (standing.overVoid > 0) {
      text += (text.empty() ? "no floor is below it " : ", and no floor is below it ") +
              of(standing.overVoid);
    }
    return {"path", CheckState::Doubt, text, ""};
  }
  if (std::abs(standing.usualRise) > kUsualRise) {
    Placement usual = standing.place;
    usual.origin.y() -= standing.usualRise;
    return {
        "path", CheckState::Doubt,
        fmt::format("in most poses its lowest point is {:.3g} m {} than in the first one, which "
                    "may be a T-pose or in the air; this would put those on the floor",
                    std::abs(standing.usualRise), standing.usualRise > 0 ? "higher" : "lower"),
        "--place " + textOf(usual)};
  }
  return {
      "path", CheckState::Good,
      standing.poses == 1
          ? std::string("its trunk is free in its one pose")
          : fmt::format("its trunk stays free in all {} poses that were looked at", standing.poses),
      ""};
}

}  // namespace

const char* toString(CheckState state) {
  switch (state) {
    case CheckState::Good: return "good";
    case CheckState::Doubt: return "doubt";
    case CheckState::Bad: return "bad";
  }
  return "?";
}

bool areUsable(const std::vector<PlacementCheck>& checks) {
  return std::none_of(checks.begin(), checks.end(),
                      [](const PlacementCheck& check) { return check.state == CheckState::Bad; });
}

bool isWrong(const Standing& standing) {
  return !standing.standsFree() || standing.isOutside || standing.backs > kMostlyBacks ||
         standing.trunkInside + standing.overVoid > 0;
}

std::string textOf(const Placement& place) {
  // Adding zero turns -0 into 0.
  return fmt::format("{:g},{:g},{:g},{:g}", place.origin.x() + 0.0, place.origin.y() + 0.0,
                     place.origin.z() + 0.0, place.yawDeg + 0.0);
}

std::vector<PlacementCheck> checksOf(const Walker& walker, const Standing& standing,
                                     const Standing* better) {
  std::vector<PlacementCheck> checks = {startCheck(walker, standing), floorCheck(standing),
                                        levelCheck(standing), pathCheck(standing)};
  if (better == nullptr) return checks;
  // Once: all of them are about the same place.
  const auto first = std::find_if(checks.begin(), checks.end(), [](const PlacementCheck& check) {
    return check.state != CheckState::Good;
  });
  if (first != checks.end() && first->tryThis.empty())
    first->tryThis = "--place " + textOf(better->place);
  return checks;
}

std::string describe(const std::vector<PlacementCheck>& checks) {
  std::string text;
  for (const PlacementCheck& check : checks) {
    const char* const mark = check.state == CheckState::Good    ? "ok"
                             : check.state == CheckState::Doubt ? "?"
                                                                : "WRONG";
    text += fmt::format("  {:<6}{:<14}{}\n", mark, check.name, check.text);
    if (!check.tryThis.empty()) text += fmt::format("  {:<20}try {}\n", "", check.tryThis);
  }
  return text;
}

void writeChecks(const std::vector<PlacementCheck>& checks, JsonWriter& out) {
  out.beginArray();
  for (const PlacementCheck& check : checks) {
    out.beginObject();
    out.field("name", check.name);
    out.field("state", toString(check.state));
    out.field("text", check.text);
    if (!check.tryThis.empty()) out.field("try", check.tryThis);
    out.endObject();
  }
  out.endArray();
}

}  // namespace foretouch::tools
