#include "bench/body.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kDigits = 5;  ///< Fingers of a hand, toes of a foot.
constexpr int kFingerJoints = 3, kStrandJoints = 4, kStrandsARing = 16;
constexpr double kFingerLength = 0.03, kToeLength = 0.02, kDigitRadius = 0.008;  // metres
constexpr double kStrandLength = 0.1, kStrandRadius = 0.01, kRingRadius = 0.2, kRingRise = 0.05;
constexpr double kDigitSwing = 0.5, kStrandSwing = 0.15;  // radians
constexpr double kSwingsPerS = 1.3;

/// A body under construction.
struct Draft {
  RawSkeleton skeleton;
  std::vector<std::vector<Lss>> lss;
  std::vector<JointId> baseJoint;
  std::vector<AddedSwing> swing;

  [[nodiscard]] int size() const { return static_cast<int>(lss.size()); }
};

Draft draftOf(const Avatar& base) {
  Draft draft;
  const Skeleton& skeleton = base.skeleton();
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    draft.skeleton.joints.push_back(
        {skeleton.name(j), skeleton.parent(j), skeleton.restOffset(j), skeleton.restRotation(j)});
    draft.lss.push_back(base.lss(j));
    draft.baseJoint.push_back(j);
    draft.swing.emplace_back();
  }
  return draft;
}

/// Among the joints without children the one whose LSS hold least; the last of equals.
JointId leastLeaf(const Draft& draft) {
  std::vector<bool> hasChild(draft.lss.size(), false);
  for (const RawJoint& joint : draft.skeleton.joints) {
    if (joint.parent != kNoParent) hasChild[slotOf(joint.parent)] = true;
  }
  JointId least = kNoParent;
  double leastVolume = 0.0;
  for (JointId j = 0; j < draft.size(); ++j) {
    if (hasChild[slotOf(j)]) continue;
    double held = 0.0;
    for (const Lss& lss : draft.lss[slotOf(j)]) held += volume(lss);
    if (least == kNoParent || held <= leastVolume) {
      least = j;
      leastVolume = held;
    }
  }
  return least;
}

void drop(Draft& draft, JointId leaf) {
  const auto erase = [leaf](auto& list) { list.erase(list.begin() + leaf); };
  erase(draft.skeleton.joints);
  erase(draft.lss);
  erase(draft.baseJoint);
  erase(draft.swing);
  for (RawJoint& joint : draft.skeleton.joints) {
    if (joint.parent > leaf) --joint.parent;
  }
}

/// Adds a joint with one LSS along `along_P`; returns it.
JointId add(Draft& draft, JointId parent, const Eigen::Vector3d& offset,
            const Eigen::Vector3d& along_P, double radius, const AddedSwing& swing) {
  const JointId joint = draft.size();
  RawJoint raw;
  raw.name = "bench_added_" + std::to_string(joint);
  raw.parent = parent;
  raw.offset = offset;
  draft.skeleton.joints.push_back(raw);
  draft.lss.push_back({Lss{Eigen::Vector3d::Zero(), along_P, radius}});
  draft.baseJoint.push_back(kNoParent);
  draft.swing.push_back(swing);
  return joint;
}

bool mentions(const std::string& name, const std::string& word) {
  std::string lower;
  for (const char c : name) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return lower.find(word) != std::string::npos;
}

/// Joints with `word` in their names, whose parents do not have it.
std::vector<JointId> joints(const Draft& draft, const std::string& word) {
  std::vector<JointId> found;
  const auto& all = draft.skeleton.joints;
  for (JointId j = 0; j < draft.size(); ++j) {
    const RawJoint& joint = all[slotOf(j)];
    const bool below = joint.parent != kNoParent && mentions(all[slotOf(joint.parent)].name, word);
    if (mentions(joint.name, word) && !below && !draft.lss[slotOf(j)].empty()) {
      found.push_back(j);
    }
  }
  return found;
}

