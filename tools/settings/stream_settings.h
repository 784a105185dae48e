// tools/settings/stream_settings.h: how to treat a stream of poses, live or from its log.
#pragma once

#include <string>

#include "network/stream/stream_policy.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// The ending of all four channels' names. `suffix` outlives the settings.
Setting& addSuffixSetting(Settings& settings, std::string& suffix);

/// --max-step, --confirmations and --unmatched-at-rest. `policy` outlives the settings.
void addStreamSettings(Settings& settings, StreamPolicy& policy);

}  // namespace foretouch::tools
