// tests/oracle/leaf_campaign.h: exact leaf tests judged by the oracles, query by query.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/oracle/leaf_families.h"
#include "tests/reference/leaf.h"

namespace foretouch::test {

/// The results of one family.
struct LeafTally {
  std::uint64_t queries = 0;
  std::uint64_t trueHits = 0;
  std::uint64_t falseNegatives = 0, falsePositives = 0;
  /// The first contact outside [toiLow, toiHigh], or an interval that is empty or too wide.
  std::uint64_t wrongTimes = 0;
  std::uint64_t thrown = 0;      ///< Exceptions, which no query may throw.
  std::uint64_t nearHits = 0;    ///< Rigid: hits only within the product's stated band.
  std::uint64_t unproved = 0;    ///< Rigid: the oracle ran out of budget; shows nothing.
  std::uint64_t hardTruths = 0;  ///< Truths that needed rationals, or thirty-four digits.
  std::array<std::uint64_t, 2> stages{};
  std::vector<std::string> failures;  ///< The first few, each with its query.

  static constexpr std::size_t kKeptFailures = 5;
  void fail(std::uint64_t& count, const std::string& text);
  void add(const LeafTally& other);
  [[nodiscard]] std::uint64_t wrong() const {
    return falseNegatives + falsePositives + wrongTimes + thrown;
  }
  [[nodiscard]] double hitShare() const {
    return queries == 0 ? 0.0 : static_cast<double>(trueHits) / static_cast<double>(queries);
  }
};

struct LeafJob {
  std::uint64_t seed = 1, queries = 0;  ///< Queries of each family.
  int threads = 1;
};

/// One tally per family, in the order of linearFamilies().
std::vector<LeafTally> judgeLinear(const LeafJob& job);

/// Judges an answer to one query.
void judgeAnswer(const oracle::LinearQuery& query, const LeafAnswer& answer,
                 const std::string& name, LeafTally& tally);
/// Judges the product's answer.
void judgeLinear(const oracle::LinearQuery& query, const std::string& name, LeafTally& tally);

/// Splits [0, queries) between threads; `judge` judges one query of one family.
using JudgeOne = void (*)(std::size_t family, std::uint64_t seed, std::uint64_t index,
                          LeafTally& tally);
std::vector<LeafTally> judgeFamilies(std::size_t families, const LeafJob& job, JudgeOne judge);

/// A table, one row per family, and the failures.
std::string tableOf(const std::vector<std::string>& names, const std::vector<LeafTally>& tallies);

}  // namespace foretouch::test
