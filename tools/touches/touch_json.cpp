#include "tools/touches/touch_json.h"

#include <array>
#include <utility>

#include "tools/contact_json.h"
#include "tools/json_line.h"

namespace foretouch::tools {
namespace {

void writeRange(std::string_view name, const std::pair<std::int64_t, std::int64_t>& range,
                JsonWriter& out) {
  const std::array<std::int64_t, 2> ends{range.first, range.second};
  out.list(name, ends, [&](std::int64_t end) { out.value(end); });
}

/// What does not depend on the clock.
void writeNature(const Touch& touch, JsonWriter& out) {
  out.field("begins", touch.beginsInside ? "inside" : "contact");
  out.field("ends", touch.isOpen ? "open" : "left");
  out.field("contacts", touch.contacts);
  out.field("separation", touch.separation);
  if (touch.startsAtAPose) writePenetration(touch.penetration, out);
  if (touch.isGround) out.field("ground", true);
  if (touch.isMissed) out.field("missed", true);
}

}  // namespace

void writeTouchCourse(const Touch& touch, std::string_view steps, JsonWriter& out) {
  out.field("begin", touch.beginS);
  out.field("end", touch.endS);
  writeRange(steps, {touch.firstStep, touch.lastStep}, out);
  writeNature(touch, out);
}

void writeTouch(const Touch& touch, const TouchWords& words, JsonWriter& out) {
  out.rawField("link", words.link);
  if (!words.other.empty()) out.rawField("other", words.other);
  if (!words.object.empty()) out.rawField("object", words.object);
  if (!words.isOfStream) return writeTouchCourse(touch, "steps", out);
  writeRange("utime", {touch.beginUs, touch.endUs}, out);
  writeRange("sequence", {touch.firstStep, touch.lastStep}, out);
  writeNature(touch, out);
}

std::string touchSummaryLine(const TouchCounts& counts, std::int64_t steps,
                             const TouchesAsked& asked) {
  return objectLine("summary", [&](JsonWriter& out) {
    out.field("steps", steps);
    out.field("touches", counts.touches);
    out.field("touches_missed", counts.missed);
    out.field("touches_ground", counts.ground);
    if (asked.ofOwnLinks) out.field("touches_own", counts.own);
    if (asked.areFollowed) out.field("followed", true);
  });
}

}  // namespace foretouch::tools
