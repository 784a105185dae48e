// tests/network/stream/stream_simulator.cpp: the simulation of streams at any length. Exit code 0:
// every promise kept; 1: one broken, and how to see it again; 2: bad use.
#include <chrono>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/network/stream/stream_attack.h"
#include "tests/network/stream/stream_simulation.h"
#include "tests/network/world_stream/crowd_simulation.h"

namespace {

using foretouch::kNumRejects;
using foretouch::kNumUndecidedReasons;
using foretouch::Verdict;
using foretouch::test::attack;
using foretouch::test::AttackRun;
using foretouch::test::AttackTally;
using foretouch::test::CrowdMutation;
using foretouch::test::CrowdRun;
using foretouch::test::CrowdTally;
using foretouch::test::Mutation;
using foretouch::test::SimulationOptions;
using foretouch::test::SimulationRun;
using foretouch::test::SimulationTally;
using foretouch::test::Standpoint;

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::uint64_t sumOf(const foretouch::RejectCounts& rejects) {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : rejects) sum += count;
  return sum;
}

/// Loss alone or with all other faults, and how much is lost.
using Rows = std::map<std::pair<bool, double>, SimulationTally>;

void printTable(const Rows& rows) {
  std::printf("%-12s %6s %8s %10s %10s %8s %8s %10s %8s %8s %8s\n", "faults", "loss", "seeds",
              "sent", "answered", "gaps", "rejects", "link-steps", "clear", "contact", "undecided");
  for (const auto& [key, tally] : rows) {
    const auto share = [&t = tally](Verdict verdict) {
      return percent(t.verdicts[static_cast<std::size_t>(verdict)], t.linkSteps());
    };
    std::printf(
        "%-12s %5.1f%% %8llu %10llu %10llu %7.2f%% %7.2f%% %10llu %7.2f%% %7.2f%% %7.2f%%\n",
        key.first ? "all" : "loss alone", 100.0 * key.second,
        static_cast<unsigned long long>(tally.seeds),
        static_cast<unsigned long long>(tally.posesSent),
        static_cast<unsigned long long>(tally.answered), percent(tally.gaps, tally.answered),
        percent(sumOf(tally.rejects), tally.posesArrived),
        static_cast<unsigned long long>(tally.linkSteps()), share(Verdict::Clear),
        share(Verdict::Contact) + share(Verdict::StartsInContact), share(Verdict::Undecided));
  }
}

void printCounts(const SimulationTally& all) {
  std::printf("\nundecided, by reason:");
  for (std::uint8_t i = 0; i < kNumUndecidedReasons; ++i) {
    if (all.reasons[i] == 0) continue;
    std::printf(" %s %llu", toString(static_cast<foretouch::UndecidedReason>(i)),
                static_cast<unsigned long long>(all.reasons[i]));
  }
  std::printf("\nrejected, by reason:");
  for (std::size_t i = 0; i < kNumRejects; ++i) {
    if (all.rejects[i] == 0) continue;
    std::printf(" %s %llu", toString(static_cast<foretouch::Reject>(i)),
                static_cast<unsigned long long>(all.rejects[i]));
  }
  std::printf(
      "\n%llu timelines; %llu altered poses kept every rule and were answered; %llu steps joined "
      "two runs of a sender without sessions\n"
      "%llu link-steps judged by the oracle, of which it gave up %llu\n",
      static_cast<unsigned long long>(all.timelines),
      static_cast<unsigned long long>(all.alteredAnswered),
      static_cast<unsigned long long>(all.unknowable), static_cast<unsigned long long>(all.judged),
      static_cast<unsigned long long>(all.unproved));
}

struct Arguments {
  std::uint64_t seeds = 1000, first = 0;
  bool isAttacked = false, isWorld = false;
  SimulationOptions options;
  CrowdMutation crowdMutation = CrowdMutation::None;
};

/// The rule of that name; `none` if there is no such rule.
template <typename Rules>
typename Rules::value_type ruleOf(const std::string& name, const Rules& rules,
                                  typename Rules::value_type none) {
  for (const auto rule : rules) {
    if (name == toString(rule)) return rule;
  }
  return none;
}

