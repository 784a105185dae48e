#include "middleware/world/work_shares.h"

#include <algorithm>

#include "lss/index.h"

namespace foretouch::internal {

void WorkShares::begin(std::size_t numBodies) {
  pairs_.clear();
  countOf_.assign(numBodies, 0);
}

void WorkShares::add(BodyId a, BodyId b) {
  pairs_.push_back({a, b});
  ++countOf_[slotOf(a)];
  if (b >= 0 && b != a) ++countOf_[slotOf(b)];
}

double WorkShares::weightOf(std::size_t pair) const {
  const auto [a, b] = pairs_[pair];
  if (a < 0) return 0.0;
  const std::uint32_t ofB = b >= 0 ? countOf_[slotOf(b)] : 0;
  return 1.0 / static_cast<double>(std::max(countOf_[slotOf(a)], ofB));
}

std::uint64_t WorkShares::partOf(std::uint64_t total, std::uint64_t most, double part) const {
  const double wanted = part * static_cast<double>(total);
  return wanted < static_cast<double>(most) ? static_cast<std::uint64_t>(wanted) : most;
}

void WorkShares::share(std::uint64_t total, std::uint64_t most) {
  shares_.assign(pairs_.size(), most);
  if (total == kUnlimited) return;
  double sum = 0.0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) sum += weightOf(i);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    shares_[i] = partOf(total, most, weightOf(i) / sum);
  }
}

void WorkShares::shareAgain(std::uint64_t total, std::uint64_t most,
                            std::vector<std::size_t>& pairs) {
  double sum = 0.0;
  for (const std::size_t pair : pairs) sum += weightOf(pair);
  const auto hasNoMore = [&](std::size_t pair) {
    const std::uint64_t more = partOf(total, most, weightOf(pair) / sum);
    if (more < kLeastShare || more / 2 < shares_[pair]) return true;
    shares_[pair] = more;
    return false;
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), hasNoMore), pairs.end());
}

}  // namespace foretouch::internal
