// VRM avatars: the importer and what becomes an avatar, against the places that the test's own
// writer gave.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "assets/bvh/bvh_roles.h"
#include "assets/human_bones.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/model_files.h"
#include "tests/assets/vrm_writer.h"
#include "tests/support/holds.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using internal::BodyRole;
using nlohmann::json;

constexpr double kFloats = 1e-6;  // m; the files hold floats

Result<Model> imported(const VrmSample& sample, const char* name = "body.vrm") {
  const TempFolder folder;
  return importModel(folder.write(name, sample.file.glb()), withModelImporter());
}

Avatar avatarOf(const VrmSample& sample) {
  return avatarFromModel(imported(sample).value()).value().avatar;
}

std::vector<LinkState> restOf(const Avatar& avatar) {
  std::vector<LinkState> states;
  const Pose rest = restPose(avatar.skeleton());
  ChainMotion(avatar.skeleton(), rest, rest).statesAt(0.0, states);
  return states;
}

/// The link's first LSS, which its node states, in the world.
Lss statedIn(const Avatar& avatar, const std::string& link) {
  const LinkId id = *avatar.skeleton().find(link);
  const LinkState state = restOf(avatar)[static_cast<std::size_t>(id)];
  const Lss& lss = avatar.lss(id).front();
  return {state.p_WL + state.R_WL * lss.a, state.p_WL + state.R_WL * lss.b, lss.radius};
}

std::string notesOf(const VrmSample& sample) {
  std::string all;
  const auto model = imported(sample);
  for (const std::string& note : model.value().notes) all += note + "\n";
  return all;
}

TEST(VrmImport, CallsNodesByTheirPartOfTheBodyWhereTheyStand) {
  for (const VrmVersion version : {VrmVersion::Old, VrmVersion::One}) {
    const VrmSample sample = vrmSample(version);
    const Avatar avatar = avatarOf(sample);
    EXPECT_TRUE(isHumanoid(avatar.skeleton()));
    const std::vector<LinkState> rest = restOf(avatar);
    for (const auto& [name, frame] : sample.frameOf) {
      const auto link = avatar.skeleton().find(name);
      ASSERT_TRUE(link) << name;
      EXPECT_LT((rest[static_cast<std::size_t>(*link)].p_WL - frame.translation()).norm(), kFloats)
          << name;
    }
  }
}

TEST(VrmImport, IsReadWhateverTheFileIsCalled) {
  for (const char* const name : {"body.VRM", "body.glb"}) {
    const auto model = imported(vrmSample(VrmVersion::One), name);
    ASSERT_TRUE(model.ok()) << describe(model.error());
    EXPECT_GE(nodeNamed(model.value(), "leftUpperArm"), 0);
  }
}

TEST(VrmImport, CollidersAreLssWithTheirNodesTransform) {
  VrmSample sample = vrmSample(VrmVersion::One);
  const Avatar avatar = avatarOf(sample);
  const Lss head = statedIn(avatar, "head"), arm = statedIn(avatar, "leftUpperArm");
  const auto at = [&](const char* node, const Vector3d& p) {
    return Vector3d(sample.frameOf.at(node) * p);
  };
  EXPECT_LT((head.a - at("head", {0.01, 0.08, 0.02})).norm(), kFloats);
  EXPECT_EQ(head.a, head.b);
  EXPECT_NEAR(head.radius, 0.1, kFloats);
  EXPECT_LT((arm.a - at("leftUpperArm", {0.02, 0, 0.01})).norm(), kFloats);
  EXPECT_LT((arm.b - at("leftUpperArm", {0.25, 0.01, 0})).norm(), kFloats);
  EXPECT_NEAR(arm.radius, 0.05, kFloats);
  // The shape of the extension counts, not the far one that stands in for it.
  EXPECT_LT((statedIn(avatar, "neck").a - at("neck", {0, 0.02, 0})).norm(), kFloats);
}

TEST(VrmImport, AnUnevenScaleMakesALssThatContainsTheCollider) {
  VrmSample sample = vrmSample(VrmVersion::One);
  sample.file.root["nodes"][sample.nodeOf.at("head")]["scale"] = {1, 3, 2};
  EXPECT_NEAR(statedIn(avatarOf(sample), "head").radius, 0.3, kFloats);
}

TEST(VrmImport, OffsetsOfVrm0AreLeftHanded) {
  const VrmSample sample = vrmSample(VrmVersion::Old);
  const Lss head = statedIn(avatarOf(sample), "head");
  EXPECT_LT((head.a - sample.frameOf.at("head") * Vector3d(0.01, 0.08, -0.03)).norm(), kFloats);
  EXPECT_NEAR(head.radius, 0.1, kFloats);
}

