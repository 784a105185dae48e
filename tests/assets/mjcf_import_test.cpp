// importModel() and importRobot() on MJCF made here: shapes, files, and what is refused by name.
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/assets/mjcf_files.h"
#include "tests/assets/urdf_files.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

std::string bodyWith(const std::string& geoms, const std::string& name = "a") {
  return "<body name=\"" + name + "\">" + geoms + "</body>";
}
const std::string kBall = "<geom size=\"0.1\"/>";
const std::string kTetrahedronObj =
    "v 0 0 0\nv 0.3 0 0\nv 0 0.2 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// As an avatar's links have them.
ModelMesh inFloat(ModelMesh mesh) {
  for (Vector3d& v : mesh.vertices) v = v.cast<float>().cast<double>();
  return mesh;
}

TEST_F(ImportMjcf, KeepsSpheresAndCapsulesExactly) {
  const Model model = modelOf(mujoco(bodyWith(
      R"(<geom type="sphere" size="0.25" pos="1 2 3"/>
<geom type="capsule" size="0.125 1" pos="0 0 1" euler="0 90 0"/>
<geom type="capsule" size="0.125" fromto="0 0 0  0 3 0"/>)")));
  ASSERT_EQ(model.nodes.size(), 1U);
  const std::vector<Lss>& lss = model.nodes[0].lss;
  ASSERT_EQ(lss.size(), 3U);
  EXPECT_EQ(lss[0].a, Vector3d(1, 2, 3));
  EXPECT_EQ(lss[0].b, Vector3d(1, 2, 3));
  EXPECT_EQ(lss[0].radius, 0.25);
  EXPECT_LT((lss[1].a - Vector3d(-1, 0, 1)).norm(), 1e-15);
  EXPECT_LT((lss[1].b - Vector3d(1, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(lss[1].radius, 0.125);
  EXPECT_LT(std::min((lss[2].a - Vector3d(0, 3, 0)).norm(), (lss[2].b - Vector3d(0, 3, 0)).norm()),
            1e-15);
  EXPECT_TRUE(model.meshes.empty());
}

/// How far a solid of those half extents reaches along a unit vector, from its centre.
double supportOf(const std::string& type, const Vector3d& half, const Vector3d& n) {
  const Vector3d reach = half.cwiseProduct(n).cwiseAbs();
  if (type == "box") return reach.sum();
  return type == "cylinder" ? reach.head<2>().norm() + reach.z() : reach.norm();
}

/// Along every direction the corners, rounded to float, reach as far as the solid, and not much
/// farther.
TEST_F(ImportMjcf, ContainsBoxesCylindersAndEllipsoidsClosely) {
  struct Case {
    const char* type;
    Vector3d size;
    double slack;  // of the largest size
  };
  Random random(7);
  for (const Case& c :
       {Case{"box", {0.3, 0.1, 0.02}, 1e-6}, Case{"box", {1e-4, 1, 2}, 1e-6},
        Case{"cylinder", {0.3, 0.2, 0}, 0.005}, Case{"cylinder", {1, 1e-3, 0}, 0.005},
        Case{"ellipsoid", {0.3, 0.2, 0.1}, 0.03}, Case{"ellipsoid", {1, 1e-3, 0.5}, 0.03}}) {
    SCOPED_TRACE(c.type);
    const Quaternion turn = random.rotation();
    const Vector3d at = random.inBox(20);
    const std::string frame = "pos=\"" + inText(at) + "\" quat=\"" + inText(turn.w()) + " " +
                              inText(turn.vec()) + "\" size=\"" + inText(c.size) + "\"";
    // Half extents along x, y and z.
    const bool isCylinder = std::string(c.type) == "cylinder";
    const Vector3d half = isCylinder ? Vector3d(c.size.x(), c.size.x(), c.size.y()) : c.size;
    const Model model =
        modelOf(mujoco(bodyWith(std::string("<geom type=\"") + c.type + "\" " + frame + "/>")));
    ASSERT_EQ(model.meshes.size(), 1U);
    const ModelMesh mesh = inFloat(model.meshes[0]);
    double least = 1e300, most = 0.0;
    for (int i = 0; i < 20000; ++i) {
      Vector3d n = random.direction();
      if (random.chance(0.2)) n = Vector3d::Unit(random.below(3)) + 1e-4 * n;
      n.normalize();
      double reach = -1e300;
      for (const Vector3d& v : mesh.vertices) reach = std::max(reach, (turn * n).dot(v - at));
      const double beyond = reach - supportOf(c.type, half, n);
      least = std::min(least, beyond);
      most = std::max(most, beyond);
    }
    EXPECT_GE(least, 0.0);
    EXPECT_LT(most, c.slack * c.size.maxCoeff() + 2e-5);
  }
}

TEST_F(ImportMjcf, TakesMeshesWhereMujocoPutsThem) {
  makeFolder("parts/deep");
  folder_.write("parts/deep/part.obj", kTetrahedronObj);
  const Model model = modelOf(mujoco(
      bodyWith(R"(<geom type="mesh" mesh="part" pos="1 0 0" euler="0 0 90"/>)"),
      R"(<compiler meshdir="parts"/><asset><mesh file="deep/part.obj" scale="2 1 1"/></asset>)"));
  ASSERT_EQ(model.meshes.size(), 1U);
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.triangles.size(), 4U);
  // (0.6, 0, 0) and (0, 0.2, 0) of the scaled mesh, turned by a quarter, one to the right;
  // libmujoco keeps vertices in single precision about the centre of the mesh.
  for (const Vector3d& expected :
       {Vector3d(1, 0, 0), Vector3d(1, 0.6, 0), Vector3d(0.8, 0, 0), Vector3d(1, 0, 0.1)}) {
    EXPECT_TRUE(std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vector3d& v) {
      return (v - expected).norm() < 1e-7;
    })) << expected.transpose();
  }
}

TEST_F(ImportMjcf, TakesWhatCollidesOrWhatIsSeen) {
  const std::string file = mujoco(
      bodyWith(R"(<geom size="0.1"/><geom class="seen" size="0.2"/><geom class="seen" size="0.3"/>
<body name="bare"><geom class="seen" size="0.4"/></body>
<body name="paired"><geom name="p" class="seen" size="0.5"/><geom class="seen" size="0.6"/></body>)"),
      R"(<default><default class="seen"><geom contype="0" conaffinity="0"/></default></default>)",
      R"(<contact><pair geom1="p" geom2="q"/></contact>)");
  // q is another body's that collides.
  const std::string whole = file.substr(0, file.find("</worldbody>")) +
                            "<body name=\"other\"><geom name=\"q\" size=\"0.7\"/></body>" +
                            file.substr(file.find("</worldbody>"));
  const auto radiiOf = [](const Model& model, const char* node) {
    std::vector<double> radii;
    for (const Lss& lss : model.nodes[static_cast<std::size_t>(nodeNamed(model, node))].lss) {
      radii.push_back(lss.radius);
    }
    return radii;
  };
  const Model model = modelOf(whole);
  EXPECT_EQ(radiiOf(model, "a"), std::vector<double>({0.1}));
  EXPECT_EQ(radiiOf(model, "bare"), std::vector<double>({0.4}));
  EXPECT_EQ(radiiOf(model, "paired"), std::vector<double>({0.5}));
  EXPECT_TRUE(mentions(model.notes, "'bare' has no geoms that collide"));
  ModelImportOptions seen = withModelImporter();
  seen.urdfSurface = UrdfSurface::Visual;
  const Model shown = modelOf(whole, seen);
  EXPECT_EQ(radiiOf(shown, "a"), std::vector<double>({0.2, 0.3}));
  EXPECT_EQ(radiiOf(shown, "paired"), std::vector<double>({0.6}));
  EXPECT_EQ(radiiOf(shown, "other"), std::vector<double>({0.7}));
}

TEST_F(ImportMjcf, LeavesOutWhatHasNoPartInShapeAndWhatIsTheWorlds) {
  const Robot robot = robotOf(
      "<mujoco model=\"whole\"><option timestep=\"0.001\"/><size njmax=\"2000000000\"/>"
      "<visual><headlight ambient=\"1 1 1\"/></visual>"
      "<asset><texture name=\"t\" type=\"2d\" file=\"gone.png\"/>"
      "<material name=\"m\" texture=\"t\"/><hfield name=\"h\" file=\"gone.bin\" size=\"1 1 1 1\"/>"
      "<mesh name=\"unused\" file=\"gone.stl\"/></asset>"
      "<default><geom material=\"m\"/><motor ctrlrange=\"-1 1\"/></default>"
      "<worldbody><light pos=\"0 0 3\"/><geom name=\"floor\" type=\"plane\" size=\"1 1 1\"/>"
      "<geom type=\"hfield\" hfield=\"h\"/><camera/>" +
      bodyWith("<joint name=\"j\" actuatorfrcrange=\"-1 1\"/><site name=\"s\"/>" + kBall) +
      "</worldbody><actuator><motor joint=\"j\"/></actuator>"
      "<sensor><touch site=\"s\"/></sensor><keyframe><key qpos=\"0\"/></keyframe></mujoco>");
  EXPECT_EQ(robot.avatar().numLss(), 1);
  EXPECT_EQ(robot.numCoordinates(), 1U);
  EXPECT_TRUE(mentions(notes_, "geoms of the world itself (2)"));
  EXPECT_TRUE(mentions(notes_, "'floor'"));
}

TEST_F(ImportMjcf, PutsIncludedFilesInTheirPlaces) {
  makeFolder("parts");
  folder_.write("parts/defaults.xml",
                "<mujoco><default><geom type=\"capsule\" size=\"0.1 0.2\"/></default></mujoco>");
  folder_.write("arm.xml",
                "<mujocoinclude>\n<body name=\"arm\"><joint name=\"j\"/>\n<geom/>"
                "<include file=\"hand.xml\"/></body></mujocoinclude>");
  folder_.write("hand.xml", "<x><body name=\"hand\"><geom/></body></x>");
  const std::string includes = "<include file=\"parts/defaults.xml\"/>";
  const Robot robot = robotOf(mujoco("<include file=\"arm.xml\"/>", includes));
  EXPECT_EQ(robot.avatar().numLss(), 2);
  EXPECT_TRUE(robot.avatar().skeleton().find("hand").has_value());

  const std::string arm = "<include file=\"arm.xml\"/>";
  expectRefusal(mujoco(arm + arm, includes), "line 3: file 'arm.xml' is included a second time");
  folder_.write("hand.xml", "<x><include file=\"arm.xml\"/></x>");
  expectRefusal(mujoco(arm, includes), "'hand.xml' line 1: file 'arm.xml' is included a second");
  folder_.write("hand.xml", "<x>\n<body name=\"hand\"><geom sise=\"1\"/></body></x>");
  expectRefusal(mujoco(arm, includes),
                "'hand.xml' line 2: Schema violation: unrecognized "
                "attribute: 'sise' in <geom>");
  folder_.write("hand.xml", "<x>\n<body></x>");
  expectRefusal(mujoco(arm, includes), "file 'hand.xml': line 2: expected </body>");
  std::filesystem::remove(folder_ / "hand.xml");
  expectRefusal(mujoco(arm, includes), "'arm.xml' line 3: file 'hand.xml' was not found");
}

TEST_F(ImportMjcf, ReadsNoFileThatDoesNotLieBesideIt) {
  makeFolder("robot/.keys");
  makeFolder("elsewhere");
  const std::string outside = folder_.write("elsewhere/t.obj", kTetrahedronObj);
  folder_.write("elsewhere/more.xml", "<mujoco/>");
  folder_.write("robot/.keys/t.obj", kTetrahedronObj);
  std::filesystem::create_symlink(outside, folder_ / "robot/link.obj");
  const auto failureWith = [&](const std::string& before, const ModelImportOptions& reading) {
    RobotImportOptions options;
    options.reading = reading;
    const auto result = importRobot(
        folder_.write("robot/r.xml", mujoco(bodyWith("<geom type=\"mesh\" mesh=\"t\"/>"), before)),
        options);
    return result.ok() ? "" : describe(result.error());
  };
  const auto asMesh = [](const std::string& file) {
    return "<asset><mesh name=\"t\" file=\"" + file + "\"/></asset>";
  };
  for (const std::string& file : {outside, std::string("../elsewhere/t.obj"),
                                  std::string(".keys/t.obj"), std::string("link.obj")}) {
    EXPECT_NE(failureWith(asMesh(file), withModelImporter()).find("is not read"), std::string::npos)
        << file;
  }
  EXPECT_NE(failureWith("<include file=\"../elsewhere/more.xml\"/>", withModelImporter())
                .find("is not read"),
            std::string::npos);
  EXPECT_NE(failureWith(asMesh("/etc/hostname"), withModelImporter()).find("expected .stl"),
            std::string::npos);
  ModelImportOptions named = withModelImporter();
  named.packagePaths = {folder_ / "elsewhere"};
  EXPECT_EQ(failureWith(asMesh("../elsewhere/t.obj"), named), "");
}

TEST_F(ImportMjcf, RefusesByNameAndPlaceWhatAPlannerCannotDoWithout) {
  const std::string two =
      bodyWith(kBall + bodyWith("<joint name=\"j\" type=\"ball\"/>" + kBall, "b"));
  expectRefusal(mujoco(two), "joint 'j' of body 'b' is a ball");
  expectRefusal(mujoco(bodyWith("<freejoint/>" + kBall) + bodyWith(kBall, "b")),
                "body 'a' floats beside other bodies");
  expectRefusal(mujoco("<body name=\"m\" mocap=\"true\">" + kBall + "</body>" + bodyWith(kBall)),
                "body 'm' floats beside other bodies");
  const std::string joints =
      bodyWith("<joint name=\"j\"/>" + kBall + bodyWith("<joint name=\"k\"/>" + kBall, "b"));
  expectRefusal(mujoco(joints, "",
                       "<equality>\n<connect body1=\"a\" body2=\"b\" anchor=\"0 0 0\"/>"
                       "</equality>"),
                "line 6: equality <connect>");
  expectRefusal(mujoco(joints, "", "<equality><weld name=\"w\" body1=\"a\"/></equality>"),
                "equality <weld> 'w'");
  expectRefusal(
      mujoco(joints, "",
             "<equality><joint joint1=\"k\" joint2=\"j\" polycoef=\"0 1 2 0 0\"/></equality>"),
      "joint 'k' of body 'b' follows by a polynomial");
  expectRefusal(mujoco(joints, "",
                       "<equality><joint joint1=\"k\" joint2=\"j\"/>"
                       "<joint joint1=\"k\"/></equality>"),
                "joint 'k' of body 'b' is held by two equalities");
  expectRefusal(mujoco(joints, "",
                       "<equality><joint joint1=\"k\" joint2=\"j\"/>"
                       "<joint joint1=\"j\" joint2=\"k\"/></equality>"),
                "follows a joint that follows another one, or itself");
  expectRefusal(mujoco(bodyWith("<joint name=\"j\" range=\"20 -10\"/>" + kBall)),
                "line 3: range[0] should be smaller than range[1] in joint 'j'");
  expectRefusal(mujoco(bodyWith("<geom type=\"hfield\" hfield=\"h\"/>")), "is a height field");
  expectRefusal(mujoco(bodyWith("<geom type=\"plane\" size=\"1 1 1\"/>")), "geom");
  expectRefusal(mujoco(bodyWith("<composite type=\"rope\" count=\"9 1 1\" spacing=\"1\"/>")),
                "line 3: <composite>");
  expectRefusal(mujoco(bodyWith(kBall), "<extension>\n<plugin plugin=\"x\"/></extension>"),
                "line 2: <extension>: plugins are programs");
  expectRefusal(mujoco(bodyWith("<plugin plugin=\"x\"/>" + kBall)), "line 3: <plugin>");

  // An avatar has poses, not coordinates: it can do without.
  const Model model =
      modelOf(mujoco(two + bodyWith("<freejoint/>" + kBall, "c"), "",
                     "<equality><connect body1=\"a\" body2=\"b\" anchor=\"0 0 0\"/></equality>"));
  EXPECT_EQ(model.nodes.size(), 3U);
  EXPECT_EQ(model.nodes[static_cast<std::size_t>(nodeNamed(model, "c"))].parent, -1);
  EXPECT_TRUE(mentions(model.notes, "<connect>"));
}

TEST_F(ImportMjcf, SaysWhereBadInputIsBad) {
  expectRefusal("<mujoco><worldbody>", "line 1: expected </worldbody>");
  expectRefusal("<mujoco>\n<worldbdy/></mujoco>", "line 2: Schema violation: unrecognized element");
  expectRefusal(mujoco("<body>" + kBall + "<geom size=\"x\"/></body>"), "line 3: ");
  expectRefusal(mujoco(bodyWith("<geom size=\"0.1\" pos=\"nan 0 0\"/>")), "not finite");
  expectRefusal(mujoco(bodyWith("<geom size=\"1e30\"/>")), "has a size that is not finite");
  expectRefusal(mujoco("<body name=\"far\" pos=\"1e30 0 0\">" + kBall + "</body>"),
                "'far' has a frame that is not finite, or beyond");
  expectRefusal(mujoco(bodyWith("<geom type=\"mesh\" mesh=\"gone\"/>"),
                       "<asset><mesh name=\"gone\"\nfile=\"gone.stl\"/></asset>"),
                "line 2: file 'gone.stl' was not found");
  folder_.write("bad.stl", std::string(84, '\x7f') + "rest");
  expectRefusal(mujoco(bodyWith("<geom type=\"mesh\" mesh=\"bad\"/>"),
                       "\n<asset><mesh file=\"bad.stl\"/></asset>"),
                "line 3: ");
  expectRefusal(mujoco(""), "robot.xml");  // nothing that has a surface
  std::string bodies;
  for (int i = 0; i < 5000; ++i) bodies += bodyWith(kBall, "n" + std::to_string(i)) + "\n";
  expectRefusal(mujoco(bodies), "more than 4096 bodies and joints");
  std::string deep;
  for (int i = 0; i < 300; ++i) deep += "<body>" + kBall;
  for (int i = 0; i < 300; ++i) deep += "</body>";
  expectRefusal(mujoco(deep), "in one another");
  expectRefusal(mujoco(bodyWith("<geom type=\"mesh\" mesh=\"m\"/>"),
                       "<asset><mesh name=\"m\" vertex=\"0 0 0 1 0 0 0 1 0 0 0 1\" "
                       "face=\"0 1 2 0 1 99\"/></asset>"),
                "robot.xml");
}

/// Whatever comes, a robot or an error that names the file.
TEST_F(ImportMjcf, SurvivesDamage) {
  const std::string whole =
      mujoco(bodyWith("<joint name=\"j\" range=\"-1 1\"/>" + kBall +
                      bodyWith("<joint name=\"k\"/><geom type=\"box\" size=\"1 2 3\"/>", "b")),
             "<compiler angle=\"radian\"/><default><geom rgba=\"1 0 0 1\"/></default>",
             "<equality><joint joint1=\"k\" joint2=\"j\"/></equality>");
  Random random(3);
  int read = 0, refused = 0;
  for (int i = 0; i < 100; ++i) {
    std::string damaged = whole;
    for (int k = 1 + random.below(2); k > 0; --k) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(damaged.size())));
      switch (random.below(7)) {
        case 0: damaged[at] = static_cast<char>(random.below(256)); break;
        case 1: damaged.erase(at, static_cast<std::size_t>(random.below(30))); break;
        case 2: damaged.insert(at, damaged.substr(damaged.size() / 2, 20)); break;
        case 3: damaged[at] = "0123456789.-e\"<>/"[random.below(17)]; break;
        default: {
          const auto digit = damaged.find_first_of("0123456789", at);
          if (digit != std::string::npos) damaged[digit] = "0123456789.-e"[random.below(13)];
        }
      }
    }
    const auto result = this->read(damaged);
    ++(result.ok() ? read : refused);
    if (result.ok()) continue;
    EXPECT_NE(describe(result.error()).find("robot.xml"), std::string::npos) << damaged;
    EXPECT_NE(result.error().code, ErrorCode::ImportCrashed) << describe(result.error()) << "\n"
                                                             << damaged;
  }
  EXPECT_GT(read, 10);
  EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace foretouch::test
