// One robot as URDF and as MJCF: both move and answer alike.
#include <cmath>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "middleware/edges/edge_query.h"
#include "middleware/scene/scene.h"
#include "tests/assets/mjcf_files.h"
#include "tests/assets/urdf_files.h"
#include "tests/support/random_geometry.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// A link and the joint that it hangs on.
struct Part {
  const char *name, *parent;
  Vector3d at, turn;  ///< Roll, pitch, yaw (rad).
  const char* joint;  ///< revolute, continuous, prismatic or fixed
  Vector3d axis;
  double lower, upper;
  const char* shape;  ///< capsule, sphere, box, cylinder: about the link's origin
  Vector3d size;      ///< Radius and length, or edges.
};

/// An arm of six joints with a gripper whose second finger follows the first.
const std::vector<Part> kArm = {
    {"base", "", {0, 0, 0}, {0, 0, 0}, "", {0, 0, 0}, 0, 0, "cylinder", {0.1, 0.2, 0}},
    {"shoulder",
     "base",
     {0, 0, 0.2},
     {0, 0, 0.3},
     "revolute",
     {0, 0, 1},
     -4,
     4,
     "sphere",
     {0.09, 0, 0}},
    {"upper",
     "shoulder",
     {0, 0.1, 0.1},
     {0.2, -0.1, 0},
     "revolute",
     {0, 2, 0},
     -2,
     2,
     "capsule",
     {0.06, 0.3, 0}},
    {"fore",
     "upper",
     {0, -0.1, 0.35},
     {0, 0, -0.7},
     "revolute",
     {0, 1, 1},
     -2.5,
     2.5,
     "capsule",
     {0.05, 0.3, 0}},
    {"roll",
     "fore",
     {0.02, 0, 0.3},
     {1.5, 0, 0},
     "continuous",
     {0, 0, -1},
     0,
     0,
     "capsule",
     {0.04, 0.1, 0}},
    {"reach",
     "roll",
     {0, 0, 0.1},
     {-1.5, 0.4, 0.1},
     "prismatic",
     {0, 0, 1},
     0,
     0.3,
     "capsule",
     {0.03, 0.2, 0}},
    {"palm", "reach", {0, 0, 0.12}, {0, 0, 1}, "fixed", {0, 0, 0}, 0, 0, "box", {0.12, 0.04, 0.05}},
    {"left",
     "palm",
     {0.03, 0, 0.05},
     {0, 0, 0},
     "prismatic",
     {1, 0, 0},
     0,
     0.04,
     "capsule",
     {0.008, 0.06, 0}},
    {"right",
     "palm",
     {-0.03, 0, 0.05},
     {0, 0, 0},
     "prismatic",
     {-1, 0, 0},
     0,
     0.04,
     "capsule",
     {0.008, 0.06, 0}}};

std::string asUrdf() {
  std::string out;
  for (const Part& part : kArm) {
    const std::string shape = part.shape;
    std::string geometry = "<sphere radius=\"" + inText(part.size.x()) + "\"/>";
    if (shape == "box") geometry = "<box size=\"" + inText(part.size) + "\"/>";
    if (shape == "capsule" || shape == "cylinder") {
      geometry = "<" + shape + " radius=\"" + inText(part.size.x()) + "\" length=\"" +
                 inText(part.size.y()) + "\"/>";
    }
    out += linkWith(geometry, part.name);
    if (*part.parent == '\0') continue;
    std::string more =
        "<origin xyz=\"" + inText(part.at) + "\" rpy=\"" + inText(part.turn) + "\"/>";
    if (part.axis.norm() > 0.0) more += "<axis xyz=\"" + inText(part.axis) + "\"/>";
    if (part.upper > part.lower) {
      more += "<limit lower=\"" + inText(part.lower) + "\" upper=\"" + inText(part.upper) +
              "\" effort=\"1\" velocity=\"1\"/>";
    }
    if (std::string(part.name) == "right") {
      more += "<mimic joint=\"to_left\" multiplier=\"0.5\" offset=\"0.01\"/>";
    }
    out += joint(part.joint, part.parent, part.name, more);
  }
  return robot(out);
}