TEST(VrmImport, TheMeshIsFittedBesideTheCollidersAndWithoutThem) {
  VrmSample sample = vrmSample(VrmVersion::One);
  const Avatar with = avatarOf(sample);
  sample.file.root["extensions"].erase("VRMC_springBone");
  const Avatar without = avatarOf(sample);
  for (LinkId link = 0; link < without.numLinks(); ++link) {
    const std::string& name = without.skeleton().name(link);
    const std::vector<Lss>& own = with.lss(*with.skeleton().find(name));
    const std::vector<Lss>& fitted = without.lss(link);
    const bool isStated = name == "head" || name == "leftUpperArm" || name == "neck";
    ASSERT_EQ(own.size(), fitted.size() + (isStated ? 1 : 0)) << name;
    EXPECT_EQ(fitted.empty(), name == "root" || name == "ROOT") << name;
  }
}

TEST(VrmImport, SaysWhatIsNotFollowedAndNotHeld) {
  const std::string notes = notesOf(vrmSample(VrmVersion::One));
  EXPECT_TRUE(holds(notes, "spring bones are not followed: 2 of hair or clothes")) << notes;
  EXPECT_TRUE(holds(notes, "VRMC_node_constraint is not followed: 1 nodes")) << notes;
  EXPECT_TRUE(holds(notes, "2 colliders of VRMC_springBone_extended_collider")) << notes;
  EXPECT_TRUE(holds(notes, "3 spheres and capsules")) << notes;
  EXPECT_TRUE(holds(notes, "19 nodes are called by their part of the body")) << notes;
  EXPECT_FALSE(holds(notes, "passed over")) << notes;
  const std::string old = notesOf(vrmSample(VrmVersion::Old));
  EXPECT_TRUE(holds(old, "faces -z")) << old;
  EXPECT_TRUE(holds(old, "spring bones are not followed: 2 of hair")) << old;
}

TEST(VrmImport, PartsOfTheBodyComeBeforeWhatNamesMean) {
  const Avatar avatar = avatarOf(vrmSample(VrmVersion::One));
  const std::vector<BodyRole> roles = internal::bodyRoles(avatar.skeleton());
  const auto roleOf = [&](const char* name) {
    return roles[static_cast<std::size_t>(*avatar.skeleton().find(name))];
  };
  EXPECT_EQ(roleOf("root"), BodyRole::Root);
  EXPECT_EQ(roleOf("hips"), BodyRole::Pelvis);
  EXPECT_EQ(roleOf("chest"), BodyRole::Torso);
  EXPECT_EQ(roleOf("leftLowerArm"), BodyRole::Forearm);
  EXPECT_EQ(roleOf("rightLowerLeg"), BodyRole::Shin);
  EXPECT_EQ(roleOf("leftThumbMetacarpal"), BodyRole::Finger);
  EXPECT_EQ(roleOf("SkirtBack"), BodyRole::Unknown);  // a back by its name
}

TEST(VrmImport, NoOtherNodeHasTheNameOfAPart) {
  VrmSample sample = vrmSample(VrmVersion::One);
  sample.file.root["nodes"][sample.nodeOf.at("root")]["name"] = "head";
  const Avatar avatar = avatarOf(sample);
  const LinkId head = *avatar.skeleton().find("head");
  EXPECT_LT((restOf(avatar)[static_cast<std::size_t>(head)].p_WL - placeInTPose("head")).norm(),
            kFloats);
  EXPECT_TRUE(avatar.skeleton().find("head#2"));
}

using Damage = std::function<void(VrmSample&)>;

std::string refusalOf(VrmVersion version, const Damage& damage) {
  VrmSample sample = vrmSample(version);
  damage(sample);
  const auto model = imported(sample);
  return model.ok() ? "" : describe(model.error());
}

