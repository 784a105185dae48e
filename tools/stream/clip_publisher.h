// tools/stream/clip_publisher.h: sends a clip like a live sender: on time, with its skeleton every
// second.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "articulated/result.h"
#include "network/wire/codec.h"
#include "tools/settings/channel_names.h"
#include "tools/stream/clip_sender.h"

namespace foretouch::tools {

/// A sender's time.
class Pace {
 public:
  virtual ~Pace() = default;
  /// Waits until this long after the start. Returns how late it is (us, >= 0), or nothing if the
  /// sender must stop.
  virtual std::optional<std::int64_t> waitUntil(std::int64_t elapsedUs) = 0;
  /// Microseconds since the Unix epoch, now.
  [[nodiscard]] virtual std::int64_t utimeUs() const = 0;
};

/// The machine's time, by absolute deadlines of its monotonic clock, so that waits do not add up.
class LivePace : public Pace {
 public:
  /// Calls `isStopped` at least after every wait, even if a signal cut it short.
  explicit LivePace(std::function<bool()> isStopped);
  std::optional<std::int64_t> waitUntil(std::int64_t elapsedUs) override;
  [[nodiscard]] std::int64_t utimeUs() const override;

 private:
  std::function<bool()> isStopped_;
  std::int64_t startNs_;
};

/// Time that passes only in waits: nothing is ever late.
class RecordedPace : public Pace {
 public:
  explicit RecordedPace(std::int64_t startUtimeUs) : startUs_(startUtimeUs) {}
  std::optional<std::int64_t> waitUntil(std::int64_t elapsedUs) override;
  [[nodiscard]] std::int64_t utimeUs() const override { return startUs_ + elapsedUs_; }

 private:
  std::int64_t startUs_, elapsedUs_ = 0;
};

struct PublishOptions {
  double speed = 1.0;  ///< Clip time per time of the pace; 0: without waiting.
  bool loop = false;   ///< Repeats from the start, as a new session, until stopped.
  ChannelNames channels;
  SenderOptions sender;
};

struct PublishReport {
  std::int64_t session = 0;     ///< The first one.
  std::int64_t poses = 0;       ///< Sent, or tried.
  std::int64_t skeletons = 0;   ///< The same.
  std::int64_t states = 0;      ///< The same: for props of a world.
  std::int64_t failures = 0;    ///< Messages that the sink lost.
  std::int64_t late = 0;        ///< Poses sent more than kLateUs after their time.
  std::int64_t mostLateUs = 0;  ///< Of all poses, the latest's.
  static constexpr std::int64_t kLateUs = 1000;
};

/// Takes a message at a time of the pace; false if it was lost. An error ends the sending.
using MessageSink =
    std::function<Result<bool>(const std::string& channel, ByteView payload, std::int64_t utimeUs)>;

/// Sends the clip once, or in a loop. `placed` as for ClipSender.
[[nodiscard]] Result<PublishReport> publishClip(const PlacedClip& placed,
                                                const StepSelection& steps,
                                                const PublishOptions& options, Pace& pace,
                                                const MessageSink& sink);

}  // namespace foretouch::tools
