// tests/judge/mesh_prover_test.cpp: the judge of links made of triangles: distances against a
// brute loop over instants, motions whose first contact is known in closed form, and planted lies.
#include "judge/mesh_prover.h"

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "tests/judge/expect_finding.h"
#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;

Triangle toTriangle(const std::array<Eigen::Vector3d, 3>& v) {
  Triangle t;
  for (std::size_t j = 0; j < 3; ++j) t[j] = {v[j].x(), v[j].y(), v[j].z()};
  return t;
}

TEST(TriangleDistance, IsSymmetricAndBoundedByEveryPairOfPoints) {
  int meeting = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(i);
    const auto pair = test::randomPair(random, 1.0, Eigen::Vector3d::Zero());
    const Triangle a = toTriangle({pair.a, pair.b, random.inBox(1.0)}), b = toTriangle(pair.v);
    std::array<Vec3r, 3> one, other;
    for (std::size_t j = 0; j < 3; ++j) {
      one[j] = a[j].as<Real>();
      other[j] = b[j].as<Real>();
    }
    const Closest<Real> there = closestPoints(one, other), back = closestPoints(other, one);
    EXPECT_NEAR(static_cast<double>(there.distance), static_cast<double>(back.distance), 1e-16);
    EXPECT_NEAR(static_cast<double>(norm(there.onSegment - there.onTriangle) - there.distance), 0.0,
                1e-16);
    meeting += there.distance == 0 ? 1 : 0;
    for (int k = 0; k < 50; ++k) {  // no pair of points is nearer
      const auto point = [&](const std::array<Vec3r, 3>& t) {
        const Real u = random.uniform(0, 1), v = random.uniform(0, 1) * (1 - u);
        return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      };
      EXPECT_GE(norm(point(one) - point(other)), there.distance - 1e-17L);
    }
    // And a plane proves it: n separates by all of it, as far as so short a difference is known.
    if (there.distance > 1e-12L) {
      const Vec3r n = (1 / there.distance) * (there.onSegment - there.onTriangle);
      Real low = 1e9L, high = -1e9L;
      for (std::size_t j = 0; j < 3; ++j) {
        low = std::min(low, dot(n, one[j] - there.onTriangle));
        high = std::max(high, dot(n, other[j] - there.onTriangle));
      }
      EXPECT_GT(low - high, there.distance - 1e-17L / there.distance - 1e-16L);
    }
  }
  EXPECT_GT(meeting, 300);
}

/// A cushion of many triangles around a lowest vertex, on an arm that swings or falls to the floor.
struct CushionCase {
  std::vector<Joint> joints{Joint{}};
  std::vector<Triangle> mesh;
  Scene floor{{Triangle{Vec3d{-50, 0, -50}, Vec3d{60, 0, -40}, Vec3d{0, 0, 70}}}};
  Real start = 0, fall = 0;  // the lowest vertex's height, and how far it falls

  CushionCase(Random& random, bool touches, int triangles) {
    const double drop = random.magnitude(1e-2, 3.0);
    const double way = touches ? drop * random.uniform(1.2, 3.0) : drop - 5e-3;
    joints[0].fromTranslation = {random.uniform(-5, 5), drop, random.uniform(-5, 5)};
    joints[0].toTranslation = joints[0].fromTranslation - Vec3d{0, way, 0};
    for (int i = 0; i < triangles; ++i) {
      const auto v = [&] {
        return Vec3d{random.uniform(-0.2, 0.2), random.uniform(0.01, 0.3),
                     random.uniform(-0.2, 0.2)};
      };
      mesh.push_back({v(), v(), v()});
    }
    mesh[mesh.size() / 2][1] = {0, 0, 0};
    start = drop;
    fall = static_cast<Real>(joints[0].fromTranslation.y) - joints[0].toTranslation.y;
  }
  [[nodiscard]] Real when(Real separation) const { return (start - separation) / fall; }
  [[nodiscard]] Answer contactAt(Real t) const {
    Answer a;
    a.verdict = Verdict::Contact;
    a.toi = a.freeUntil = static_cast<double>(t);
    const Real height = std::max<Real>(0, start - fall * a.toi);
    a.separation = static_cast<double>(height);
    a.triangle = 0;
    a.capsule = static_cast<int>(mesh.size() / 2);
    a.onScene = {joints[0].fromTranslation.x, 0, joints[0].fromTranslation.z};
    a.onLink = {a.onScene.x, a.separation, a.onScene.z};
    a.normal = {0, 1, 0};
    return a;
  }
  [[nodiscard]] Judgement judged(const Answer& answer) const {
    const Motion motion(joints);
    return Judge(floor, motion, 0, mesh).judge(answer, kTolerance);
  }
};