/// Phases that do not repeat: multiples of the golden angle.
double phaseOf(const Draft& draft) {
  constexpr double kGoldenAngle = 2.39996322972865332;
  return std::fmod(kGoldenAngle * draft.size(), 2.0 * kPi);
}

/// Five digits on each host, joint by joint and host by host, until there are `links` links.
void addDigits(Draft& draft, const std::vector<JointId>& hosts, int jointsADigit, double length,
               int links) {
  std::vector<JointId> tips(hosts.size() * kDigits, kNoParent);
  for (int level = 0; level < jointsADigit; ++level) {
    for (std::size_t i = 0; i < tips.size() && draft.size() < links; ++i) {
      const JointId host = hosts[i / kDigits];
      const Lss palm = draft.lss[slotOf(host)].front();
      const Eigen::Vector3d axis = palm.b - palm.a;
      const Eigen::Vector3d along =
          axis.norm() > 0.0 ? axis.normalized() : Eigen::Vector3d::UnitX().eval();
      const Eigen::Vector3d across = along.unitOrthogonal();
      const double side = (static_cast<double>(i % kDigits) / (kDigits - 1) - 0.5) * 2.0;
      const Eigen::Vector3d root = palm.b + 0.9 * side * palm.radius * across;
      const AddedSwing swing{across, kDigitSwing, phaseOf(draft)};
      const bool first = level == 0;
      tips[i] = add(draft, first ? host : tips[i], first ? root : Eigen::Vector3d(length * along),
                    length * along, kDigitRadius, swing);
    }
  }
}

/// Strands about the first root, ring under ring, until there are `links` links.
void addStrands(Draft& draft, int links) {
  for (int strand = 0; draft.size() < links; ++strand) {
    const double angle = 2.0 * kPi * strand / kStrandsARing;
    const double radius = kRingRadius + kRingRise * (strand / kStrandsARing);
    const Eigen::Vector3d out(std::cos(angle), 0.0, std::sin(angle));
    const Eigen::Vector3d down(0.0, -kStrandLength, 0.0);
    JointId parent = 0;
    for (int level = 0; level < kStrandJoints && draft.size() < links; ++level) {
      const AddedSwing swing{Eigen::Vector3d(-out.z(), 0.0, out.x()), kStrandSwing, phaseOf(draft)};
      parent = add(draft, parent, level == 0 ? Eigen::Vector3d(radius * out) : down, down,
                   kStrandRadius, swing);
    }
  }
}

}  // namespace

Result<BenchBody> bodyWithLinks(const Avatar& base, int links) {
  FORETOUCH_ASSERT(links >= 1 && links <= kMaxBenchLinks);
  Draft draft = draftOf(base);
  while (draft.size() > links) drop(draft, leastLeaf(draft));
  if (draft.size() < links) {
    addDigits(draft, joints(draft, "hand"), kFingerJoints, kFingerLength, links);
    addDigits(draft, joints(draft, "toe"), 1, kToeLength, links);
    addStrands(draft, links);
  }
  FORETOUCH_TRY(auto skeleton, Skeleton::build(draft.skeleton));
  FORETOUCH_TRY(auto avatar, Avatar::build(std::move(skeleton), std::move(draft.lss)));
  return BenchBody{std::move(avatar), std::move(draft.baseJoint), std::move(draft.swing)};
}

Pose poseOfBody(const BenchBody& body, const Pose& base, double timeS) {
  Pose pose = restPose(body.avatar.skeleton());
  for (std::size_t j = 0; j < body.baseJoint.size(); ++j) {
    if (body.baseJoint[j] != kNoParent) {
      const auto source = static_cast<std::size_t>(body.baseJoint[j]);
      pose.rotations[j] = base.rotations[source];
      pose.translations[j] = base.translations[source];
      continue;
    }
    const AddedSwing& swing = body.swing[j];
    const double angle = swing.amplitude * std::sin(2.0 * kPi * kSwingsPerS * timeS + swing.phase);
    pose.rotations[j] = Quaternion(Eigen::AngleAxisd(angle, swing.axis_P));
  }
  return pose;
}

}  // namespace foretouch::tools
