// bench/peers/peer_solvers.h: the peers, FCL and Bullet, on rigid sweeps and as hands. The only
// interface to them: no other header shows one of their types, and the program builds without them
// if they are not installed (CMake option FORETOUCH_PEERS).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "bench/peers/hand_follower.h"
#include "bench/peers/moving_pairs.h"
#include "bench/peers/sweep_solver.h"
#include "lss/lss.h"

namespace foretouch::tools {

/// The versions built in, "FCL 0.7.0 and Bullet 3.24 (double precision)".
[[nodiscard]] std::string peerVersions();

/// Bullet's hands: a capsule of 0.4 kg as a free rigid body, without gravity and friction, in a
/// scene of triangles. Its velocity is set so that it would arrive, or a spring of 10 Hz,
/// critically damped, pulls it; each with and without Bullet's continuous collision detection, and
/// the first with four substeps too. The usual hands of VR frameworks are of these kinds.
class BulletHands {
 public:
  explicit BulletHands(const std::vector<Triangle>& triangles);
  BulletHands(const BulletHands&) = delete;
  BulletHands& operator=(const BulletHands&) = delete;
  ~BulletHands();

  /// One per kind, each in its own world. The axis' middle is the frame's origin.
  [[nodiscard]] HandFollowers of(const Lss& hand_L) const;

 private:
  std::shared_ptr<class BulletMesh> mesh_;
};

/// Bullet's rays and casts in a scene of triangles that stands still.
class BulletCasts {
 public:
  explicit BulletCasts(const std::vector<Triangle>& triangles);
  BulletCasts(const BulletCasts&) = delete;
  BulletCasts& operator=(const BulletCasts&) = delete;
  ~BulletCasts();

  /// The share of the way at which a sphere first hits something; a ray, if it has no radius.
  /// Nothing: it hits nothing.
  [[nodiscard]] std::optional<double> first(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                            double radius) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Solvers for two bodies that both move, one for every peer and setting. Bullet casts only convex
/// shapes: no ring.
[[nodiscard]] PairSolvers peerPairSolvers(PairKind kind);

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
