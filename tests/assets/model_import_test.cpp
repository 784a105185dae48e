// importModel() on small models made here: what becomes of nodes, skins, animations, units and
// axes.
#include "assets/import/model_import.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

class ImportModel : public testing::Test {
 protected:
  Model written(const std::string& name, std::string_view content,
                const ModelImportOptions& options = withModelImporter()) {
    auto result = importModel(folder_.write(name, content), options);
    if (!result.ok()) {
      ADD_FAILURE() << describe(result.error());
      return {};
    }
    return std::move(result).value();
  }
  Error failureOf(const std::string& name, std::string_view content) {
    const std::string path = folder_.write(name, content);
    const auto result = importModel(path, withModelImporter());
    if (result.ok()) {
      ADD_FAILURE() << name << " was imported";
      return {};
    }
    EXPECT_EQ(result.error().file, path);
    EXPECT_FALSE(hasChildren());
    return result.error();
  }

  TempFolder folder_;
};

TEST_F(ImportModel, KeepsNodesMeshesBonesAndWeights) {
  const Model model = written("leg.gltf", skinnedGltf());
  ASSERT_EQ(model.nodes.size(), 4U);
  const auto body = nodeNamed(model, "body"), hip = nodeNamed(model, "hip"),
             knee = nodeNamed(model, "knee"), skin = nodeNamed(model, "skin");
  EXPECT_EQ(model.nodes[body].parent, -1);
  EXPECT_EQ(model.nodes[hip].parent, body);
  EXPECT_EQ(model.nodes[knee].parent, hip);
  EXPECT_EQ(model.nodes[skin].parent, body);
  EXPECT_EQ(model.nodes[knee].toParent.translation, Vector3d(0, 1, 0));
  EXPECT_EQ(model.nodes[knee].joint, ModelJointType::Free);
  ASSERT_EQ(model.meshes.size(), 1U);
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.node, skin);
  EXPECT_EQ(mesh.vertices, (std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}}));
  ASSERT_EQ(mesh.bones.size(), 2U);
  EXPECT_EQ(mesh.bones[0].node, hip);
  EXPECT_EQ(mesh.bones[1].node, knee);
  EXPECT_EQ(mesh.bones[1].meshToBone.translation, Vector3d(0, -1, 0));
  double sum = 0;
  for (const auto& weight : mesh.bones[1].weights) {
    sum += weight.weight;
    if (weight.vertex == 2) {
      EXPECT_EQ(weight.weight, 0.75);
    }
  }
  EXPECT_EQ(sum, 1.75);
}

TEST_F(ImportModel, GivesAnimationKeysInSecondsAndMetres) {
  const Model model = written("leg.gltf", skinnedGltf());
  ASSERT_EQ(model.animations.size(), 1U);
  const ModelAnimation& bend = model.animations[0];
  EXPECT_EQ(bend.name, "bend");
  EXPECT_NEAR(bend.durationS, 2.0, 1e-6);
  int checked = 0;
  for (const ModelTrack& track : bend.tracks) {
    if (track.node == nodeNamed(model, "knee")) {
      ASSERT_EQ(track.rotations.size(), 2U);
      EXPECT_NEAR(track.rotations[1].timeS, 2.0, 1e-6);
      EXPECT_NEAR(track.rotations[1].value.w(), std::sqrt(0.5), 1e-6);
      EXPECT_NEAR(track.rotations[1].value.x(), std::sqrt(0.5), 1e-6);
      ++checked;
    }
    if (track.node == nodeNamed(model, "hip")) {
      ASSERT_EQ(track.positions.size(), 2U);
      EXPECT_EQ(track.positions[1].value, Vector3d(0, 0.5, 0));
      ++checked;
    }
  }
  EXPECT_EQ(checked, 2);
}

