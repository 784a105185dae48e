// importRobot() on MJCF: where links are, held against mj_kinematics of libmujoco itself.
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/assets/mjcf_files.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// Of metres and of a rotation's entries.
constexpr double kAlike = 1e-12;

/// Bodies that hang on one another by hinges and slides of every kind, and what they follow.
class RandomMjcf {
 public:
  explicit RandomMjcf(std::uint64_t seed) : random_(seed) {
    isRadian_ = random_.chance(0.5);
    if (random_.chance(0.2)) {
      bodies_ = floating();
      return;
    }
    const int roots = 1 + random_.below(2);
    for (int i = 0; i < roots; ++i) bodies_ += body(0);
  }

  std::string file() {
    std::string rules;
    for (std::size_t i = 1; i < joints_.size(); ++i) {
      // Leaders follow nobody: odd ones follow even ones.
      if (i % 2 == 0 || !random_.chance(0.3)) continue;
      const double constant = random_.uniform(-1, 1), factor = random_.uniform(-2, 2);
      rules += "<joint joint1=\"" + joints_[i] + "\" joint2=\"" + joints_[i - 1] +
               "\" polycoef=\"" + inText(constant) + " " + inText(factor) + " 0 0 0\"/>";
      follows_[joints_[i]] = {joints_[i - 1], constant, factor};
    }
    return mujoco(bodies_,
                  std::string("<compiler autolimits=\"true\" angle=\"") +
                      (isRadian_ ? "radian" : "degree") + "\" eulerseq=\"" +
                      (random_.chance(0.5) ? "xyz" : "ZYX") + "\"/>\n",
                  "<equality>" + rules + "</equality>\n");
  }
  struct Rule {
    std::string leader;
    double constant, factor;
  };
  [[nodiscard]] const std::map<std::string, Rule>& follows() const { return follows_; }
  [[nodiscard]] std::size_t numJoints() const { return joints_.size(); }

 private:
  double angle(double radians) { return isRadian_ ? radians : radians * 180.0 / M_PI; }

  std::string frame() {
    std::string out = " pos=\"" + inText(random_.inBox(0.5)) + "\"";
    const Vector3d v = random_.direction();
    switch (random_.below(5)) {
      case 0: return out;
      case 1: return out + " quat=\"" + inText(random_.uniform(0.1, 2)) + " " + inText(v) + "\"";
      case 2:
        return out + " axisangle=\"" + inText(v) + " " + inText(angle(random_.uniform(-3, 3))) +
               "\"";
      case 3:
        return out + " euler=\"" + inText(angle(random_.uniform(-3, 3))) + " " +
               inText(angle(random_.uniform(-1, 1))) + " " + inText(angle(random_.uniform(-3, 3))) +
               "\"";
      default:
        return out + " xyaxes=\"" + inText(v) + " " + inText(v.unitOrthogonal() + 0.3 * v) + "\"";
    }
  }

  std::string joint() {
    const std::string name = "j" + std::to_string(joints_.size());
    joints_.push_back(name);
    const bool turns = random_.chance(0.7);
    std::string out = "<joint name=\"" + name + "\" type=\"" + (turns ? "hinge" : "slide") +
                      "\" axis=\"" + inText(3.0 * random_.direction()) + "\"";
    if (random_.chance(0.5)) out += " pos=\"" + inText(random_.inBox(0.2)) + "\"";
    if (random_.chance(0.3)) {
      const double reference = random_.uniform(-1, 1);
      out += " ref=\"" + inText(turns ? angle(reference) : reference) + "\"";
    }
    if (random_.chance(0.5)) {
      const double low = random_.uniform(-4, 0), high = random_.uniform(0.1, 4);
      out += " range=\"" + inText(turns ? angle(low) : low) + " " +
             inText(turns ? angle(high) : high) + "\"";
    }
    return out + "/>\n";
  }

