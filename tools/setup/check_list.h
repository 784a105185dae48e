// tools/setup/check_list.h: what was checked and found good, doubtful or bad, as reported to people
// and programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/json_writer.h"

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

/// Aligned lines, one per check and per option to copy.
[[nodiscard]] std::string describe(const std::vector<PlacementCheck>& checks);
/// An array of objects: name, state, text and, where there is one, "try".
void writeChecks(const std::vector<PlacementCheck>& checks, JsonWriter& out);

}  // namespace foretouch::tools
