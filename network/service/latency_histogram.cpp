#include "network/service/latency_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/index.h"

namespace foretouch {
namespace {

constexpr double kNsPerUs = 1e3;

std::uint64_t wholeNs(double us) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const double ns = us * kNsPerUs;
  if (!(ns > 0.0)) return 0;
  return ns < static_cast<double>(kMost) ? static_cast<std::uint64_t>(ns) : kMost;
}

int highestBit(std::uint64_t value) {
  int bit = 0;
  while (value >>= 1) ++bit;
  return bit;
}

}  // namespace

// Below 2^kSubBits one bucket per nanosecond. Above, the highest bit selects the octave and the
// kSubBits below it the bucket within it.
std::size_t LatencyHistogram::bucketOf(std::uint64_t ns) {
  if (ns < (1u << kSubBits)) return static_cast<std::size_t>(ns);
  const int shift = highestBit(ns) - kSubBits;
  return (static_cast<std::size_t>(shift) << kSubBits) + static_cast<std::size_t>(ns >> shift);
}

std::uint64_t LatencyHistogram::lastOf(std::size_t bucket) {
  if (bucket < (2u << kSubBits)) return bucket;
  const std::size_t shift = (bucket >> kSubBits) - 1;
  const std::uint64_t start = (bucket - (shift << kSubBits)) << shift;
  return start + ((std::uint64_t{1} << shift) - 1);
}

void LatencyHistogram::record(double us) {
  const std::uint64_t ns = wholeNs(us);
  ++buckets_[bucketOf(ns)];
  ++count_;
  maxNs_ = std::max(maxNs_, ns);
  const double counted = static_cast<double>(ns) / kNsPerUs;
  sumUs_ += counted;
  const auto bound = std::lower_bound(kBoundsUs.begin(), kBoundsUs.end(), counted);
  if (bound != kBoundsUs.end()) ++within_[slotOf(bound - kBoundsUs.begin())];
}

void LatencyHistogram::clear() {
  *this = LatencyHistogram();
}

double LatencyHistogram::maxUs() const {
  return static_cast<double>(maxNs_) / kNsPerUs;
}

double LatencyHistogram::quantileUs(double share) const {
  if (count_ == 0) return 0.0;
  const double rank = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(count_));
  const auto wanted = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rank));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    seen += buckets_[i];
    if (seen >= wanted) return static_cast<double>(std::min(lastOf(i), maxNs_)) / kNsPerUs;
  }
  return maxUs();
}

std::uint64_t LatencyHistogram::countAtMost(std::size_t i) const {
  std::uint64_t counted = 0;
  for (std::size_t k = 0; k <= i; ++k) counted += within_[k];
  return counted;
}

}  // namespace foretouch
