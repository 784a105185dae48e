// bench/peers/fcl_solvers.h: the Flexible Collision Library [Pan12] on rigid sweeps, in the ways in
// which it finds these contacts. They do not include its own conservative advancement of a shape
// and a mesh, which takes seconds per motion, misses contacts, and overflows the stack with the
// arguments swapped.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/sweep_solver.h"
#include "lss/lss.h"

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
