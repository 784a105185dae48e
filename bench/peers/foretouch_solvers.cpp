#include "bench/peers/foretouch_solvers.h"

#include <fmt/format.h>

#include "articulated/try.h"
#include "middleware/query/query.h"

namespace foretouch::tools {
namespace {

class ForetouchSolver : public SweepSolver {
 public:
  explicit ForetouchSolver(Query query)
      : SweepSolver(fmt::format("Foretouch, {:g} m", query.options().tolerance), false),
        query_(std::move(query)),
        from_(restPose(query_.avatar().skeleton())),
        to_(from_) {}

  SweepAnswer solve(const RigidSweep& sweep) override {
    setPose(from_, poseAt(sweep, 0.0));
    setPose(to_, poseAt(sweep, 1.0));
    motion_.assign(query_.avatar().skeleton(), from_, to_);
    query_.answer(motion_, scratch_, contacts_);
    const LinkContact& contact = contacts_.links.front();
    return {contact.verdict != Verdict::Clear, contact.freeUntil};
  }

 private:
  static void setPose(Pose& pose, const RigidPose& rigid) {
    pose.rotations.front() = rigid.rotation;
    pose.translations.front() = rigid.pivot;
  }

  Query query_;
  Pose from_, to_;
  Scratch scratch_;
  ChainMotion motion_;
  StepContacts contacts_;
};

Result<Avatar> avatarOf(const Lss& lss_L) {
  RawSkeleton raw;
  raw.joints.push_back({"link", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()});
  FORETOUCH_TRY(auto skeleton, Skeleton::build(raw));
  return Avatar::build(std::move(skeleton), {{lss_L}});
}

}  // namespace

Result<SweepSolvers> foretouchSolvers(const Scene& scene, const Lss& lss_L) {
  FORETOUCH_TRY(const auto avatar, avatarOf(lss_L));
  SweepSolvers solvers;
  for (const double tolerance : kForetouchTolerances) {
    QueryOptions options;
    options.tolerance = tolerance;
    FORETOUCH_TRY(auto query, Query::build(avatar, scene, options));
    solvers.push_back(std::make_unique<ForetouchSolver>(std::move(query)));
  }
  return solvers;
}

}  // namespace foretouch::tools
