// bench/peers/peer_solvers.h: the peers, FCL and Bullet, on rigid sweeps. The only interface to
// them: no other header shows one of their types, and the program builds without them if they are
// not installed (CMake option FORETOUCH_PEERS).
#pragma once

#include <memory>
#include <vector>

#include "bench/peers/sweep_solver.h"
#include "lss/triangle.h"

namespace foretouch::tools {

/// The versions built in, "FCL 0.7.0 and Bullet 3.24 (double precision)".
[[nodiscard]] std::string peerVersions();

/// The scene in the peers' own structures, built once.
class PeerScenes {
 public:
  explicit PeerScenes(const std::vector<Triangle>& triangles);
  PeerScenes(const PeerScenes&) = delete;
  PeerScenes& operator=(const PeerScenes&) = delete;
  ~PeerScenes();

  /// A solver for every peer and setting. They share the scene, which must outlive them.
  [[nodiscard]] SweepSolvers solvers(const Lss& lss_L) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch::tools
