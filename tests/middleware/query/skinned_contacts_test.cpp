// Skinned fidelity: surfaces whose vertices follow the blend of several links.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/asked.h"
#include "tests/support/judged.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using test::Random;
using test::randomSkin;
using test::RandomSkin;
using Real = oracle::Precise;

bool touches(const LinkContact& contact) {
  return contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact;
}

/// A root that stands still and a link that turns about +Y; the skin hangs half on either.
struct HalfTurning {
  Avatar avatar;
  Pose from, to;
  Skin skin;
  std::vector<std::size_t> counts;

  HalfTurning(const std::vector<Vector3d>& corners, double turn) : avatar(makeAvatar()) {
    from = restPose(avatar.skeleton());
    to = from;
    to.rotations[1] = Quaternion(std::cos(turn / 2), 0.0, std::sin(turn / 2), 0.0);
    for (const Vector3d& corner : corners) {
      skin.vertices.push_back({{0, 0.5, corner}, {1, 0.5, corner}});
    }
    skin.triangles = {{0, 1, 2}};
    counts = {0, 1};
  }
  static Avatar makeAvatar() {
    RawSkeleton raw;
    raw.joints = {{"root", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                  {"arm", 0, Vector3d::Zero(), Quaternion::Identity()}};
    return Avatar::build(Skeleton::build(raw).value(),
                         {{}, {{Vector3d::Zero(), Vector3d(1, 0, 0), 0.1}}})
        .value();
  }
};

// Half of a point at (r, y, 0) stays, half turns by a: z = -r/2 sin(a), which reaches -d at
// a = asin(2d/r), where the turning point itself is long past the wall.
TEST(SkinnedContacts, OfAHalfWeightedVertexAreThoseOfItsBlend) {
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const double r = random.uniform(0.5, 2.0), d = random.uniform(0.05, 0.6) * r;
    const double turn = random.uniform(0.2, 1.5);
    const HalfTurning body({Vector3d(r, 0, 0), Vector3d(0.2 * r, 0.1, 0), Vector3d(0.2 * r, 0, 0)},
                           turn);
    RawScene raw{
        {{{Vector3d(-50, -50, -d), Vector3d(50, -50, -d), Vector3d(0, 50, -d)}}}, {0}, {"wall"}};
    QueryOptions options;
    options.tolerance = random.magnitude(1e-6, 1e-3);
    options.fidelity = Fidelity::Skinned;
    options.skin = SkinnedSurface::build(body.avatar, body.skin, body.counts).value();
    const auto result =
        firstContacts(body.avatar, ChainMotion(body.avatar.skeleton(), body.from, body.to),
                      Scene::build(std::move(raw)).value(), options);
    ASSERT_TRUE(result.ok()) << describe(result.error());
    EXPECT_EQ(result.value().links[0].verdict, Verdict::Clear);
    const LinkContact& got = result.value().links[1];
    const bool hit = 2 * d < r && std::asin(2 * d / r) <= turn;
    const double deepest = 0.5 * r * std::sin(turn);
    if (!hit && d - deepest > options.tolerance) {
      ASSERT_EQ(got.verdict, Verdict::Clear);
      continue;
    }
    ++hits;
    ASSERT_EQ(got.verdict, Verdict::Contact);
    if (hit) {
      ASSERT_LE(got.toi, std::asin(2 * d / r) / turn) << "late";
    }
    const double separation = d - 0.5 * r * std::sin(turn * got.toi);
    ASSERT_GT(separation, 0.0) << "late";
    ASSERT_LE(separation, options.tolerance) << "early";
    EXPECT_NEAR(got.separation, separation, 1e-12);
    EXPECT_EQ(got.linkTriangle, 0);
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 290);
}

/// The blend in fifty digits.
std::array<Precise3, 3> preciseTriangle(const RandomSkin& made, LinkId link, std::int32_t index,
                                        const std::vector<oracle::PreciseFrame>& frames) {
  std::size_t first = 0;
  for (LinkId l = 0; l < link; ++l) first += made.counts[static_cast<std::size_t>(l)];
  std::array<Precise3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int32_t vertex = made.skin.triangles[first + static_cast<std::size_t>(index)][i];
    for (const SkinInfluence& influence : made.skin.vertices[static_cast<std::size_t>(vertex)]) {
      corners[i] =
          corners[i] + Real(influence.weight) *
                           frames[static_cast<std::size_t>(influence.link)].at(influence.p_L);
    }
  }
  return corners;
}

