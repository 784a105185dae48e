// importModel() on URDF made here: links, joints, and refusals.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/assets/urdf_files.h"

namespace foretouch::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

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
  EXPECT_EQ(nodeOf("planar").joint, ModelJointType::Planar);
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

/// The largest signed volume that any point of `points` lies outside a triangle's plane, as a
/// distance: above 0 where the convex mesh does not contain them all.
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

TEST_F(ImportUrdf, SaysOnWhichLineAFileIsMalformed) {
  const auto reason = [&](const std::string& text) { return failureOf(text).message; };
  EXPECT_EQ(reason("<robot name=\"r\">\n<link name=\"a\">\n</robot>\n"),
            "the importer refused the file: line 3: expected </link>, which closes line 2, found "
            "</robot>");
  EXPECT_EQ(reason("<robot name=\"r\">\n<link name=\"a\"/>\n"),
            "the importer refused the file: line 3: expected </robot>, which closes line 1, found "
            "the end");
  EXPECT_EQ(reason("<?xml version=\"1.0\"?>\n<sdf/>"),
            "the importer refused the file: line 2: expected a <robot> element, found <sdf>");
  EXPECT_EQ(reason(std::string("<robot>\n\n\0</robot>", 18)),
            "the importer refused the file: line 3: expected text, found a zero byte");
  // What urdfdom objects to, where the word stands once.
  const std::string refused =
      reason("<robot name=\"r\">\n" + linkWith("<cone radius=\"1\"/>") + "\n</robot>");
  EXPECT_EQ(refused.rfind("the importer refused the file: line 2: ", 0), 0u) << refused;
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
