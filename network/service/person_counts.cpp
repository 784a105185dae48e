#include "network/service/person_counts.h"

#include "lss/index.h"

namespace foretouch {

void PersonCounter::said(const PersonMessage& message) {
  const std::lock_guard lock(mutex_);
  PersonCount& count = avatars_[message.avatar];
  count.avatar = message.avatar;
  count.broken += message.broken.size();
  times_.record(message.personUs);
  if (message.kind == StepKind::First) return;  // no step is answered
  for (const BracketVerdict verdict : message.verdicts) {
    // The others were counted step by step.
    if (!message.isOfFoundLinks() || verdict != BracketVerdict::Unclaimed)
      ++count.links[slotOf(verdict)];
  }
}

PersonCounts PersonCounter::counts() const {
  const std::lock_guard lock(mutex_);
  PersonCounts counts;
  counts.times = times_;
  for (const auto& [number, count] : avatars_) counts.avatars.push_back(count);
  return counts;
}

}  // namespace foretouch
