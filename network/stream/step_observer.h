// network/stream/step_observer.h: the place of whoever looks at a service while it answers. The
// service asks once a pose whether somebody does, and goes on.
#pragma once

#include <cstddef>

#include "network/stream/avatar_stream.h"
#include "network/wire/messages.h"

namespace foretouch {

class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Whether the next step of the service's avatar `avatar` (an index) is looked at. From any
  /// thread; an atomic load.
  [[nodiscard]] virtual bool wants(std::size_t avatar) const noexcept = 0;
  /// One thread at a time for an avatar, after its answer was sent. What is needed later must be
  /// copied. Never waits: it holds up the avatar's next answer.
  virtual void observe(std::size_t avatar, const StreamStep& step,
                       const ContactsMessage& answer) noexcept = 0;
};

}  // namespace foretouch
