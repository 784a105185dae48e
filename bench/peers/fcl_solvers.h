// bench/peers/fcl_solvers.h: the Flexible Collision Library [Pan12] on rigid sweeps, the ways
// in which it finds these contacts. Its own conservative advancement of a shape and a mesh is not
// among them: it takes seconds a motion, misses what it is asked for, and overflows the stack the
// other way round.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/sweep_solver.h"
#include "lss/triangle.h"

namespace foretouch::tools {

[[nodiscard]] std::string fclVersion();

class FclScene {
 public:
  explicit FclScene(const std::vector<Triangle>& triangles);
  ~FclScene();

  /// Distance and advancement by hand (three ways, at 1e-3 m and 1e-4 m), continuousCollide() and
  /// sub-step-and-test (10 and 100 samples).
  [[nodiscard]] SweepSolvers solvers(const Lss& lss_L) const;

  struct Impl;

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace foretouch::tools
