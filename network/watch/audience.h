// network/watch/audience.h: those who watch: a bounded number of connections, served events by one
// thread that waits for none of them. However many watch, and however slowly, nothing but that
// thread has more to do.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>

#include "articulated/result.h"
#include "network/watch/view_event.h"
#include "network/watch/viewer_backlog.h"

namespace foretouch {

inline constexpr std::size_t kMaxViewers = 64;

struct AudienceOptions {
  std::size_t maxViewers = kMaxViewers;
  std::size_t maxBacklogBytes = kMaxBacklogBytes;  ///< Of each viewer.
  std::chrono::milliseconds collectEvery{10};      ///< While somebody watches.
  std::chrono::milliseconds restEvery{1000};       ///< While nobody does.
  std::chrono::milliseconds heartbeatAfter{2000};  ///< Without anything to send: a comment line.
  std::chrono::milliseconds stalledAfter{
      10'000};  ///< A viewer that takes nothing for so long goes.
};

class Audience {
 public:
  /// Runs from here on. Errors: a thread or a descriptor that the system does not give.
  static Result<Audience> start(std::unique_ptr<EventSource> source,
                                const AudienceOptions& options);
  Audience(Audience&&) noexcept;
  Audience& operator=(Audience&&) noexcept;
  ~Audience();  ///< Closes all connections.

 private:
  struct Impl;

 public:
  /// A place among those who watch, kept while it lives.
  class Seat {
   public:
    Seat(Seat&& other) noexcept;
    Seat& operator=(Seat&&) = delete;
    ~Seat();
    /// The connection is the audience's from now on, and the place the connection's; false, and
    /// nothing has changed, where memory has run out. Within the audience's life.
    [[nodiscard]] bool take(int socket) noexcept;

   private:
    friend class Audience;
    explicit Seat(Impl* audience) : audience_(audience) {}
    Impl* audience_ = nullptr;
  };
  /// None where all are taken. From any thread.
  [[nodiscard]] std::optional<Seat> claimSeat();
  /// Seats that are taken.
  [[nodiscard]] std::size_t size() const;

 private:
  explicit Audience(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
