// tools/settings/stream_settings.h: how to treat a stream of poses, live or from its log.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "network/stream/stream_policy.h"
#include "network/world_stream/world_setup.h"
#include "tools/settings/settings.h"
#include "tools/settings/solid_settings.h"

namespace foretouch::tools {

/// A solid avatar for each avatar of a stream. Each setting is legal by itself.
struct StreamSolidRequest {
  SolidRequest solid;
  bool stopsItself = false;      ///< Own links stop each other, too.
  std::int64_t budgetUs = 2000;  ///< Time per pose, converted to SolidOptions::workBudget.
  /// For a moving world: names or patterns of the avatars that are solid among all that moves.
  std::vector<std::string> worldBodies{};
};

/// The settings of addSolidSettings(), --solid-self and --solid-budget-us. `request` outlives the
/// settings.
void addStreamSolidSettings(Settings& settings, StreamSolidRequest& request);

/// --world-solid. `request` outlives the settings, which have --solid and --world.
void addWorldSolidSetting(Settings& settings, StreamSolidRequest& request);

/// The ending of all channels' names. `suffix` outlives the settings.
Setting& addSuffixSetting(Settings& settings, std::string& suffix);

/// --key: a file with the key that messages are signed with. `path` outlives the settings.
Setting& addKeySetting(Settings& settings, std::string& path, const char* help);

/// How long an avatar's sender must be silent before another one may speak for it (us). Live only:
/// a log holds only the messages of the senders that spoke.
Setting& addTakeoverSetting(Settings& settings, std::int64_t& takeoverUs);

/// --max-step, --confirmations and --unmatched-at-rest. `policy` outlives the settings.
void addStreamSettings(Settings& settings, StreamPolicy& policy);

/// --world-wait and --world-silent: how long a moving world waits for a body, and what silence
/// means. `policy` outlives the settings.
void addWorldStreamSettings(Settings& settings, WorldPolicy& policy);

}  // namespace foretouch::tools
