// tests/oracle/oracle_sweep.cpp: the sweep at any length: clips x scenes x placements x rates x
// tolerances. Exit code 0: every promise kept; 1: one broken; 2: bad use or nothing to do.
#include <chrono>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "lss/simd.h"
#include "tests/oracle/sweep.h"
#include "tests/oracle/sweep_placement.h"
#include "tests/support/shared_data.h"

namespace {

using foretouch::test::SweepClip;
using foretouch::test::SweepOptions;
using foretouch::test::SweepScene;
using foretouch::test::SweepTally;

struct Arguments {
  std::vector<std::string> clips{"all"};
  std::vector<std::string> scenes;
  std::vector<double> rates{5, 10, 30};
  std::vector<double> tolerances{1e-3, 1e-5};
  int maxSteps = 200, threads = 2, placements = 2;
  std::string data, culler = "flat", leaves = "advancement", backtracking = "lanes", simd,
                    fidelity = "link";
  double budgetS = 0.0, deadlineUs = 0.0;
  std::uint64_t workBudget = 0;
  bool everyClip = false, self = false;
};

std::vector<std::string> simdNames() {
  std::vector<std::string> names;
  for (const foretouch::Simd simd : foretouch::supportedSimd()) names.emplace_back(toString(simd));
  return names;
}

std::optional<Arguments> parse(int argc, char** argv, int& code) {
  Arguments a;
  a.data = foretouch::test::sharedDataFolder().value_or("");
  CLI::App app{"Judges the answers of real clips in real scenes by an independent oracle"};
  app.add_option("--clips", a.clips,
                 "BVH files, by name in DATA/mocap or by path; or 'all'. Animated models, by path, "
                 "are judged at "
                 "exact fidelity")
      ->delimiter(',');
  app.add_option("--scenes", a.scenes, "Scenes by name; all if none is given")->delimiter(',');
  app.add_flag("--self", a.self,
               "Judge whether own links touch each other; without --scenes, with nothing around");
  app.add_option("--rates", a.rates, "Pose rates in Hz")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--tolerances", a.tolerances, "Tolerances in metres")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--placements", a.placements, "Places a clip and scene")
      ->check(CLI::PositiveNumber);
  app.add_option("--max-steps", a.maxSteps, "Steps a combination")->check(CLI::PositiveNumber);
  app.add_option("--threads", a.threads, "Worker threads")->check(CLI::Range(1, 256));
  app.add_option("--culler", a.culler, "flat or point")->check(CLI::IsMember({"flat", "point"}));
  app.add_option("--leaves", a.leaves, "advancement or cubics, of models")
      ->check(CLI::IsMember({"advancement", "cubics"}));
  app.add_option("--backtracking", a.backtracking, "lanes or scalar")
      ->check(CLI::IsMember({"lanes", "scalar"}));
  app.add_option("--fidelity", a.fidelity, "limb, avatar or link; models: skinned, else exact")
      ->check(CLI::IsMember({"limb", "avatar", "link", "skinned"}));
  app.add_option("--simd", a.simd, "Vector instructions of the lanes; the widest if not given")
      ->check(CLI::IsMember(simdNames()));
  app.add_option("--data", a.data, "Folder with mocap/ and scenes/");
  app.add_option("--work-budget", a.workBudget, "Of each query, in evaluations in lanes; 0: none");
  app.add_option("--deadline-us", a.deadlineUs, "Of each query, by the clock; 0: none")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--budget-s", a.budgetS, "Stop after so many seconds; 0: never");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    code = app.exit(error) == 0 ? 0 : 2;
    return std::nullopt;
  }
  a.everyClip = a.clips == std::vector<std::string>{"all"};
  if (a.everyClip) a.clips = foretouch::test::clipPaths(a.data);
  if (a.scenes.empty() && !a.self) a.scenes = foretouch::test::sceneNames();
  return a;
}

/// Nothing where a clip that was asked for by name cannot be swept.
std::optional<std::vector<SweepClip>> loadClips(const Arguments& a) {
  std::vector<SweepClip> clips;
  for (const std::string& name : a.clips) {
    const bool isPath = name.find('/') != std::string::npos;
    auto clip = foretouch::test::loadClip(isPath ? name : a.data + "/mocap/" + name);
    if (clip) {
      clips.push_back(std::move(clip).value());
    } else {
      std::cerr << "left out: " << describe(clip.error()) << "\n";
      if (!a.everyClip) return std::nullopt;
    }
  }
  return clips;
}

