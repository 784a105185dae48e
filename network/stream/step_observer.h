// network/stream/step_observer.h: a hook to watch a service while it answers. The service asks once
// per pose whether anybody watches. Not installed.
#pragma once

#include <cstddef>

#include "network/stream/avatar_stream.h"
#include "network/wire/messages.h"

namespace foretouch {

/// What a solid avatar shows at the end of a step. Its joints are the avatar's.
struct ShownStep {
  const Pose& from;  ///< What it showed before.
  const SolidMessage& answer;
};

class PersonStream;

class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Whether to observe the next step of the service's avatar `avatar` (an index). From any thread;
  /// an atomic load.
  [[nodiscard]] virtual bool wants(std::size_t avatar) const noexcept = 0;
  /// One thread at a time per avatar, after its answer was sent. `shown`: null if the avatar is not
  /// solid; `person`: what it says now; null if it is not asked. Must copy what it needs later, and
  /// must never wait: it delays the avatar's next answer.
  virtual void observe(std::size_t avatar, const StreamStep& step, const ContactsMessage& answer,
                       const ShownStep* shown, const PersonStream* person) noexcept = 0;
};

}  // namespace foretouch
