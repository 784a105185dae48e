// importModel() on FBX files that the test writes, against the formula of FBX: pivots, orders of
// rotation, units and axes, at rest and in motion.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "assets/avatar/joint_match.h"
#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/fbx_writer.h"
#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"
#include "tests/support/random_geometry.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr double kNear = 1e-5;  // metres
constexpr double kKeysPerS = 4.0;
constexpr int kKeys = 5;

enum class Pivots { None, Turns, All };

/// Bones of a hand's length, turned and keyed at random.
FbxFile randomFile(std::uint64_t seed, Pivots pivots) {
  Random random(seed);
  FbxFile file;
  file.stopS = (kKeys - 1) / kKeysPerS;
  for (int i = 0; i < 6; ++i) {
    FbxNode node;
    node.name = "bone " + std::to_string(i);
    node.parent = i - 1 - (i > 2 ? random.below(2) : 0);
    node.translation = random.inBox(20);
    node.rotation = random.inBox(170);
    node.rotationOrder = random.below(6);
    if (random.below(3) == 0) node.scaling = Vector3d::Constant(random.uniform(0.5, 2.0));
    if (pivots != Pivots::None && random.below(3) > 0) node.preRotation = random.inBox(170);
    if (pivots != Pivots::None && random.below(2) > 0) node.postRotation = random.inBox(170);
    if (pivots == Pivots::All) {
      for (Vector3d* const pivot :
           {&node.rotationOffset, &node.rotationPivot, &node.scalingOffset, &node.scalingPivot}) {
        if (random.below(2) > 0) *pivot = random.inBox(10);
      }
    }
    file.nodes.push_back(node);
  }
  return file;
}

/// Of the components that `picks` names (bits, from x), around the node's own value.
void key(FbxCurves& curves, const Vector3d& usual, double reach, int picks, Random& random) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    if ((picks >> i & 1) == 0) continue;
    for (int k = 0; k < kKeys; ++k) {
      curves[static_cast<std::size_t>(i)].emplace_back(k / kKeysPerS,
                                                       usual[i] + random.uniform(-reach, reach));
    }
  }
}

class ImportFbx : public testing::Test {
 protected:
  Model read(const FbxFile& file, const ModelImportOptions& options = withModelImporter()) {
    auto model = importModel(folder_.write("file.fbx", file.text()), options);
    if (model.ok()) return std::move(model).value();
    ADD_FAILURE() << describe(model.error());
    return {};
  }
  /// The positions of a clip's joints, by name.
  static std::map<std::string, Vector3d> positionsIn(const Clip& clip, std::size_t frame) {
    std::vector<LinkState> states;
    ChainMotion(clip.skeleton, clip.frames[frame], clip.frames[frame]).statesAt(0.0, states);
    std::map<std::string, Vector3d> positions;
    for (std::size_t j = 0; j < states.size(); ++j) {
      positions[clip.skeleton.name(static_cast<JointId>(j))] = states[j].p_WL;
    }
    return positions;
  }
  static Clip clipOf(const Model& model) {
    auto clip = clipFromModel(model, {"", kKeysPerS});
    if (clip.ok()) return std::move(clip).value();
    ADD_FAILURE() << describe(clip.error());
    return {};
  }
  /// Every node of the file stands in every frame where the formula says, in metres with +Y up.
  static void expectMoves(const Clip& clip, const FbxFile& file, const std::string& what) {
    ASSERT_EQ(clip.frames.size(), std::size_t{kKeys}) << what;
    std::size_t compared = 0;
    for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
      const auto found = positionsIn(clip, frame);
      const auto expected = file.framesAt(static_cast<double>(frame) / kKeysPerS);
      for (std::size_t i = 0; i < file.nodes.size(); ++i) {
        Vector3d p = expected[i].translation() * (file.unitScaleFactor / 100.0);
        if (file.upAxis == 2) p = Vector3d(p.x(), p.z(), -p.y());
        if (found.count(file.nodes[i].name) == 0) continue;  // nothing moves this end: no link
        ++compared;
        EXPECT_LT((found.at(file.nodes[i].name) - p).norm(), kNear)
            << what << ", " << file.nodes[i].name << ", frame " << frame;
      }
    }
    EXPECT_GE(compared, clip.frames.size() * (file.nodes.size() + 1) / 2) << what;
  }

  TempFolder folder_;
};

