#include "bench/peers/fcl_solvers.h"

#include <fcl/config.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>
#include <limits>

#include <fmt/format.h>

#include "bench/peers/fcl_capsule.h"
#include "bench/peers/fcl_mesh.h"

namespace foretouch::tools {

using Eigen::Vector3d;

struct FclScene::Impl {
  std::shared_ptr<FclMesh> mesh;
};

namespace {

/// Evaluations of the distance; no motion of a few metres reaches it.
constexpr int kMostAdvancements = 100'000;

/// Metres: the error of FCL's distances; its solvers stop at 1e-6.
constexpr double kDistanceSlack = 1e-5;

class FclSolver : public SweepSolver {
 public:
  FclSolver(std::string name, std::shared_ptr<const FclScene::Impl> scene, const Lss& lss_L)
      : SweepSolver(std::move(name), true), scene_(std::move(scene)), capsule_(lss_L) {}

 protected:
  [[nodiscard]] const FclMesh& mesh() const { return *scene_->mesh; }
  [[nodiscard]] const FclCapsule& capsule() const { return capsule_; }

 private:
  std::shared_ptr<const FclScene::Impl> scene_;
  FclCapsule capsule_;
};

/// A kind of distance query.
struct FclDistance {
  const char* name;
  fcl::GJKSolverType solver;
  /// The previous nearest distance plus the motion since then bounds the search. The same answers,
  /// sooner.
  bool isBounded;
};
constexpr FclDistance kPlainDistance = {"libccd", fcl::GST_LIBCCD, false};
constexpr FclDistance kBoundedDistance = {"libccd, bounded", fcl::GST_LIBCCD, true};
constexpr FclDistance kOwnBoundedDistance = {"own GJK, bounded", fcl::GST_INDEP, true};

/// Conservative advancement around fcl::distance(), as a user would write it. The speed bound is
/// the tightest single number per motion: that of the axis, not of the surface.
class FclAdvancement : public FclSolver {
 public:
  FclAdvancement(std::shared_ptr<const FclScene::Impl> scene, const Lss& lss_L,
                 const FclDistance& how, double tolerance)
      : FclSolver(fmt::format("FCL distance ({}), advanced by hand, {:g} m", how.name, tolerance),
                  std::move(scene), lss_L),
        isBounded_(how.isBounded),
        tolerance_(tolerance) {
    request_.gjk_solver_type = how.solver;
  }

  SweepAnswer solve(const RigidSweep& sweep) override {
    const fcl::Transform3d rest = fcl::Transform3d::Identity();
    const double speed = fastestAxisPoint(sweep);
    double t = 0.0, bound = std::numeric_limits<double>::max();
    for (int step = 0; step < kMostAdvancements; ++step) {
      fcl::DistanceResultd result(bound);
      const double distance = fcl::distance<double>(
          &mesh(), rest, &capsule().shape, capsule().poseOf(poseAt(sweep, t)), request_, result);
      if (distance <= tolerance_) return {true, t};
      if (distance >= speed * (1.0 - t)) return {false, 1.0};
      t += distance / speed;
      if (isBounded_) bound = 2.0 * distance + kDistanceSlack;
    }
    return {true, t};
  }

 private:
  fcl::DistanceRequestd request_;
  bool isBounded_;
  double tolerance_;
};

/// fcl::continuousCollide() with its default method: tests poses one by one.
class FclContinuous : public FclSolver {
 public:
  FclContinuous(std::shared_ptr<const FclScene::Impl> scene, const Lss& lss_L, int samples)
      : FclSolver(fmt::format("FCL continuousCollide, {} samples", samples), std::move(scene),
                  lss_L),
        request_(static_cast<std::size_t>(samples)) {}

  SweepAnswer solve(const RigidSweep& sweep) override {
    const fcl::Transform3d from = capsule().poseOf(poseAt(sweep, 0.0)),
                           to = capsule().poseOf(poseAt(sweep, 1.0));
    // The constructors without a reference point leave it unset, and the one of transforms with it
    // leaves the velocities unset.
    const fcl::InterpMotion<double> moving(from.linear(), from.translation(), to.linear(),
                                           to.translation(), capsule().pivot_C());
    const fcl::Matrix3d unturned = fcl::Matrix3d::Identity();
    const Vector3d origin = Vector3d::Zero();
    const fcl::InterpMotion<double> resting(unturned, origin, unturned, origin, origin);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide<double>(&mesh(), &resting, &capsule().shape, &moving, request_, result);
    return {result.is_collide, result.time_of_contact};
  }

 private:
  fcl::ContinuousCollisionRequestd request_;
};

/// Sub-step-and-test, like most programs: fcl::collide() at a number of poses after the first.
class FclSubsteps : public FclSolver {
 public:
  FclSubsteps(std::shared_ptr<const FclScene::Impl> scene, const Lss& lss_L, int samples)
      : FclSolver(fmt::format("FCL collide, {} sub-steps", samples), std::move(scene), lss_L),
        samples_(samples) {}

  SweepAnswer solve(const RigidSweep& sweep) override {
    const fcl::Transform3d rest = fcl::Transform3d::Identity();
    const fcl::CollisionRequestd request;
    for (int i = 1; i <= samples_; ++i) {
      const double t = static_cast<double>(i) / samples_;
      fcl::CollisionResultd result;
      if (fcl::collide<double>(&mesh(), rest, &capsule().shape, capsule().poseOf(poseAt(sweep, t)),
                               request, result) > 0) {
        return {true, t};
      }
    }
    return {false, 1.0};
  }

 private:
  int samples_;
};

}  // namespace

std::string fclVersion() {
  return "FCL " FCL_VERSION;
}

FclScene::FclScene(const std::vector<Triangle>& triangles) {
  auto scene = std::make_shared<Impl>();
  scene->mesh = fclMeshOf(triangles);
  impl_ = std::move(scene);
}

FclScene::~FclScene() = default;

SweepSolvers FclScene::solvers(const Lss& lss_L) const {
  SweepSolvers solvers;
  for (const FclDistance& how : {kPlainDistance, kBoundedDistance, kOwnBoundedDistance}) {
    for (const double tolerance : {1e-3, 1e-4}) {
      solvers.push_back(std::make_unique<FclAdvancement>(impl_, lss_L, how, tolerance));
    }
  }
  for (const int samples : {10, 100}) {
    solvers.push_back(std::make_unique<FclContinuous>(impl_, lss_L, samples));
  }
  for (const int samples : {10, 100}) {
    solvers.push_back(std::make_unique<FclSubsteps>(impl_, lss_L, samples));
  }
  return solvers;
}

}  // namespace foretouch::tools
