#include "assets/bvh/bvh_roles.h"

#include <array>
#include <string>
#include <string_view>

#include "assets/human_bones.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

struct WordRole {
  std::string_view word;
  BodyRole role;
};

// The first word found in a name decides, so longer words come before those they contain ("forearm"
// before "arm") and fingers before the hand that their names mention.
constexpr std::array<WordRole, 52> kWords = {{
    {"spine", BodyRole::Torso},       {"armature", BodyRole::Root},
    {"fingerbase", BodyRole::Hand},   {"fingers", BodyRole::Hand},
    {"thumb", BodyRole::Finger},      {"index", BodyRole::Finger},
    {"middle", BodyRole::Finger},     {"ring", BodyRole::Finger},
    {"pinky", BodyRole::Finger},      {"little", BodyRole::Finger},
    {"metacarpal", BodyRole::Finger}, {"finger", BodyRole::Finger},
    {"forearm", BodyRole::Forearm},   {"lowerarm", BodyRole::Forearm},
    {"loarm", BodyRole::Forearm},     {"elbow", BodyRole::Forearm},
    {"collar", BodyRole::Clavicle},   {"clavicle", BodyRole::Clavicle},
    {"scapula", BodyRole::Clavicle},  {"shoulder", BodyRole::Clavicle},
    {"wrist", BodyRole::Hand},        {"hand", BodyRole::Hand},
    {"palm", BodyRole::Hand},         {"arm", BodyRole::UpperArm},
    {"humerus", BodyRole::UpperArm},  {"forefoot", BodyRole::Toe},
    {"toe", BodyRole::Toe},           {"foot", BodyRole::Foot},
    {"ankle", BodyRole::Foot},        {"heel", BodyRole::Foot},
    {"thigh", BodyRole::Thigh},       {"upleg", BodyRole::Thigh},
    {"upperleg", BodyRole::Thigh},    {"femur", BodyRole::Thigh},
    {"knee", BodyRole::Shin},         {"shin", BodyRole::Shin},
    {"calf", BodyRole::Shin},         {"shank", BodyRole::Shin},
    {"leg", BodyRole::Shin},          {"hip", BodyRole::Pelvis},
    {"pelvis", BodyRole::Pelvis},     {"neck", BodyRole::Neck},
    {"head", BodyRole::Head},         {"skull", BodyRole::Head},
    {"back", BodyRole::Torso},        {"chest", BodyRole::Torso},
    {"torso", BodyRole::Torso},       {"abdomen", BodyRole::Torso},
    {"waist", BodyRole::Torso},       {"thorax", BodyRole::Torso},
    {"root", BodyRole::Root},         {"reference", BodyRole::Root},
}};

/// The letters of a name in lower case, without a namespace ("mixamorig:") before it.
std::string letters(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  if (colon != name.npos && colon + 1 < name.size()) name.remove_prefix(colon + 1);
  std::string out;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if (c >= 'a' && c <= 'z') out += c;
  }
  return out;
}

BodyRole roleOfName(std::string_view name) {
  const std::string word = letters(name);
  for (const WordRole& entry : kWords) {
    if (word.find(entry.word) != word.npos) return entry.role;
  }
  return BodyRole::Unknown;
}

/// The roles in a skeleton whose joints are called by their part of the body. That comes before
/// what else a name may mean: "SkirtBack" is not a back. What carries the hips is a root.
std::vector<BodyRole> rolesOfHumanoid(const Skeleton& skeleton) {
  std::vector<BodyRole> roles;
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    const std::string& name = skeleton.name(j);
    roles.push_back(isHumanBone(name) ? roleOfName(name) : BodyRole::Unknown);
  }
  JointId above = skeleton.parent(*skeleton.find("hips"));
  for (; above != kNoParent; above = skeleton.parent(above)) roles[slotOf(above)] = BodyRole::Root;
  return roles;
}

}  // namespace

