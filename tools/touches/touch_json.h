// tools/touches/touch_json.h: one touch as JSON (docs/formats.md, "Touches"): the same fields in
// results, in the lines of a stream, in view documents and in a GLB.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "assets/json_writer.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

/// Fields that are not the same everywhere; JSON already.
struct TouchWords {
  std::string_view link;    ///< Its name, or its number.
  std::string_view other;   ///< For own links, the other's name or number; empty: none.
  std::string_view object;  ///< Empty: not reported.
  bool isOfStream = false;  ///< Times are those of the stream's clock, and poses have sequences.
};

/// Writes the touch's fields into an open object.
void writeTouch(const Touch& touch, const TouchWords& words, JsonWriter& out);

/// Writes only when and how it is: the times and steps of a clip, and all fields behind
/// them. `steps`: the name of theirs.
void writeTouchCourse(const Touch& touch, std::string_view steps, JsonWriter& out);

/// How the touches of results were found.
struct TouchesAsked {
  bool ofOwnLinks = false;
  bool areFollowed = false;  ///< From enter to leave: both are proven.
};

/// The last line of results: {"summary":...} with "steps", "touches", "touches_missed",
/// "touches_ground" and, if own links were asked, "touches_own"; "followed" if they are; and a line
/// break.
[[nodiscard]] std::string touchSummaryLine(const TouchCounts& counts, std::int64_t steps,
                                           const TouchesAsked& asked);

}  // namespace foretouch::tools
