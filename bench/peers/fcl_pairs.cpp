#include "bench/peers/fcl_pairs.h"

#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>

#include <fmt/format.h>

#include "bench/peers/fcl_capsule.h"
#include "bench/peers/fcl_mesh.h"

namespace foretouch::tools {
namespace {

constexpr int kMostPairAdvancements = 100'000;
constexpr double kPairTolerance = 1e-3;

/// The first one of a pair in FCL's own form: a capsule, or the ring's triangles.
class FclFirst {
 public:
  explicit FclFirst(PairKind kind) {
    if (kind == PairKind::RingAndCapsule) mesh_ = fclMeshOf(movingRing());
  }
  [[nodiscard]] const fcl::CollisionGeometryd* shape() const {
    if (mesh_) return mesh_.get();
    return &capsule_.shape;
  }
  [[nodiscard]] fcl::Transform3d poseOf(const RigidPose& pose) const {
    if (!mesh_) return capsule_.poseOf(pose);
    fcl::Transform3d placed = fcl::Transform3d::Identity();
    placed.linear() = pose.rotation.toRotationMatrix();
    placed.translation() = pose.pivot;
    return placed;
  }
  /// The point about which it turns, in its own frame.
  [[nodiscard]] Eigen::Vector3d pivot() const {
    return mesh_ ? Eigen::Vector3d::Zero() : capsule_.pivot_C();
  }

 private:
  std::shared_ptr<FclMesh> mesh_;
  FclCapsule capsule_{movingLss()};
};

class FclPairAdvancement final : public PairSolver {
 public:
  explicit FclPairAdvancement(PairKind kind)
      : PairSolver(fmt::format("FCL distance (libccd), advanced by hand, {:g} m", kPairTolerance)),
        first_(kind) {
    request_.gjk_solver_type = fcl::GST_LIBCCD;
  }

  SweepAnswer solve(const MovingPair& pair) override {
    const double speed = fastestAxisPoint(pair.one) + fastestAxisPoint(pair.other);
    double t = 0.0;
    for (int step = 0; step < kMostPairAdvancements; ++step) {
      fcl::DistanceResultd result;
      const double distance =
          fcl::distance<double>(first_.shape(), first_.poseOf(poseAt(pair.one, t)), &capsule_.shape,
                                capsule_.poseOf(poseAt(pair.other, t)), request_, result);
      if (distance <= kPairTolerance) return {true, t};
      if (distance >= speed * (1.0 - t)) return {false, 1.0};
      t += distance / speed;
    }
    return {true, t};
  }

 private:
  FclFirst first_;
  FclCapsule capsule_{movingLss()};
  fcl::DistanceRequestd request_;
};

class FclPairContinuous final : public PairSolver {
 public:
  FclPairContinuous(PairKind kind, int samples)
      : PairSolver(fmt::format("FCL continuousCollide, {} samples", samples)),
        first_(kind),
        request_(static_cast<std::size_t>(samples)) {}

  SweepAnswer solve(const MovingPair& pair) override {
    const auto one = motionOf(first_.poseOf(poseAt(pair.one, 0.0)),
                              first_.poseOf(poseAt(pair.one, 1.0)), first_.pivot()),
               other = motionOf(capsule_.poseOf(poseAt(pair.other, 0.0)),
                                capsule_.poseOf(poseAt(pair.other, 1.0)), capsule_.pivot_C());
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide<double>(first_.shape(), &one, &capsule_.shape, &other, request_, result);
    return {result.is_collide, result.time_of_contact};
  }

 private:
  /// As in FclContinuous: the only constructor that sets all.
  [[nodiscard]] static fcl::InterpMotion<double> motionOf(const fcl::Transform3d& from,
                                                          const fcl::Transform3d& to,
                                                          const Eigen::Vector3d& pivot) {
    return {from.linear(), from.translation(), to.linear(), to.translation(), pivot};
  }

  FclFirst first_;
  FclCapsule capsule_{movingLss()};
  fcl::ContinuousCollisionRequestd request_;
};

}  // namespace

PairSolvers fclPairSolvers(PairKind kind) {
  PairSolvers solvers;
  solvers.push_back(std::make_unique<FclPairAdvancement>(kind));
  for (const int samples : {10, 100}) {
    solvers.push_back(std::make_unique<FclPairContinuous>(kind, samples));
  }
  return solvers;
}

}  // namespace foretouch::tools
