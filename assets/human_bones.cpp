#include "assets/human_bones.h"

#include <algorithm>
#include <set>

namespace foretouch {
namespace {

constexpr std::array<std::string_view, 7> kMiddle{"hips", "spine", "chest", "upperChest",
                                                  "neck", "head",  "jaw"};
/// One on each side: "leftShoulder", "rightShoulder".
constexpr std::array<std::string_view, 9> kLimbs{"Shoulder", "UpperArm", "LowerArm", "Hand", "Eye",
                                                 "UpperLeg", "LowerLeg", "Foot",     "Toes"};
constexpr std::array<std::string_view, 15> kFingers{
    "ThumbMetacarpal",   "ThumbProximal",      "ThumbDistal",      "IndexProximal",
    "IndexIntermediate", "IndexDistal",        "MiddleProximal",   "MiddleIntermediate",
    "MiddleDistal",      "RingProximal",       "RingIntermediate", "RingDistal",
    "LittleProximal",    "LittleIntermediate", "LittleDistal"};

/// The words of another scheme for kMiddle, kLimbs and kFingers, in their order, in small letters
/// and digits; empty: it has none.
struct Scheme {
  std::string_view left, right;
  bool sideIsBehind;
  std::array<std::string_view, 7> middle;
  std::array<std::string_view, 9> limbs;
  std::array<std::string_view, 15> fingers;
};

// The names of VRM, Unity and VMC in small letters; MotionBuilder's and Mixamo's; Bandai's;
// Biovision's, which call a bone by the joint that it begins with; Xsens' segments; CMU's bones in
// ASF; and SMPL's joints. A word that two schemes share may mean the same bone in both (hips). A
// word that means another bone in the other one (shoulder) is
// why only one scheme counts.
constexpr std::array<Scheme, 7> kSchemes{{
    {"left",
     "right",
     false,
     {"hips", "spine", "chest", "upperchest", "neck", "head", "jaw"},
     {"shoulder", "upperarm", "lowerarm", "hand", "eye", "upperleg", "lowerleg", "foot", "toes"},
     {"thumbmetacarpal", "thumbproximal", "thumbdistal", "indexproximal", "indexintermediate",
      "indexdistal", "middleproximal", "middleintermediate", "middledistal", "ringproximal",
      "ringintermediate", "ringdistal", "littleproximal", "littleintermediate", "littledistal"}},
    {"left",
     "right",
     false,
     {"hips", "spine", "spine1", "spine2", "neck", "head", ""},
     {"shoulder", "arm", "forearm", "hand", "eye", "upleg", "leg", "foot", "toebase"},
     {"handthumb1", "handthumb2", "handthumb3", "handindex1", "handindex2", "handindex3",
      "handmiddle1", "handmiddle2", "handmiddle3", "handring1", "handring2", "handring3",
      "handpinky1", "handpinky2", "handpinky3"}},
    {"l",
     "r",
     true,
     {"hips", "spine", "chest", "", "neck", "head", ""},
     {"shoulder", "upperarm", "lowerarm", "hand", "", "upperleg", "lowerleg", "foot", "toes"},
     {}},
    {"left",
     "right",
     false,
     {"hips", "chest", "chest2", "chest3", "neck", "head", ""},
     {"collar", "shoulder", "elbow", "wrist", "", "hip", "knee", "ankle", "toe"},
     {}},
    {"left",
     "right",
     false,
     {"pelvis", "l3", "t12", "t8", "neck", "head", ""},
     {"shoulder", "upperarm", "forearm", "hand", "", "upperleg", "lowerleg", "foot", "toe"},
     {}},
    {"l",
     "r",
     false,
     {"root", "lowerback", "upperback", "thorax", "lowerneck", "head", ""},
     {"clavicle", "humerus", "radius", "hand", "", "femur", "tibia", "foot", "toes"},
     {}},
    {"left",
     "right",
     false,
     {"pelvis", "spine1", "spine2", "spine3", "neck", "head", "jaw"},
     {"collar", "shoulder", "elbow", "wrist", "eye", "hip", "knee", "ankle", "foot"},
     {"thumb1", "thumb2", "thumb3", "index1", "index2", "index3", "middle1", "middle2", "middle3",
      "ring1", "ring2", "ring3", "pinky1", "pinky2", "pinky3"}},
}};

/// The name in small letters and digits, without a namespace.
std::string plain(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  if (colon != std::string_view::npos) name.remove_prefix(colon + 1);
  std::string word;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') word += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) word += c;
  }
  return word;
}

/// VRM's names of all bones; per scheme, its word for each.
struct Names {
  std::set<std::string, std::less<>> bones;
  std::array<std::map<std::string, std::string_view>, kSchemes.size()> boneOf;

