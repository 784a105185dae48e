// bench/event_readers.h: a benchmark's viewers of a service: connections that read every event and
// note its time of arrival.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// The viewers' records. Delays run from a pose's due time (its capture time) until the viewer has
/// read the whole event from its socket; microseconds.
struct ReadEvents {
  std::vector<double> stepDelaysUs;     ///< Of each event of a step, by its newest pose.
  std::vector<double> contactDelaysUs;  ///< Of each contact, by the pose that ends its own step.
  std::int64_t skippedSteps = 0;
  std::int64_t bytes = 0;
  std::int64_t ended = 0;  ///< Connections that the service ended.
};

class EventReaders {
 public:
  /// `count` viewers of the service on this machine's `port`, which one thread reads from now on.
  /// `periodUs`: time between two poses of an avatar. Errors: the service refuses a viewer.
  static Result<EventReaders> start(int count, std::uint16_t port, double periodUs);
  EventReaders(EventReaders&&) noexcept;
  EventReaders& operator=(EventReaders&&) = delete;
  ~EventReaders();

  /// Stops reading.
  [[nodiscard]] ReadEvents stop();

 private:
  struct Impl;
  explicit EventReaders(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch::tools
