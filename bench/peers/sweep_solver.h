// bench/peers/sweep_solver.h: the interface of `bench peers` to Foretouch and every peer.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/rigid_sweep.h"

namespace foretouch::tools {

struct SweepAnswer {
  bool touches = false;
  double toi = 1.0;  ///< Normalised; valid if it touches.
};

/// One solver with one setting, in one scene, for one LSS in its link's frame. The constructor
/// prepares everything that a user would prepare once; only solve() is timed.
class SweepSolver {
 public:
  SweepSolver(std::string name, bool isPeer) : name_(std::move(name)), isPeer_(isPeer) {}
  SweepSolver(const SweepSolver&) = delete;
  SweepSolver& operator=(const SweepSolver&) = delete;
  virtual ~SweepSolver() = default;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool isPeer() const { return isPeer_; }

  /// The sweep's LSS is the one that the solver was made for.
  [[nodiscard]] virtual SweepAnswer solve(const RigidSweep& sweep) = 0;

 private:
  std::string name_;
  bool isPeer_;
};

using SweepSolvers = std::vector<std::unique_ptr<SweepSolver>>;

}  // namespace foretouch::tools
