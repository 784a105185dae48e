// tools/log/log_touches.h: the answers of a log's replay as touches.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/log/replay_log.h"
#include "tools/stream/stream_touches.h"
#include "tools/touches/ground.h"

namespace foretouch::tools {

/// Collects the touches of all avatars. Keeps each: about 200 bytes.
class LogTouches {
 public:
  /// `inputs` must outlive it.
  explicit LogTouches(const LogReplayInputs& inputs);

  /// Answers in the order of the log.
  void add(const AnsweredPose& answered);
  /// Call after the last answer.
  void finish();

  [[nodiscard]] const TouchCounts& counts() const { return counts_; }
  /// After finish(): the last lines of the results, one per touch, and the counts. Without touches
  /// of the ground if they are ignored.
  [[nodiscard]] std::string lines() const;

 private:
  struct Player {
    StreamTouches touches;
    GroundTest ground;
  };
  void keep(std::vector<StreamTouch>& ended);

  const LogReplayInputs& inputs_;
  std::vector<Player> players_;  // by avatar
  std::int64_t answers_ = 0;
  TouchCounts counts_;
  std::vector<StreamTouch> listed_;
};

}  // namespace foretouch::tools
