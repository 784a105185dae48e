// tools/settings/numbered_avatars.h: avatars by their numbers in messages, as typed in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

struct NumberedAvatar {
  std::int32_t id = 1;
  std::string path;
  /// Solid among all that moves in a world, and so not by itself; no user types that in here.
  bool isSolidInWorld = false;
};

/// A whole number from 0 to 2^31 - 1.
[[nodiscard]] Result<std::int32_t> parseAvatarId(const std::string& option,
                                                 const std::string& text);

/// A whole number of microseconds since the Unix epoch, from 0 to 2^53.
[[nodiscard]] Result<std::int64_t> parseUtime(const std::string& option, const std::string& text);

/// "FILE" or "ID=FILE"; several need one ID each; a single one without ID is 1. Write ./5=file for
/// a file whose name begins with a number and an equals sign.
[[nodiscard]] Result<std::vector<NumberedAvatar>> parseNumberedAvatars(
    const std::string& option, const std::vector<std::string>& texts);

}  // namespace foretouch::tools