TEST(MeshJudge, AcceptsWhatIsRightAndNamesPlantedLies) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(i);
    const CushionCase c(random, true, 40);
    expectFinding(c.judged(c.contactAt(c.when(0.5L * kTolerance))), Finding::Ok);
    expectFinding(c.judged(c.contactAt(c.when(0) + 1e-6L)), Finding::Late);
    expectFinding(c.judged(c.contactAt(c.when((1 + 1e-6L) * kTolerance))), Finding::Early);
    expectFinding(c.judged(Answer{}), Finding::Missed);
    Answer start = c.contactAt(0);
    expectFinding(c.judged(start), Finding::Early);
    start.verdict = Verdict::StartsInContact;
    expectFinding(c.judged(start), Finding::WrongStart);
    Answer undecided;
    undecided.verdict = Verdict::Undecided;
    undecided.freeUntil = static_cast<double>(c.when(1e-6L));
    expectFinding(c.judged(undecided), Finding::Ok);
    undecided.freeUntil = static_cast<double>(c.when(0) + 1e-6L);
    expectFinding(c.judged(undecided), Finding::Late);
    Answer wrong = c.contactAt(c.when(0.5L * kTolerance));
    switch (random.below(4)) {
      case 0: wrong.onLink.x += 1e-8; break;
      case 1: wrong.capsule += 1; break;
      case 2: wrong.separation += 1e-8; break;
      default: wrong.normal = {0, -1, 0}; break;
    }
    expectFinding(c.judged(wrong), Finding::Inconsistent);
  }
}

TEST(MeshJudge, AcceptsClearWhereNothingIsTouched) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    Random random(i);
    expectFinding(CushionCase(random, false, 40).judged(Answer{}), Finding::Ok);
  }
}

TEST(MeshJudge, BracketsTheFirstContact) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    Random random(i);
    const CushionCase c(random, true, 40);
    const Motion motion(c.joints);
    const auto first = Judge(c.floor, motion, 0, c.mesh).firstContact();
    ASSERT_TRUE(first.has_value());
    EXPECT_LE(first->low, c.when(0) + 1e-14L);
    EXPECT_GE(first->high, c.when(0) - 1e-14L);
    EXPECT_LE(first->high - first->low, 1e-9L);
  }
}

TEST(MeshJudge, CatchesADipBetweenTwoFreePoses) {
  for (const double depth : {1e-2, 1e-5, 1e-8, 1e-11}) {
    SCOPED_TRACE(depth);
    Random random(1);
    CushionCase c(random, true, 1);
    c.mesh = {{Vec3d{0, -1, 0}, Vec3d{0.01, 0, 0.01}, Vec3d{-0.01, 0, 0.01}}};
    c.joints[0] = Joint{};
    c.joints[0].fromRotation = {std::cos(0.3), 0, 0, -std::sin(0.3)};
    c.joints[0].toRotation = {std::cos(0.31), 0, 0, std::sin(0.31)};
    c.joints[0].fromTranslation = c.joints[0].toTranslation = {0, 1 - depth, 0};
    expectFinding(c.judged(Answer{}), Finding::Missed);
    c.joints[0].fromTranslation.y = c.joints[0].toTranslation.y = 1 + depth;
    expectFinding(c.judged(Answer{}), Finding::Ok);
  }
}

