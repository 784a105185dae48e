#include "network/service/latency_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

/// By sorting: the nearest rank.
double quantileOf(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

TEST(LatencyHistogram, QuantilesAreThoseOfSortingWithinTheStatedError) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> logarithm(std::log(1e-3), std::log(1e9));
  for (int trial = 0; trial < 50; ++trial) {
    LatencyHistogram histogram;
    std::vector<double> values;
    for (int i = 0; i < 400; ++i) {
      // From a nanosecond to 17 minutes; in every other trial, within a factor of two.
      double value = std::exp(logarithm(random));
      if (trial % 2 == 1) value = 100.0 + value / 1e7;
      values.push_back(value);
      histogram.record(value);
    }
    for (const double share : {0.0, 0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
      const double exact = quantileOf(values, share);
      const double told = histogram.quantileUs(share);
      EXPECT_GE(told, exact - LatencyHistogram::kResolutionUs) << trial << " " << share;
      EXPECT_LE(told, exact * (1.0 + LatencyHistogram::kRelativeError)) << trial << " " << share;
    }
    EXPECT_NEAR(histogram.maxUs(), quantileOf(values, 1.0), LatencyHistogram::kResolutionUs);
  }
}

TEST(LatencyHistogram, CountsExactlyAgainstItsBounds) {
  LatencyHistogram histogram;
  std::mt19937 random(6);
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(static_cast<double>(random() % 3'000'000));
  for (const double bound : LatencyHistogram::kBoundsUs) values.push_back(bound);
  double sum = 0.0;
  for (const double value : values) {
    histogram.record(value);
    sum += value;
  }
  for (std::size_t i = 0; i < LatencyHistogram::kBoundsUs.size(); ++i) {
    const auto expected = std::count_if(values.begin(), values.end(), [&](double value) {
      return value <= LatencyHistogram::kBoundsUs[i];
    });
    EXPECT_EQ(histogram.countAtMost(i), static_cast<std::uint64_t>(expected)) << i;
  }
  EXPECT_EQ(histogram.count(), values.size());
  EXPECT_NEAR(histogram.sumUs(), sum, 1e-6 * sum);
}

TEST(LatencyHistogram, TakesAnyNumber) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.quantileUs(0.5), 0.0);
  EXPECT_EQ(histogram.maxUs(), 0.0);
  for (const double value :
       {-1.0, -1e300, std::nan(""), 0.0, -std::numeric_limits<double>::infinity()}) {
    histogram.record(value);
  }
  EXPECT_EQ(histogram.quantileUs(1.0), 0.0);
  EXPECT_EQ(histogram.sumUs(), 0.0);
  for (const double value :
       {1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max()}) {
    histogram.record(value);
  }
  EXPECT_EQ(histogram.count(), 8u);
  EXPECT_GT(histogram.maxUs(), 9e15);
  EXPECT_EQ(histogram.quantileUs(1.0), histogram.maxUs());
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0u);
  EXPECT_EQ(histogram.countAtMost(LatencyHistogram::kBoundsUs.size() - 1), 0u);
}

// Every nanosecond around every power of two: buckets neither overlap nor leave anything out.
TEST(LatencyHistogram, BucketsMeet) {
  for (int bit = 0; bit < 62; ++bit) {
    for (int off = -2; off <= 2; ++off) {
      const double ns = std::ldexp(1.0, bit) + off;
      if (ns < 1.0 || ns > 4e15) continue;  // beyond: doubles of microseconds are too coarse
      LatencyHistogram histogram;
      histogram.record(ns / 1e3);
      histogram.record(9e12);  // so that the maximum is not what is told
      const double told = histogram.quantileUs(0.5) * 1e3;
      EXPECT_GE(told, ns - 1.5) << bit << " " << off;
      EXPECT_LE(told, ns * (1.0 + LatencyHistogram::kRelativeError)) << bit << " " << off;
    }
  }
}

}  // namespace
}  // namespace foretouch
