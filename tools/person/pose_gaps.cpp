#include "tools/person/pose_gaps.h"

#include <algorithm>
#include <utility>

namespace foretouch::tools {

bool PoseGap::has(LinkId link) const {
  return std::binary_search(links.begin(), links.end(), link);
}

const std::vector<LinkBound>& PoseGaps::claimed(std::int64_t step, const PosedStep& around,
                                                const std::vector<LinkBound>& bounds) {
  if (!lost_.isAny()) return bounds;
  claimed_ = bounds;
  for (std::size_t i = 0; i < openSince_.size(); ++i) {
    const auto link = static_cast<LinkId>(i);
    const bool isOpen = isLost(link, step) || isLost(link, step + 1) ||
                        (around.before != nullptr && isLost(link, step - 1)) ||
                        (around.after != nullptr && isLost(link, step + 2));
    if (isOpen) {
      claimed_[i] = LinkBound{};
      if (openSince_[i] == kClosed) openSince_[i] = step;
    } else if (openSince_[i] != kClosed) {
      end(link, step);
    }
  }
  return claimed_;
}

void PoseGaps::end(LinkId link, std::int64_t pose) {
  const std::int64_t from = std::exchange(openSince_[slotOf(link)], kClosed);
  const bool isBounded = !isLost(link, from) && !isLost(link, pose);
  auto gap = std::find_if(ended_.begin(), ended_.end(), [&](const PoseGap& one) {
    return one.from == from && one.isBounded == isBounded;
  });
  if (gap == ended_.end()) gap = ended_.insert(gap, {from, pose, isBounded, {}});
  gap->links.push_back(link);
}

bool PoseGaps::isAllOpen() const {
  return std::count(openSince_.begin(), openSince_.end(), kClosed) == 0;
}

std::vector<PoseGap> PoseGaps::ended() {
  return std::exchange(ended_, {});
}

std::vector<PoseGap> PoseGaps::endAll(std::int64_t pose) {
  for (std::size_t i = 0; i < openSince_.size(); ++i) {
    if (openSince_[i] != kClosed) end(static_cast<LinkId>(i), pose);
  }
  return ended();
}

std::vector<LinkBound> PoseGaps::across(const PoseGap& gap,
                                        const std::vector<LinkBound>& bounds) const {
  std::vector<LinkBound> known(bounds.size());
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto link = static_cast<LinkId>(i);
    if (!isLost(link, gap.from) && !isLost(link, gap.to)) known[i] = bounds[i];
  }
  return known;
}

}  // namespace foretouch::tools