TEST(SkinnedContacts, AreTightInFiftyDigitsAndMissNoSampledTouch) {
  int contacts = 0, sampled = 0;
  for (int seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const test::RandomBody body = test::bodyInClutter(random, 5, Vector3d::Zero());
    const Scene scene = Scene::build(test::clutter(random, 400, 3, Vector3d::Zero())).value();
    const ChainMotion motion = body.motion();
    const RandomSkin made = randomSkin(body.avatar, motion, random);
    QueryOptions options;
    options.tolerance = random.magnitude(1e-6, 1e-3);
    options.fidelity = Fidelity::Skinned;
    options.skin = SkinnedSurface::build(body.avatar, made.skin, made.counts).value();
    const StepContacts step = firstContacts(body.avatar, motion, scene, options).value();
    const auto joints = test::plainJoints(body.avatar.skeleton(), body.from, body.to);
    Scratch scratch;
    for (const LinkContact& got : step.links) {
      ASSERT_NE(got.verdict, Verdict::Undecided);
      for (int k = 0; k <= 20; ++k) {
        if (!test::touchesAt(body.avatar, motion, got.link, k / 20.0, scene, options, scratch))
          continue;
        ++sampled;
        ASSERT_TRUE(touches(got)) << "missed at " << k / 20.0;
        ASSERT_LE(got.toi, k / 20.0) << "late";
      }
      if (got.verdict != Verdict::Contact) continue;
      ++contacts;
      const auto frames = oracle::preciseFrames(joints, Real(got.toi));
      const auto part = preciseTriangle(made, got.link, got.linkTriangle, frames);
      std::array<Precise3, 3> other;
      for (std::size_t i = 0; i < 3; ++i) {
        other[i] = Precise3(scene.triangle(got.triangle).vertices[i]);
      }
      Real truth(1e9);
      for (std::size_t i = 0; i < 3; ++i) {
        truth = std::min(truth, oracle::preciseDistance(part[i], part[(i + 1) % 3], other));
        truth = std::min(truth, oracle::preciseDistance(other[i], other[(i + 1) % 3], part));
      }
      EXPECT_LE(truth, Real(options.tolerance)) << "early";
      EXPECT_NEAR(static_cast<double>(truth), got.separation, 1e-11);
    }
  }
  EXPECT_GT(contacts, 20);
  EXPECT_GT(sampled, 100);
}

TEST(SkinnedSurface, RefusesWhatIsNoSkinOfTheAvatar) {
  const HalfTurning body({Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 0)}, 1.0);
  ASSERT_TRUE(SkinnedSurface::build(body.avatar, body.skin, body.counts).ok());
  const auto refused = [&](auto&& spoil) {
    Skin skin = body.skin;
    std::vector<std::size_t> counts = body.counts;
    spoil(skin, counts);
    const auto built = SkinnedSurface::build(body.avatar, skin, counts);
    return built.ok() ? "accepted" : built.error().message;
  };
  using Counts = std::vector<std::size_t>;
  EXPECT_EQ(refused([](Skin& s, Counts&) { s.vertices[1][0].weight = 0.7; }),
            "skin vertex 1: expected weights that sum to one");
  EXPECT_EQ(refused([](Skin& s, Counts&) { s.vertices[1][0].weight = std::nan(""); }),
            "skin vertex 1: expected finite coordinates and weights above 0");
  EXPECT_EQ(refused([](Skin& s, Counts&) { s.vertices[2][1].link = 2; }),
            "skin vertex 2: expected a link of the avatar");
  EXPECT_EQ(refused([](Skin& s, Counts&) { s.vertices[2].clear(); }),
            "skin vertex 2: expected weights that sum to one");
  EXPECT_EQ(refused([](Skin& s, Counts&) { s.triangles[0][2] = 3; }),
            "skin triangle 0: expected vertices of the skin");
  EXPECT_EQ(refused([](Skin& s, Counts&) { s.vertices[0][0].p_L.x() = 1.1e7; }),
            "skin vertex 0: expected coordinates within 1e7 m");
  EXPECT_NE(refused([](Skin&, Counts& c) { c = {1, 1}; }).find("link's number"), std::string::npos);
  EXPECT_NE(refused([](Skin& s, Counts&) { s.triangles.clear(); }).find("expected 1 to"),
            std::string::npos);
}

}  // namespace
}  // namespace foretouch
