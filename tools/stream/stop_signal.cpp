#include "tools/stream/stop_signal.h"

#include <atomic>
#include <cerrno>
#include <cstddef>
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

StopSignal::StopSignal() {
  if (::pipe2(pipe_.data(), O_CLOEXEC | O_NONBLOCK) != 0) pipe_ = {-1, -1};
  noteTo = pipe_[1];
  struct sigaction note {};
  note.sa_handler = &foretouchNoteStop;
  note.sa_flags = SA_RESTART;
  sigemptyset(&note.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    // Without a pipe, signals end the program as usual.
    if (before_[i].sa_handler != SIG_IGN && pipe_[1] >= 0) sigaction(kSignals[i], &note, nullptr);
  }
}

StopSignal::~StopSignal() {
  restore();
  noteTo = -1;
  for (const int end : pipe_) {
    if (end >= 0) ::close(end);
  }
}

void StopSignal::restore() {
  if (isRestored_) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  isRestored_ = true;
}

bool StopSignal::wait(std::chrono::milliseconds most) {
  const auto until = std::chrono::steady_clock::now() + most;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until - std::chrono::steady_clock::now());
    pollfd noted{pipe_[0], POLLIN, 0};
    const int ready = ::poll(&noted, 1, left.count() > 0 ? static_cast<int>(left.count()) : 0);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    restore();
    return true;
  }
}

}  // namespace foretouch::tools
