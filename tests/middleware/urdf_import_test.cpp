// importModel() on URDF made here: links, joints, shapes, references to meshes, and refusals.
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "middleware/model_import.h"
#include "tests/middleware/import_files.h"
#include "tests/middleware/model_files.h"

namespace foretouch::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

std::string robot(const std::string& content) {
  return "<?xml version=\"1.0\"?><robot name=\"r\">" + content + "</robot>";
}

std::string linkWith(const std::string& geometry, const std::string& name = "a",
                     const std::string& origin = "") {
  return "<link name=\"" + name + "\"><collision>" + origin + "<geometry>" + geometry +
         "</geometry></collision></link>";
}

std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& more = "") {
  return "<joint name=\"to_" + child + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + more + "</joint>";
}

const std::string kSphere = "<sphere radius=\"0.1\"/>";

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

class ImportUrdf : public testing::Test {
 protected:
  Model imported(const std::string& content,
                 const ModelImportOptions& options = withModelImporter()) {
    auto result = importModel(folder_.write("robot.urdf", robot(content)), options);
    if (!result.ok()) {
      ADD_FAILURE() << describe(result.error());
      return {};
    }
    return std::move(result).value();
  }
  Error failureOf(const std::string& text) {
    const auto result = importModel(folder_.write("robot.urdf", text), withModelImporter());
    if (result.ok()) {
      ADD_FAILURE() << "imported: " << text;
      return {};
    }
    EXPECT_FALSE(hasChildren());
    return result.error();
  }
  void expectRefused(const std::string& content, const std::string& reason) {
    const Error error = failureOf(robot(content));
    EXPECT_EQ(error.code, ErrorCode::ImportFailed) << error.message;
    EXPECT_NE(error.message.find(reason), std::string::npos) << error.message;
  }
  void makeFolder(const std::string& name) { std::filesystem::create_directories(folder_ / name); }

  TempFolder folder_;
};