  std::string geom() {
    if (random_.chance(0.3)) {
      return "<geom type=\"capsule\" fromto=\"" + inText(random_.inBox(0.3)) + " " +
             inText(random_.inBox(0.3)) + "\" size=\"0.05\"/>\n";
    }
    return std::string("<geom type=\"") + (random_.chance(0.5) ? "capsule" : "sphere") +
           "\" size=\"0.05 0.1\"" + frame() + "/>\n";
  }

  std::string body(int depth) {
    std::string out = "<body name=\"b" + std::to_string(numBodies_++) + "\"" + frame() + ">\n";
    const int joints = random_.below(4);
    for (int i = 0; i < joints; ++i) out += joint();
    out += geom();
    const int children = depth > 5 ? 0 : random_.below(depth == 0 ? 4 : 3);
    for (int i = 0; i < children && numBodies_ < 40; ++i) out += body(depth + 1);
    return out + "</body>\n";
  }

  std::string floating() {
    return "<body name=\"base\"" + frame() + "><freejoint/>" + geom() + body(1) + "</body>";
  }

  Random random_;
  bool isRadian_ = false;
  int numBodies_ = 0;
  std::string bodies_;
  std::vector<std::string> joints_;
  std::map<std::string, Rule> follows_;
};

/// The same configuration for both.
void drawBoth(Random& random, const Robot& robot, const RandomMjcf& made, MujocoItself& mujoco,
              std::vector<double>& q) {
  const auto qposOf = [&](const std::string& joint) -> mjtNum& {
    const int id = mujoco.idOf(mjOBJ_JOINT, joint);
    return mujoco.data().qpos[mujoco.model().jnt_qposadr[id]];
  };
  const auto referenceOf = [&](const std::string& joint) {
    return mujoco.model().qpos0[mujoco.model().jnt_qposadr[mujoco.idOf(mjOBJ_JOINT, joint)]];
  };
  q.resize(robot.numCoordinates());
  for (std::size_t i = 0; i < q.size(); ++i) {
    q[i] = random.uniform(-7, 7);
    qposOf(robot.coordinates()[i].name) = q[i];
  }
  for (const auto& [joint, rule] : made.follows()) {
    qposOf(joint) = referenceOf(joint) + rule.constant +
                    rule.factor * (qposOf(rule.leader) - referenceOf(rule.leader));
  }
}

/// Returns how many links it compared.
int compareLinks(const Robot& robot, const Pose& pose, const MujocoItself& mujoco,
                 const mjData& data) {
  const Skeleton& skeleton = robot.avatar().skeleton();
  int compared = 0;
  for (int body = 1; body < mujoco.model().nbody; ++body) {
    const std::string name = mujoco.nameOf(mjOBJ_BODY, body);
    const auto link = skeleton.find(name);
    if (!link) {
      ADD_FAILURE() << "no link " << name;
      continue;
    }
    const Affine frame = frameOf(skeleton, pose, *link);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turned(data.xmat +
                                                                                9 * body);
    const Vector3d at(data.xpos[3 * body], data.xpos[3 * body + 1], data.xpos[3 * body + 2]);
    EXPECT_LT((frame.translation - at).norm(), kAlike) << name;
    EXPECT_LT((frame.linear - turned).cwiseAbs().maxCoeff(), kAlike) << name;

    // Its geom: on every body there is one, the capsule's segment along z of its frame.
    const int geom = mujoco.model().body_geomadr[body];
    const Vector3d centre(data.geom_xpos[3 * geom], data.geom_xpos[3 * geom + 1],
                          data.geom_xpos[3 * geom + 2]);
    const Vector3d along(data.geom_xmat[9 * geom + 2], data.geom_xmat[9 * geom + 5],
                         data.geom_xmat[9 * geom + 8]);
    const double half = mujoco.model().geom_type[geom] == mjGEOM_CAPSULE
                            ? mujoco.model().geom_size[3 * geom + 1]
                            : 0.0;
    const std::vector<Lss>& lss = robot.avatar().lss(*link);
    if (lss.size() != 1) {
      ADD_FAILURE() << name << " has " << lss.size() << " LSS";
      continue;
    }
    EXPECT_LT((frame * lss[0].a - (centre - half * along)).norm(), kAlike) << name;
    EXPECT_LT((frame * lss[0].b - (centre + half * along)).norm(), kAlike) << name;
    EXPECT_EQ(lss[0].radius, mujoco.model().geom_size[3 * geom]);
    ++compared;
  }
  return compared;
}

