// tools/solid_json.h: what a solid avatar shows as JSON (docs/formats.md, "Solid avatars"): the
// same fields in a file of ticks and in the lines of a stream.
#pragma once

#include <string_view>

#include "articulated/skeleton.h"
#include "assets/json_writer.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch::tools {

/// Writes it as "rotations" and "translations" of an open object, bit for bit.
void writePose(const Pose& pose, JsonWriter& out);
/// Writes them as "counters" of an open object.
void writeCounters(const SolidCounters& counters, JsonWriter& out);
/// Both names are JSON already: the link's, and that of the object or own link that it touches.
void writeSolidContact(const SolidContact& contact, std::string_view link, std::string_view touched,
                       JsonWriter& out);

}  // namespace foretouch::tools
