#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "assets/bvh/bvh_reader.h"
#include "assets/bvh/bvh_roles.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using internal::BodyRole;
using internal::kLegPerStature;
using internal::radiusPerStature;

// Choices; docs/formats.md gives the reasons.
constexpr double kShortestBone = 1e-4;   // of stature; below it a bone has no direction to trust
constexpr double kUnknownRadius = 0.15;  // of the bone's length
constexpr double kSlenderness = 0.5;     // largest radius of a limb, of the limb's length
constexpr double kTipSkin = 0.1;         // of the radius: how far flesh extends past an End Site
constexpr double kFlatRest = 0.1;        // a rest pose flatter than this is not a posture
constexpr double kLongestPath = 1.55;    // of stature: from the toes to the other side's fingers
constexpr double kSphereAhead = 0.9;     // of the radius: a head's centre past its joint

struct Bone {
  std::size_t joint = 0;
  std::size_t child = 0;  ///< Meaningless if `isTip`.
  bool isTip = false;
  Eigen::Vector3d toward = Eigen::Vector3d::Zero();
  double length = 0.0;
};

bool isTrunk(BodyRole role) {
  return role == BodyRole::Pelvis || role == BodyRole::Torso;
}

/// Parts as thick as they are long: their length does not bound their radius.
bool isBlock(BodyRole role) {
  return isTrunk(role) || role == BodyRole::Head || role == BodyRole::Hand ||
         role == BodyRole::Foot;
}

/// Makes LSS for the bones of one clip's skeleton. Lengths in metres.
class BodyBuilder {
 public:
  explicit BodyBuilder(const Clip& clip, double radiusScale);

  [[nodiscard]] std::vector<std::vector<Lss>> lssPerLink() const;

 private:
  void findOffsets();
  void findBones();
  void findStature();
  void findRuns();
  [[nodiscard]] double legLength() const;
  [[nodiscard]] std::pair<double, double> restExtents() const;
  [[nodiscard]] double longestPath() const;
  [[nodiscard]] double radiusOf(const Bone& bone) const;
  [[nodiscard]] double radiusPastEnd(const Bone& bone, double radius) const;
  [[nodiscard]] Lss lssOf(const Bone& bone) const;
  void addTerminalSphere(std::size_t joint, std::vector<Lss>& lss) const;
  [[nodiscard]] std::size_t size() const { return roles_.size(); }
  [[nodiscard]] std::size_t parentOf(std::size_t joint) const {  // size(): a root
    const JointId parent = clip_.skeleton.parent(static_cast<JointId>(joint));
    return parent == kNoParent ? size() : slotOf(parent);
  }

  const Clip& clip_;
  double radiusScale_;
  std::vector<BodyRole> roles_;
  std::vector<Eigen::Vector3d> offsets_;  ///< Per joint, from its parent; zero for roots.
  std::vector<Bone> bones_;               ///< Bones that end at a joint come before those that
                                          ///< start there.
  std::vector<bool> hasChild_;
  std::vector<double> runs_;  ///< Per joint: length of the limb (joints of one role) it is part of.
  double stature_ = 0.0;
};

BodyBuilder::BodyBuilder(const Clip& clip, double radiusScale)
    : clip_(clip), radiusScale_(radiusScale), roles_(internal::bodyRoles(clip.skeleton)) {
  findOffsets();
  findBones();
  findStature();
  findRuns();
}

/// If position channels move a joint and its OFFSET is zero, takes its place from the first frame.
void BodyBuilder::findOffsets() {
  for (std::size_t j = 0; j < size(); ++j) {
    Eigen::Vector3d offset = clip_.skeleton.restOffset(static_cast<JointId>(j));
    const bool isSilent = offset.isZero(0.0) && clip_.hasTranslation[j] && !clip_.frames.empty();
    if (isSilent) offset = clip_.frames.front().translations[j];
    offsets_.push_back(parentOf(j) == size() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : offset);
  }
}

void BodyBuilder::findBones() {
  hasChild_.assign(size(), false);
  const auto add = [this](std::size_t joint, std::size_t child, bool isTip,
                          const Eigen::Vector3d& toward) {
    bones_.push_back({joint, child, isTip, toward, toward.norm()});
  };
  for (std::size_t j = 0; j < size(); ++j) {
    const std::size_t parent = parentOf(j);
    if (parent != size()) {
      hasChild_[parent] = true;
      add(parent, j, false, offsets_[j]);
    }
    for (const Eigen::Vector3d& site : clip_.endSites[j]) add(j, j, true, site);
  }
}

