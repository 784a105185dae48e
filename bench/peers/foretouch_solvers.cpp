#include "bench/peers/foretouch_solvers.h"

#include <fmt/format.h>

#include "articulated/try.h"
#include "middleware/query/query.h"

namespace foretouch::tools {
namespace {

class ForetouchSolver : public SweepSolver {
 public:
  ForetouchSolver(const Scene& scene, Avatar avatar, double tolerance)
      : SweepSolver(fmt::format("Foretouch, {:g} m", tolerance), false),
        scene_(scene),
        avatar_(std::move(avatar)),
        from_(restPose(avatar_.skeleton())),
        to_(from_) {
    options_.tolerance = tolerance;
  }

  SweepAnswer solve(const RigidSweep& sweep) override {
    setPose(from_, poseAt(sweep, 0.0));
    setPose(to_, poseAt(sweep, 1.0));
    motion_.assign(avatar_.skeleton(), from_, to_);
    const auto done = firstContacts(avatar_, motion_, scene_, options_, scratch_, contacts_);
    FORETOUCH_ASSERT(done.ok());
    static_cast<void>(done);
    const LinkContact& contact = contacts_.links.front();
    return {contact.verdict != Verdict::Clear, contact.freeUntil};
  }

 private:
  static void setPose(Pose& pose, const RigidPose& rigid) {
    pose.rotations.front() = rigid.rotation;
    pose.translations.front() = rigid.pivot;
  }

  Scene scene_;
  Avatar avatar_;
  Pose from_, to_;
  QueryOptions options_;
  QueryScratch scratch_;
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
    solvers.push_back(std::make_unique<ForetouchSolver>(scene, avatar, tolerance));
  }
  return solvers;
}

}  // namespace foretouch::tools
