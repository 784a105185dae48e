// tools/settings/numbered_avatars.h: avatars by the numbers that messages call them, as typed in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

struct NumberedAvatar {
  std::int32_t id = 1;
  std::string path;
};

/// A whole number from 0 to 2^31 - 1.
[[nodiscard]] Result<std::int32_t> parseAvatarId(const std::string& option,
                                                 const std::string& text);

/// A whole number of microseconds since the Unix epoch, from 0 to 2^53.
[[nodiscard]] Result<std::int64_t> parseUtime(const std::string& option, const std::string& text);

/// "FILE" or "ID=FILE", of several each with an ID of its own; one without is 1. A file whose name
/// begins with a number and an equals sign is written ./5=file.
[[nodiscard]] Result<std::vector<NumberedAvatar>> parseNumberedAvatars(
    const std::string& option, const std::vector<std::string>& texts);

}  // namespace foretouch::tools
