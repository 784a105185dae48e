// importScene() on good files: formats, node transforms, instances, units, names.
#include "assets/import/scene_import.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/assets/import_files.h"
#include "tests/support/environment.h"

namespace foretouch::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class ImportScene : public testing::Test {
 protected:
  ImportedScene imported(const std::string& path,
                         const SceneImportOptions& options = withImporter()) {
    auto result = importScene(path, options);
    if (!result.ok()) {
      ADD_FAILURE() << describe(result.error());
      return {};
    }
    EXPECT_EQ(result.value().scene.objectOf.size(), result.value().scene.triangles.size());
    return std::move(result).value();
  }
  ImportedScene written(const std::string& name, std::string_view content,
                        const SceneImportOptions& options = withImporter()) {
    return imported(folder_.write(name, content), options);
  }

  TempFolder folder_;
  const Matrix3d unitTriangle_ = rows({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
};

TEST_F(ImportScene, ReadsObjWithPolygonsGroupsAndNoMaterialFile) {
  const auto scene = written("two.obj",
                             "mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\n"
                             "o floor\nusemtl gone\nf 1 2 3 4\no fin\nf 1 2 5\n");
  ASSERT_EQ(scene.scene.triangles.size(), 3U);
  EXPECT_EQ(cornersOf(scene, 0), rows({0, 0, 0}, {1, 0, 0}, {1, 1, 0}));
  EXPECT_EQ(cornersOf(scene, 1), rows({0, 0, 0}, {1, 1, 0}, {0, 1, 0}));
  EXPECT_EQ(cornersOf(scene, 2), rows({0, 0, 0}, {1, 0, 0}, {0, 0, 2}));
  EXPECT_EQ(scene.scene.objectNames, (std::vector<std::string>{"floor", "fin"}));
  EXPECT_EQ(scene.scene.objectOf, (std::vector<ObjectId>{0, 0, 1}));
}

TEST_F(ImportScene, KeepsEveryTriangleOfAPolygonOutOfPlane) {
  const auto scene = written("bent.obj",
                             "v 0 0 0\nv 1 0 3\nv 1 1 -4\nv 0 1 5\nv -1 0.5 -2\nv 0.2 0.2 7\n"
                             "f 6 2 4 1 5 3\n");
  EXPECT_EQ(scene.scene.triangles.size(), 4U);
}

TEST_F(ImportScene, KeepsDegenerateAndDuplicateTrianglesInOrder) {
  const auto scene = written("dirty.obj",
                             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\n"
                             "f 1 2 4\nf 1 2 3\nf 1 2 3\nf 3 1 2\nf 1 1 1\nf 2 2 3\n");
  ASSERT_EQ(scene.scene.triangles.size(), 6U);
  EXPECT_EQ(cornersOf(scene, 0), rows({0, 0, 0}, {1, 0, 0}, {2, 0, 0}));
  EXPECT_EQ(cornersOf(scene, 3), rows({0, 1, 0}, {0, 0, 0}, {1, 0, 0}));
  EXPECT_EQ(cornersOf(scene, 5), rows({1, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  const SceneAudit audit = auditScene(scene.scene);
  EXPECT_EQ(audit.zeroArea, 3U);
  EXPECT_EQ(audit.duplicates, 2U);
}

TEST_F(ImportScene, ReadsPlyAsTextAndAsBinary) {
  const auto text = written("t.ply",
                            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                            "property float y\nproperty float z\nelement face 1\n"
                            "property list uchar int vertex_indices\nend_header\n"
                            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const auto binary =
      written("b.ply", binaryPly({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}));
  ASSERT_EQ(text.scene.triangles.size(), 1U);
  ASSERT_EQ(binary.scene.triangles.size(), 2U);
  EXPECT_EQ(cornersOf(text, 0), unitTriangle_);
  EXPECT_EQ(cornersOf(binary, 0), unitTriangle_);
  EXPECT_EQ(cornersOf(binary, 1), rows({0, 1, 0}, {1, 0, 0}, {0, 0, 0}));
}

TEST_F(ImportScene, ReadsStlAsTextAndAsBinary) {
  const auto text = written("t.stl",
                            "solid wedge\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                            "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid wedge\n");
  std::string bytes(80, ' ');
  bytes += std::string("\x01\0\0\0", 4) + std::string(12, '\0');  // one facet, no normal
  const std::string one("\0\0\x80\x3F", 4), zero(4, '\0');
  bytes += zero + zero + zero + one + zero + zero + zero + one + zero + std::string(2, '\0');
  const auto binary = written("b.stl", bytes);
  ASSERT_EQ(text.scene.triangles.size(), 1U);
  ASSERT_EQ(binary.scene.triangles.size(), 1U);
  EXPECT_EQ(cornersOf(text, 0), unitTriangle_);
  EXPECT_EQ(cornersOf(binary, 0), unitTriangle_);
}

TEST_F(ImportScene, AppliesNestedNodeTransformsToEveryInstance) {
  // Root: moved by (10,0,0), twice as large. A turns x to y (its matrix, by columns), then moves by
  // (0,0,3). B mirrors x. C hangs below B: half a turn about z and (0,1,0).
  const auto scene = written("tree.gltf", gltfWithNodes(R"([
      {"name":"root","translation":[10,0,0],"scale":[2,2,2],"children":[1,2],"mesh":0},
      {"name":"A","matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,3,1],"mesh":0},
      {"name":"B","scale":[-1,1,1],"children":[3],"mesh":0},
      {"name":"C","rotation":[0,0,1,0],"translation":[0,1,0],"mesh":0}])"));
  ASSERT_EQ(scene.scene.triangles.size(), 4U);
  EXPECT_EQ(cornersOf(scene, 0), rows({10, 0, 0}, {12, 0, 0}, {10, 2, 0}));
  EXPECT_EQ(cornersOf(scene, 1), rows({10, 0, 6}, {10, 2, 6}, {8, 0, 6}));
  EXPECT_EQ(cornersOf(scene, 2), rows({10, 0, 0}, {8, 0, 0}, {10, 2, 0}));
  EXPECT_EQ(cornersOf(scene, 3), rows({10, 2, 0}, {12, 2, 0}, {10, 0, 0}));
  EXPECT_EQ(scene.scene.objectNames, (std::vector<std::string>{"root", "A", "B", "C"}));
  EXPECT_EQ(scene.scene.objectOf, (std::vector<ObjectId>{0, 1, 2, 3}));
  EXPECT_EQ(scene.report.nodes, 4U);
  EXPECT_EQ(scene.report.meshInstances, 4U);
  EXPECT_EQ(scene.report.skippedPrimitives, 0U);
}

TEST_F(ImportScene, VisitsNodesDepthFirstInTheOrderOfTheFile) {
  const auto scene = written("order.gltf", gltfWithNodes(R"([
      {"name":"0","children":[1,4]},
      {"name":"1","children":[2,3],"mesh":0}, {"name":"2","mesh":0}, {"name":"3","mesh":0},
      {"name":"4","children":[5],"mesh":0}, {"name":"5","mesh":0}])"));
  EXPECT_EQ(scene.scene.objectNames, (std::vector<std::string>{"1", "2", "3", "4", "5"}));
}

TEST_F(ImportScene, ComposesTransformsInDouble) {
  // 1000 nodes of 0.001 each: in float the sum would be off by some 1e-6.
  std::string nodes = "[";
  for (int i = 0; i < 1000; ++i) {
    nodes += R"({"translation":[0.001,0,0],"children":[)" + std::to_string(i + 1) + "]},";
  }
  const auto scene = written("chain.gltf", gltfWithNodes(nodes + R"({"mesh":0}])"));
  ASSERT_EQ(scene.scene.triangles.size(), 1U);
  EXPECT_NEAR(scene.scene.triangles[0].vertices[0].x(), 1.0, 1e-13);
}

TEST_F(ImportScene, SkipsAndCountsPointsAndLinesOncePerPlacement) {
  const auto scene = written("wire.gltf", gltfWithNodes(R"([
      {"children":[1,2]}, {"name":"body","mesh":0,"children":[3]},
      {"name":"wire","mesh":1}, {"name":"wire again","mesh":1}])"));
  EXPECT_EQ(scene.scene.objectNames, (std::vector<std::string>{"body"}));
  EXPECT_EQ(scene.report.skippedPrimitives, 2U * (2 + 1));  // two points and a line, twice
  const auto obj = written("mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\nl 2 3\n");
  EXPECT_EQ(obj.scene.triangles.size(), 1U);
  EXPECT_EQ(obj.report.skippedPrimitives, 2U);
}

/// A triangle as Collada; `axis`: its up_axis.
std::string panelInCentimetres(const std::string& axis) {
  std::string text = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 100 0 0 0 100 200</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="panel">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  return text.replace(text.find("Z_UP"), 4, axis);
}

TEST_F(ImportScene, ObeysTheUnitAndTheAxisOfCollada) {
  const auto scene = written("z.dae", panelInCentimetres("Z_UP"));
  ASSERT_EQ(scene.scene.triangles.size(), 1U);
  EXPECT_TRUE(cornersOf(scene, 0).isApprox(rows({0, 0, 0}, {1, 0, 0}, {0, 2, -1}), 1e-6))
      << cornersOf(scene, 0);
  EXPECT_EQ(describe(scene.frame), "says 0.01 m per unit and Z up; both applied");
}

TEST_F(ImportScene, AppliesOnceWhatAnOptionRepeats) {
  SceneImportOptions options = withImporter();
  options.scale = 0.01;
  options.up = UpAxis::Z;
  const auto scene = written("z.dae", panelInCentimetres("Z_UP"), options);
  const auto asItSays = written("z.dae", panelInCentimetres("Z_UP"));
  ASSERT_EQ(scene.scene.triangles.size(), 1U);
  EXPECT_EQ(cornersOf(scene, 0), cornersOf(asItSays, 0));
}

TEST_F(ImportScene, TakesAnOptionInPlaceOfWhatTheFileSays) {
  SceneImportOptions options = withImporter();
  options.up = UpAxis::Y;
  options.scale = 1.0;
  const auto flat = written("z.dae", panelInCentimetres("Z_UP"), options);
  EXPECT_TRUE(cornersOf(flat, 0).isApprox(rows({0, 0, 0}, {100, 0, 0}, {0, 100, 200}), 1e-6))
      << cornersOf(flat, 0);
  EXPECT_EQ(describe(flat.frame), "says 0.01 m per unit and Z up; read otherwise, as asked");
  // Files say Y_UP over vertices with Z up.
  options = withImporter();
  options.up = UpAxis::Z;
  const auto turned = written("y.dae", panelInCentimetres("Y_UP"), options);
  EXPECT_TRUE(cornersOf(turned, 0).isApprox(rows({0, 0, 0}, {1, 0, 0}, {0, 2, -1}), 1e-6))
      << cornersOf(turned, 0);
  EXPECT_EQ(describe(turned.frame),
            "says 0.01 m per unit and Y up; the unit applied, the axis read otherwise, as asked");
}

TEST_F(ImportScene, SaysNothingForFilesThatSayNothing) {
  const auto obj = written("t.obj", kTriangleObj);
  EXPECT_FALSE(obj.frame.declared.metresPerUnit || obj.frame.declared.up);
  EXPECT_EQ(describe(obj.frame), "");
  const auto gltf = written("t.gltf", gltfWithNodes(R"([{"mesh":0}])"));
  EXPECT_TRUE(gltf.frame.declared.isOfFormat);
  EXPECT_EQ(gltf.frame.declared.metresPerUnit, 1.0);
  EXPECT_EQ(describe(gltf.frame), "");
}

TEST_F(ImportScene, TurnsTheCentimetresOfFbxIntoMetres) {
  const auto scene = written("cm.fbx", R"(; FBX 7.5.0 project file
FBXHeaderExtension:  {
	FBXVersion: 7500
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "", 1
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
  ASSERT_EQ(scene.scene.triangles.size(), 1U);
  EXPECT_TRUE(cornersOf(scene, 0).isApprox(rows({0, 0, 0.5}, {1, 0, 0.5}, {0, 3, 0.5}), 1e-15))
      << cornersOf(scene, 0);
  EXPECT_EQ(scene.scene.objectNames, (std::vector<std::string>{"wall"}));
}

TEST_F(ImportScene, ScalesFirstAndTurnsZUpToYUp) {
  SceneImportOptions options = withImporter();
  options.scale = 0.5;
  options.up = UpAxis::Z;
  const auto scene = written("t.obj", "v 2 4 6\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", options);
  ASSERT_EQ(scene.scene.triangles.size(), 1U);
  EXPECT_EQ(cornersOf(scene, 0), rows({1, 3, -2}, {0.5, 0, 0}, {0, 0, -0.5}));
}

TEST_F(ImportScene, ReadsSideFilesFromTheModelsOwnFolder) {
  std::string bytes(36, '\0');
  bytes.replace(12, 4, std::string("\0\0\x80\x3F", 4));
  bytes.replace(28, 4, std::string("\0\0\x80\x3F", 4));
  folder_.write("side.bin", bytes);
  std::string gltf = gltfWithNodes(R"([{"mesh":0}])");
  const std::size_t uri = gltf.find("data:");
  gltf.replace(uri, gltf.find('"', uri) - uri, "side.bin");
  const auto scene = written("beside.gltf", gltf);
  ASSERT_EQ(scene.scene.triangles.size(), 1U);
  EXPECT_EQ(cornersOf(scene, 0), unitTriangle_);
}

TEST_F(ImportScene, ReadsPathsRelativeToTheCallersFolder) {
  folder_.write("-dash name é.obj", kTriangleObj);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_ / "");
  const auto scene = imported("-dash name é.obj");
  std::filesystem::current_path(before);
  EXPECT_EQ(scene.scene.triangles.size(), 1U);
}

TEST_F(ImportScene, HandsNonFiniteVerticesOnForTheSceneToDrop) {
  const float nan = std::nanf("");
  const auto scene = written(
      "nan.ply", binaryPly({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}));
  ASSERT_EQ(scene.scene.triangles.size(), 2U);
  EXPECT_FALSE(cornersOf(scene, 1).allFinite());
  const SceneAudit audit = auditScene(scene.scene);
  EXPECT_EQ(audit.triangles, 1U);
  EXPECT_EQ(audit.droppedNonFinite, 1U);
}

TEST_F(ImportScene, SkipsAndCountsFacesWithIndicesOutOfRange) {
  const auto result =
      importScene(folder_.write("range.ply", binaryPly({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                                       {{0, 1, 2}, {0, 1, 7}, {0, -5, 2}})),
                  withImporter());
  // The reader itself may refuse the file, as newer ones do; what it hands over must be sound.
  if (!result.ok()) {
    EXPECT_EQ(result.error().code, ErrorCode::ImportFailed) << describe(result.error());
    return;
  }
  EXPECT_EQ(result.value().scene.triangles.size(), 1U);
  EXPECT_EQ(result.value().report.skippedFaces, 2U);
}

TEST_F(ImportScene, NamesObjectsInReadableUtf8) {
  const auto scene = written("names.gltf", gltfWithNodes(R"([
      {"children":[1,2,3]}, {"name":"Küche\u001b[31m\n","mesh":0}, {"mesh":0},
      {"name":")" + std::string(500, 'n') + R"(","mesh":0}])"));
  ASSERT_EQ(scene.scene.objectNames.size(), 3U);
  EXPECT_EQ(scene.scene.objectNames[0].substr(0, 6), "Küche");
  for (const std::string& name : scene.scene.objectNames) {
    EXPECT_LE(name.size(), 256U);
    EXPECT_FALSE(name.empty());
    for (const char c : name) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
  }
}

TEST_F(ImportScene, NamesTheNamelessAfterTheFile) {
  const auto scene =
      written("counter top.ply", binaryPly({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(scene.scene.objectNames, (std::vector<std::string>{"counter top"}));
}

TEST_F(ImportScene, FindsTheImporterBesideTheRunningProgram) {
  test::unsetVariable("FORETOUCH_IMPORTER");
  EXPECT_EQ(written("t.obj", kTriangleObj, SceneImportOptions{}).scene.triangles.size(), 1U);
}

TEST_F(ImportScene, PrefersTheOptionToTheEnvironmentToTheRest) {
  const std::string named = folder_.script("from-environment", "exit 9");
  const std::string model = folder_.write("t.obj", kTriangleObj);
  test::setVariable("FORETOUCH_IMPORTER", named);
  const auto fromEnvironment = importScene(model);
  const auto fromOption = importScene(model, withImporter());
  test::unsetVariable("FORETOUCH_IMPORTER");
  EXPECT_TRUE(fromOption.ok());
  ASSERT_FALSE(fromEnvironment.ok());
  EXPECT_NE(fromEnvironment.error().message.find("status 9"), std::string::npos);
}

TEST_F(ImportScene, GivesTheSameBytesEveryTime) {
  const std::string path = folder_.write("again.gltf", gltfWithNodes(R"([{"children":[1,2]},
      {"mesh":0,"rotation":[0.1,0.2,0.3,0.9]}, {"mesh":0,"scale":[0.1,0.2,0.3]}])"));
  const auto first = imported(path), second = imported(path);
  ASSERT_EQ(first.scene.triangles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(cornersOf(first, i), cornersOf(second, i));
}

}  // namespace
}  // namespace foretouch::test