TEST(VrmImport, RefusesWhatIsMalformedWithItsPlace) {
  const auto bones = [](VrmSample& s) -> json& {
    return s.extension("VRMC_vrm")["humanoid"]["humanBones"];
  };
  const auto collider = [](VrmSample& s) -> json& {
    return s.extension("VRMC_springBone")["colliders"][0];
  };
  const std::vector<std::pair<Damage, std::string>> cases{
      {[&](VrmSample& s) { s.extension("VRMC_vrm") = 3; },
       "extensions.VRMC_vrm: expected an object"},
      {[&](VrmSample& s) { s.extension("VRMC_vrm").erase("humanoid"); },
       "extensions.VRMC_vrm.humanoid: expected this key"},
      {[&](VrmSample& s) { bones(s) = json::array(); }, "humanBones: expected an object"},
      {[&](VrmSample& s) { bones(s)["head"] = json::object(); },
       "humanBones.head.node: expected this key"},
      {[&](VrmSample& s) { bones(s)["head"]["node"] = 9999; },
       "humanBones.head.node: expected the number of one of"},
      {[&](VrmSample& s) { bones(s)["head"]["node"] = -1; }, "humanBones.head.node"},
      {[&](VrmSample& s) { bones(s)["neck"]["node"] = bones(s)["head"]["node"]; },
       "'neck'.node: expected a node of its own"},
      {[&](VrmSample& s) { collider(s)["node"] = 9999; }, "colliders[0].node: expected the number"},
      {[&](VrmSample& s) { collider(s).erase("shape"); }, "colliders[0].shape: expected this key"},
      {[&](VrmSample& s) { collider(s)["shape"] = json::object(); },
       "colliders[0].shape: expected a sphere or a capsule"},
      {[&](VrmSample& s) { collider(s)["shape"]["sphere"]["radius"] = -0.1; },
       "colliders[0]: expected a radius of at least 0"},
      {[&](VrmSample& s) { collider(s)["shape"]["sphere"]["radius"] = "wide"; },
       "colliders[0].shape.sphere.radius: expected a number"},
      {[&](VrmSample& s) {
         collider(s)["shape"]["sphere"]["offset"] = {0, 1e9, 0};
       },
       "colliders[0]: expected a radius of at least 0, and numbers within 1e7"},
      {[&](VrmSample& s) {
         collider(s)["shape"]["sphere"]["offset"] = {0, 1};
       },
       "offset: expected a list of 3 numbers"},
      {[&](VrmSample& s) { s.extension("VRMC_springBone")["colliders"] = json::object(); },
       "colliders: expected a list"},
      {[&](VrmSample& s) {
         json& all = s.extension("VRMC_springBone")["colliders"];
         const json one = all[0];
         for (int i = 0; i < 5000; ++i) all.push_back(one);
       },
       "more than 4096 spheres and capsules"}};
  for (const auto& [damage, expected] : cases) {
    const std::string refusal = refusalOf(VrmVersion::One, damage);
    EXPECT_TRUE(holds(refusal, expected)) << expected << "\n" << refusal;
    EXPECT_TRUE(holds(refusal, "body.vrm")) << refusal;
  }
}

TEST(VrmImport, RefusesWhatIsMalformedInVrm0WithItsPlace) {
  const auto bones = [](VrmSample& s) -> json& {
    return s.extension("VRM")["humanoid"]["humanBones"];
  };
  const auto group = [](VrmSample& s) -> json& {
    return s.extension("VRM")["secondaryAnimation"]["colliderGroups"][0];
  };
  const std::vector<std::pair<Damage, std::string>> cases{
      {[&](VrmSample& s) { bones(s) = 1; }, "humanBones: expected a list"},
      {[&](VrmSample& s) { bones(s)[0]["node"] = 9999; },
       "humanBones[0].node: expected the number"},
      {[&](VrmSample& s) { bones(s)[0].erase("bone"); }, "humanBones[0].bone: expected this key"},
      {[&](VrmSample& s) { bones(s)[1]["bone"] = bones(s)[0]["bone"]; },
       "humanBones[1]: expected the bone 'hips' once"},
      {[&](VrmSample& s) { group(s)["node"] = -1; }, "colliderGroups[0].node"},
      {[&](VrmSample& s) { group(s)["colliders"][0]["radius"] = -1; },
       "colliderGroups[0].colliders[0]: expected a radius"},
      {[&](VrmSample& s) { group(s)["colliders"][0]["offset"]["z"] = "near"; },
       "offset.z: expected a number"}};
  for (const auto& [damage, expected] : cases) {
    const std::string refusal = refusalOf(VrmVersion::Old, damage);
    EXPECT_TRUE(holds(refusal, expected)) << expected << "\n" << refusal;
  }
}

TEST(VrmImport, NotesWhatItCannotUse) {
  VrmSample sample = vrmSample(VrmVersion::One);
  json& vrm = sample.extension("VRMC_vrm");
  vrm["specVersion"] = "2.0";
  vrm["humanoid"]["humanBones"].erase("spine");
  vrm["humanoid"]["humanBones"]["tail"] = {{"node", sample.nodeOf.at("hair")}};
  const std::string notes = notesOf(sample);
  EXPECT_TRUE(holds(notes, "VRMC_vrm says of itself the specVersion")) << notes;
  EXPECT_TRUE(holds(notes, "lacks bones that VRM requires: 'spine'")) << notes;
  EXPECT_TRUE(holds(notes, "'tail' is no bone of a VRM humanoid")) << notes;
}

}  // namespace
}  // namespace foretouch::test
