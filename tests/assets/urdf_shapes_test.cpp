// importModel() on URDF made here: shapes, and references to meshes.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/assets/urdf_files.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

TEST_F(ImportUrdf, KeepsSpheresAndCapsulesExactly) {
  const Model model =
      imported(linkWith("<sphere radius=\"0.25\"/>", "a", "<origin xyz=\"1 2 3\"/>") +
               linkWith("<capsule radius=\"0.125\" length=\"2\"/>", "b",
                        "<origin xyz=\"0 0 1\" rpy=\"0 1.5707963267948966 0\"/>") +
               joint("fixed", "a", "b"));
  const Lss& sphere = model.nodes[nodeNamed(model, "a")].lss.at(0);
  EXPECT_EQ(sphere.a, Vector3d(1, 2, 3));
  EXPECT_EQ(sphere.b, Vector3d(1, 2, 3));
  EXPECT_EQ(sphere.radius, 0.25);
  const Lss& capsule = model.nodes[nodeNamed(model, "b")].lss.at(0);
  EXPECT_LT((capsule.a - Vector3d(-1, 0, 1)).norm(), 1e-15);
  EXPECT_LT((capsule.b - Vector3d(1, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(capsule.radius, 0.125);
  EXPECT_TRUE(model.meshes.empty());
}

TEST_F(ImportUrdf, TellsCapsulesFromCylindersOfOneLink) {
  const auto shape = [](const std::string& kind) {
    return "<collision><geometry><" + kind +
           " radius=\"0.1\" length=\"1\"/></geometry></collision>";
  };
  const Model model = imported("<link name=\"a\">" + shape("cylinder") + shape("capsule") +
                               shape("cylinder") + "</link>");
  EXPECT_EQ(model.nodes[0].lss.size(), 1U);
  EXPECT_EQ(model.meshes.size(), 2U);
}

double farthestOutside(const ModelMesh& mesh, const std::vector<Vector3d>& points) {
  double farthest = -1e300;
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vector3d normal = (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                                .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                                .normalized();
    for (const Vector3d& p : points) farthest = std::max(farthest, normal.dot(p - a));
  }
  return farthest;
}

double volumeOf(const ModelMesh& mesh) {
  double six = 0;
  for (const auto& t : mesh.triangles) {
    six += mesh.vertices[static_cast<std::size_t>(t[0])].dot(
        mesh.vertices[static_cast<std::size_t>(t[1])].cross(
            mesh.vertices[static_cast<std::size_t>(t[2])]));
  }
  return six / 6;
}

TEST_F(ImportUrdf, MakesABoxOfTwelveTrianglesFacingOut) {
  const Model model = imported(linkWith("<box size=\"1 2 4\"/>", "a", "<origin xyz=\"10 0 0\"/>"));
  ASSERT_EQ(model.meshes.size(), 1U);
  const ModelMesh& box = model.meshes[0];
  EXPECT_EQ(box.triangles.size(), 12U);
  EXPECT_EQ(box.vertices.size(), 8U);
  EXPECT_NEAR(volumeOf(box), 8.0, 1e-12);
  EXPECT_NEAR(farthestOutside(box, {{10, 0, 0}}), -0.5, 1e-12);
  for (const Vector3d& v : box.vertices) {
    EXPECT_EQ((v - Vector3d(10, 0, 0)).cwiseAbs(), Vector3d(0.5, 1, 2));
  }
}

TEST_F(ImportUrdf, MakesACylinderThatContainsTheTrueOneClosely) {
  const Model model = imported(linkWith("<cylinder radius=\"0.3\" length=\"2\"/>"));
  ASSERT_EQ(model.meshes.size(), 1U);
  std::vector<Vector3d> rim;
  for (int i = 0; i < 10000; ++i) {
    const double angle = 2 * kPi * i / 10000;
    for (const double z : {-1.0, 1.0}) {
      rim.emplace_back(0.3 * std::cos(angle), 0.3 * std::sin(angle), z);
    }
  }
  EXPECT_LT(farthestOutside(model.meshes[0], rim), 0.0);
  EXPECT_NEAR(volumeOf(model.meshes[0]), kPi * 0.09 * 2, 0.005 * kPi * 0.09 * 2);
  double farthest = 0;
  for (const Vector3d& v : model.meshes[0].vertices) {
    farthest = std::max(farthest, v.head<2>().norm() - 0.3);
  }
  EXPECT_LT(farthest, 0.005 * 0.3);  // as stated
}

TEST_F(ImportUrdf, FindsMeshesByEveryKindOfReference) {
  makeFolder("pkg/meshes");
  makeFolder("elsewhere/other/meshes");
  folder_.write("pkg/meshes/t.obj", kTriangleObj);
  folder_.write("elsewhere/other/meshes/u.obj", kTriangleObj);
  folder_.write("own.obj", kTriangleObj);
  ModelImportOptions options = withModelImporter();
  options.packagePaths = {folder_ / "elsewhere"};
  for (const std::string& reference :
       {std::string("own.obj"), std::string("pkg/meshes/t.obj"), "file://" + (folder_ / "own.obj"),
        std::string("package://pkg/meshes/t.obj"), std::string("package://other/meshes/u.obj"),
        std::string("package://any_name/own.obj"), std::string("model://pkg/meshes/t.obj"),
        folder_ / "own.obj"}) {
    const Model model = imported(linkWith("<mesh filename=\"" + reference + "\"/>"), options);
    EXPECT_EQ(trianglesOf(model), 1U) << reference;
    EXPECT_TRUE(model.notes.empty()) << reference;
  }
}

TEST_F(ImportUrdf, FindsPackagesAboveItsOwnFolder) {
  makeFolder("robot/urdf");
  makeFolder("robot/meshes");
  folder_.write("robot/meshes/t.obj", kTriangleObj);
  const std::string path = folder_.write(
      "robot/urdf/r.urdf", robot(linkWith("<mesh filename=\"package://robot/meshes/t.obj\"/>")));
  const auto model = importModel(path, withModelImporter());
  ASSERT_TRUE(model.ok()) << describe(model.error());
  EXPECT_EQ(trianglesOf(model.value()), 1U);
}

TEST_F(ImportUrdf, ReadsMeshesOfItsPackageAndThoseBesideItAlone) {
  for (const char* const name : {"ws/robot/urdf", "ws/other/meshes", "elsewhere", "ws/.keys"}) {
    makeFolder(name);
  }
  folder_.write("ws/robot/package.xml", "<package/>");
  for (const char* const name :
       {"ws/other/meshes/t.obj", "elsewhere/t.obj", "ws/.keys/t.obj", "ws/robot/t.obj"}) {
    folder_.write(name, kTriangleObj);
  }
  const auto trianglesBy = [&](const std::string& reference, const ModelImportOptions& options) {
    const std::string path = folder_.write(
        "ws/robot/urdf/r.urdf", robot(linkWith("<mesh filename=\"" + reference + "\"/>", "a") +
                                      linkWith(kSphere, "b") + joint("fixed", "a", "b")));
    const auto model = importModel(path, options);
    EXPECT_TRUE(model.ok()) << describe(model.error());
    if (!model.ok()) return std::size_t{0};
    EXPECT_EQ(trianglesOf(model.value()) == 0, mentions(model.value().notes, "is not read"));
    return trianglesOf(model.value());
  };
  ModelImportOptions options = withModelImporter();
  EXPECT_EQ(trianglesBy("package://robot/t.obj", options), 1U);
  EXPECT_EQ(trianglesBy("../t.obj", options), 1U);
  EXPECT_EQ(trianglesBy("package://other/meshes/t.obj", options), 1U);
  const std::string outside = folder_ / "elsewhere/t.obj";
  for (const std::string& bad : {outside, "file://" + outside, std::string("../../.keys/t.obj"),
                                 std::string("../../../elsewhere/t.obj")}) {
    EXPECT_EQ(trianglesBy(bad, options), 0U) << bad;
  }
  options.packagePaths = {folder_ / "elsewhere"};
  EXPECT_EQ(trianglesBy(outside, options), 1U);
}

TEST_F(ImportUrdf, AppliesAMeshsScaleBeforeItsOrigin) {
  folder_.write("t.obj", kTriangleObj);
  const Model model = imported(linkWith("<mesh filename=\"t.obj\" scale=\"2 -3 1\"/>", "a",
                                        "<origin xyz=\"1 0 0\" rpy=\"0 0 1.5707963267948966\"/>"));
  ASSERT_EQ(model.meshes.size(), 1U);
  const auto& v = model.meshes[0].vertices;
  EXPECT_LT((v[0] - Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((v[1] - Vector3d(1, 2, 0)).norm(), 1e-15);
  EXPECT_LT((v[2] - Vector3d(4, 0, 0)).norm(), 1e-14);
}

TEST_F(ImportUrdf, ComposesTheNodesOfAMeshFile) {
  folder_.write("n.gltf", gltfWithNodes(R"([{"mesh":0,"translation":[0,0,7],"children":[1]},
{"mesh":0,"translation":[0,5,0]}])"));
  const Model model = imported(linkWith("<mesh filename=\"n.gltf\"/>"));
  ASSERT_EQ(model.meshes.size(), 1U);
  EXPECT_EQ(model.meshes[0].triangles.size(), 2U);
  EXPECT_EQ(model.meshes[0].vertices.at(0), Vector3d(0, 0, 7));
  EXPECT_EQ(model.meshes[0].vertices.at(3), Vector3d(0, 5, 7));
}

TEST_F(ImportUrdf, NotesMeshesThatAreMissingOrCannotBeRead) {
  folder_.write("bad.gltf", "{");
  folder_.write("strange.foretouch", "x");
  const Model model =
      imported(linkWith("<mesh filename=\"absent.stl\"/>", "a") +
               linkWith("<mesh filename=\"bad.gltf\"/>", "b") + joint("fixed", "a", "b") +
               linkWith("<mesh filename=\"strange.foretouch\"/>", "c") + joint("fixed", "a", "c") +
               linkWith(kSphere, "d") + joint("fixed", "a", "d"));
  EXPECT_TRUE(mentions(model.notes, "'absent.stl' of link 'a' was not found"));
  EXPECT_TRUE(mentions(model.notes, "'bad.gltf' of link 'b' cannot be read"));
  EXPECT_TRUE(mentions(model.notes, "'strange.foretouch' of link 'c' cannot be read"));
  EXPECT_EQ(model.nodes.size(), 4U);
  EXPECT_EQ(trianglesOf(model), 0U);
}

TEST_F(ImportUrdf, FailsWhereNoSurfaceIsLeft) {
  const Error error = failureOf(robot(linkWith("<mesh filename=\"absent.stl\"/>")));
  EXPECT_EQ(error.code, ErrorCode::Empty);
  EXPECT_NE(error.message.find("'absent.stl'"), std::string::npos) << error.message;
}

TEST_F(ImportUrdf, TakesTheDescriptionThatIsAskedForOrTheOtherWithANote) {
  const std::string both =
      "<link name=\"both\"><visual><geometry><sphere radius=\"1\"/></geometry></visual>"
      "<collision><geometry><sphere radius=\"2\"/></geometry></collision></link>";
  const std::string visual =
      "<link name=\"v\"><visual><geometry><sphere radius=\"3\"/></geometry></visual></link>";
  const std::string missing =
      "<link name=\"m\"><visual><geometry><capsule radius=\"4\" length=\"1\"/></geometry></visual>"
      "<collision><geometry><mesh filename=\"absent.obj\"/></geometry></collision></link>";
  const std::string content =
      both + visual + missing + joint("fixed", "both", "v") + joint("fixed", "both", "m");
  const auto radius = [](const Model& model, const char* name) {
    return model.nodes[nodeNamed(model, name)].lss.at(0).radius;
  };
  const Model collision = imported(content);
  EXPECT_EQ(radius(collision, "both"), 2);
  EXPECT_EQ(radius(collision, "v"), 3);
  EXPECT_EQ(radius(collision, "m"), 4);
  EXPECT_TRUE(mentions(collision.notes, "link 'v' has no usable collision shapes"));
  EXPECT_TRUE(mentions(collision.notes, "link 'm' has no usable collision shapes"));
  EXPECT_FALSE(mentions(collision.notes, "link 'both'"));
  ModelImportOptions options = withModelImporter();
  options.urdfSurface = UrdfSurface::Visual;
  const Model seen = imported(
      content + linkWith("<sphere radius=\"5\"/>", "c") + joint("fixed", "both", "c"), options);
  EXPECT_EQ(radius(seen, "both"), 1);
  EXPECT_EQ(radius(seen, "c"), 5);
  EXPECT_TRUE(mentions(seen.notes, "link 'c' has no usable visual shapes"));
}

}  // namespace
}  // namespace foretouch::test
