// How deep links are whose surfaces are triangles: convex ones against all separating axes that
// there are, others against the boxes that they are made of.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/depth/depth.h"
#include "middleware/depth/hull_depth.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using Mesh = std::vector<Triangle>;

Mesh movedBy(Mesh mesh, const Eigen::Matrix3d& R, const Vector3d& p) {
  for (Triangle& triangle : mesh) {
    for (Vector3d& v : triangle.vertices) v = R * v + p;
  }
  return mesh;
}

/// A prism over a polygon, which is a fan around its first corner.
Mesh prism(const std::vector<Eigen::Vector2d>& base, double height) {
  Mesh mesh;
  const auto at = [&](std::size_t i, double z) {
    const Eigen::Vector2d& p = base[i % base.size()];
    return Vector3d(p.x(), p.y(), z);
  };
  for (std::size_t i = 0; i < base.size(); ++i) {
    mesh.push_back({{at(i, 0.0), at(i + 1, 0.0), at(i, height)}});
    mesh.push_back({{at(i + 1, 0.0), at(i + 1, height), at(i, height)}});
    if (i == 0 || i + 1 >= base.size()) continue;
    mesh.push_back({{at(0, 0.0), at(i, 0.0), at(i + 1, 0.0)}});
    mesh.push_back({{at(0, height), at(i, height), at(i + 1, height)}});
  }
  return mesh;
}

Mesh regularPrism(int sides, double radius, double height) {
  std::vector<Eigen::Vector2d> base;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * test::kPi * i / sides;
    base.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return prism(base, height);
}

Mesh box(const Vector3d& from, const Vector3d& to) {
  const Mesh mesh =
      prism({{from.x(), from.y()}, {to.x(), from.y()}, {to.x(), to.y()}, {from.x(), to.y()}},
            to.z() - from.z());
  return movedBy(mesh, Eigen::Matrix3d::Identity(), {0, 0, from.z()});
}

/// An L of two boxes, closed, seen as a fan from its inner corner.
Mesh angled() {
  return prism({{0.1, 0.1}, {0.1, 0.6}, {0.0, 0.6}, {0.0, 0.0}, {0.6, 0.0}, {0.6, 0.1}}, 0.2);
}
std::vector<Mesh> boxesOfAngled() {
  return {box({0, 0, 0}, {0.1, 0.6, 0.2}), box({0, 0, 0}, {0.6, 0.1, 0.2})};
}

/// The least over all axes along which two convex bodies can be parted: their depth; not above zero
/// if they are apart.
double deepBySeparatingAxes(const Mesh& one, const Mesh& other) {
  const auto edgesOf = [](const Mesh& mesh) {
    std::vector<Vector3d> edges;
    for (const Triangle& t : mesh) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d edge = (t.vertices[(k + 1) % 3] - t.vertices[k]).normalized();
        const bool isKnown = std::any_of(edges.begin(), edges.end(), [&](const Vector3d& e) {
          return e.cross(edge).norm() < 1e-12;
        });
        if (!isKnown) edges.push_back(edge);
      }
    }
    return edges;
  };
  std::vector<Vector3d> axes;
  for (const Mesh* mesh : {&one, &other}) {
    for (const Triangle& t : *mesh) {
      axes.push_back((t.vertices[1] - t.vertices[0]).cross(t.vertices[2] - t.vertices[0]));
    }
  }
  for (const Vector3d& e : edgesOf(one)) {
    for (const Vector3d& f : edgesOf(other)) {
      if (e.cross(f).norm() > 1e-9) axes.push_back(e.cross(f));
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& axis : axes) {
    const Vector3d n = axis.normalized();
    double ends[4] = {1e9, -1e9, 1e9, -1e9};
    for (int side = 0; side < 2; ++side) {
      for (const Triangle& t : side == 0 ? one : other) {
        for (const Vector3d& v : t.vertices) {
          ends[2 * side] = std::min(ends[2 * side], n.dot(v));
          ends[2 * side + 1] = std::max(ends[2 * side + 1], n.dot(v));
        }
      }
    }
    least = std::min({least, ends[1] - ends[2], ends[3] - ends[0]});
  }
  return least;
}

/// Two links side by side below a root, each in a large ball.
struct TwoLinks {
  Avatar avatar;
  AvatarSurface surface;
  LinkDepths depths;