std::string bodyOf(const Part& part) {
  std::string out = "<body name=\"" + std::string(part.name) + "\" pos=\"" + inText(part.at) +
                    "\" euler=\"" + inText(part.turn) + "\">\n";
  const std::string kind = part.joint;
  if (!kind.empty() && kind != "fixed") {
    out += "<joint name=\"to_" + std::string(part.name) + "\" type=\"" +
           (kind == "prismatic" ? "slide" : "hinge") + "\" axis=\"" + inText(part.axis) + "\"";
    if (part.upper > part.lower) {
      out += " range=\"" + inText(part.lower) + " " + inText(part.upper) + "\"";
    }
    out += "/>\n";
  }
  const std::string shape = part.shape;
  const Vector3d half = shape == "box"      ? Vector3d(0.5 * part.size)
                        : shape == "sphere" ? part.size
                                            : Vector3d(part.size.x(), 0.5 * part.size.y(), 0);
  out += "<geom type=\"" + shape + "\" size=\"" + inText(half) + "\"/>\n";
  for (const Part& child : kArm) {
    if (std::string(child.parent) == part.name) out += bodyOf(child);
  }
  return out + "</body>\n";
}

std::string asMjcf() {
  return mujoco(bodyOf(kArm[0]), "<compiler angle=\"radian\" eulerseq=\"XYZ\"/>\n",
                "<equality><joint joint1=\"to_right\" joint2=\"to_left\" "
                "polycoef=\"0.01 0.5 0 0 0\"/></equality>\n");
}

class OneRobotTwice : public ImportMjcf {
 protected:
  Robot urdf(const std::string& path) {
    RobotImportOptions options;
    options.reading = withModelImporter();
    auto imported = importRobot(path, options);
    if (!imported.ok()) throw std::runtime_error(describe(imported.error()));
    return std::move(imported).value().made.robot;
  }
};

std::vector<double> drawn(Random& random, const Robot& robot) {
  std::vector<double> q;
  for (const RobotCoordinate& c : robot.coordinates()) {
    const bool isLimited = std::isfinite(c.lower) && std::isfinite(c.upper);
    q.push_back(isLimited ? random.uniform(c.lower, c.upper) : random.uniform(-6, 6));
  }
  return q;
}

void expectSameCoordinates(const Robot& a, const Robot& b, double tolerance) {
  ASSERT_EQ(a.numCoordinates(), b.numCoordinates());
  for (std::size_t i = 0; i < a.numCoordinates(); ++i) {
    const RobotCoordinate &of = a.coordinates()[i], &other = b.coordinates()[i];
    EXPECT_EQ(of.name, other.name);
    EXPECT_EQ(of.isAngle, other.isAngle);
    EXPECT_EQ(of.isPeriodic, other.isPeriodic);
    if (std::isfinite(of.lower) || std::isfinite(other.lower)) {
      EXPECT_NEAR(of.lower, other.lower, tolerance);
      EXPECT_NEAR(of.upper, other.upper, tolerance);
    }
  }
}

/// Of the links that both have; returns how many those are.
int expectSameFrames(const Robot& a, const Robot& b, const std::vector<double>& q,
                     double tolerance) {
  Pose ofA, ofB;
  a.poseAt(q.data(), ofA);
  b.poseAt(q.data(), ofB);
  const Skeleton &bonesA = a.avatar().skeleton(), &bonesB = b.avatar().skeleton();
  int compared = 0;
  for (JointId link = 0; link < bonesA.numJoints(); ++link) {
    const auto other = bonesB.find(bonesA.name(link));
    if (!other) continue;
    const Affine x = frameOf(bonesA, ofA, link), y = frameOf(bonesB, ofB, *other);
    EXPECT_LT((x.translation - y.translation).norm(), tolerance) << bonesA.name(link);
    EXPECT_LT((x.linear - y.linear).cwiseAbs().maxCoeff(), tolerance) << bonesA.name(link);
    ++compared;
  }
  return compared;
}

