// tools/world/world_person.h: what the persons of a world surely touched and may have touched, in
// the scene, on themselves and on each other. Seconds on the file's clock.
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
  PersonCounts counts;                    ///< Counts links with the scene, and links of two bodies.
  std::vector<std::string> notes;         ///< Sentences.
  std::int64_t persons = 0;
  BodyId worstBody = 0;  ///< The body whose clip breaks its bounds by most, if any does.
};

/// For every body that the file has bounds for, from one instant of the world to another: each of
/// its steps with the scene and itself, and with every body about which something is claimed: a
/// person, one whose motion the file calls exact, or one that stands. Nothing if there is none.
/// Errors: those of the bounds' files.
[[nodiscard]] Result<std::optional<WorldPersons>> personsOf(const LoadedWorld& world,
                                                            std::int64_t fromUs, std::int64_t toUs);

/// Lines of the results: one per touch, and one with the counts.
[[nodiscard]] std::string personLines(const LoadedWorld& world, const WorldPersons& persons);
/// The touches as text for people.
[[nodiscard]] std::string personText(const LoadedWorld& world, const WorldPersons& persons);

}  // namespace foretouch::tools