TEST_F(ImportModel, ScalesLengthsAndTurnsRootsAlone) {
  ModelImportOptions options = withModelImporter();
  options.import.scale = 0.01;
  options.import.up = UpAxis::Z;
  const Model plain = written("leg.gltf", skinnedGltf());
  const Model placed = written("leg.gltf", skinnedGltf(), options);
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  ASSERT_EQ(placed.nodes.size(), plain.nodes.size());
  for (std::size_t i = 0; i < plain.nodes.size(); ++i) {
    // The same place in the world, scaled and turned ...
    const Affine from = toWorld(plain, static_cast<std::int32_t>(i));
    const Affine to = toWorld(placed, static_cast<std::int32_t>(i));
    EXPECT_TRUE(to.linear.isApprox(turn * from.linear, 1e-12)) << i;
    EXPECT_LT((to.translation - 0.01 * turn * from.translation).norm(), 1e-12) << i;
    // ... with frames below the root as they were.
    if (plain.nodes[i].parent >= 0) {
      EXPECT_EQ(placed.nodes[i].toParent.linear, plain.nodes[i].toParent.linear);
    }
  }
  EXPECT_LT((placed.meshes[0].vertices[1] - Vector3d(0.01, 0, 0)).norm(), 1e-15);
  EXPECT_LT((placed.meshes[0].bones[1].meshToBone.translation - Vector3d(0, -0.01, 0)).norm(),
            1e-15);
  for (const ModelTrack& track : placed.animations[0].tracks) {
    if (track.node != nodeNamed(placed, "hip")) continue;
    EXPECT_LT((track.positions[1].value - Vector3d(0, 0.005, 0)).norm(), 1e-15);
  }
}

TEST_F(ImportModel, TurnsAnimationsOfTheRoot) {
  std::string gltf = skinnedGltf();
  // The same animation, but of the node "body" in place of the hip.
  const std::string target = R"("node":1,"path":"translation")";
  gltf.replace(gltf.find(target), target.size(), R"("node":0,"path":"translation")");
  const std::string other = R"("node":2,"path":"rotation")";
  gltf.replace(gltf.find(other), other.size(), R"("node":0,"path":"rotation")");
  ModelImportOptions options = withModelImporter();
  options.import.up = UpAxis::Z;
  const Model model = written("root.gltf", gltf, options);
  ASSERT_EQ(model.animations.at(0).tracks.size(), 1U);
  const ModelTrack& track = model.animations[0].tracks[0];
  // (x, y, z) becomes (x, z, -y).
  EXPECT_LT((track.positions[1].value - Vector3d(0, 0, -0.5)).norm(), 1e-12);
  // A quarter about x takes y to z; turned, z is up.
  EXPECT_LT((track.rotations[1].value * Vector3d(0, 1, 0) - Vector3d(0, 1, 0)).norm(), 1e-6);
  EXPECT_LT((track.rotations[0].value * Vector3d(0, 0, 1) - Vector3d(0, 1, 0)).norm(), 1e-6);
}

TEST_F(ImportModel, PlacesAMeshOncePerNode) {
  const Model model = written(
      "twice.gltf",
      gltfWithNodes(
          R"([{"name":"a","mesh":0,"children":[1]},{"name":"b","mesh":0,"translation":[5,0,0]}])"));
  ASSERT_EQ(model.meshes.size(), 2U);
  EXPECT_EQ(model.meshes[0].node, nodeNamed(model, "a"));
  EXPECT_EQ(model.meshes[1].node, nodeNamed(model, "b"));
  EXPECT_EQ(model.meshes[0].vertices, model.meshes[1].vertices);  // in the node's frame
}

