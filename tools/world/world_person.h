// tools/world/world_person.h: what the persons of a world surely touched and may have touched, of
// the scene, of themselves and of each other. Seconds of the file's clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "middleware/world/world.h"
#include "tools/person/bracket_joiner.h"
#include "tools/person/person_touches.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// `touch.other`: a link of `other`, or an own one.
struct WorldPersonTouch {
  BodyId body = 0;
  std::optional<BodyId> other;
  PersonTouch touch;
};

struct WorldPersons {
  std::vector<WorldPersonTouch> touches;  ///< By begin.
  PersonCounts counts;                    ///< Of links and the scene, and of links of two bodies.
  std::vector<std::string> notes;         ///< Sentences.
  std::int64_t persons = 0;
  BodyId worstBody = 0;  ///< Whose clip breaks its bounds by most, if any does.
};

/// Of every body that the file has bounds of, from one instant of the world to another: each of its
/// steps with the scene and itself, and with every body of which something is claimed, too: a
/// person, one whose motion the file calls exact, or one that stands. Nothing if there is none.
/// Errors: those of the bounds' files.
[[nodiscard]] Result<std::optional<WorldPersons>> personsOf(const LoadedWorld& world,
                                                            std::int64_t fromUs, std::int64_t toUs);

/// Lines of the results: one per touch, and one with the counts.
[[nodiscard]] std::string personLines(const LoadedWorld& world, const WorldPersons& persons);
/// For people.
[[nodiscard]] std::string personText(const LoadedWorld& world, const WorldPersons& persons);

}  // namespace foretouch::tools
