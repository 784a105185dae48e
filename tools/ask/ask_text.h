// tools/ask/ask_text.h: an answer about a world file's world, for people and as a line of JSON.
#pragma once

#include <string>

#include "middleware/ask/ask.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// "hit", "clear", "unknown".
[[nodiscard]] const char* toString(AskVerdict verdict);

/// A line per hit, then a line per body that is not known.
[[nodiscard]] std::string answerText(const LoadedWorld& world, const WorldQuestion& question,
                                     const WorldAnswer& answer);
[[nodiscard]] std::string answerLine(const LoadedWorld& world, const WorldQuestion& question,
                                     const WorldAnswer& answer);

}  // namespace foretouch::tools
