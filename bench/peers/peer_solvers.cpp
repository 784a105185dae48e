#include "bench/peers/peer_solvers.h"

#include "bench/peers/bullet_pairs.h"
#include "bench/peers/bullet_solvers.h"
#include "bench/peers/fcl_pairs.h"
#include "bench/peers/fcl_solvers.h"

namespace foretouch::tools {

std::string peerVersions() {
  return fclVersion() + " and " + bulletVersion();
}

PairSolvers peerPairSolvers(PairKind kind) {
  PairSolvers all = fclPairSolvers(kind);
  if (kind != PairKind::Capsules) return all;
  for (auto& solver : bulletPairSolvers()) all.push_back(std::move(solver));
  return all;
}

struct PeerScenes::Impl {
  explicit Impl(const std::vector<Triangle>& triangles) : fcl(triangles), bullet(triangles) {}
  FclScene fcl;
  BulletScene bullet;
};

PeerScenes::PeerScenes(const std::vector<Triangle>& triangles)
    : impl_(std::make_unique<Impl>(triangles)) {}

PeerScenes::~PeerScenes() = default;

SweepSolvers PeerScenes::solvers(const Lss& lss_L) const {
  SweepSolvers all = impl_->fcl.solvers(lss_L);
  for (auto& solver : impl_->bullet.solvers(lss_L)) all.push_back(std::move(solver));
  return all;
}

}  // namespace foretouch::tools
