// network/watch/viewer_connection.h: one viewer's socket and what is still to be sent through it.
// Waits for nothing.
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

  ViewerConnection(Descriptor socket, std::size_t maxBacklogBytes, Time now);

  void add(const ViewEvent& event, const SharedText& whole, Time now);
  /// A text that goes out before all events.
  void say(SharedText text, Time now);
  /// Sends what the system takes at once.
  void flush(Time now);
  /// To be called where there is something to read: a viewer says nothing after its request but
  /// that it goes.
  void hear();
  /// It has gone, or has said something.
  [[nodiscard]] bool isOver() const { return isOver_; }

  [[nodiscard]] int socket() const { return socket_.get(); }
  [[nodiscard]] bool isWaiting() const { return sending_ || !backlog_.isEmpty(); }
  /// When it last took something, or was given something after it had taken all.
  [[nodiscard]] Time lastMoved() const { return lastMoved_; }

 private:
  void noteIfIdle(Time now);

  Descriptor socket_;
  ViewerBacklog backlog_;
  SharedText sending_;
  std::size_t sent_ = 0;  // of sending_
  bool isOver_ = false;
  Time lastMoved_;
};

}  // namespace foretouch