  static TwoLinks of(const Mesh& a, const Mesh& b, double radius = 10.0) {
    RawSkeleton raw;
    for (const char* const name : {"root", "a", "b"}) {
      raw.joints.push_back(
          {name, raw.joints.empty() ? kNoParent : 0, Vector3d::Zero(), Quaternion::Identity()});
    }
    const Lss ball{Vector3d::Zero(), Vector3d::Zero(), radius};
    Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {{}, {ball}, {ball}}).value();
    AvatarSurface surface = AvatarSurface::build(avatar, {{}, a, b}).value();
    return {avatar, surface, LinkDepths(avatar, surface)};
  }

  [[nodiscard]] Pose pose(const RigidPose& ofA, const RigidPose& ofB) const {
    Pose pose = restPose(avatar.skeleton());
    pose.rotations = {Quaternion::Identity(), ofA.rotation, ofB.rotation};
    pose.translations = {Vector3d::Zero(), ofA.translation, ofB.translation};
    return validatedPose(avatar.skeleton(), pose).value();
  }
  [[nodiscard]] LinkDepth at(const RigidPose& ofA, const RigidPose& ofB) const {
    const Pose both = pose(ofA, ofB);
    return depths.at(ChainMotion(avatar.skeleton(), both, both), 0.0, 1, 2);
  }
};

Mesh seen(const Mesh& mesh, const RigidPose& pose) {
  return movedBy(mesh, pose.rotation.toRotationMatrix(), pose.translation);
}

Mesh convexBody(test::Random& random) {
  const double size = random.magnitude(0.02, 0.5);
  switch (random.below(4)) {
    case 0: return box(-size * Vector3d(1, 0.5, 0.2), size * Vector3d(1, 0.5, 0.4));
    case 1: return regularPrism(3, size, 0.3 * size);
    case 2: return regularPrism(12, 0.3 * size, 2.0 * size);
    default: return regularPrism(5, size, size);
  }
}

TEST(LinkDepths, OfConvexLinksAreThoseOfAllSeparatingAxes) {
  int deep = 0, apart = 0;
  double widest = 0.0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Mesh a = convexBody(random), b = convexBody(random);
    RigidPose ofA, ofB;
    // Faces on faces and edges along edges, too.
    if (random.chance(0.7)) ofA.rotation = random.rotation();
    if (random.chance(0.7)) ofB.rotation = random.rotation();
    ofA.translation = random.inBox(3.0);
    ofB.translation = ofA.translation + random.inBox(random.magnitude(0.02, 0.5));
    const double truth = deepBySeparatingAxes(seen(a, ofA), seen(b, ofB));
    const LinkDepth depth = TwoLinks::of(a, b).at(ofA, ofB);
    if (truth < -1e-9) {
      EXPECT_EQ(depth.upper, 0.0);
      EXPECT_EQ(depth.lower, 0.0);
      ++apart;
      continue;
    }
    ASSERT_LE(depth.lower, truth + 1e-12) << "a shorter way parts them";
    ASSERT_GE(depth.upper, truth - 1e-12) << "no way as short as this one parts them";
    ASSERT_LE(depth.lower, depth.upper);
    if (truth < 1e-6) continue;
    ++deep;
    widest = std::max(widest, depth.upper - depth.lower);
    // Its way parts them.
    RigidPose moved = ofA;
    moved.translation += (depth.upper + 1e-12) * depth.nhat_BA_W;
    ASSERT_LE(deepBySeparatingAxes(seen(a, moved), seen(b, ofB)), 1e-12);
  }
  EXPECT_LT(widest, 1e-6);
  EXPECT_GT(deep, 100);
  EXPECT_GT(apart, 50);
}