/// From the legs, whose share of stature varies little; else from the rest pose; else, if all bones
/// lie along one axis at rest and there is no posture, from the longest path.
void BodyBuilder::findStature() {
  stature_ = legLength() / kLegPerStature;
  if (stature_ > 0.0) return;
  const auto [largest, second] = restExtents();
  stature_ = second >= kFlatRest * largest ? largest : longestPath() / kLongestPath;
}

/// Hip to ankle, the mean of all legs; 0 if the names show none.
double BodyBuilder::legLength() const {
  std::vector<internal::RoleBone> bones;
  bones.reserve(bones_.size());
  for (const Bone& bone : bones_) {
    const BodyRole next = bone.isTip ? BodyRole::Unknown : roles_[bone.child];
    bones.push_back({roles_[bone.joint], next, bone.isTip, bone.length});
  }
  return internal::legsOf(bones).length;
}

/// The largest and the second largest extent of the rest pose: height, and the span of the arms.
std::pair<double, double> BodyBuilder::restExtents() const {
  std::vector<Eigen::Vector3d> positions(size(), Eigen::Vector3d::Zero());
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = low;
  const auto include = [&](const Eigen::Vector3d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  };
  for (std::size_t j = 0; j < size(); ++j) {
    const std::size_t parent = parentOf(j);
    // A joint that carries the body is not part of its height.
    if (parent != size() && roles_[parent] != BodyRole::Root) {
      positions[j] = positions[parent] + offsets_[j];
    }
    include(positions[j]);
    for (const Eigen::Vector3d& site : clip_.endSites[j]) include(positions[j] + site);
  }
  std::array<double, 3> extents = {high.x() - low.x(), high.y() - low.y(), high.z() - low.z()};
  std::sort(extents.begin(), extents.end());
  return {extents[2], extents[1]};
}

/// The longest way from one end of the tree to another, along bones.
double BodyBuilder::longestPath() const {
  std::vector<double> deepest(size(), 0.0);
  double longest = 0.0;
  const auto extend = [&](std::size_t joint, double reach) {
    longest = std::max(longest, deepest[joint] + reach);
    deepest[joint] = std::max(deepest[joint], reach);
  };
  for (std::size_t j = size(); j-- > 0;) {  // children before parents
    for (const Eigen::Vector3d& site : clip_.endSites[j]) extend(j, site.norm());
    const std::size_t parent = parentOf(j);
    if (parent != size() && roles_[parent] != BodyRole::Root) {
      extend(parent, offsets_[j].norm() + deepest[j]);
    }
  }
  return longest;
}

/// A limb may be split into several joints (upperarm01, upperarm02): their lengths add up.
void BodyBuilder::findRuns() {
  std::vector<double> below(size(), 0.0);  // longest way down through joints of the same role
  for (std::size_t i = bones_.size(); i-- > 0;) {
    const Bone& bone = bones_[i];
    const bool goesOn = !bone.isTip && roles_[bone.child] == roles_[bone.joint];
    const double length = bone.length + (goesOn ? below[bone.child] : 0.0);
    below[bone.joint] = std::max(below[bone.joint], length);
  }
  std::vector<double> above(size(), 0.0);
  runs_.assign(size(), 0.0);
  for (std::size_t j = 0; j < size(); ++j) {
    const std::size_t parent = parentOf(j);
    if (parent != size() && roles_[parent] == roles_[j]) {
      above[j] = above[parent] + offsets_[j].norm();
    }
    runs_[j] = above[j] + below[j];
  }
}

