// tools/setup/placement_check.h: what is right and what is wrong about unit, axis and place, as the
// engine finds it: the ticks of `foretouch view` and of `foretouch setup`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/json_writer.h"
#include "tools/setup/standing.h"

namespace foretouch::tools {

enum class CheckState : std::uint8_t {
  Good,
  Doubt,  ///< Legal, and likely not meant: a person should look.
  Bad,    ///< An answer from here says nothing of use.
};

/// "good", "doubt", "bad".
[[nodiscard]] const char* toString(CheckState state);

struct PlacementCheck {
  std::string name;  ///< "start", "floor": short, stable.
  CheckState state = CheckState::Good;
  std::string text;     ///< One sentence.
  std::string tryThis;  ///< An option to copy; empty: none.
};

/// Start, floor, level and path. `better`: where the body could stand; nullptr if nobody looked, or
/// if there is no such place.
[[nodiscard]] std::vector<PlacementCheck> checksOf(const Walker& walker, const Standing& standing,
                                                   const Standing* better);

/// True if nothing is wrong; doubts may be left.
[[nodiscard]] bool areUsable(const std::vector<PlacementCheck>& checks);

/// True if a better place should be looked for.
[[nodiscard]] bool isWrong(const Standing& standing);

/// "X,Y,Z,YAW", as --place takes it.
[[nodiscard]] std::string textOf(const Placement& place);

/// Aligned lines, one per check and per option to copy.
[[nodiscard]] std::string describe(const std::vector<PlacementCheck>& checks);
/// An array of objects: name, state, text and, where there is one, "try".
void writeChecks(const std::vector<PlacementCheck>& checks, JsonWriter& out);

}  // namespace foretouch::tools
