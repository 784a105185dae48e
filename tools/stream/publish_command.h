// tools/stream/publish_command.h: `foretouch publish`, and a clip written as an event log.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "tools/console.h"
#include "tools/stream/clip_publisher.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand; what it ends with goes to `exit`, which must outlive `program`.
void addPublishCommand(CLI::App& program, ExitCode& exit);

/// A clip and how it is placed, as motionRequestOf() and loadPlayedClip() take it.
struct PublishRequest {
  std::string avatarPath, motionPath, mapPath, animation, robotPath;
  std::vector<std::string> packagePaths;
  std::optional<double> rateHz;  ///< Empty: every frame.
  double motionScale = 1.0;      ///< Metres per unit of the clip.
  Placement placement;
};

/// Microseconds since the Unix epoch, now.
[[nodiscard]] std::int64_t utimeNow();

/// Writes what publishing the clip sends, stamped as if every message had arrived the instant it
/// was due, into a new event log.
[[nodiscard]] Result<PublishReport> publishToLog(const PublishRequest& request,
                                                 const PublishOptions& options,
                                                 const std::string& logPath);

}  // namespace foretouch::tools