TEST(LinkDepths, OfAnAngleAreBoundedByItsBoxes) {
  const Mesh b = box({-0.03, -0.2, -0.04}, {0.03, 0.2, 0.04});
  const TwoLinks links = TwoLinks::of(angled(), b);
  ASSERT_TRUE(links.depths.hasInside(1));
  const auto parts = boxesOfAngled();
  // Of a union: how deep the deeper box is.
  const auto deepAfter = [&](const RigidPose& ofA, const RigidPose& ofB) {
    double most = -1e9;
    for (const Mesh& part : parts) {
      most = std::max(most, deepBySeparatingAxes(seen(part, ofA), seen(b, ofB)));
    }
    return most;
  };
  int deep = 0, inTheAngle = 0;
  double share = 0.0;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    RigidPose ofA, ofB;
    ofA.rotation = random.rotation();
    ofA.translation = random.inBox(2.0);
    ofB.rotation = random.rotation();
    const Vector3d at(random.uniform(0.0, 0.6), random.uniform(0.0, 0.6), random.uniform(0.0, 0.2));
    ofB.translation = ofA.translation + ofA.rotation.toRotationMatrix() * at;
    const LinkDepth depth = links.at(ofA, ofB);
    const double ofDeeper = deepAfter(ofA, ofB);
    if (ofDeeper < -1e-9) {
      EXPECT_EQ(depth.lower, 0.0) << "in the angle nothing is inside";
      inTheAngle += depth.upper > 0.0 ? 1 : 0;
      continue;
    }
    for (int k = 0; k < 60; ++k) {  // nothing shorter parts them
      RigidPose moved = ofA;
      moved.translation += 0.999999 * depth.lower * random.direction();
      ASSERT_GE(deepAfter(moved, ofB), -1e-12);
    }
    RigidPose moved = ofA;
    moved.translation += (depth.upper + 1e-12) * depth.nhat_BA_W;
    ASSERT_LE(deepAfter(moved, ofB), 1e-12);
    if (ofDeeper < 0.01) continue;
    ++deep;
    share += depth.lower / ofDeeper;
  }
  EXPECT_GT(deep, 30);
  EXPECT_GT(inTheAngle, 5);
  EXPECT_GT(share / deep, 0.6) << "balls prove too little";
}

