#include "tools/interrupt.h"

#include <cstddef>

namespace foretouch::tools {
namespace {

volatile std::sig_atomic_t notedSignal = 0;

extern "C" void foretouchNoteSignal(int signal) {
  notedSignal = signal;
}

}  // namespace

HandledSignals::HandledSignals(void (*handler)(int)) {
  struct sigaction note {};
  note.sa_handler = handler;
  note.sa_flags = SA_RESTART;
  sigemptyset(&note.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &note, nullptr);
  }
}

void HandledSignals::restore() {
  if (isRestored_) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  isRestored_ = true;
}

InterruptGuard::InterruptGuard() : signals_(&foretouchNoteSignal) {}

InterruptGuard::~InterruptGuard() {
  signals_.restore();
  const int noted = notedSignal;
  notedSignal = 0;
  if (noted != 0) std::raise(noted);
}

bool InterruptGuard::requested() const {
  return notedSignal != 0;
}

}  // namespace foretouch::tools
