// network/watch/viewer_connection.h: one viewer's socket and the texts still to send through it.
// Never waits.
#pragma once

#include <chrono>
#include <cstddef>

#include "network/watch/view_event.h"
#include "network/watch/viewer_backlog.h"
#include "network/wire/udpm_socket.h"

namespace foretouch {

class ViewerConnection {
 public:
  using Time = std::chrono::steady_clock::time_point;

  ViewerConnection(internal::FileDescriptor socket, std::size_t maxBacklogBytes, Time now);

  void add(const ViewEvent& event, const SharedText& whole, Time now);
  /// Sends a text before all events.
  void say(SharedText text, Time now);
  /// Sends as much as the system takes at once.
  void flush(Time now);
  /// Call when there is something to read: after its request a viewer sends nothing but its end.
  void hear();
  /// The viewer has gone, or has sent something.
  [[nodiscard]] bool isOver() const { return isOver_; }

  [[nodiscard]] int socket() const { return socket_.get(); }
  [[nodiscard]] bool isWaiting() const { return sending_ || !backlog_.isEmpty(); }
  /// When it last took something, or got something new after it had taken all.
  [[nodiscard]] Time lastMoved() const { return lastMoved_; }

 private:
  void noteIfIdle(Time now);

  internal::FileDescriptor socket_;
  ViewerBacklog backlog_;
  SharedText sending_;
  std::size_t sent_ = 0;  // of sending_
  bool isOver_ = false;
  Time lastMoved_;
};

}  // namespace foretouch