TEST_F(ImportFbx, CamerasAndLightsAreNoJointsHoweverTheyMove) {
  const FbxCurve moves{{0.0, 0.0}, {1.0, 50.0}};
  const auto moving = [&](const char* name, int parent, const char* onlooker = "") {
    FbxNode node;
    node.name = name;
    node.parent = parent;
    node.translation = {0, 10, 0};
    node.translations[0] = moves;
    node.preRotation = {0, 0, 20};  // makes a chain of pivots
    node.onlooker = onlooker;
    return node;
  };
  FbxFile file;
  file.stopS = 1.0;
  file.nodes = {moving("hips", -1),          moving("head", 0),
                moving("view", 1, "Camera"), moving("crane", -1),
                moving("boom", 3),           moving("shot", 4, "Camera"),
                moving("lamp", -1, "Light"), moving("rig", -1, "Camera"),
                moving("carried", 7),        moving("hand", 0)};
  const Skeleton skeleton = clipOf(read(file)).skeleton;
  std::set<std::string> names;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) names.insert(skeleton.name(joint));
  for (const char* const joint : {"hips", "head", "hand", "rig", "carried"}) {
    EXPECT_EQ(names.count(joint), 1u) << joint << ": a camera's parent or child may be a bone";
  }
  for (const char* const none : {"view", "crane", "boom", "shot", "lamp"}) {
    EXPECT_EQ(names.count(none), 0u) << none;
  }
}

TEST_F(ImportFbx, PlacesNodesAtRestAsTheFormulaSays) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    FbxFile file = randomFile(seed, seed % 2 == 0 ? Pivots::All : Pivots::Turns);
    file.nodes.back().hasMesh = true;
    const Model model = read(file);
    const auto expected = file.frames();
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
      const Affine found = toWorld(model, nodeNamed(model, file.nodes[i].name));
      EXPECT_LT((found.translation - expected[i].translation() / 100.0).norm(), kNear)
          << "seed " << seed << ", node " << i;
      EXPECT_LT((found.linear - expected[i].linear()).norm(), kNear)
          << "seed " << seed << ", node " << i;
    }
  }
}

TEST_F(ImportFbx, MovesNodesAsTheFormulaSays) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    FbxFile file = randomFile(seed, static_cast<Pivots>(seed % 3));
    Random random(seed + 1000);
    for (FbxNode& node : file.nodes) {
      const bool isTurned = &node == &file.nodes.front() || random.below(4) > 0;
      if (isTurned) key(node.rotations, node.rotation, 100, 7, random);
      if (random.below(2) > 0) key(node.translations, node.translation, 10, 7, random);
    }
    expectMoves(clipOf(read(file)), file, "seed " + std::to_string(seed));
  }
}

TEST_F(ImportFbx, KeepsTheNodesOwnValueWhereAComponentHasNoCurve) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    FbxFile file = randomFile(seed, seed % 2 == 0 ? Pivots::None : Pivots::Turns);
    Random random(seed + 2000);
    for (FbxNode& node : file.nodes) {
      const bool isFirst = &node == &file.nodes.front();
      key(node.rotations, node.rotation, 100, isFirst ? 7 : random.below(8), random);
      key(node.translations, node.translation, 10, random.below(8), random);
    }
    expectMoves(clipOf(read(file)), file, "seed " + std::to_string(seed));
  }
}