/// A mesh skinned to "knee", on a node of that name, and behind it the knee, at (x, 1, 0).
std::string kneesAsX(const std::string& x) {
  const std::string axes = "1.0,0.0,0.0,0.0, 0.0,1.0,0.0,0.0, 0.0,0.0,1.0,0.0, ";
  const std::string still = "FrameTransformMatrix { " + axes + "0.0,0.0,0.0,1.0;; }\n";
  return "xof 0303txt 0032\nFrame body {\n" + still + "Frame knee {\n" + still +
         "Mesh leg { 3; 0.0;0.0;0.0;, 1.0;0.0;0.0;, 0.0;1.0;0.0;; 1; 3;0,1,2;;\n"
         "XSkinMeshHeader { 1; 1; 1; }\nSkinWeights { \"knee\"; 3; 0, 1, 2; 1.0, 1.0, 1.0; " +
         axes + "0.0,-1.0,0.0,1.0;; }\n}\n}\nFrame knee {\nFrameTransformMatrix { " + axes + x +
         ",1.0,0.0,1.0;; }\n}\n}\n";
}

// assimp tells of bones by their names alone.
TEST_F(ImportModel, PrefersNodesWithoutAMeshForBonesOfTheirName) {
  const Model model = written("same.x", kneesAsX("0.0"));
  const ModelBone& knee = model.meshes.at(0).bones.at(0);
  EXPECT_EQ(knee.name, "knee");
  EXPECT_NE(knee.node, model.meshes[0].node);
  EXPECT_EQ(model.nodes[static_cast<std::size_t>(knee.node)].toParent.translation.y(), 1);
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_NE(model.notes[0].find("'knee'"), std::string::npos);
}

TEST_F(ImportModel, TellsNodesOfOneNameApartInGltf) {
  std::string gltf = skinnedGltf();
  const std::string name = R"("name":"skin")";
  gltf.replace(gltf.find(name), name.size(), R"("name":"knee")");
  // The mesh's node first, so that order alone would choose it.
  const std::string children = R"("children":[1,3])";
  gltf.replace(gltf.find(children), children.size(), R"("children":[3,1])");
  const Model model = written("same.gltf", gltf);
  const ModelBone& knee = model.meshes.at(0).bones.at(1);
  EXPECT_EQ(knee.name, "knee");
  EXPECT_NE(knee.node, model.meshes[0].node);
  EXPECT_EQ(model.nodes[static_cast<std::size_t>(knee.node)].toParent.translation,
            Vector3d(0, 1, 0));
  EXPECT_TRUE(model.notes.empty());
}

TEST_F(ImportModel, CountsWhatHasNoSurfaceInItsNotes) {
  const Model model =
      written("wire.gltf", gltfWithNodes(R"([{"mesh":0,"children":[1]},{"mesh":1}])"));
  EXPECT_EQ(trianglesOf(model), 1U);
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_EQ(model.notes[0].substr(0, 28), "3 points and lines are left ");
}

TEST_F(ImportModel, AppliesTheUnitOfFbxToLengthsAlone) {
  const Model model = written("cm.fbx", R"(; FBX 7.5.0 project file
FBXHeaderExtension:  {
	FBXVersion: 7500
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UnitScaleFactor", "double", "Number", "", 1
	}
}
Objects:  {
	Geometry: 1, "Geometry::wall", "Mesh" {
		Vertices: *9 {
			a: 0,0,0,100,0,0,0,300,0
		}
		PolygonVertexIndex: *3 {
			a: 0,1,-3
		}
		GeometryVersion: 124
	}
	Model: 2, "Model::wall", "Mesh" {
		Version: 232
		Properties70:  {
			P: "Lcl Translation", "Lcl Translation", "", "A", 0, 0, 50
		}
	}
}
Connections:  {
	C: "OO",1,2
	C: "OO",2,0
}
)");
  const auto wall = nodeNamed(model, "wall");
  ASSERT_EQ(model.meshes.size(), 1U);
  EXPECT_TRUE(toWorld(model, wall).linear.isApprox(Eigen::Matrix3d::Identity(), 1e-6));
  EXPECT_TRUE(toWorld(model, wall).translation.isApprox(Vector3d(0, 0, 0.5), 1e-6));
  EXPECT_TRUE(model.meshes[0].vertices[2].isApprox(Vector3d(0, 3, 0), 1e-12));
}

