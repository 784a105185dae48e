// network/service/latency_histogram.h: latencies, in memory that does not grow. A bucket's width is
// a fixed fraction of its value, as in HdrHistogram: 32 per octave of nanoseconds. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace foretouch {

class LatencyHistogram {
 public:
  /// A reported quantile q of values whose quantile is v (microseconds): v - kResolutionUs <= q <=
  /// v * (1 + kRelativeError).
  static constexpr double kRelativeError = 1.0 / 32.0;
  /// Rounds values down to whole nanoseconds.
  static constexpr double kResolutionUs = 1e-3;

  /// Negative values and NaN count as 0, values above some 292 years as that.
  void record(double us);
  void clear();

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] double sumUs() const { return sumUs_; }
  [[nodiscard]] double maxUs() const;
  /// The least value that at least `share` (0 to 1) of all values do not exceed (nearest rank); 0
  /// if there are none.
  [[nodiscard]] double quantileUs(double share) const;

  /// Upper bounds (us) with exact counts, so that histograms of several services can be added.
  static constexpr std::array<double, 17> kBoundsUs{
      5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6};
  /// How many values were at most kBoundsUs[i].
  [[nodiscard]] std::uint64_t countAtMost(std::size_t i) const;

 private:
  static constexpr int kSubBits = 5;  // 2^5 buckets per octave: kRelativeError
  static constexpr std::size_t kNumBuckets = (64 - kSubBits) << kSubBits;
  static std::size_t bucketOf(std::uint64_t ns);
  static std::uint64_t lastOf(std::size_t bucket);

  std::array<std::uint64_t, kNumBuckets> buckets_{};
  std::array<std::uint64_t, kBoundsUs.size()> within_{};
  std::uint64_t count_ = 0;
  std::uint64_t maxNs_ = 0;
  double sumUs_ = 0.0;
};

}  // namespace foretouch
