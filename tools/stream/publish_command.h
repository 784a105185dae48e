// tools/stream/publish_command.h: `foretouch publish`, and a clip written as an event log.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/command_line.h"
#include "tools/stream/clip_publisher.h"

namespace foretouch::tools {

[[nodiscard]] Command publishCommand();

/// Microseconds since the Unix epoch, now.
[[nodiscard]] std::int64_t utimeNow();

/// Writes the messages of publishing the clip into a new event log, stamped as if every message had
/// arrived the instant it was due.
[[nodiscard]] Result<PublishReport> publishToLog(const ClipRequest& request,
                                                 const PublishOptions& options,
                                                 const std::string& logPath);

}  // namespace foretouch::tools