template <typename Rules>
std::string namesOf(const Rules& rules) {
  std::string names;
  for (const auto rule : rules) names += (names.empty() ? "" : ", ") + std::string(toString(rule));
  return names;
}

std::optional<Arguments> parse(int argc, char** argv, int& code) {
  Arguments a;
  double loss = 0.0;
  std::string mutation;
  CLI::App app{"Streams over a faulty network, each answer judged by an independent oracle"};
  app.add_option("--seeds", a.seeds, "How many runs")->check(CLI::PositiveNumber);
  app.add_option("--first", a.first, "The first seed");
  auto* const adversary =
      app.add_flag("--adversary", a.isAttacked,
                   "One true sender each, and an adversary that wants no pose of it answered; with "
                   "--world: somebody whose bodies carry each other and are ahead of their time");
  const auto* const lossOption =
      app.add_option("--loss", loss, "Share of messages lost; drawn by the seed if not given")
          ->check(CLI::Range(0.0, 1.0))
          ->excludes(adversary);
  app.add_flag("--world", a.isWorld,
               "A moving world: avatars, and props that they carry, of which all events are judged")
      ->excludes("--loss");
  app.add_option("--break", mutation,
                 "Break this rule on purpose, which must be found: " +
                     namesOf(foretouch::test::kMutations) +
                     "; with --world: " + namesOf(foretouch::test::kCrowdMutations))
      ->excludes(adversary);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    code = app.exit(error) == 0 ? 0 : 2;
    return std::nullopt;
  }
  if (lossOption->count() > 0) a.options.loss = loss;
  a.options.mutation = ruleOf(mutation, foretouch::test::kMutations, Mutation::None);
  a.crowdMutation = ruleOf(mutation, foretouch::test::kCrowdMutations, CrowdMutation::None);
  const bool isBroken =
      a.isWorld ? a.crowdMutation != CrowdMutation::None : a.options.mutation != Mutation::None;
  if (!mutation.empty() && !isBroken) {
    std::fprintf(stderr, "--break: there is no rule '%s' here\n", mutation.c_str());
    code = 2;
    return std::nullopt;
  }
  return a;
}

void printViolations(std::uint64_t seed, const SimulationRun& run,
                     const SimulationOptions& options) {
  for (const std::string& violation : run.violations) {
    std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), violation.c_str());
  }
  std::printf("  again: ./run simulate --first %llu --seeds 1",
              static_cast<unsigned long long>(seed));
  if (options.loss) std::printf(" --loss %.17g", *options.loss);
  if (options.mutation != Mutation::None) std::printf(" --break %s", toString(options.mutation));
  std::printf("\n");
}

const char* wordOf(Standpoint standpoint) {
  switch (standpoint) {
    case Standpoint::OtherSenders: return "other senders";
    case Standpoint::Before: return "before it starts";
    case Standpoint::SameSender: return "its own address";
  }
  return "";
}

/// Returns the exit code.
int runAttacks(const Arguments& arguments) {
  std::map<Standpoint, AttackTally> tallies;
  std::uint64_t failed = 0;
  for (std::uint64_t i = 0; i < arguments.seeds; ++i) {
    const auto seed = static_cast<unsigned long long>(arguments.first + i);
    const AttackRun run = attack(seed);
    tallies[run.standpoint].add(run.tally);
    if (run.violations.empty()) continue;
    ++failed;
    for (const std::string& violation : run.violations) {
      std::printf("seed %llu: %s\n", seed, violation.c_str());
    }
    std::printf("  again: ./run simulate --adversary --first %llu --seeds 1\n", seed);
  }
  std::printf("%-18s %8s %10s %11s %12s %10s\n", "datagrams come from", "seeds", "true poses",
              "unanswered", "most in a row", "hostile");
  for (const auto& [standpoint, tally] : tallies) {
    std::printf("%-19s %8llu %10llu %11llu %13llu %10llu\n", wordOf(standpoint),
                static_cast<unsigned long long>(tally.seeds),
                static_cast<unsigned long long>(tally.truePoses),
                static_cast<unsigned long long>(tally.unanswered),
                static_cast<unsigned long long>(tally.longestRun),
                static_cast<unsigned long long>(tally.hostile));
  }
  std::printf("%llu seeds: %llu with a broken promise\n",
              static_cast<unsigned long long>(arguments.seeds),
              static_cast<unsigned long long>(failed));
  return failed == 0 ? 0 : 1;
}

