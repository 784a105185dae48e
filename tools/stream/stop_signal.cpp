#include "tools/stream/stop_signal.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace foretouch::tools {
namespace {

std::atomic<int> noteTo{-1};
static_assert(std::atomic<int>::is_always_lock_free, "written by a signal's handler");

extern "C" void foretouchNoteStop(int) {
  const int before = errno;
  const char note = 1;
  // A full pipe has already woken wait().
  if (::write(noteTo, &note, 1) < 0) errno = before;
  errno = before;
}

}  // namespace

StopSignal::Pipe::Pipe() {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return;
  readEnd = internal::FileDescriptor(ends[0]);
  writeEnd = internal::FileDescriptor(ends[1]);
  noteTo = ends[1];
}

StopSignal::Pipe::~Pipe() {
  noteTo = -1;
}

StopSignal::StopSignal() {
  if (pipe_.writeEnd.isOpen()) signals_.emplace(&foretouchNoteStop);
}

bool StopSignal::wait(std::chrono::milliseconds most) {
  const auto until = std::chrono::steady_clock::now() + most;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until - std::chrono::steady_clock::now());
    pollfd noted{pipe_.readEnd.get(), POLLIN, 0};
    const int ready = ::poll(&noted, 1, left.count() > 0 ? static_cast<int>(left.count()) : 0);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    if (signals_) signals_->restore();
    return true;
  }
}

}  // namespace foretouch::tools
