// tests/world_fuzz/world_fuzz.cpp: random worlds, judged, at any length. Exit code 0: nothing is
// wrong; 1: something is, and a world file that shows it; 2: bad use.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/world_fuzz/fuzz_run.h"

namespace {

using foretouch::test::drawFuzzWorld;
using foretouch::test::FuzzTally;
using foretouch::test::kFuzzFaults;
using foretouch::test::runFuzzWorld;

constexpr int kMostShown = 10;

struct Campaign {
  std::uint64_t first = 0, seeds = 2000;
  int threads = 1;
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  FuzzTally all;
  int shown = 0;

  void work() {
    for (;;) {
      const std::uint64_t i = next++;
      if (i >= seeds) return;
      const FuzzTally tally = runFuzzWorld(first + i);
      const std::lock_guard lock(mutex);
      all.add(tally);
      if (tally.wrong() > 0 && ++shown <= kMostShown) show(first + i, tally);
    }
  }

  static void show(std::uint64_t seed, const FuzzTally& tally) {
    const std::string file = "fuzz-world-" + std::to_string(seed) + ".toml";
    std::ofstream(file) << textOf(drawFuzzWorld(seed), seed);
    std::printf("seed %llu: %s\n  its world: %s; again: ./run world-fuzz --first %llu --seeds 1\n",
                static_cast<unsigned long long>(seed), tally.first.c_str(), file.c_str(),
                static_cast<unsigned long long>(seed));
    std::fflush(stdout);
  }

  void print() const {
    const auto row = [](const char* title, std::uint64_t count) {
      std::printf("%-26s %12llu\n", title, static_cast<unsigned long long>(count));
    };
    row("worlds", all.worlds);
    row("instants of two, judged", all.pairInstants);
    row("contacts", all.contacts);
    row("events of triggers", all.triggerEvents);
    row("unresolved", all.unresolved);
    for (std::size_t i = 0; i < kFuzzFaults.size(); ++i) row(kFuzzFaults[i], all.faults[i]);
  }
};

}  // namespace

int main(int argc, char** argv) {
  Campaign campaign;
  CLI::App app{"Random worlds through file, program's reader, library and C, judged"};
  app.add_option("--seeds", campaign.seeds, "How many worlds")->check(CLI::PositiveNumber);
  app.add_option("--first", campaign.first, "The first seed");
  app.add_option("--threads", campaign.threads, "At a time")->check(CLI::Range(1, 256));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> threads;
  for (int i = 1; i < campaign.threads; ++i) threads.emplace_back([&] { campaign.work(); });
  campaign.work();
  for (std::thread& thread : threads) thread.join();
  campaign.print();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::printf("%-26s %12.1f\n", "seconds", took.count());
  return campaign.all.wrong() > 0 ? 1 : 0;
}
