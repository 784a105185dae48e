// bench/event_readers.h: those who watch a service, as a benchmark has them: connections that
// read all that comes and note when it came.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// What viewers saw. Delays run from when a pose was due to be sent (its capture time) until the
/// whole event had been read from the viewer's socket; microseconds.
struct ReadEvents {
  std::vector<double> stepDelaysUs;     ///< Of each event of a step, by its newest pose.
  std::vector<double> contactDelaysUs;  ///< Of each contact, by the pose that ends its own step.
  std::int64_t skippedSteps = 0;
  std::int64_t bytes = 0;
  std::int64_t ended = 0;  ///< Connections that the service ended.
};

class EventReaders {
 public:
  /// `count` viewers of the service on this machine's `port`, read by one thread from here on.
  /// `periodUs` lies between two poses of an avatar. Errors: a viewer that is not let in.
  static Result<EventReaders> start(int count, std::uint16_t port, double periodUs);
  EventReaders(EventReaders&&) noexcept;
  EventReaders& operator=(EventReaders&&) = delete;
  ~EventReaders();

  /// Reads no more.
  [[nodiscard]] ReadEvents stop();

 private:
  struct Impl;
  explicit EventReaders(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch::tools
