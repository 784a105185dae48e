// tools/world/world_results.h: the lines of a world's results file, format
// "foretouch-world-results" version 1 (docs/formats.md, "Results of a world"). Pure: the same
// answers give the same text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/json_writer.h"
#include "tools/world/world_touches.h"
#include "tools/world/world_windows.h"

namespace foretouch::tools {

/// One side of a contact or touch, if the writers know no more about it.
struct NamedSide {
  BodyId body = kStillScene;
  LinkId link = 0;  ///< kEveryLink: the body as a whole.
};
/// Writes "body" and, where it has several, "link" into an open object; nothing for the scene.
void writeSide(const LoadedWorld& world, const NamedSide& side, JsonWriter& out);

/// The triangles that a body is made of, or the static scene; nothing for other bodies.
[[nodiscard]] const std::optional<Scene>& meshOf(const LoadedWorld& world, BodyId body);
/// The instant in seconds under this name, for people, and exactly.
void writeInstant(const char* name, const WorldTime& time, JsonWriter& out);
/// The same as "time" in an object with this name.
void writeInstantObject(const char* name, const WorldTime& time, JsonWriter& out);
/// An object. `isTold`: with where on it the contact is.
void writeContactSide(const LoadedWorld& world, const ContactSide& side, bool isTold,
                      JsonWriter& out);

/// Fields of a first line: which world it is, and its bodies without triggers.
void writeWorldFields(const LoadedWorld& world, JsonWriter& out);
void writeBodies(const LoadedWorld& world, JsonWriter& out);

/// The first line.
[[nodiscard]] std::string worldHeader(const LoadedWorld& world, const WindowRequest& request,
                                      const std::vector<std::int64_t>& cuts);
/// A window's line.
[[nodiscard]] std::string windowLine(const LoadedWorld& world, const WorldStep& step);
/// One contact as an object: as in that line.
void writeWorldContact(const LoadedWorld& world, const WorldContact& contact, JsonWriter& out);
/// Writes the fields of a touch into an open object, as in its line.
void writeWorldTouch(const LoadedWorld& world, const TouchSides& sides, const WorldTouch& touch,
                     JsonWriter& out);
/// The last lines: one per touch, and the counts.
[[nodiscard]] std::string touchLines(const LoadedWorld& world, const WorldTouches& touches,
                                     std::int64_t windows);

}  // namespace foretouch::tools
