// bench/stream_load.h: senders of poses beside a running service, and the answers: matches every
// answer with its pose by session and sequence, on one clock.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/moving_load.h"
#include "network/wire/messages.h"
#include "network/wire/wire.h"

namespace foretouch::tools {

struct LoadSender {
  std::int32_t avatar = 0;
  double rateHz = 0.0;
};

/// The poses that every sender repeats: forth and back, so that the motion never jumps.
struct LoadTrack {
  SkeletonMessage skeleton;
  std::vector<PoseMessage> poses;  ///< At least two; sequence and stamps are filled in.
};

struct LoadRequest {
  UdpmUrl url;
  std::vector<LoadSender> senders;
  double durationS = 10.0;
  double garbageShare = 0.0;  ///< Invalid datagrams, or wrong messages, per pose.
  std::uint64_t seed = 1;     ///< The seed of the garbage.
  MovingRequest moving;       ///< With balls the avatars stand apart (placeInCrowd()).
};

struct LoadAnswer {
  float roundTripUs = 0.0F;  ///< From before the system gets the pose to the receipt of its answer.
  float serviceUs = 0.0F;    ///< By the service: from receiving the pose to sending the answer.
  float queryUs = 0.0F;      ///< The part of that which the query takes.
  std::int32_t sender = 0;   ///< Index in LoadRequest::senders.
};

struct LoadOutcome {
  std::int64_t sent = 0, garbage = 0;
  std::int64_t sendFailures = 0;  ///< Poses that the system did not take.
  std::int64_t lateSends = 0;     ///< Poses sent more than a period after they were due.
  std::int64_t unanswered = 0;    ///< Poses without an answer: lost in either direction.
  std::int64_t repeated = 0;      ///< Repeated answers.
  std::int64_t gaps = 0;          ///< Answers marked AcrossGap.
  std::int64_t ownDrops = 0;      ///< Datagrams that the system dropped before this side read them.
  StatusMessage status;           ///< The service's last one.
  std::vector<LoadAnswer> answers;
  std::int64_t propMessages = 0;  ///< For all balls.
  MovingAnswers world;
};

/// Sends from the calling thread for `durationS` and receives in another; waits for the last
/// answers up to a second. Calls `everySecond` about once a second while it runs.
[[nodiscard]] Result<LoadOutcome> runLoad(const LoadTrack& track, const LoadRequest& request,
                                          const std::function<void()>& everySecond = {});

}  // namespace foretouch::tools