TEST_F(ImportFbx, SaysWhereANodeWithPivotsLacksACurve) {
  FbxFile file;
  file.stopS = (kKeys - 1) / kKeysPerS;
  FbxNode door;
  door.name = "door";
  door.translation = Vector3d(10, 20, 30);
  door.rotation = Vector3d(40, 0, 0);
  door.rotationPivot = Vector3d(5, 0, 0);
  file.nodes = {door};
  Random random(3);
  key(file.nodes[0].rotations, door.rotation, 90, 7, random);
  EXPECT_TRUE(read(file).notes.empty());
  for (const bool isOfRotation : {true, false}) {
    FbxFile other = file;
    FbxNode& moved = other.nodes[0];
    key(moved.translations, door.translation, 9, 7, random);
    if (isOfRotation) {
      moved.rotations[0].clear();  // turns about y alone, though it rests turned about x
      moved.rotations[2].clear();
    } else {
      moved.translations[1].clear();
    }
    const Model model = read(other);
    ASSERT_EQ(model.notes.size(), 1U);
    EXPECT_EQ(model.notes[0],
              "the animation of 'door' has no curve for a part of its translation or rotation, "
              "which becomes 0");
  }
}

// Straight lines join keys, whatever the file says of the way between them.
TEST_F(ImportFbx, CountsCurvesOfCubicKeys) {
  FbxFile file;
  file.stopS = (kKeys - 1) / kKeysPerS;
  file.nodes.emplace_back();
  file.nodes[0].name = "door";
  Random random(5);
  key(file.nodes[0].rotations, Vector3d::Zero(), 90, 7, random);
  std::string text = file.text();
  const std::string linear = "KeyAttrFlags: *1 {\n\t\t\ta: 4";
  const std::size_t first = text.find(linear), second = text.find(linear, first + 1);
  ASSERT_NE(second, std::string::npos);
  for (const std::size_t at : {second, first}) text.insert(at + linear.size() - 1, "26");  // 264
  const auto model = importModel(folder_.write("cubic.fbx", text), withModelImporter());
  ASSERT_TRUE(model.ok()) << describe(model.error());
  ASSERT_EQ(model.value().notes.size(), 1U);
  EXPECT_EQ(model.value().notes[0].rfind("the cubic keys of 2 animation curves are joined", 0), 0U)
      << model.value().notes[0];
}

TEST_F(ImportFbx, CountsCurvesOfCubicKeysInBinaryFiles) {
  FORETOUCH_REQUIRE_SHARED(path, "avatars/pab_run.fbx");
  const auto model = importModel(*path, withModelImporter());
  ASSERT_TRUE(model.ok()) << describe(model.error());
  const auto& notes = model.value().notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.rfind("the cubic keys of 549 animation curves", 0) == 0;
  }));
}

/// A door frame, with Z up, in inches.
FbxFile inInchesZUp() {
  FbxFile file;
  file.unitScaleFactor = 2.54;
  file.upAxis = 2;
  file.stopS = (kKeys - 1) / kKeysPerS;
  FbxNode hinge;
  hinge.name = "hinge";
  hinge.translation = Vector3d(10, 20, 40);
  hinge.preRotation = Vector3d(0, 90, 0);
  hinge.hasMesh = true;
  Random random(7);
  key(hinge.rotations, hinge.rotation, 90, 7, random);
  file.nodes.push_back(hinge);
  return file;
}

TEST_F(ImportFbx, BringsModelsToMetresAndYUpAsTheySay) {
  const FbxFile file = inInchesZUp();
  const Model model = read(file);
  EXPECT_EQ(model.frame.declared.metresPerUnit, 0.0254);
  EXPECT_EQ(model.frame.declared.up, UpAxis::Z);
  EXPECT_EQ(describe(model.frame), "says 0.0254 m per unit and Z up; both applied");
  EXPECT_TRUE(toWorld(model, nodeNamed(model, "hinge"))
                  .translation.isApprox(Vector3d(0.254, 1.016, -0.508), 1e-6));
  expectMoves(clipOf(model), file, "as it says");
}

