// tools/settings/channel_names.h: the channels of one service and its senders.
#pragma once

#include <string>

#include "articulated/result.h"

namespace foretouch::tools {

/// The channels of network/wire/messages.h, each with the suffix.
struct ChannelNames {
  std::string skeleton, pose, contacts, solid, person, status, speaker;
  std::string body, rigidPose, events, pushes;  ///< Those of network/wire/world_messages.h.
};

/// Errors name --suffix: a name beyond kMaxChannelBytes, bytes that are not printable ASCII.
[[nodiscard]] Result<ChannelNames> channelNames(const std::string& suffix);

/// `given`; else the environment variable LCM_DEFAULT_URL, as in every LCM program; else
/// kDefaultUrl.
[[nodiscard]] std::string urlOrDefault(const std::string& given);

}  // namespace foretouch::tools
