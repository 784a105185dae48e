#include "bench/peers/fcl_pairs.h"

#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>

#include <fmt/format.h>

#include "bench/peers/fcl_capsule.h"

namespace foretouch::tools {
namespace {

constexpr int kMostPairAdvancements = 100'000;
constexpr double kPairTolerance = 1e-3;

class FclPairAdvancement final : public PairSolver {
 public:
  FclPairAdvancement()
      : PairSolver(fmt::format("FCL distance (libccd), advanced by hand, {:g} m", kPairTolerance)) {
    request_.gjk_solver_type = fcl::GST_LIBCCD;
  }

  SweepAnswer solve(const MovingPair& pair) override {
    const double speed = fastestAxisPoint(pair.one) + fastestAxisPoint(pair.other);
    double t = 0.0;
    for (int step = 0; step < kMostPairAdvancements; ++step) {
      fcl::DistanceResultd result;
      const double distance = fcl::distance<double>(
          &capsule_.shape, capsule_.poseOf(poseAt(pair.one, t)), &capsule_.shape,
          capsule_.poseOf(poseAt(pair.other, t)), request_, result);
      if (distance <= kPairTolerance) return {true, t};
      if (distance >= speed * (1.0 - t)) return {false, 1.0};
      t += distance / speed;
    }
    return {true, t};
  }

 private:
  FclCapsule capsule_{movingLss()};
  fcl::DistanceRequestd request_;
};

class FclPairContinuous final : public PairSolver {
 public:
  explicit FclPairContinuous(int samples)
      : PairSolver(fmt::format("FCL continuousCollide, {} samples", samples)),
        request_(static_cast<std::size_t>(samples)) {}

  SweepAnswer solve(const MovingPair& pair) override {
    const auto one = motionOf(pair.one), other = motionOf(pair.other);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide<double>(&capsule_.shape, &one, &capsule_.shape, &other, request_,
                                   result);
    return {result.is_collide, result.time_of_contact};
  }

 private:
  /// As FclContinuous has it: the only constructor that sets all.
  [[nodiscard]] fcl::InterpMotion<double> motionOf(const RigidSweep& sweep) const {
    const fcl::Transform3d from = capsule_.poseOf(poseAt(sweep, 0.0)),
                           to = capsule_.poseOf(poseAt(sweep, 1.0));
    return {from.linear(), from.translation(), to.linear(), to.translation(), capsule_.pivot_C()};
  }

  FclCapsule capsule_{movingLss()};
  fcl::ContinuousCollisionRequestd request_;
};

}  // namespace

PairSolvers fclPairSolvers() {
  PairSolvers solvers;
  solvers.push_back(std::make_unique<FclPairAdvancement>());
  for (const int samples : {10, 100}) {
    solvers.push_back(std::make_unique<FclPairContinuous>(samples));
  }
  return solvers;
}

}  // namespace foretouch::tools