class Run {
 public:
  explicit Run(const Arguments& a) : arguments_(a) {
    if (a.budgetS <= 0.0) return;
    deadline_ = std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                    std::chrono::duration<double>(a.budgetS));
  }

  void clipInScene(const SweepClip& clip, const SweepScene& scene) {
    for (const auto& placement : choosePlacements(clip, scene, arguments_.placements)) {
      placedClip(clip, scene, placement);
    }
  }

  void clipAlone(const SweepClip& clip) {
    placedClip(clip, foretouch::test::emptySurroundings(), foretouch::test::Placement{});
  }

  [[nodiscard]] bool outOfTime() const { return total_.outOfTime; }

  int report() const {
    if (total_.outOfTime) std::cout << "the budget was spent\n";
    std::cout << "total: " << total_.summary() << "\n";
    for (const std::string& line : total_.violations) std::cout << "  " << line << "\n";
    if (total_.judged == 0) return 2;
    return total_.broken() > 0 || total_.of(foretouch::oracle::Finding::Unproved) > 0 ? 1 : 0;
  }

 private:
  void placedClip(const SweepClip& clip, const SweepScene& scene,
                  const foretouch::test::Placement& placement) {
    SweepOptions options;
    if (arguments_.self) {
      auto rules = foretouch::PairRules::derive(clip.avatar);
      if (!rules) {
        std::cerr << "left out: " << clip.name << ": " << describe(rules.error()) << "\n";
        return;
      }
      options.self = std::move(rules).value();
    }
    for (const double rate : arguments_.rates) {
      for (const double tolerance : arguments_.tolerances) {
        if (total_.outOfTime) return;
        options.rateHz = rate;
        options.tolerance = tolerance;
        combination(clip, scene, placement, options);
      }
    }
  }

  void combination(const SweepClip& clip, const SweepScene& scene,
                   const foretouch::test::Placement& placement, SweepOptions options) {
    options.maxSteps = arguments_.maxSteps;
    options.threads = arguments_.threads;
    options.reference.culler =
        arguments_.culler == "point" ? foretouch::Culler::PointQuery : foretouch::Culler::FlatBvh;
    options.reference.leafMethod = arguments_.leaves == "cubics"
                                       ? foretouch::LeafMethod::Cubics
                                       : foretouch::LeafMethod::Advancement;
    if (arguments_.backtracking == "scalar") {
      options.reference.backtracking = foretouch::Backtracking::Scalar;
    }
    if (arguments_.workBudget > 0) options.workBudget = arguments_.workBudget;
    if (arguments_.deadlineUs > 0.0) options.deadlineUs = arguments_.deadlineUs;
    if (arguments_.fidelity == "limb") options.reference.rung = foretouch::Rung::Limb;
    if (arguments_.fidelity == "avatar") options.reference.rung = foretouch::Rung::Avatar;
    if (arguments_.fidelity == "skinned") options.fidelity = foretouch::Fidelity::Skinned;
    options.deadline = deadline_;
    const SweepTally tally = sweep(clip, scene, placement, options);
    std::cout << clip.name << " x " << scene.name << ", " << options.rateHz << " Hz, eps "
              << options.tolerance << ", probed contact rate " << placement.contactRate << ": "
              << tally.summary() << std::endl;
    total_.add(tally);
  }

  const Arguments& arguments_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  SweepTally total_;
};

}  // namespace

int main(int argc, char** argv) {
  int code = 0;
  const auto arguments = parse(argc, argv, code);
  if (!arguments) return code;
  foretouch::useSimd(foretouch::simdFromName(arguments->simd));
  const auto clips = loadClips(*arguments);
  if (!clips) return 2;
  Run run(*arguments);
  if (arguments->scenes.empty()) {
    for (const SweepClip& clip : *clips) run.clipAlone(clip);
  }
  for (const std::string& name : arguments->scenes) {
    if (run.outOfTime()) break;
    const auto scene = foretouch::test::loadScene(name, arguments->data);
    if (!scene) {
      std::cerr << describe(scene.error()) << "\n";
      return 2;
    }
    for (const SweepClip& clip : *clips) run.clipInScene(clip, scene.value());
  }
  return run.report();
}
