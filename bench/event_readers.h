// bench/event_readers.h: a benchmark's viewers of a service: connections that read every event.
#pragma once

#include <cstdint>
#include <memory>

#include "articulated/result.h"

namespace foretouch::tools {

class EventReaders {
 public:
  /// `count` viewers of the service on this machine's `port`, which one thread reads from now on.
  /// Errors: the service refuses a viewer.
  static Result<EventReaders> start(int count, std::uint16_t port);
  EventReaders(EventReaders&&) noexcept;
  EventReaders& operator=(EventReaders&&) = delete;
  ~EventReaders();

  /// Stops reading. Returns how many connections the service ended.
  [[nodiscard]] std::int64_t stop();

 private:
  struct Impl;
  explicit EventReaders(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch::tools