double BodyBuilder::radiusOf(const Bone& bone) const {
  const BodyRole role = roles_[bone.joint];
  if (role == BodyRole::Unknown) {
    return std::min(kUnknownRadius * bone.length, radiusPerStature(BodyRole::Torso) * stature_);
  }
  double radius = radiusPerStature(role) * stature_;
  if (!isBlock(role)) radius = std::min(radius, kSlenderness * runs_[bone.joint]);
  if (!isTrunk(role) || bone.isTip) return radius;
  const double next = radiusPerStature(roles_[bone.child]) * stature_;
  // From the trunk to a limb: the limb's root, not more trunk. From the trunk to the neck: the
  // chest, which ends where the neck begins.
  const bool goesUp = isTrunk(roles_[bone.child]) || roles_[bone.child] == BodyRole::Neck ||
                      roles_[bone.child] == BodyRole::Head;
  if (roles_[bone.child] == BodyRole::Unknown) return std::min(radius, bone.length);
  return goesUp ? std::min(radius, bone.length + next) : std::min(radius, next);
}

/// How far the LSS may reach past the bone's end: as far as the next part is thick.
double BodyBuilder::radiusPastEnd(const Bone& bone, double radius) const {
  if (bone.isTip) return kTipSkin * radius;
  const double next = radiusPerStature(roles_[bone.child]) * stature_;
  return next > 0.0 ? std::min(radius, next) : radius;
}

/// The axis starts at the joint and ends before the bone does, so far that the round end stops
/// radiusPastEnd() after it. It still contains the bone, as it ends within a radius of its end.
Lss BodyBuilder::lssOf(const Bone& bone) const {
  const double radius = radiusOf(bone);
  const double inset = radiusScale_ * (radius - radiusPastEnd(bone, radius));
  Lss lss;
  lss.b = bone.toward * (std::max(0.0, bone.length - inset) / bone.length);
  lss.radius = radiusScale_ * radius;
  return lss;
}

/// Files often end at the wrist, the ankle or the base of the skull. There a sphere replaces the
/// missing part; heads and hands continue the bone before them, feet turn away from it.
void BodyBuilder::addTerminalSphere(std::size_t joint, std::vector<Lss>& lss) const {
  const BodyRole role = roles_[joint];
  const std::size_t parent = parentOf(joint);
  const bool endsBody = role == BodyRole::Head || role == BodyRole::Hand ||
                        role == BodyRole::Foot || role == BodyRole::Toe;
  // A "HeadTop" on a head, the end of a hand on a hand: the part is there already.
  if (!endsBody || hasChild_[joint] || (parent != size() && roles_[parent] == role)) return;
  Lss sphere;
  sphere.radius = radiusScale_ * radiusPerStature(role) * stature_;
  const double length = offsets_[joint].norm();
  const bool goesOn = role == BodyRole::Head || role == BodyRole::Hand;
  if (goesOn && length > kShortestBone * stature_) {
    sphere.a = offsets_[joint] * (kSphereAhead * sphere.radius / length);
  }
  sphere.b = sphere.a;
  lss.push_back(sphere);
}

std::vector<std::vector<Lss>> BodyBuilder::lssPerLink() const {
  std::vector<std::vector<Lss>> lss(size());
  for (const Bone& bone : bones_) {
    const bool isConnector = roles_[bone.joint] == BodyRole::Root;
    if (isConnector || bone.length <= kShortestBone * stature_) continue;
    lss[bone.joint].push_back(lssOf(bone));
  }
  for (std::size_t j = 0; j < size(); ++j) {
    if (lss[j].empty() && stature_ > 0.0) addTerminalSphere(j, lss[j]);
  }
  return lss;
}

}  // namespace

Result<Avatar> avatarFromClip(const Clip& clip, const BvhAvatarOptions& options) {
  if (!(options.radiusScale > 0.0) || !std::isfinite(options.radiusScale)) {
    return Error::of(ErrorCode::OutOfRange, "expected a radius scale above 0 and finite, found " +
                                                std::to_string(options.radiusScale));
  }
  const auto n = countOf(clip.skeleton.numJoints());
  if (clip.endSites.size() != n || clip.hasTranslation.size() != n) {
    return Error::of(ErrorCode::Mismatch,
                     "expected a clip with End Sites and channel flags for each of its " +
                         std::to_string(n) + " joints");
  }
  auto lss = BodyBuilder(clip, options.radiusScale).lssPerLink();
  const bool any = std::any_of(lss.begin(), lss.end(), [](const auto& l) { return !l.empty(); });
  if (!any) {
    return Error::of(ErrorCode::Empty,
                     "the skeleton has no bones: expected an OFFSET that is not zero below a root");
  }
  return Avatar::build(clip.skeleton, std::move(lss));
}

}  // namespace foretouch
