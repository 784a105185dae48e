// bench/peers.h: compares Foretouch with its peers on generated motions in one scene, and formats
// the results.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/peers/comparison.h"
#include "bench/peers/motion_sets.h"
#include "bench/report.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Whether FCL and Bullet are built in (CMake option FORETOUCH_PEERS).
[[nodiscard]] bool hasPeers();
/// "FCL 0.7.0 and Bullet 3.24 (double precision)"; empty if they are not built in.
[[nodiscard]] std::string builtInPeers();

struct PeersPlan {
  std::vector<MotionSetKind> sets;
  std::size_t motions = 1'000;  ///< Per set.
  std::uint64_t seed = 1;
  RoundCounts rounds;
};

struct ComparedSet {
  MotionSet motions;
  std::vector<SolverRun> runs;
  std::vector<Judgement> judgements;  ///< One per run.
};

/// Draws the sets and runs every solver on them. `progress` gets the number of finished rounds of
/// solvers, and of all. Errors: a scene that the motions do not fit.
[[nodiscard]] Result<std::vector<ComparedSet>> comparePeers(
    const Scene& scene, const PeersPlan& plan,
    const std::function<void(std::int64_t done, std::int64_t total)>& progress);

/// One table per set, and one with the factor by which Foretouch is faster than the fastest sound
/// peer.
[[nodiscard]] std::vector<BenchTable> peerTables(const std::vector<ComparedSet>& sets);
/// One row per motion and solver.
[[nodiscard]] BenchTable rawPeerTable(const std::vector<ComparedSet>& sets);
/// How to read the columns.
[[nodiscard]] std::vector<std::string> peerNotes(const std::vector<ComparedSet>& sets);

/// Contacts that Foretouch missed or reported late, over all sets and tolerances: it promises that
/// there are none.
[[nodiscard]] std::size_t brokenPromises(const std::vector<ComparedSet>& sets);

}  // namespace foretouch::tools