TEST(LinkDepths, OfASurfaceThatEnclosesNothingAreNotKnown) {
  Mesh open = box({0, 0, 0}, {1, 1, 1});
  open.pop_back();
  const TwoLinks links = TwoLinks::of(open, box({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(links.depths.hasInside(1));
  EXPECT_TRUE(links.depths.hasInside(2));
  RigidPose ofB;
  ofB.translation = {0.9, 0.2, 0.3};
  const LinkDepth depth = links.at(RigidPose(), ofB);
  EXPECT_EQ(depth.lower, 0.0);
  EXPECT_NEAR(depth.upper, 0.1, 1e-9);
}

TEST(LinkDepths, OfAPieceThatIsClosedBesideOneThatIsNot) {
  Mesh both = box({0, 0, 0}, {1, 1, 1});
  both.push_back({{Vector3d(0, 0, 2), Vector3d(1, 0, 2), Vector3d(0, 1, 2)}});
  const TwoLinks links = TwoLinks::of(both, box({0, 0, 0}, {1, 1, 1}));
  RigidPose ofB;
  ofB.translation = {0.9, 0.2, 0.3};
  const LinkDepth depth = links.at(RigidPose(), ofB);
  EXPECT_NEAR(depth.lower, 0.1, 1e-8);
  EXPECT_GE(depth.upper, depth.lower);
}

TEST(LinkDepths, OfALinkWithinAnother) {
  const TwoLinks links =
      TwoLinks::of(regularPrism(8, 1.0, 2.0), box(-0.1 * Vector3d::Ones(), 0.1 * Vector3d::Ones()));
  RigidPose ofB;
  ofB.translation = {0, 0, 0.9};
  const LinkDepth depth = links.at(RigidPose(), ofB);
  const double apothem = std::cos(test::kPi / 8.0);
  EXPECT_GT(depth.lower, apothem) << "it has to go all the way out";
  EXPECT_NEAR(depth.lower, depth.upper, 1e-6);
}

TEST(LinkDepths, OfACapsuleWithoutAMeshInABox) {
  RawSkeleton raw;
  raw.joints = {{"a", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                {"b", 0, Vector3d(0.0, 1.05, 0.0), Quaternion::Identity()}};
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 10.0};
  const Lss capsule{{-0.2, 0, 0}, {0.2, 0, 0}, 0.1};
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {{ball}, {capsule}}).value();
  const AvatarSurface surface =
      AvatarSurface::build(avatar, {box({-1, -1, -1}, {1, 1, 1}), {}}).value();
  const Pose rest = restPose(avatar.skeleton());
  const LinkDepth depth =
      LinkDepths(avatar, surface).at(ChainMotion(avatar.skeleton(), rest, rest), 0.0, 0, 1);
  EXPECT_NEAR(depth.upper, 0.05, 1e-9);
  EXPECT_NEAR(depth.lower, 0.05, 1e-6);
  EXPECT_LE(depth.lower, 0.05);
}

/// Two cubes of a metre, one 0.8 m over the other at the end of a long arm, which many joints turn
/// by a whole turn, or nearly.
struct CubeOnLongArm {
  static constexpr int kTurns = 240;
  static constexpr double kArm = 1e5, kOver = 0.8;
  Quaternion turn;
  Avatar avatar;
  Pose pose;

  explicit CubeOnLongArm(int wholeTurns) : turn(turnOf(wholeTurns)), avatar(build()) {
    pose = restPose(avatar.skeleton());
    for (int i = 0; i < kTurns; ++i) pose.rotations[slotOf(i + 2)] = turn;
    pose = validatedPose(avatar.skeleton(), pose).value();
    turn = pose.rotations[2];
  }
  /// By which the last joint is higher than its rest has it.
  [[nodiscard]] long double rise() const {
    const long double angle = 2.0L * std::atan2(static_cast<long double>(turn.z()), turn.w());
    return kArm * std::sin(kTurns * angle) + kOver * (std::cos(kTurns * angle) - 1.0L);
  }

 private:
  static Quaternion turnOf(int wholeTurns) {
    const double half = test::kPi * wholeTurns / kTurns;
    return {std::cos(half), 0.0, 0.0, std::sin(half)};
  }
  static Avatar build() {
    RawSkeleton raw;
    raw.joints = {{"cube", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                  {"arm", 0, Vector3d(-kArm, 0.0, 0.0), Quaternion::Identity()}};
    for (int i = 0; i < kTurns; ++i) {
      raw.joints.push_back({"turn " + std::to_string(i),
                            static_cast<JointId>(raw.joints.size()) - 1, Vector3d::Zero(),
                            Quaternion::Identity()});
    }
    raw.joints.push_back({"over", kTurns + 1, Vector3d(kArm, kOver, 0.0), Quaternion::Identity()});
    std::vector<std::vector<Lss>> lss(raw.joints.size());
    lss.front() = lss.back() = {{Vector3d::Zero(), Vector3d::Zero(), 1.0}};
    return Avatar::build(Skeleton::build(raw).value(), lss).value();
  }
};

TEST(LinkDepths, HoldWhatALongChainRounds) {
  const Mesh cube = box(-0.5 * Vector3d::Ones(), 0.5 * Vector3d::Ones());
  int far = 0;
  for (int wholeTurns = 1; wholeTurns < 40; ++wholeTurns) {
    SCOPED_TRACE(wholeTurns);
    const CubeOnLongArm arm(wholeTurns);
    const LinkId last = arm.avatar.numLinks() - 1;
    std::vector<Mesh> meshes(countOf(arm.avatar.numLinks()));
    meshes.front() = meshes.back() = cube;
    const AvatarSurface surface = AvatarSurface::build(arm.avatar, meshes).value();
    const ChainMotion motion(arm.avatar.skeleton(), arm.pose, arm.pose);
    const double over = motion.stateAt(last, 0.0).p_WL.y();
    const auto truth = static_cast<double>(1.0L - CubeOnLongArm::kOver - arm.rise());
    // More than what the cubes' own sizes round.
    far += std::abs(1.0 - over - truth) > 1e-9 ? 1 : 0;
    for (const auto& [a, b] : {std::pair{LinkId{0}, last}, std::pair{last, LinkId{0}}}) {
      const LinkDepth depth = LinkDepths(arm.avatar, surface).at(motion, 0.0, a, b);
      EXPECT_LE(depth.lower, truth);
      EXPECT_GE(depth.upper, truth);
      EXPECT_NEAR(depth.lower, depth.upper, 1e-5);
    }
  }
  EXPECT_GT(far, 10);
}

TEST(LinkDepths, OfABallWithoutAMeshInTheLegOfAnAngle) {
  RawSkeleton raw;
  raw.joints = {{"angle", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                {"ball", 0, Vector3d(0.3, 0.05, 0.1), Quaternion::Identity()}};
  const Lss large{Vector3d::Zero(), Vector3d::Zero(), 10.0};
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 0.03};
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {{large}, {ball}}).value();
  const AvatarSurface surface = AvatarSurface::build(avatar, {angled(), {}}).value();
  const Pose rest = restPose(avatar.skeleton());
  const LinkDepth depth =
      LinkDepths(avatar, surface).at(ChainMotion(avatar.skeleton(), rest, rest), 0.0, 0, 1);
  // Out of the leg's middle, on either side.
  EXPECT_LE(depth.lower, 0.05 + 0.03);
  EXPECT_GE(depth.lower, 0.95 * (0.05 + 0.03));
}

}  // namespace
}  // namespace foretouch
