// bench/peers/bullet_solvers.h: the Bullet physics library on rigid sweeps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/sweep_solver.h"
#include "lss/lss.h"

namespace foretouch::tools {

[[nodiscard]] std::string bulletVersion();

class BulletScene {
 public:
  explicit BulletScene(const std::vector<Triangle>& triangles);
  ~BulletScene();

  /// btCollisionWorld::convexSweepTest(), and btContinuousConvexCollision with each triangle that
  /// the sweep's box meets: each over the whole motion, and in pieces that turn little enough for
  /// Bullet.
  [[nodiscard]] SweepSolvers solvers(const Lss& lss_L) const;

  struct Impl;

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace foretouch::tools
