#include "tools/interrupt.h"

#include <cstddef>

namespace foretouch::tools {
namespace {

volatile std::sig_atomic_t notedSignal = 0;

extern "C" void foretouchNoteSignal(int signal) {
  notedSignal = signal;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  notedSignal = 0;
  struct sigaction note {};
  note.sa_handler = &foretouchNoteSignal;
  note.sa_flags = SA_RESTART;
  sigemptyset(&note.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &note, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  if (notedSignal != 0) std::raise(notedSignal);
}

bool InterruptGuard::requested() const {
  return notedSignal != 0;
}

}  // namespace foretouch::tools