  Names() {
    for (std::size_t i = 0; i < kMiddle.size(); ++i) {
      add(std::string(kMiddle[i]), [i](const Scheme& of) { return std::string(of.middle[i]); });
    }
    for (const bool isLeft : {true, false}) {
      for (std::size_t i = 0; i < kLimbs.size(); ++i) {
        addOfSide(isLeft, kLimbs[i], [i](const Scheme& of) { return of.limbs[i]; });
      }
      for (std::size_t i = 0; i < kFingers.size(); ++i) {
        addOfSide(isLeft, kFingers[i], [i](const Scheme& of) { return of.fingers[i]; });
      }
    }
  }

 private:
  template <typename WordIn>
  void addOfSide(bool isLeft, std::string_view bone, const WordIn& wordIn) {
    add((isLeft ? "left" : "right") + std::string(bone), [&](const Scheme& of) {
      const std::string word(wordIn(of)), side(isLeft ? of.left : of.right);
      if (word.empty()) return word;
      return of.sideIsBehind ? word + side : side + word;
    });
  }

  template <typename WordIn>
  void add(const std::string& bone, const WordIn& wordIn) {
    const std::string_view kept = *bones.insert(bone).first;
    for (std::size_t i = 0; i < kSchemes.size(); ++i) {
      if (const std::string word = wordIn(kSchemes[i]); !word.empty()) boneOf[i][word] = kept;
    }
  }
};

const Names& names() {
  static const Names all;
  return all;
}

}  // namespace

bool isHumanBone(std::string_view name) {
  return names().bones.count(name) != 0;
}

std::string thumbOf(const std::string& bone) {
  for (const std::string side : {"left", "right"}) {
    if (bone == side + "ThumbProximal") return side + "ThumbMetacarpal";
    if (bone == side + "ThumbIntermediate") return side + "ThumbProximal";
  }
  return bone;
}

std::string humanBoneOfUnity(std::string_view name) {
  std::string bone(name);
  if (bone.empty() || bone[0] < 'A' || bone[0] > 'Z') return {};
  bone[0] = static_cast<char>(bone[0] - 'A' + 'a');
  return thumbOf(bone);
}

bool isHumanoid(const Skeleton& skeleton) {
  return std::all_of(kRequiredHumanBones.begin(), kRequiredHumanBones.end(),
                     [&](std::string_view bone) { return skeleton.find(bone).has_value(); });
}

std::map<std::string_view, JointId> humanBonesOf(const Skeleton& skeleton) {
  for (const auto& boneOf : names().boneOf) {
    std::map<std::string_view, JointId> found;
    for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
      const auto bone = boneOf.find(plain(skeleton.name(joint)));
      if (bone != boneOf.end()) found.emplace(bone->second, joint);  // of several, the first
    }
    const bool isWhole = std::all_of(kRequiredHumanBones.begin(), kRequiredHumanBones.end(),
                                     [&](std::string_view bone) { return found.count(bone) != 0; });
    if (isWhole) return found;
  }
  return {};
}

}  // namespace foretouch
