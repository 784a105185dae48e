#include "bench/rigid_comparison.h"

#include <utility>

#include "articulated/try.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

Result<Pose> worldPose(const Skeleton& forest, const ChainMotion& motion, double t) {
  std::vector<LinkState> states;
  motion.statesAt(t, states);
  Pose pose;
  for (const LinkState& state : states) {
    pose.rotations.emplace_back(state.R_WL);
    pose.translations.push_back(state.p_WL);
  }
  return validatedPose(forest, std::move(pose));
}

/// Length of the path, between two times of the true motion, of the link's point that is at `p_W`
/// at time `from`. By chords: to distinguish a millimetre from more, sixteen are ample.
double travelled(const ChainMotion& motion, LinkId link, const Vector3d& p_W, double from,
                 double to) {
  constexpr int kChords = 16;
  const LinkState start = motion.stateAt(link, from);
  const Vector3d p_L = start.R_WL.transpose() * (p_W - start.p_WL);
  double length = 0.0;
  Vector3d last = p_W;
  for (int i = 1; i <= kChords; ++i) {
    const double t = from + (to - from) * i / kChords;
    const Vector3d next = motion.stateAt(link, t).pointAt(p_L);
    length += (next - last).norm();
    last = next;
  }
  return length;
}

bool meets(Verdict verdict) {
  return verdict == Verdict::Contact || verdict == Verdict::StartsInContact;
}

RigidCounts compareLink(const ChainMotion& motion, const LinkContact& truth,
                        const LinkContact& rigid) {
  RigidCounts counts;
  if (truth.verdict == Verdict::Undecided || rigid.verdict == Verdict::Undecided) {
    counts.undecided = 1;
  } else if (truth.verdict == Verdict::Clear) {
    counts.falseContacts = meets(rigid.verdict) ? 1 : 0;
  } else if (truth.verdict == Verdict::Contact) {
    counts.contacts = 1;
    if (rigid.verdict == Verdict::Clear) {
      counts.missed = 1;
    } else if (travelled(motion, truth.link, truth.p_WLink, truth.toi, rigid.toi) > kNoticeable) {
      (rigid.toi > truth.toi ? counts.late : counts.early) = 1;
    }
  }
  return counts;
}

}  // namespace

void RigidCounts::add(const RigidCounts& other) {
  contacts += other.contacts;
  missed += other.missed;
  late += other.late;
  early += other.early;
  falseContacts += other.falseContacts;
  undecided += other.undecided;
}

Result<RigidComparison> RigidComparison::build(const Avatar& avatar, const Scene& scene,
                                               const QueryOptions& options) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    RawJoint joint;
    joint.name = avatar.skeleton().name(link);
    raw.joints.push_back(std::move(joint));
    lss.push_back(avatar.lss(link));
  }
  FORETOUCH_TRY(auto skeleton, Skeleton::build(raw));
  FORETOUCH_TRY(auto forest, Avatar::build(std::move(skeleton), std::move(lss)));
  QueryOptions ofForest = options;
  // Compared is each link's first contact with the scene, which is the same in both scopes.
  if (ofForest.scope == Scope::EveryObject) ofForest.scope = Scope::EveryLink;
  ofForest.self.reset();
  FORETOUCH_TRY(auto query, Query::build(forest, scene, ofForest));
  return RigidComparison(std::move(query));
}

Result<RigidCounts> RigidComparison::compare(const ChainMotion& motion, const StepContacts& truth,
                                             Scratch& scratch) const {
  const Skeleton& skeleton = forest_.avatar().skeleton();
  FORETOUCH_TRY(const auto from, worldPose(skeleton, motion, 0.0));
  FORETOUCH_TRY(const auto to, worldPose(skeleton, motion, 1.0));
  const StepContacts rigid = forest_.answer(ChainMotion(skeleton, from, to), scratch);
  RigidCounts counts;
  for (std::size_t i = 0; i < truth.links.size(); ++i) {
    counts.add(compareLink(motion, truth.links[i], rigid.links[i]));
  }
  return counts;
}

}  // namespace foretouch::tools