/// Rods of 4 mm around the arm.
Scene rods() {
  RawScene raw;
  raw.objectNames = {"rods"};
  for (int i = 0; i < 10; ++i) {
    const double x = 0.6 * std::cos(0.7 * i), y = 0.6 * std::sin(0.7 * i);
    raw.triangles.push_back({{Vector3d(x, y, -1), Vector3d(x + 0.004, y, -1), Vector3d(x, y, 2)}});
    raw.objectOf.push_back(0);
  }
  return Scene::build(std::move(raw)).value();
}

TEST_F(OneRobotTwice, MovesAndAnswersAlike) {
  const Robot fromUrdf = urdf(folder_.write("arm.urdf", asUrdf()));
  const Robot fromMjcf = robotOf(asMjcf());
  ASSERT_EQ(fromUrdf.avatar().numLinks(), fromMjcf.avatar().numLinks());
  expectSameCoordinates(fromUrdf, fromMjcf, 1e-15);
  EdgeOptions options;
  options.self = PairRules::derive(fromUrdf.avatar()).value();
  const auto ofUrdf = EdgeQuery::build(fromUrdf, rods(), options).value();
  options.self = PairRules::derive(fromMjcf.avatar()).value();
  const auto ofMjcf = EdgeQuery::build(fromMjcf, rods(), options).value();
  Random random(11);
  Scratch scratch;
  int clear = 0, met = 0, starts = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<double> q0 = drawn(random, fromUrdf), q1 = drawn(random, fromUrdf);
    EXPECT_EQ(expectSameFrames(fromUrdf, fromMjcf, q0, 1e-12), 9);
    const EdgeAnswer a = ofUrdf.answer(q0, q1, scratch).value();
    const EdgeAnswer b = ofMjcf.answer(q0, q1, scratch).value();
    // Rounding apart, the shapes are the same but for boxes and cylinders, which are larger by the
    // rounding of their corners to float.
    ASSERT_EQ(a.verdict, b.verdict) << i;
    EXPECT_NEAR(a.freeUntil, b.freeUntil, 1e-4) << i;
    if (a.verdict == Verdict::Contact) {
      EXPECT_EQ(a.contact.link, b.contact.link) << i;
    }
    clear += a.verdict == Verdict::Clear ? 1 : 0;
    met += a.verdict == Verdict::Contact ? 1 : 0;
    starts += a.verdict == Verdict::StartsInContact ? 1 : 0;
  }
  EXPECT_GT(clear, 200);
  EXPECT_GT(met, 200);
  EXPECT_GT(starts, 20);
}

/// libmujoco reads URDF as well, and writes what it has read as MJCF, with six digits.
TEST_F(OneRobotTwice, IiwaInMujocosOwnHand) {
  FORETOUCH_REQUIRE_SHARED(path, "robots/kuka_iiwa/model.urdf");
  const auto folder = std::filesystem::path(*path).parent_path();
  makeFolder("meshes");
  for (const auto& entry : std::filesystem::directory_iterator(folder / "meshes")) {
    if (entry.path().extension() == ".stl") {
      std::filesystem::copy(entry.path(), folder_ / "meshes");
    }
  }
  std::string text = contentOf(*path);
  text.insert(
      text.rfind("</robot>"),
      "<mujoco><compiler meshdir=\"meshes\" fusestatic=\"false\" strippath=\"true\"/></mujoco>");
  MujocoItself read(folder_.write("iiwa.urdf", text));
  const std::string written = folder_ / "iiwa.xml";
  std::array<char, 1000> error{};
  ASSERT_NE(mj_saveLastXML(written.c_str(), &read.model(), error.data(), error.size()), 0)
      << error.data();
  const Robot fromUrdf = urdf(*path), fromMjcf = urdf(written);
  expectSameCoordinates(fromUrdf, fromMjcf, 1e-5);
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(expectSameFrames(fromUrdf, fromMjcf, drawn(random, fromUrdf), 1e-4), 8);
  }
}

}  // namespace
}  // namespace foretouch::test
