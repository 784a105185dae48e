#include "network/service/solid_counts.h"

#include "lss/index.h"

namespace foretouch {

void SolidCounter::shown(const SolidMessage& message, const PushesMessage* pushes) {
  const std::lock_guard lock(mutex_);
  SolidCount& count = avatars_[message.avatar];
  count.avatar = message.avatar;
  ++count.poses[slotOf(message.state)];
  if (!message.isCertified) ++count.uncertified;
  count.queries += message.counters.queries;
  count.work += message.counters.work;
  count.state = message.state;
  count.deviation = message.deviation;
  if (pushes != nullptr && !pushes->contacts.empty()) ++count.pushed;
  if (pushes != nullptr && !pushes->crushes.empty()) ++count.crushed;
  times_.record(message.solidUs);
}

SolidCounts SolidCounter::counts() const {
  const std::lock_guard lock(mutex_);
  SolidCounts counts;
  counts.times = times_;
  for (const auto& [number, count] : avatars_) counts.avatars.push_back(count);
  return counts;
}

}  // namespace foretouch
