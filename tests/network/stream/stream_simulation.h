// tests/network/stream/stream_simulation.h: senders, a faulty network and solvers in one thread;
// one seed decides everything. Compares every answer with the truth: the full motion of the body,
// with all the poses and all the joints that the receiver never saw, by the independent oracle.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "network/wire/messages.h"

namespace foretouch::test {

/// A rule broken on purpose, which the simulation must detect.
enum class Mutation {
  None,
  GapsAreSteps,      ///< Ignores lost poses.
  InvalidIsValid,    ///< Uses values of invalid joints.
  StaleIsTracked,    ///< ... of joints that are neither tracked nor inferred.
  MissingIsAtRest,   ///< Joints that are not listed keep their rest values.
  LackingIsAtRest,   ///< Joints that the sender does not have keep theirs.
  RestartsAreSteps,  ///< Another session continues where the one before ended.
  CopiesAreNew,      ///< Answers both copies of a repeated pose.
  ContactsAreLate,   ///< By a hundredth of the step.
  LastIsForgotten,   ///< Reports the last link as clear.
};
inline constexpr std::array<Mutation, 9> kMutations{
    Mutation::GapsAreSteps,    Mutation::InvalidIsValid,  Mutation::StaleIsTracked,
    Mutation::MissingIsAtRest, Mutation::LackingIsAtRest, Mutation::RestartsAreSteps,
    Mutation::CopiesAreNew,    Mutation::ContactsAreLate, Mutation::LastIsForgotten};
[[nodiscard]] const char* toString(Mutation mutation);

struct SimulationOptions {
  std::optional<double> loss;  ///< For every seed; else each draws one of kLosses.
  Mutation mutation = Mutation::None;
};

/// Shares of lost messages.
inline constexpr std::array<double, 5> kLosses{0.0, 0.001, 0.01, 0.1, 0.5};

struct SimulationTally {
  std::uint64_t seeds = 0;
  std::uint64_t posesSent = 0, posesArrived = 0;  ///< The latter include copies and altered ones.
  std::uint64_t answered = 0;
  std::uint64_t gaps = 0, timelines = 0;
  std::uint64_t alteredAnswered = 0;  ///< Changed bytes that still meet every rule.
  /// Steps between two runs of a sender without sessions that continues the old run's numbers.
  std::uint64_t unknowable = 0;
  RejectCounts rejects{};                                     ///< Of bytes, poses and skeletons.
  std::array<std::uint64_t, 4> verdicts{};                    ///< Of link-steps.
  std::array<std::uint64_t, kNumUndecidedReasons> reasons{};  ///< Of undecided ones.
  std::uint64_t judged = 0;    ///< Link-steps that the oracle examined.
  std::uint64_t unproved = 0;  ///< It gave up.

  void add(const SimulationTally& other);
  [[nodiscard]] std::uint64_t linkSteps() const;
};

struct SimulationRun {
  double loss = 0.0;
  bool isLossAlone = false;  ///< No other fault.
  SimulationTally tally;
  std::vector<std::string> violations;  ///< At most some; each names the seed.
};

[[nodiscard]] SimulationRun simulate(std::uint64_t seed, const SimulationOptions& options = {});

}  // namespace foretouch::test