TEST(MeshJudge, TakesALinkWithoutTriangles) {
  Random random(1);
  CushionCase c(random, true, 1);
  c.mesh.clear();
  expectFinding(c.judged(Answer{}), Finding::Ok);
}

/// A crowd of triangles, and a link of as many on an arm of three joints.
struct CrowdedMesh {
  std::vector<Triangle> triangles, mesh;
  std::vector<Joint> joints;

  /// The scene's triangles are at least about `clearance` from the root.
  CrowdedMesh(Random& random, double clearance, int inScene, int inLink) {
    for (int k = 0; k < inScene; ++k) {
      const auto pair = test::randomPair(random, random.magnitude(5e-3, 0.05),
                                         random.uniform(clearance, 1.0) * random.direction());
      triangles.push_back(toTriangle(pair.v));
    }
    for (int k = 0; k < inLink; ++k) {
      const Eigen::Vector3d center = {random.uniform(0, 0.2), 0, 0};
      mesh.push_back(
          toTriangle({center + 0.04 * random.direction(), center + 0.04 * random.direction(),
                      center + 0.04 * random.direction()}));
    }
    for (int j = 0; j < 3; ++j) {
      const auto from = random.rotation();
      const auto to = from * random.turn(random.uniform(0.0, 0.8));
      const Eigen::Vector3d offset = 0.2 * random.direction();
      Joint joint;
      joint.parent = j - 1;
      joint.fromRotation = {from.w(), from.x(), from.y(), from.z()};
      joint.toRotation = {to.w(), to.x(), to.y(), to.z()};
      joint.fromTranslation = joint.toTranslation = {offset.x(), offset.y(), offset.z()};
      joints.push_back(joint);
    }
  }
};

TEST(MeshProver, FindsWhatALoopOverInstantsAndTrianglesFinds) {
  constexpr int kInstants = 10;
  int found = 0, free = 0;
  for (std::uint64_t i = 0; i < 24; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(i);
    const CrowdedMesh c(random, 0.2, 150, 30);
    const Scene scene(c.triangles);
    const Motion motion(c.joints);
    Judge judge(scene, motion, 2, c.mesh);
    const MeshProver prover(scene, motion, 2, c.mesh);
    const auto first = judge.firstContact();
    (first ? found : free) += 1;
    const Real low = first ? first->low : 2;
    for (int k = 0; k <= kInstants; ++k) {
      const Real t = static_cast<Real>(k) / kInstants;
      Real least = Box::kEmpty;
      for (int piece = 0; piece < prover.numPieces(); ++piece) {
        for (int id = 0; id < scene.numTriangles(); ++id) {
          least = std::min(least, prover.separationFrom(piece, id, t));
        }
      }
      EXPECT_NEAR(static_cast<double>(judge.separationAt(t) - least), 0.0, 1e-17);
      if (least == 0) {
        EXPECT_LE(low, t);
      }
    }
    if (first) {
      EXPECT_LE(judge.separationAt(first->high), 1e-12L);
    }
  }
  EXPECT_GT(found, 8);
  EXPECT_GT(free, 3);
}

// Not timed: the looks are what time goes with.
TEST(MeshProver, NeedsFewLooksForALinkOfAThousandTriangles) {
  std::uint64_t looks = 0;
  int free = 0;
  constexpr std::uint64_t kSteps = 20;
  for (std::uint64_t i = 0; i < kSteps; ++i) {
    Random random(i);
    const CrowdedMesh c(random, 0.6, 5000, 1000);
    const Scene scene(c.triangles);
    const Motion motion(c.joints);
    const SpanOutcome outcome = MeshProver(scene, motion, 2, c.mesh).prove(0, 1);
    looks += outcome.looks;
    free += outcome.free ? 1 : 0;
  }
  EXPECT_GT(free, 3);
  EXPECT_LT(looks / kSteps, 20'000u);
  RecordProperty("looks", static_cast<int>(looks / kSteps));
}

}  // namespace
}  // namespace foretouch::oracle