std::vector<BodyRole> bodyRoles(const Skeleton& skeleton) {
  if (isHumanoid(skeleton)) return rolesOfHumanoid(skeleton);
  const auto n = countOf(skeleton.numJoints());
  std::vector<BodyRole> named(n);
  std::vector<int> children(n, 0);
  for (std::size_t j = 0; j < n; ++j) named[j] = roleOfName(skeleton.name(static_cast<JointId>(j)));

  std::vector<BodyRole> roles = named;
  std::vector<bool> aboveHips(n, false);
  for (std::size_t j = 0; j < n; ++j) {
    const JointId parentId = skeleton.parent(static_cast<JointId>(j));
    if (parentId == kNoParent) continue;
    const auto parent = static_cast<std::size_t>(parentId);
    ++children[parent];
    aboveHips[parent] = aboveHips[parent] || named[j] == BodyRole::Pelvis;
    // Biovision calls joints by their articulation: there the shoulder moves the upper arm and the
    // hip the thigh. Elsewhere a shoulder carries an arm, and hips carry legs. A root does not move
    // a thigh.
    if (named[parent] == BodyRole::Clavicle && named[j] == BodyRole::Forearm) {
      roles[parent] = BodyRole::UpperArm;
    }
    if (named[parent] == BodyRole::Pelvis && named[j] == BodyRole::Shin) {
      const bool isHipJoint = skeleton.parent(parentId) != kNoParent;
      (isHipJoint ? roles[parent] : roles[j]) = BodyRole::Thigh;
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    // With nothing but hips below, a root only places the body; else it is the hips by another
    // name.
    if (roles[j] == BodyRole::Root && !(children[j] == 1 && aboveHips[j])) {
      roles[j] = BodyRole::Pelvis;
    }
  }
  return roles;
}

Legs legsOf(const std::vector<RoleBone>& bones) {
  Legs legs;
  double sum = 0.0;
  for (const RoleBone& bone : bones) {
    const bool isKnee = bone.role == BodyRole::Thigh && bone.next == BodyRole::Shin;
    const bool isAnkle = bone.role == BodyRole::Shin && (bone.next == BodyRole::Foot || bone.isTip);
    const bool isWithin =
        bone.role == bone.next && (bone.role == BodyRole::Thigh || bone.role == BodyRole::Shin);
    if (isKnee || isAnkle || isWithin) sum += bone.length;
    legs.knees += isKnee ? 1 : 0;
    legs.ankles += isAnkle ? 1 : 0;
  }
  if (legs.knees > 0) legs.length = sum / legs.knees;
  return legs;
}

// Girths in centimetres, divided by 2 pi and by the mean stature of 178.2: the means of 252 men,
// [Penrose85] (docs/formats.md). The rest is not in that table but our choice, with reasons in
// docs/formats.md.
double radiusPerStature(BodyRole role) {
  constexpr double kPerGirth = 1.0 / (2.0 * 3.14159265358979323846 * 178.2);
  switch (role) {
    case BodyRole::Unknown:
    case BodyRole::Root: return 0.0;
    case BodyRole::Pelvis: return 99.9 * kPerGirth;  // hip
    case BodyRole::Torso: return 92.6 * kPerGirth;   // abdomen
    case BodyRole::Neck: return 38.0 * kPerGirth;
    case BodyRole::UpperArm: return 32.3 * kPerGirth;  // biceps
    case BodyRole::Forearm: return 28.7 * kPerGirth;
    case BodyRole::Thigh: return 59.4 * kPerGirth;
    case BodyRole::Shin: return 38.6 * kPerGirth;  // knee, in place of the calf
    case BodyRole::Head: return 0.055;
    case BodyRole::Clavicle: return 0.04;
    case BodyRole::Hand: return 0.02;
    case BodyRole::Finger: return 0.0055;
    case BodyRole::Foot: return 0.022;
    case BodyRole::Toe: return 0.014;
  }
  return 0.0;
}

}  // namespace foretouch::internal
