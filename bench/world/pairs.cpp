#include "bench/world/pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/machine.h"
#include "bench/peers/moving_pairs.h"
#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "bench/world/timed_world.h"
#ifdef FORETOUCH_HAS_PEERS
#include "bench/peers/peer_solvers.h"
#endif

namespace foretouch::tools {
namespace {

/// A world of the two alone: poses in, the window's answer out.
class WorldPair final : public PairSolver {
 public:
  explicit WorldPair(PairKind kind)
      : PairSolver("Foretouch World, 0.001 m, poses and window"),
        world_(World::build(std::nullopt, {kBenchWorldTolerance}).value()) {
    RawSkeleton raw;
    raw.joints = {{"link", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
    const Avatar capsule = Avatar::build(Skeleton::build(raw).value(), {{movingLss()}}).value();
    bodies_[0] = (kind == PairKind::Capsules ? world_.add(capsule) : world_.add(ring())).value();
    bodies_[1] = world_.add(capsule).value();
  }

  SweepAnswer solve(const MovingPair& pair) override {
    for (const double t : {0.0, 1.0}) {
      nowUs_ += kStepUs;
      push(bodies_[0], poseAt(pair.one, t));
      push(bodies_[1], poseAt(pair.other, t));
    }
    const std::int64_t fromUs = nowUs_ - kStepUs;
    static_cast<void>(world_.contacts(fromUs, nowUs_, scratch_, answer_).value());
    world_.forgetBefore(nowUs_);
    if (answer_.contacts.empty()) return {false, 1.0};
    const double us = microsecondsAfter(fromUs, answer_.contacts.front().time);
    return {true, us / static_cast<double>(kStepUs)};
  }

 private:
  static constexpr std::int64_t kStepUs = 1'000'000;

  static Scene ring() {
    RawScene raw;
    raw.objectNames = {"ring"};
    raw.triangles = movingRing();
    raw.objectOf.assign(raw.triangles.size(), 0);
    return Scene::build(std::move(raw)).value();
  }
  void push(BodyId body, const RigidPose& pose) {
    static_cast<void>(
        world_.push(body, nowUs_, foretouch::RigidPose{pose.rotation, pose.pivot}).value());
  }

  World world_;
  BodyId bodies_[2] = {0, 0};
  Scratch scratch_;
  WorldContacts answer_;
  std::int64_t nowUs_ = 0;
};

struct PairTally {
  std::uint64_t missed = 0, late = 0, invented = 0;
  std::vector<double> us, off;
};

/// The least of a few rounds counts.
PairTally judgedPairs(const std::vector<MovingPair>& pairs, PairSolver& solver) {
  constexpr int kRounds = 3;
  /// A touch of the judge is within a nanometre, at so many metres per unit of t at least.
  constexpr double kLate = 1e-6;
  PairTally tally;
  tally.us.assign(pairs.size(), 1e300);
  std::vector<SweepAnswer> answers(pairs.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const ThreadStopwatch watch;
      answers[i] = solver.solve(pairs[i]);
      tally.us[i] = std::min(tally.us[i], watch.us());
    }
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    tally.missed += pairs[i].touches && !answers[i].touches;
    tally.invented += !pairs[i].touches && answers[i].touches;
    if (!pairs[i].touches || !answers[i].touches) continue;
    tally.late += answers[i].toi > pairs[i].toi + kLate;
    tally.off.push_back(std::abs(answers[i].toi - pairs[i].toi));
  }
  return tally;
}

}  // namespace

JudgedTable pairsTable(PairKind kind, int pairs, std::uint64_t seed) {
  JudgedTable result;
  const bool isRing = kind == PairKind::RingAndCapsule;
  result.table = {isRing ? "ring_pairs" : "pairs",
                  isRing ? "A ring of 384 triangles and a capsule that both move and turn, alone"
                         : "Two capsules of 25 cm that both move and turn, alone: first contacts",
                  {{"solver", "solver"},
                   {"pairs", "pairs", 0},
                   {"touching", "touching", 0},
                   {"missed", "missed", 0},
                   {"late", "late", 0},
                   {"invented", "invented", 0},
                   {"off_p50", "off by t p50", -1},
                   {"off_p99", "p99", -1},
                   {"mean_us", "mean us", 2},
                   {"p99_us", "p99 us", 2}},
                  {}};
  const std::vector<MovingPair> drawn = drawnPairs(kind, pairs, seed);
  const auto touching =
      std::count_if(drawn.begin(), drawn.end(), [](const MovingPair& p) { return p.touches; });
  PairSolvers solvers;
  solvers.push_back(std::make_unique<WorldPair>(kind));
#ifdef FORETOUCH_HAS_PEERS
  for (auto& peer : peerPairSolvers(kind)) solvers.push_back(std::move(peer));
#endif
  for (const auto& solver : solvers) {
    const PairTally tally = judgedPairs(drawn, *solver);
    const Percentiles us = percentilesOf(tally.us), off = percentilesOf(tally.off);
    if (solver == solvers.front()) result.violations = tally.missed + tally.late;
    result.table.rows.push_back({solver->name(), static_cast<std::int64_t>(drawn.size()),
                                 std::int64_t{touching}, cell(tally.missed), cell(tally.late),
                                 cell(tally.invented), off.p50, off.p99, us.mean, us.p99});
  }
  return result;
}

}  // namespace foretouch::tools