TEST_F(ImportUrdf, ReadsEveryTypeOfJoint) {
  std::string content = linkWith(kSphere, "base");
  const std::string axis = "<axis xyz=\"0 3 4\"/>";
  const std::string limit = "<limit lower=\"-1.5\" upper=\"0.5\" effort=\"1\" velocity=\"1\"/>";
  for (const char* type : {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"}) {
    content += linkWith(kSphere, type) + joint(type, "base", type, axis + limit);
  }
  const Model model = imported(content);
  ASSERT_EQ(model.nodes.size(), 7U);
  const auto nodeOf = [&](const char* name) { return model.nodes[nodeNamed(model, name)]; };
  EXPECT_EQ(nodeOf("base").joint, ModelJointType::Free);
  EXPECT_EQ(nodeOf("base").jointName, "");
  EXPECT_EQ(nodeOf("revolute").joint, ModelJointType::Revolute);
  EXPECT_EQ(nodeOf("revolute").jointName, "to_revolute");
  EXPECT_LT((nodeOf("revolute").axis - Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(nodeOf("revolute").lowerLimit, -1.5);
  EXPECT_EQ(nodeOf("revolute").upperLimit, 0.5);
  EXPECT_EQ(nodeOf("continuous").joint, ModelJointType::Continuous);
  EXPECT_EQ(nodeOf("continuous").lowerLimit, nodeOf("continuous").upperLimit);
  EXPECT_EQ(nodeOf("prismatic").joint, ModelJointType::Prismatic);
  EXPECT_EQ(nodeOf("prismatic").upperLimit, 0.5);
  EXPECT_EQ(nodeOf("fixed").joint, ModelJointType::Fixed);
  EXPECT_EQ(nodeOf("floating").joint, ModelJointType::Free);
  EXPECT_EQ(nodeOf("planar").joint, ModelJointType::Free);
  EXPECT_TRUE(mentions(model.notes, "planar"));
}

TEST_F(ImportUrdf, PutsALinkWhereItsJointsOriginSays) {
  const Model model =
      imported(linkWith(kSphere, "base") + linkWith(kSphere, "arm") +
               joint("continuous", "base", "arm", "<origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.3\"/>"));
  const ModelNode& arm = model.nodes[nodeNamed(model, "arm")];
  EXPECT_EQ(arm.toParent.translation, Vector3d(1, 2, 3));
  // Roll, pitch, yaw about fixed axes, in this order.
  const Eigen::Matrix3d expected =
      (AngleAxisd(0.3, Vector3d::UnitZ()) * AngleAxisd(0.2, Vector3d::UnitY()) *
       AngleAxisd(0.1, Vector3d::UnitX()))
          .toRotationMatrix();
  EXPECT_TRUE(arm.toParent.linear.isApprox(expected, 1e-14));
  EXPECT_EQ(arm.axis, Vector3d::UnitX());  // where none is stated
}

TEST_F(ImportUrdf, ScalesAndTurnsLikeEveryModel) {
  ModelImportOptions options = withModelImporter();
  options.import.scale = 2.0;
  options.import.up = UpAxis::Z;
  const std::string limit = "<limit lower=\"-1\" upper=\"3\" effort=\"1\" velocity=\"1\"/>";
  const Model model = imported(
      linkWith(kSphere, "base") + linkWith("<capsule radius=\"0.1\" length=\"1\"/>", "arm") +
          joint("prismatic", "base", "arm", "<origin xyz=\"1 2 3\"/>" + limit),
      options);
  const auto arm = nodeNamed(model, "arm");
  EXPECT_LT((toWorld(model, arm).translation - Vector3d(2, 6, -4)).norm(), 1e-14);
  EXPECT_EQ(model.nodes[arm].upperLimit, 6.0);
  ASSERT_EQ(model.nodes[arm].lss.size(), 1U);
  EXPECT_EQ(model.nodes[arm].lss[0].radius, 0.2);
  EXPECT_EQ(model.nodes[arm].lss[0].b, Vector3d(0, 0, 1));
}

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

/// The largest signed volume that any point of `points` lies outside a triangle's plane, as a
/// distance: above 0 where the convex mesh does not contain them all.
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

TEST_F(ImportUrdf, PassesOverWhatASurfaceDoesNotNeed) {
  const Model model = imported(
      "<material name=\"no colour\"/><transmission><nonsense/></transmission><gazebo/>"
      "<link name=\"a\"><inertial><mass value=\"heavy\"/></inertial><collision><geometry>" +
      kSphere +
      "</geometry></collision><visual><geometry><sphere radius=\"1\"/></geometry>"
      "<material name=\"absent\"/></visual></link>" +
      linkWith(kSphere, "b") +
      joint("revolute", "a", "b", "<axis xyz=\"0 0 1\"/><mimic joint=\"other\"/>"));
  EXPECT_EQ(model.nodes.size(), 2U);
  const ModelNode& b = model.nodes[nodeNamed(model, "b")];
  EXPECT_EQ(b.joint, ModelJointType::Revolute);
  EXPECT_EQ(b.lowerLimit, b.upperLimit);
  EXPECT_TRUE(mentions(model.notes, "states no limits"));
  EXPECT_TRUE(mentions(model.notes, "mimics 'other'"));
}

TEST_F(ImportUrdf, ReadsLimitsTheWrongWayRoundAsNone) {
  const Model model = imported(
      linkWith(kSphere, "a") + linkWith(kSphere, "b") +
      joint("revolute", "a", "b", "<limit lower=\"1\" upper=\"-1\" effort=\"1\" velocity=\"1\"/>"));
  const ModelNode& b = model.nodes[nodeNamed(model, "b")];
  EXPECT_EQ(b.lowerLimit, b.upperLimit);
  EXPECT_TRUE(mentions(model.notes, "lower limit above"));
}

TEST_F(ImportUrdf, RefusesTreesThatAreNone) {
  const std::string a = linkWith(kSphere, "a"), b = linkWith(kSphere, "b"),
                    c = linkWith(kSphere, "c");
  expectRefused(a + b + joint("fixed", "a", "b") + joint("fixed", "b", "a"), "");
  // A root, and a cycle apart from it.
  expectRefused(a + b + c + joint("fixed", "b", "c") + joint("fixed", "c", "b"), "cycle");
  expectRefused(a + joint("fixed", "a", "a"), "");
  expectRefused(a + joint("fixed", "absent", "a"), "absent");
  expectRefused(a + b, "");   // two roots
  expectRefused(a + a, "a");  // twice the same name
  expectRefused("", "");      // no link at all
  // Two joints lead to one link.
  expectRefused(a + b + c + joint("fixed", "a", "b") + joint("fixed", "a", "c") +
                    "<joint name=\"second\" type=\"fixed\"><parent link=\"b\"/><child "
                    "link=\"c\"/></joint>",
                "several joints");
}

TEST_F(ImportUrdf, RefusesNumbersThatCannotBe) {
  for (const char* bad : {"nan", "inf", "1e9", "-1", "1e400", "long", ""}) {
    const std::string text = bad;
    expectRefused(linkWith("<sphere radius=\"" + text + "\"/>"), "");
    expectRefused(linkWith("<capsule radius=\"1\" length=\"" + text + "\"/>"), "");
    expectRefused(linkWith("<cylinder radius=\"" + text + "\" length=\"1\"/>"), "");
    expectRefused(linkWith("<box size=\"1 " + text + " 1\"/>"), "");
    if (text == "-1") continue;
    expectRefused(linkWith(kSphere, "a", "<origin xyz=\"0 0 " + text + "\"/>"), "");
    if (text == "1e9") continue;
    expectRefused(linkWith(kSphere, "a", "<origin rpy=\"0 0 " + text + "\"/>"), "");
    expectRefused(linkWith(kSphere, "a") + linkWith(kSphere, "b") +
                      joint("continuous", "a", "b", "<axis xyz=\"0 0 " + text + "\"/>"),
                  "");
  }
  expectRefused(linkWith(kSphere, "a") + linkWith(kSphere, "b") +
                    joint("continuous", "a", "b", "<axis xyz=\"0 0 0\"/>"),
                "no axis");
}

TEST_F(ImportUrdf, RefusesShapesAndJointsThatItDoesNotKnow) {
  expectRefused(linkWith("<cone radius=\"1\"/>"), "");
  expectRefused(linkWith(""), "");
  expectRefused(linkWith(kSphere, "a") + linkWith(kSphere, "b") + joint("spherical", "a", "b"),
                "spherical");
}

TEST_F(ImportUrdf, RefusesWhatIsNoXml) {
  for (const std::string& text :
       {std::string("not xml"), std::string("<robot name=\"r\"><link name=\"a\""),
        std::string("<sdf/>"), std::string("<robot>\0</robot>", 16), robot("<link/>")}) {
    EXPECT_EQ(failureOf(text).code, ErrorCode::ImportFailed) << text;
  }
}

TEST_F(ImportUrdf, RefusesFilesAboveItsLimit) {
  std::string text = robot(linkWith(kSphere));
  text.resize((std::size_t{16} << 20) + 1, ' ');
  EXPECT_EQ(failureOf(text).code, ErrorCode::LimitExceeded);
}

TEST_F(ImportUrdf, SurvivesElementsNestedWithoutEnd) {
  std::string text = "<robot name=\"r\">";
  for (int i = 0; i < 1000000; ++i) text += "<link>";
  const ErrorCode code = failureOf(text).code;
  EXPECT_TRUE(code == ErrorCode::ImportCrashed || code == ErrorCode::ImportFailed);
}

TEST_F(ImportUrdf, StandsDeepChains) {
  std::string content = linkWith(kSphere, "l0");
  constexpr int kLinks = 3000;
  for (int i = 1; i < kLinks; ++i) {
    content += linkWith(kSphere, "l" + std::to_string(i)) +
               joint("fixed", "l" + std::to_string(i - 1), "l" + std::to_string(i));
  }
  const Model model = imported(content);
  EXPECT_EQ(model.nodes.size(), static_cast<std::size_t>(kLinks));
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    ASSERT_EQ(model.nodes[i].parent, static_cast<std::int32_t>(i) - 1);
  }
}

}  // namespace
}  // namespace foretouch::test
