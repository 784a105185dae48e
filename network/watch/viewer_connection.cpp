#include "network/watch/viewer_connection.h"

#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <utility>

namespace foretouch {
namespace {

/// A small buffer: text that a slow viewer has not read yet is old, and in this buffer it cannot be
/// merged.
constexpr int kSendBufferBytes = 128 << 10;

}  // namespace

ViewerConnection::ViewerConnection(internal::FileDescriptor socket, std::size_t maxBacklogBytes,
                                   Time now)
    : socket_(std::move(socket)), backlog_(maxBacklogBytes), lastMoved_(now) {
  const int yes = 1;
  ::setsockopt(socket_.get(), SOL_SOCKET, SO_SNDBUF, &kSendBufferBytes, sizeof kSendBufferBytes);
  ::setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

void ViewerConnection::noteIfIdle(Time now) {
  if (!isWaiting()) lastMoved_ = now;
}

void ViewerConnection::add(const ViewEvent& event, const SharedText& whole, Time now) {
  noteIfIdle(now);
  backlog_.add(event, whole);
}

void ViewerConnection::say(SharedText text, Time now) {
  noteIfIdle(now);
  if (!sending_) sending_ = std::move(text);
}

void ViewerConnection::flush(Time now) {
  for (;;) {
    if (!sending_) {
      sending_ = backlog_.next();
      sent_ = 0;
      if (!sending_) return;
    }
    const ssize_t taken = ::send(socket_.get(), sending_->data() + sent_, sending_->size() - sent_,
                                 MSG_DONTWAIT | MSG_NOSIGNAL);
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) {
      isOver_ = isOver_ || (errno != EAGAIN && errno != ENOBUFS);
      return;
    }
    lastMoved_ = now;
    sent_ += static_cast<std::size_t>(taken);
    if (sent_ == sending_->size()) {
      sending_.reset();
      sent_ = 0;
    }
  }
}

void ViewerConnection::hear() {
  char said = 0;
  const ssize_t got = ::recv(socket_.get(), &said, 1, MSG_DONTWAIT | MSG_PEEK);
  isOver_ = isOver_ || got >= 0 || (errno != EAGAIN && errno != EINTR);
}

}  // namespace foretouch