TEST_F(ImportFbx, TakesAnOptionInPlaceOfWhatTheFileSays) {
  const FbxFile file = inInchesZUp();
  ModelImportOptions options = withModelImporter();
  options.import.scale = 0.0254;
  options.import.up = UpAxis::Z;
  const Model repeated = read(file, options);
  EXPECT_EQ(difference(repeated, read(file)), "") << "what repeats the file changes nothing";
  options.import.scale = 0.01;
  options.import.up = UpAxis::Y;
  const Model model = read(file, options);
  EXPECT_EQ(describe(model.frame), "says 0.0254 m per unit and Z up; read otherwise, as asked");
  EXPECT_TRUE(toWorld(model, nodeNamed(model, "hinge"))
                  .translation.isApprox(Vector3d(0.1, 0.2, 0.4), 1e-6));
  FbxFile inCentimetres = file;
  inCentimetres.unitScaleFactor = 1.0;
  inCentimetres.upAxis = 1;
  expectMoves(clipOf(model), inCentimetres, "as asked");
}

/// As other programs write the same scene with Y up: turned at its top.
FbxFile withYUp(FbxFile file) {
  FbxNode& top = file.nodes.front();
  top.translation = Vector3d(top.translation.x(), top.translation.z(), -top.translation.y());
  top.preRotation = Vector3d(-90, 0, 0);
  file.upAxis = 1;
  return file;
}

TEST_F(ImportFbx, MovesABodyByAnAnimationWithAnotherAxisAndUnit) {
  Random random(11);
  FbxFile body;
  body.upAxis = 2;
  for (int i = 0; i < 3; ++i) {
    FbxNode bone;
    bone.name = "bone" + std::to_string(i);
    bone.parent = i - 1;
    bone.translation = random.inBox(50);
    body.nodes.push_back(bone);
  }
  body.nodes.back().hasMesh = true;
  FbxFile animation = withYUp(body);
  animation.unitScaleFactor = 2.54;
  animation.stopS = (kKeys - 1) / kKeysPerS;
  for (FbxNode& bone : animation.nodes) {
    bone.translation /= 2.54;
    bone.hasMesh = false;
    key(bone.rotations, bone.rotation, 90, 7, random);
  }
  const auto made = avatarFromModel(read(body));
  ASSERT_TRUE(made.ok()) << describe(made.error());
  const Skeleton& skeleton = made.value().avatar.skeleton();
  const Clip clip = clipOf(read(animation));
  const auto match = matchJoints(skeleton, clip.skeleton);
  ASSERT_TRUE(match.ok());
  for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
    const Pose pose = poseOfAvatar(skeleton, clip, match.value(), frame);
    std::vector<LinkState> states;
    ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
    const auto expected = animation.framesAt(static_cast<double>(frame) / kKeysPerS);
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
      const std::size_t joint = i + 1;  // below the file's own root
      EXPECT_EQ(skeleton.name(static_cast<JointId>(joint)), body.nodes[i].name);
      EXPECT_LT((states[joint].p_WL - 0.0254 * expected[i].translation()).norm(), kNear)
          << "frame " << frame << ", bone " << i;
    }
  }
}

TEST_F(ImportFbx, BringsScenesToMetresAndYUpAsTheySay) {
  FbxFile file = inInchesZUp();
  file.nodes[0].preRotation = Vector3d::Zero();
  const std::string path = folder_.write("file.fbx", file.text());
  const auto cornerOf = [&](const SceneImportOptions& options) -> Vector3d {
    const auto scene = importScene(path, options);
    if (!scene.ok()) ADD_FAILURE() << describe(scene.error());
    return scene.ok() ? scene.value().scene.triangles.at(0).vertices[2] : Vector3d::Zero();
  };
  SceneImportOptions options = withImporter();
  EXPECT_TRUE(cornerOf(options).isApprox(Vector3d(0.254, 1.016, -0.5588), 1e-6));
  options.up = UpAxis::Z;
  options.scale = 0.0254;
  EXPECT_TRUE(cornerOf(options).isApprox(Vector3d(0.254, 1.016, -0.5588), 1e-6));
  options.up = UpAxis::Y;
  options.scale = 1.0;
  EXPECT_TRUE(cornerOf(options).isApprox(Vector3d(10, 22, 40), 1e-6));
}

}  // namespace
}  // namespace foretouch::test
