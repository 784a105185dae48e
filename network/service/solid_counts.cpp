#include "network/service/solid_counts.h"

#include "lss/index.h"

namespace foretouch {

void SolidCounter::shown(std::size_t avatar, const SolidMessage& message) {
  const std::lock_guard lock(mutex_);
  if (avatar >= avatars_.size()) {
    avatars_.resize(avatar + 1);
    hasShown_.resize(avatar + 1, false);
  }
  hasShown_[avatar] = true;
  SolidCount& count = avatars_[avatar];
  count.avatar = message.avatar;
  ++count.poses[slotOf(message.state)];
  if (!message.isCertified) ++count.uncertified;
  count.queries += message.counters.queries;
  count.work += message.counters.work;
  count.state = message.state;
  count.deviation = message.deviation;
  times_.record(message.solidUs);
}

SolidCounts SolidCounter::counts() const {
  const std::lock_guard lock(mutex_);
  SolidCounts counts;
  counts.times = times_;
  for (std::size_t i = 0; i < avatars_.size(); ++i) {
    if (hasShown_[i]) counts.avatars.push_back(avatars_[i]);
  }
  return counts;
}

}  // namespace foretouch
