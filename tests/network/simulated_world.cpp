#include "tests/network/simulated_world.h"

#include <string>
#include <utility>

#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

constexpr double kRoom = 0.7;  // half its edge, m

Skeleton randomSkeleton(Random& random) {
  RawSkeleton raw;
  const int joints = 2 + random.below(5);
  const double chain = random.uniform(0.3, 1.0);
  for (int j = 0; j < joints; ++j) {
    const JointId parent = j == 0 ? kNoParent : (random.chance(chain) ? j - 1 : random.below(j));
    const Eigen::Vector3d offset =
        j == 0 ? random.inBox(0.5 * kRoom) : random.uniform(0.1, 0.4) * random.direction();
    raw.joints.push_back({"Joint" + std::to_string(j), parent, offset, random.rotation()});
  }
  return Skeleton::build(raw).value();
}

Lss randomLss(Random& random) {
  const Eigen::Vector3d a = random.inBox(0.1);
  const double length = random.chance(0.1) ? 0.0 : random.uniform(0.05, 0.4);
  return {a, a + length * random.direction(),
          random.chance(0.1) ? 0.0 : random.uniform(0.01, 0.07)};
}

}  // namespace

SimulatedBody randomBody(Random& random) {
  Skeleton skeleton = randomSkeleton(random);
  std::vector<std::vector<Lss>> lss(static_cast<std::size_t>(skeleton.numJoints()));
  std::vector<std::vector<oracle::Capsule>> capsules(lss.size());
  for (std::size_t link = 0; link < lss.size(); ++link) {
    const int count = link > 0 && random.chance(0.15) ? 0 : (random.chance(0.2) ? 2 : 1);
    for (int i = 0; i < count; ++i) {
      lss[link].push_back(randomLss(random));
      capsules[link].push_back(plain(lss[link].back()));
    }
  }
  Avatar avatar = Avatar::build(std::move(skeleton), std::move(lss)).value();
  return {std::move(avatar), std::move(capsules)};
}

SimulatedScene randomScene(Random& random) {
  RawScene raw;
  raw.objectNames = {"thing"};
  std::vector<oracle::Triangle> triangles;
  const int count = 3 + random.below(10);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d center = random.inBox(kRoom);
    const double size = random.magnitude(0.05, 1.0);
    Triangle triangle;
    for (auto& vertex : triangle.vertices) vertex = center + random.inBox(size);
    raw.triangles.push_back(triangle);
    raw.objectOf.push_back(0);
    triangles.push_back(plain(triangle));
  }
  return {Scene::build(std::move(raw)).value(), oracle::Scene(std::move(triangles))};
}

TrueMotion::TrueMotion(Random& random, const Skeleton& skeleton, std::vector<bool> moves,
                       std::vector<bool> drifts)
    : random_(random),
      skeleton_(skeleton),
      moves_(std::move(moves)),
      drifts_(std::move(drifts)),
      leapChance_(random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.3)),
      pose_(restPose(skeleton)),
      joints_(moves_.size()) {
  for (std::size_t j = 0; j < joints_.size(); ++j) leap(j);
}

void TrueMotion::leap(std::size_t joint) {
  const JointId id = static_cast<JointId>(joint);
  if (moves_[joint]) pose_.rotations[joint] = random_.rotation();
  if (drifts_[joint]) {
    const bool isRoot = skeleton_.parent(id) == kNoParent;
    pose_.translations[joint] =
        isRoot ? random_.inBox(kRoom)
               : Eigen::Vector3d(skeleton_.restOffset(id) + random_.inBox(0.1));
  }
  joints_[joint] = {random_.direction(), random_.uniform(0.0, 1.5) * random_.direction(),
                    random_.uniform(0.0, 6.0)};
}

Pose TrueMotion::next(double seconds) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (random_.chance(leapChance_)) {
      leap(j);
      continue;
    }
    Joint& joint = joints_[j];
    if (moves_[j]) {
      const double half = 0.5 * joint.turnRate * seconds;
      const Eigen::Vector3d v = std::sin(half) * joint.axis;
      pose_.rotations[j] = pose_.rotations[j] * Quaternion(std::cos(half), v.x(), v.y(), v.z());
    }
    if (!drifts_[j]) continue;
    pose_.translations[j] += seconds * joint.velocity;
    for (int axis = 0; axis < 3; ++axis) {  // back into the room
      const double place = pose_.translations[j][axis];
      if (std::abs(place) > kRoom && place * joint.velocity[axis] > 0.0)
        joint.velocity[axis] *= -1.0;
    }
  }
  pose_ = validatedPose(skeleton_, std::move(pose_)).value();
  return pose_;
}

oracle::Motion oracleMotion(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  return oracle::Motion(plainJoints(skeleton, from, to));
}

}  // namespace foretouch::test
