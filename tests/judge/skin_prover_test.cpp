// tests/judge/skin_prover_test.cpp: the judge of skins: against the judge of meshes where a skin
// hangs on one link, a closed form where a corner hangs half on another, and planted lies.
#include "judge/skin_prover.h"

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "judge/mesh_prover.h"
#include "tests/judge/expect_finding.h"
#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;

/// A root at rest and a link at its origin that falls by `fall`; the lowest corner hangs half on
/// each, so that it falls by half as much.
struct HalfFalling {
  std::vector<Joint> joints{Joint{}, Joint{}};
  std::vector<SkinTriangle> skin;
  Scene floor{{Triangle{Vec3d{-50, 0, -50}, Vec3d{60, 0, -40}, Vec3d{0, 0, 70}}}};
  double height = 0, fall = 0;

  HalfFalling(Random& random, bool touches) {
    height = random.magnitude(1e-2, 3.0);
    fall = 2.0 * (touches ? height * random.uniform(1.2, 3.0) : height - 5e-3);
    joints[0].fromTranslation = joints[0].toTranslation = {0, height, 0};
    joints[1].parent = 0;
    joints[1].toTranslation = {0, -fall, 0};
    for (int i = 0; i < 20; ++i) {
      SkinTriangle triangle;
      for (SkinCorner& corner : triangle) {
        corner =
            half({random.uniform(-0.2, 0.2), random.uniform(0.01, 0.3), random.uniform(-0.2, 0.2)});
      }
      skin.push_back(triangle);
    }
    skin[7][1] = half({0, 0, 0});
  }
  static SkinCorner half(const Vec3d& point) { return {{0, 0.5, point}, {1, 0.5, point}}; }

  [[nodiscard]] Real when(Real separation) const { return (height - separation) / (fall / 2); }
  [[nodiscard]] Answer contactAt(Real t) const {
    Answer a;
    a.verdict = Verdict::Contact;
    a.toi = a.freeUntil = static_cast<double>(t);
    a.separation = std::max(0.0, height - fall / 2 * a.toi);
    a.triangle = 0;
    a.capsule = 7;
    a.onLink = {0, a.separation, 0};
    a.normal = {0, 1, 0};
    return a;
  }
  [[nodiscard]] std::string judged(const Answer& answer) const {
    const Motion motion(joints);
    return toString(Judge(floor, motion, skin).judge(answer, kTolerance).finding);
  }
};

TEST(SkinJudge, AcceptsWhatIsRightAndNamesPlantedLies) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(i);
    const HalfFalling c(random, true);
    EXPECT_EQ(c.judged(c.contactAt(c.when(0.5L * kTolerance))), "ok");
    EXPECT_EQ(c.judged(c.contactAt(c.when(0) + 1e-6L)), "late");
    EXPECT_EQ(c.judged(c.contactAt(c.when((1 + 1e-6L) * kTolerance))), "early");
    EXPECT_EQ(c.judged(Answer{}), "missed");
    Answer start = c.contactAt(0);
    start.verdict = Verdict::StartsInContact;
    EXPECT_EQ(c.judged(start), "wrong start");
    Answer undecided;
    undecided.verdict = Verdict::Undecided;
    undecided.freeUntil = static_cast<double>(c.when(1e-6L));
    EXPECT_EQ(c.judged(undecided), "ok");
    undecided.freeUntil = static_cast<double>(c.when(0) + 1e-6L);
    EXPECT_EQ(c.judged(undecided), "late");
    Answer wrong = c.contactAt(c.when(0.5L * kTolerance));
    wrong.capsule = 8;
    EXPECT_EQ(c.judged(wrong), "inconsistent");
    EXPECT_EQ(HalfFalling(random, false).judged(Answer{}), "ok");
  }
}

TEST(SkinJudge, AgreesWithTheJudgeOfMeshesOnOneLink) {
  int touching = 0, free = 0;
  for (std::uint64_t i = 0; i < 80; ++i) {
    SCOPED_TRACE(i);
    Random random(i);
    const auto vertex = [&](double size) {
      return Vec3d{random.uniform(-size, size), random.uniform(-size, size),
                   random.uniform(-size, size)};
    };
    std::vector<Triangle> triangles, mesh;
    std::vector<SkinTriangle> skin;
    for (int k = 0; k < 20; ++k) triangles.push_back({vertex(2), vertex(2), vertex(2)});
    for (int k = 0; k < 8; ++k) {
      mesh.push_back({vertex(0.2), vertex(0.2), vertex(0.2)});
      SkinTriangle corners;
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = {{0, 0.25, mesh.back()[c]}, {0, 0.75, mesh.back()[c]}};
      }
      skin.push_back(corners);
    }
    std::vector<Joint> joints{Joint{}};
    joints[0].fromTranslation = vertex(3);
    joints[0].toTranslation = vertex(3);
    joints[0].toRotation = {0.8, 0.6, 0, 0};
    const Scene scene(triangles);
    const Motion motion(joints);
    const auto one = Judge(scene, motion, 0, mesh).firstContact();
    const auto other = Judge(scene, motion, skin).firstContact();
    ASSERT_EQ(one.has_value(), other.has_value());
    (one ? touching : free) += 1;
    if (!one) continue;
    EXPECT_NEAR(static_cast<double>(one->high), static_cast<double>(other->high), 1e-8);
  }
  EXPECT_GT(touching, 10);
  EXPECT_GT(free, 10);
}

}  // namespace
}  // namespace foretouch::oracle
