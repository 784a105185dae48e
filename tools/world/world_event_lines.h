// tools/world/world_event_lines.h: the lines of an events file, format "foretouch-events" version 1
// (docs/formats.md, "Events of a world"). Pure: the same events give the same text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "assets/json_writer.h"
#include "tools/world/followed_world.h"
#include "tools/world/world_intervals.h"

namespace foretouch::tools {

/// The first line. Without an end: for a service, which goes on, and reports no triggers.
[[nodiscard]] std::string eventsHeader(const LoadedWorld& world, std::int64_t fromUs,
                                       std::optional<std::int64_t> untilUs);
/// The line of one contact's event. `cause`: why it ends, if LeaveCause does not say it.
[[nodiscard]] std::string eventLine(const LoadedWorld& world, const WorldEvent& event,
                                    const char* cause = nullptr);
/// A line per event, contacts and triggers in one order of time.
[[nodiscard]] std::string eventLines(const LoadedWorld& world, const FollowedStretch& stretch);
/// The last lines: one per interval, one per stay in a trigger, and the counts.
[[nodiscard]] std::string intervalLines(const LoadedWorld& world, const WorldIntervals& intervals);

/// Writes the fields of an interval or a stay into an open object, as in its line.
void writeInterval(const LoadedWorld& world, const ContactInterval& interval, JsonWriter& out);
void writeEventCounts(const char* name, const std::int64_t (&counts)[kNumEventKinds],
                      JsonWriter& out);
void writeStay(const LoadedWorld& world, const TriggerStay& stay, JsonWriter& out);

}  // namespace foretouch::tools
