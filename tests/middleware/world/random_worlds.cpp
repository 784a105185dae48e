#include "tests/middleware/world/random_worlds.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/middleware/mesh_body.h"
#include "tests/middleware/own_body.h"

namespace foretouch::test {

using Eigen::Vector3d;

void Walker::step(Random& random) {
  for (std::size_t j = 0; j < turns.size(); ++j) {
    pose.rotations[j] = (pose.rotations[j] * turns[j]).normalized();
    if (random.chance(0.2)) turns[j] = random.turn(random.uniform(0.0, 0.6));
  }
  pose.translations[0] += drift;
}

Walker randomWalker(Random& random, const Vector3d& place, double speed) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  const int joints = 2 + random.below(5);
  for (int j = 0; j < joints; ++j) {
    const Vector3d offset = j == 0 ? place : random.magnitude(0.05, 0.4) * random.direction();
    raw.joints.push_back({"joint" + std::to_string(j), j == 0 ? kNoParent : random.below(j), offset,
                          random.rotation()});
    lss.push_back(j > 0 && random.chance(0.2) ? std::vector<Lss>{} : randomLss(random));
  }
  const Skeleton skeleton = Skeleton::build(raw).value();
  Walker walker{
      Avatar::build(skeleton, lss).value(), restPose(skeleton), speed * random.direction(), {}};
  for (int j = 0; j < joints; ++j) walker.turns.push_back(random.turn(random.uniform(0.0, 0.5)));
  return walker;
}

Scene randomMesh(Random& random) {
  RawScene raw;
  raw.objectNames = {"mesh"};
  const double size = random.magnitude(0.05, 0.4);
  const int count = 1 + random.below(20);
  for (int i = 0; i < count; ++i) {
    const Vector3d middle = random.inBox(size);
    Triangle triangle;
    for (Vector3d& v : triangle.vertices) v = middle + random.inBox(0.5 * size);
    raw.triangles.push_back(triangle);
    raw.objectOf.push_back(0);
  }
  return Scene::build(std::move(raw)).value();
}

AvatarSurface randomSurface(const Avatar& avatar, Random& random) {
  auto meshes = meshWithin(avatar, random, 1 + random.below(8), 0.9);
  for (auto& mesh : meshes) {
    if (random.chance(0.15)) mesh.clear();
  }
  return AvatarSurface::build(avatar, std::move(meshes)).value();
}

void walk(BothWorlds& both, BodyId body, Walker& walker, std::int64_t periodUs,
          std::int64_t untilUs, Random& random) {
  for (std::int64_t us = 0; us < untilUs + periodUs; us += periodUs) {
    both.push(body, us, walker.pose);
    walker.step(random);
  }
}

void fly(BothWorlds& both, BodyId body, const Vector3d& place, std::int64_t periodUs,
         std::int64_t untilUs, Random& random) {
  RigidPose pose{random.rotation(), place};
  const Vector3d drift = random.inBox(0.15);
  const Quaternion turn = random.turn(random.uniform(0.0, 1.5));
  for (std::int64_t us = 0; us < untilUs + periodUs; us += periodUs) {
    both.push(body, us, pose);
    pose.translation += drift;
    pose.rotation = (pose.rotation * turn).normalized();
  }
}

std::int64_t randomPeriod(Random& random) {
  const std::int64_t periods[] = {11111, 8333, 33333, 33334, 100000, 12345};
  return periods[random.below(6)];
}

double randomTolerance(Random& random) {
  return random.magnitude(1e-6, 1e-3);
}

void add(const BothWorlds& both, WorldTally& sum) {
  for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
  const WorldTally& more = both.tally;
  sum.clear += more.clear;
  sum.contact += more.contact;
  sum.start += more.start;
  sum.undecided += more.undecided;
  sum.grazing += more.grazing;
}

}  // namespace foretouch::test
