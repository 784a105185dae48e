#include <algorithm>
#include <cmath>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <fmt/format.h>

#include "bench/peers/fcl_capsule.h"
#include "bench/peers/fcl_mesh.h"
#include "tests/planning/edge_solver.h"

namespace foretouch::test {
namespace {

using tools::FclCapsule;
using tools::FclMesh;
using tools::RigidPose;

struct LinkCapsule {
  LinkId link;
  FclCapsule capsule;
};

/// The arm's capsules, and where its links are.
class FclArm : public EdgeSolver {
 public:
  FclArm(std::string name, const PlanStage& stage, std::shared_ptr<const FclMesh> mesh)
      : EdgeSolver(std::move(name)), robot_(stage.edges->robot()), mesh_(std::move(mesh)) {
    for (LinkId link = 0; link < robot_.avatar().numLinks(); ++link) {
      if (std::count(stage.left.begin(), stage.left.end(), link) != 0) continue;
      for (const Lss& lss : robot_.avatar().lss(link)) {
        capsules_.push_back({link, FclCapsule(lss)});
      }
    }
  }

 protected:
  void place(const std::vector<double>& q, std::vector<RigidPose>& links) {
    robot_.poseAt(q.data(), pose_);
    const auto& parents = robot_.avatar().skeleton().parents();
    links.resize(parents.size());
    for (std::size_t i = 0; i < parents.size(); ++i) {
      links[i] = {pose_.rotations[i], pose_.translations[i]};
      if (parents[i] == kNoParent) continue;
      const RigidPose& parent = links[static_cast<std::size_t>(parents[i])];
      links[i] = {parent.rotation * links[i].rotation,
                  parent.pivot + parent.rotation * links[i].pivot};
    }
  }
  [[nodiscard]] static const RigidPose& of(const std::vector<RigidPose>& links, LinkId link) {
    return links[static_cast<std::size_t>(link)];
  }

  const Robot& robot_;
  std::shared_ptr<const FclMesh> mesh_;
  std::vector<LinkCapsule> capsules_;

 private:
  Pose pose_;
};

class SampledByFcl : public FclArm {
 public:
  SampledByFcl(const PlanStage& stage, std::shared_ptr<const FclMesh> mesh, double resolution,
               fcl::GJKSolverType solver)
      : FclArm(fmt::format("FCL collide ({}) at {:g} %",
                           solver == fcl::GST_INDEP ? "own GJK" : "libccd", 100.0 * resolution),
               stage, std::move(mesh)) {
    request_.gjk_solver_type = solver;
    double sum = 0.0;
    for (const RobotCoordinate& c : robot_.coordinates()) {
      const double range =
          std::isfinite(c.upper - c.lower) ? c.upper - c.lower : 2.0 * 3.14159265358979323846;
      sum += range * range;
    }
    step_ = resolution * std::sqrt(sum);
  }

  bool touches(const std::vector<double>& q0, const std::vector<double>& q1) override {
    double sum = 0.0;
    for (std::size_t i = 0; i < q0.size(); ++i) sum += (q1[i] - q0[i]) * (q1[i] - q0[i]);
    const int parts = std::max(1, static_cast<int>(std::ceil(std::sqrt(sum) / step_)));
    q_.resize(q0.size());
    for (int i = 0; i <= parts; ++i) {
      robot_.between(q0.data(), q1.data(), static_cast<double>(i) / parts, q_.data());
      if (touchesAt(q_)) return true;
    }
    return false;
  }

 private:
  bool touchesAt(const std::vector<double>& q) {
    place(q, links_);
    const fcl::Transform3d rest = fcl::Transform3d::Identity();
    return std::any_of(capsules_.begin(), capsules_.end(), [&](const LinkCapsule& c) {
      fcl::CollisionResultd result;
      return fcl::collide<double>(mesh_.get(), rest, &c.capsule.shape,
                                  c.capsule.poseOf(of(links_, c.link)), request_, result) > 0;
    });
  }

  fcl::CollisionRequestd request_;
  double step_ = 1.0;
  std::vector<double> q_;
  std::vector<RigidPose> links_;
};

class ContinuousByFcl : public FclArm {
 public:
  ContinuousByFcl(const PlanStage& stage, std::shared_ptr<const FclMesh> mesh, int samples)
      : FclArm(fmt::format("FCL continuousCollide, {} samples", samples), stage, std::move(mesh)),
        request_(static_cast<std::size_t>(samples)) {}

  bool touches(const std::vector<double>& q0, const std::vector<double>& q1) override {
    place(q0, from_);
    place(q1, to_);
    const fcl::Matrix3d unturned = fcl::Matrix3d::Identity();
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    const fcl::InterpMotion<double> resting(unturned, origin, unturned, origin, origin);
    return std::any_of(capsules_.begin(), capsules_.end(), [&](const LinkCapsule& c) {
      const fcl::Transform3d from = c.capsule.poseOf(of(from_, c.link)),
                             to = c.capsule.poseOf(of(to_, c.link));
      const fcl::InterpMotion<double> moving(from.linear(), from.translation(), to.linear(),
                                             to.translation(), c.capsule.pivot_C());
      fcl::ContinuousCollisionResultd result;
      fcl::continuousCollide<double>(mesh_.get(), &resting, &c.capsule.shape, &moving, request_,
                                     result);
      return result.is_collide;
    });
  }

 private:
  fcl::ContinuousCollisionRequestd request_;
  std::vector<RigidPose> from_, to_;
};

}  // namespace

EdgeSolvers fclEdgeSolvers(const PlanStage& stage, const std::vector<double>& resolutions,
                           const std::vector<int>& continuousSamples) {
  const std::shared_ptr<const FclMesh> mesh = tools::fclMeshOf(stage.triangles);
  EdgeSolvers solvers;
  for (const double resolution : resolutions) {
    for (const auto solver : {fcl::GST_LIBCCD, fcl::GST_INDEP}) {
      solvers.push_back(std::make_unique<SampledByFcl>(stage, mesh, resolution, solver));
    }
  }
  for (const int samples : continuousSamples) {
    solvers.push_back(std::make_unique<ContinuousByFcl>(stage, mesh, samples));
  }
  return solvers;
}

}  // namespace foretouch::test