TEST_F(ImportMjcf, PutsLinksWhereMujocoItselfHasThem) {
  int links = 0, coordinates = 0, followers = 0, floating = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMjcf made(seed);
    const std::string file = made.file();
    const Robot robot = robotOf(file);
    MujocoItself mujoco(path_);
    ASSERT_EQ(robot.numCoordinates() + made.follows().size(), made.numJoints());
    Random random(1000 + seed);
    std::vector<double> q;
    Pose pose;
    for (int i = 0; i < 20; ++i) {
      drawBoth(random, robot, made, mujoco, q);
      mujoco.computeFrames();
      robot.poseAt(q.data(), pose);
      links += compareLinks(robot, pose, mujoco, mujoco.data());
    }
    coordinates += static_cast<int>(robot.numCoordinates());
    followers += static_cast<int>(made.follows().size());
    floating += file.find("freejoint") != std::string::npos ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(links, 5000);
  EXPECT_GT(coordinates, 200);
  EXPECT_GT(followers, 20);
  EXPECT_GT(floating, 3);
}

TEST_F(ImportMjcf, HasMujocosNamesLimitsAndReference) {
  const Robot robot = robotOf(mujoco(
      R"(<body name="arm" pos="0 0 1"><joint name="turn" axis="0 0 2" range="-90 180" ref="90"/>
<geom size="0.1"/><body name="hand"><joint name="push" type="slide" axis="1 0 0" range="0 0.5"/>
<joint axis="0 1 0"/><geom size="0.1"/></body></body>)"));
  ASSERT_EQ(robot.numCoordinates(), 3U);
  const auto& coordinates = robot.coordinates();
  EXPECT_EQ(coordinates[0].name, "turn");
  EXPECT_DOUBLE_EQ(coordinates[0].lower, -M_PI / 2);
  EXPECT_DOUBLE_EQ(coordinates[0].upper, M_PI);
  EXPECT_TRUE(coordinates[0].isAngle);
  EXPECT_FALSE(coordinates[0].isPeriodic);
  EXPECT_EQ(coordinates[1].name, "push");
  EXPECT_FALSE(coordinates[1].isAngle);
  EXPECT_EQ(coordinates[1].upper, 0.5);
  EXPECT_EQ(coordinates[2].name, "hand");  // of the link: the joint has no name
  EXPECT_TRUE(coordinates[2].isPeriodic);
  // At the reference, a quarter turn, the arm is as the file has it.
  Pose pose;
  const std::vector<double> q{M_PI / 2, 0, 0};
  robot.poseAt(q.data(), pose);
  const Skeleton& skeleton = robot.avatar().skeleton();
  EXPECT_LT(
      (frameOf(skeleton, pose, *skeleton.find("arm")).linear - Eigen::Matrix3d::Identity()).norm(),
      1e-15);
  EXPECT_TRUE(skeleton.find("world").has_value());
}

TEST_F(ImportMjcf, HoldsAJointThatAnEqualityFixes) {
  const Robot robot = robotOf(mujoco(
      R"(<body name="arm"><joint name="held" type="slide" axis="1 0 0" ref="0.25"/><geom size="0.1"/>
</body>)",
      "", R"(<equality><joint joint1="held" polycoef="0.5 0 0 0 0"/></equality>)"));
  EXPECT_EQ(robot.numCoordinates(), 0U);
  Pose pose;
  robot.poseAt(nullptr, pose);
  const Skeleton& skeleton = robot.avatar().skeleton();
  // Held half a metre beyond its reference, where the file has it.
  EXPECT_LT(
      (frameOf(skeleton, pose, *skeleton.find("arm")).translation - Vector3d(0.5, 0, 0)).norm(),
      1e-15);
}

}  // namespace
}  // namespace foretouch::test