void printCrowds(const CrowdTally& all) {
  const auto count = [](std::uint64_t number) { return static_cast<unsigned long long>(number); };
  std::printf(
      "%llu events of two sides, %llu of them marked; unmarked ones: %llu of two avatars, %llu of "
      "an "
      "avatar and a prop, %llu of two props, %llu of own links, %llu of the scene; %llu of a prop "
      "that was carried\n",
      count(all.events), count(all.marked), count(all.ofAvatars), count(all.ofAvatarAndProp),
      count(all.ofProps), count(all.ofOwnLinks), count(all.ofScene), count(all.ofCarried));
  std::printf(
      "%llu spans of two links proven free (%.0f s), of which %llu were given up; %llu "
      "instants of contact judged\n",
      count(all.freeSpans), all.freeSeconds, count(all.unproved), count(all.touching));
  std::printf(
      "%.0f s of two links were told to be unknown, %.0f s answered before a change of "
      "carrier was heard; %llu refused, %llu silences, %llu gaps, %llu late changes, %llu "
      "failures\n",
      all.unknownSeconds, all.lateSeconds, count(all.refused), count(all.silences), count(all.gaps),
      count(all.lateChanges), count(all.failures));
}

/// Returns the exit code.
int runCrowds(const Arguments& arguments) {
  constexpr std::uint64_t kMostShown = 10;
  const auto start = std::chrono::steady_clock::now();
  CrowdTally all;
  std::uint64_t failed = 0;
  for (std::uint64_t i = 0; i < arguments.seeds; ++i) {
    const auto seed = static_cast<unsigned long long>(arguments.first + i);
    const CrowdRun run =
        foretouch::test::simulateCrowd(seed, arguments.crowdMutation, arguments.isAttacked);
    all.add(run.tally);
    if (run.violations.empty() || ++failed > kMostShown) continue;
    for (const std::string& violation : run.violations) {
      std::printf("seed %llu: %s\n", seed, violation.c_str());
    }
    std::printf("  again: ./run simulate --world --first %llu --seeds 1\n", seed);
  }
  printCrowds(all);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%llu seeds in %.1f s: %llu with a broken promise\n",
              static_cast<unsigned long long>(arguments.seeds), seconds,
              static_cast<unsigned long long>(failed));
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  int code = 0;
  const auto arguments = parse(argc, argv, code);
  if (!arguments) return code;
  if (arguments->isAttacked && !arguments->isWorld) return runAttacks(*arguments);
  if (arguments->isWorld) return runCrowds(*arguments);
  constexpr std::uint64_t kMostShown = 10;
  const auto start = std::chrono::steady_clock::now();
  Rows rows;
  SimulationTally all;
  std::uint64_t failed = 0;
  for (std::uint64_t i = 0; i < arguments->seeds; ++i) {
    const std::uint64_t seed = arguments->first + i;
    const SimulationRun run = simulate(seed, arguments->options);
    rows[{!run.isLossAlone, run.loss}].add(run.tally);
    all.add(run.tally);
    if (run.violations.empty()) continue;
    if (++failed <= kMostShown) printViolations(seed, run, arguments->options);
  }
  printTable(rows);
  printCounts(all);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%llu seeds in %.1f s: %llu with a broken promise\n",
              static_cast<unsigned long long>(arguments->seeds), seconds,
              static_cast<unsigned long long>(failed));
  return failed == 0 ? 0 : 1;
}
