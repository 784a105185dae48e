// network/watch/audience.h: the viewers: a bounded number of connections. One thread sends them
// events and waits for none of them. More or slower viewers cost no other thread anything. Not
// installed.
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
  std::size_t maxBacklogBytes = kMaxBacklogBytes;  ///< Per viewer.
  std::chrono::milliseconds collectEvery{10};      ///< While anybody watches.
  std::chrono::milliseconds restEvery{1000};       ///< While nobody watches.
  std::chrono::milliseconds heartbeatAfter{2000};  ///< Without events: sends a comment line.
  std::chrono::milliseconds stalledAfter{
      10'000};  ///< Drops a viewer that takes nothing for so long.
};

class Audience {
 public:
  /// Starts its thread. Errors: the system refuses a thread or a descriptor.
  static Result<Audience> start(std::unique_ptr<EventSource> source,
                                const AudienceOptions& options);
  Audience(Audience&&) noexcept;
  Audience& operator=(Audience&&) noexcept;
  ~Audience();  ///< Closes all connections.

 private:
  struct Impl;

 public:
  /// A place in the audience, for as long as this object lives.
  class Seat {
   public:
    Seat(Seat&& other) noexcept;
    Seat& operator=(Seat&&) = delete;
    ~Seat();
    /// Gives the connection to the audience, and the seat to the connection; false, without a
    /// change, if memory has run out. Only while the audience lives.
    [[nodiscard]] bool take(int socket) noexcept;

   private:
    friend class Audience;
    explicit Seat(Impl* audience) : audience_(audience) {}
    Impl* audience_ = nullptr;
  };
  /// None if all are taken. From any thread.
  [[nodiscard]] std::optional<Seat> claimSeat();
  /// Seats that are taken.
  [[nodiscard]] std::size_t size() const;

 private:
  explicit Audience(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
