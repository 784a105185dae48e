// A humanoid of 29 joints with a moving root, as a G1 has them: where its links are and how far
// apart, held against libmujoco's own kinematics and collision.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "lss/separation.h"
#include "tests/assets/mjcf_files.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// Of distances (m): MuJoCo moves parallel capsules' nearest points by as much.
constexpr double kSameDistance = 1e-9;

std::string body(const std::string& name, const std::string& at, const std::string& axes,
                 const std::string& geom, const std::string& children = "") {
  std::string joints;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string axis = axes[i] == 'x' ? "1 0 0" : axes[i] == 'y' ? "0 1 0" : "0 0 1";
    joints += "<joint name=\"" + name + "_" + axes[i] + "\" type=\"hinge\" axis=\"" + axis + "\"/>";
  }
  return "<body name=\"" + name + "\" pos=\"" + at + "\">" + joints + "<geom margin=\"3\" " + geom +
         "/>" + children + "</body>\n";
}

std::string capsule(const std::string& fromTo, const std::string& radius) {
  return "type=\"capsule\" fromto=\"" + fromTo + "\" size=\"" + radius + "\"";
}

std::string humanoid() {
  std::string limbs;
  for (const std::string side : {"left", "right"}) {
    const std::string y = side == "left" ? "" : "-";
    const std::string foot =
        body(side + "_foot", "0 0 -0.3", "yx", capsule("-0.05 0 -0.03 0.12 0 -0.03", "0.03"));
    const std::string shin =
        body(side + "_shin", "0 0 -0.3", "y", capsule("0 0 -0.05 0 0 -0.25", "0.04"), foot);
    limbs += body(side + "_thigh", "0 " + y + "0.1 -0.1", "yxz",
                  capsule("0 0 -0.05 0.02 0 -0.25", "0.06"), shin);
  }
  std::string arms;
  for (const std::string side : {"left", "right"}) {
    const std::string y = side == "left" ? "" : "-";
    const std::string hand =
        body(side + "_hand", "0.2 0 0", "xyz", "type=\"sphere\" pos=\"0.06 0 0\" size=\"0.04\"");
    const std::string fore =
        body(side + "_fore", "0 0 -0.2", "y", capsule("0.02 0 0 0.16 0 0", "0.03"), hand);
    arms += body(side + "_arm", "0 " + y + "0.15 0.25", "yxz",
                 capsule("0 0 -0.02 0 0 -0.16", "0.035"), fore);
  }
  const std::string torso =
      body("torso", "0 0 0.1", "zxy", capsule("0 0 0.05 0 0 0.25", "0.09"), arms);
  std::string pelvis =
      body("pelvis", "0 0 0.8", "", capsule("0 -0.05 0 0 0.05 0", "0.07"), torso + limbs);
  pelvis.insert(pelvis.find('>') + 1, "<freejoint name=\"root\"/>");
  return mujoco(pelvis,
                "<size nconmax=\"2000\" njmax=\"8000\"/>\n"
                "<option><flag filterparent=\"disable\"/></option>\n");
}

/// As libmujoco's collision has them: of two links, the least of their geoms.
std::map<std::pair<std::string, std::string>, double> mujocosDistances(MujocoItself& mujoco) {
  mj_collision(&mujoco.model(), &mujoco.data());
  std::map<std::pair<std::string, std::string>, double> least;
  for (int i = 0; i < mujoco.data().ncon; ++i) {
    const mjContact& contact = mujoco.data().contact[i];
    const auto nameOf = [&](int geom) {
      return mujoco.nameOf(mjOBJ_BODY, mujoco.model().geom_bodyid[geom]);
    };
    const auto pair = std::minmax({nameOf(contact.geom1), nameOf(contact.geom2)});
    const auto known = least.emplace(pair, contact.dist).first;
    known->second = std::min(known->second, contact.dist);
  }
  return least;
}

TEST_F(ImportMjcf, HasTheDistancesOfAHumanoidThatMujocoHas) {
  const Robot robot = robotOf(humanoid());
  MujocoItself mujoco(path_);
  const Skeleton& skeleton = robot.avatar().skeleton();
  ASSERT_EQ(robot.numCoordinates(), 29u);
  const auto root = skeleton.find("pelvis");
  ASSERT_TRUE(root.has_value());
  Random random(46);
  std::vector<double> q(robot.numCoordinates());
  Pose pose;
  int compared = 0, deep = 0;
  for (int look = 0; look < 200; ++look) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] = random.uniform(-1.5, 1.5);
      const int joint = mujoco.idOf(mjOBJ_JOINT, robot.coordinates()[i].name);
      mujoco.data().qpos[mujoco.model().jnt_qposadr[joint]] = q[i];
    }
    robot.poseAt(q.data(), pose);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(random.uniform(0, 3), random.direction()));
    const Vector3d place = random.inBox(2.0);
    pose.rotations[static_cast<std::size_t>(*root)] = Quaternion(turn);
    pose.translations[static_cast<std::size_t>(*root)] = place;
    mjtNum* const free = mujoco.data().qpos;
    std::copy_n(place.data(), 3, free);
    const double wxyz[] = {turn.w(), turn.x(), turn.y(), turn.z()};
    std::copy_n(wxyz, 4, free + 3);
    mujoco.computeFrames();
    for (const auto& [pair, distance] : mujocosDistances(mujoco)) {
      const auto hullOf = [&](const std::string& name, double& radius) {
        const JointId link = *skeleton.find(name);
        const Affine frame = frameOf(skeleton, pose, link);
        const Lss& lss = robot.avatar().lss(link).front();
        radius = lss.radius;
        return Hull::segment(frame * lss.a, frame * lss.b);
      };
      double one = 0.0, other = 0.0;
      const Separation between = separation(hullOf(pair.first, one), hullOf(pair.second, other));
      EXPECT_NEAR(between.distance - one - other, distance, kSameDistance)
          << pair.first << " and " << pair.second;
      ++compared;
      deep += distance < 0.0 ? 1 : 0;
    }
    if (HasFailure()) return;
  }
  // 14 links, every two of them.
  EXPECT_EQ(compared, 200 * 14 * 13 / 2);
  EXPECT_GT(deep, 1000);
}

}  // namespace
}  // namespace foretouch::test