TEST_F(ImportModel, RefusesWhatIsNoModel) {
  EXPECT_EQ(failureOf("empty.gltf", gltfWithNodes(R"([{"name":"nothing"}])")).code,
            ErrorCode::Empty);
  EXPECT_EQ(failureOf("unknown.foretouch", "x").code, ErrorCode::UnknownName);
  EXPECT_EQ(failureOf("bad.gltf", "{").code, ErrorCode::ImportFailed);
  EXPECT_EQ(importModel(folder_ / "absent.glb", withModelImporter()).error().code,
            ErrorCode::FileNotFound);
  ModelImportOptions options = withModelImporter();
  options.import.scale = -1;
  EXPECT_EQ(importModel(folder_.write("leg.gltf", skinnedGltf()), options).error().code,
            ErrorCode::OutOfRange);
  options = withModelImporter();
  options.packagePaths = {std::string("a\0b", 3)};
  EXPECT_EQ(importModel(folder_ / "leg.gltf", options).error().code, ErrorCode::OutOfRange);
}

TEST_F(ImportModel, RefusesNodesWithoutAFiniteFrame) {
  const Error error = failureOf("huge.x", kneesAsX("1e39"));
  EXPECT_EQ(error.code, ErrorCode::ImportFailed);
  EXPECT_NE(error.message.find("'knee' is not finite"), std::string::npos) << error.message;
}

TEST_F(ImportModel, ReportsACrashOfTheReader) {
  EXPECT_EQ(failureOf("deep.bvh", bvhThatCrashesTheReader()).code, ErrorCode::ImportCrashed);
}

// Its tree is on no stack.
TEST_F(ImportModel, ReadsAGltfHoweverDeepItIs) {
  constexpr int kNodes = 60000;
  std::string nodes = "[";
  for (int i = 1; i < kNodes; ++i) {
    nodes += R"({"translation":[0,0,1],"children":[)" + std::to_string(i) + "]},";
  }
  const Model model = written("deep.gltf", gltfWithNodes(nodes + "{\"mesh\":0}]"));
  ASSERT_EQ(model.nodes.size(), std::size_t{kNodes});
  EXPECT_EQ(toWorld(model, kNodes - 1).translation.z(), kNodes - 1);
}

TEST_F(ImportModel, RefusesMoreNodesThanTheLimit) {
  std::string nodes = "[{\"children\":[";
  for (int i = 1; i <= 66000; ++i) nodes += (i == 1 ? "" : ",") + std::to_string(i);
  nodes += "]}";
  for (int i = 1; i <= 66000; ++i) nodes += i == 1 ? ",{\"mesh\":0}" : ",{}";
  const Error error = failureOf("wide.gltf", gltfWithNodes(nodes + "]"));
  EXPECT_EQ(error.code, ErrorCode::LimitExceeded) << error.message;
  EXPECT_NE(error.message.find("65536 nodes"), std::string::npos) << error.message;
}

TEST_F(ImportModel, SurvivesTruncationsAndGarblings) {
  const std::string gltf = skinnedGltf();
  int refused = 0, read = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    std::mt19937 random(seed);
    std::string bytes = gltf;
    if (seed % 4 == 0) bytes.resize(1 + random() % (bytes.size() - 1));
    for (unsigned k = 0; k < seed % 4; ++k) {
      bytes[random() % bytes.size()] =
          static_cast<char>(seed % 3 == 0 ? random() : '0' + random() % 10);
    }
    const auto result = importModel(folder_.write("garbled.gltf", bytes), withModelImporter());
    ++(result.ok() ? read : refused);
  }
  EXPECT_GT(refused, 20);
  EXPECT_GT(read, 10);
}

}  // namespace
}  // namespace foretouch::test
