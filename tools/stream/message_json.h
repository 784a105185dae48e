// tools/stream/message_json.h: what all messages of a stream have in common as JSON.
#pragma once

#include <cstdint>

namespace foretouch::tools {

/// Whether a line has the fields that no replay repeats: stamps, and the time that it took.
enum class Stamps : std::uint8_t { With, Without };

}  // namespace foretouch::tools
