// Links asked each with its own tolerance and fidelity: every verdict keeps the promise of its own
// link's, links that are alike are answered as without policies, and bad policies are refused.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "middleware/worker_pool.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/middleware/reference/random_step.h"
#include "tests/reference/reference_query.h"
#include "tests/support/asked.h"
#include "tests/support/judged_answer.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;
using test::RandomBody;

/// How an answer may be come by.
struct Way {
  Backtracking backtracking;
  std::optional<Simd> simd;
};
std::vector<Way> everyWay() {
  std::vector<Way> ways{{Backtracking::Scalar, std::nullopt}};
  for (const Simd simd : supportedSimd()) ways.push_back({Backtracking::Lanes, simd});
  return ways;
}

class LinkPolicies : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam().simd)); }
  void TearDown() override { useSimd(std::nullopt); }
  static ReferenceOptions reference(Descent descent = Descent::Straight) {
    ReferenceOptions reference;
    reference.backtracking = GetParam().backtracking;
    reference.descent = descent;
    return reference;
  }
};

void expectSame(const LinkContact& x, const LinkContact& y) {
  EXPECT_EQ(x.link, y.link);
  EXPECT_EQ(x.verdict, y.verdict);
  EXPECT_EQ(x.reason, y.reason);
  EXPECT_EQ(x.toi, y.toi);
  EXPECT_EQ(x.freeUntil, y.freeUntil);
  EXPECT_EQ(x.separation, y.separation);
  EXPECT_EQ(x.penetration, y.penetration);
  EXPECT_EQ(x.triangle, y.triangle);
  EXPECT_EQ(x.lss, y.lss);
  EXPECT_EQ(x.linkTriangle, y.linkTriangle);
  EXPECT_EQ(x.p_WScene, y.p_WScene);
  EXPECT_EQ(x.p_WLink, y.p_WLink);
  EXPECT_EQ(x.nhat_SL_W, y.nhat_SL_W);
}

std::array<std::uint64_t, 13> numbersOf(const QueryCounters& c) {
  return {c.nodes,     c.leaves,       c.candidates,     c.clusterSteps, c.laneSteps,
          c.partSteps, c.advancements, c.hierarchyTests, c.planeTests,   c.leafTests,
          c.states,    c.rungTests,    c.settledAbove};
}

/// A body in clutter, its scene, and a mesh for every link.
struct ClutteredWorld {
  RawScene raw;
  Scene scene;
  RandomBody body;
  std::vector<std::vector<Triangle>> mesh;
  AvatarSurface surface;
};
ClutteredWorld someWorld(int seed, int triangles = 1500, int links = 8) {
  Random random(static_cast<std::uint64_t>(seed));
  RawScene raw = test::clutter(random, triangles, 3, Vector3d::Zero());
  RandomBody body = test::bodyInClutter(random, links, Vector3d::Zero());
  auto mesh = test::meshWithin(body.avatar, random, 8, 0.9);
  AvatarSurface surface = AvatarSurface::build(body.avatar, mesh).value();
  return {raw, Scene::build(raw).value(), std::move(body), std::move(mesh), std::move(surface)};
}

StepContacts answer(const ClutteredWorld& world, const QueryOptions& options,
                    const ReferenceOptions& reference) {
  return firstContacts(world.body.avatar, world.body.motion(), world.scene, options, reference)
      .value();
}

std::vector<LinkPolicy> randomPolicies(Random& random, std::int32_t links,
                                       const std::vector<double>& tolerances) {
  std::vector<LinkPolicy> policies;
  for (LinkId link = 0; link < links; ++link) {
    policies.push_back(
        {tolerances[static_cast<std::size_t>(random.below(static_cast<int>(tolerances.size())))],
         random.chance(0.4) ? Fidelity::Exact : Fidelity::Link});
  }
  return policies;
}

TEST_P(LinkPolicies, OfLinksThatAreAlikeDoNotShow) {
  int touched = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const ClutteredWorld world = someWorld(i);
    QueryOptions plain;
    plain.tolerance = std::array<double, 3>{5e-3, 1e-4, 1e-6}[i % 3];
    plain.fidelity = i % 2 == 0 ? Fidelity::Link : Fidelity::Exact;
    plain.surface = world.surface;
    plain.ignored = {{1, 0}};
    const ReferenceOptions way = reference(i % 5 == 0 ? Descent::ByNeed : Descent::Straight);
    QueryOptions perLink = plain;
    perLink.linkPolicies.assign(static_cast<std::size_t>(world.body.avatar.numLinks()),
                                {plain.tolerance, plain.fidelity});
    perLink.tolerance = 1.0;  // what stands beside policies decides nothing
    perLink.fidelity = i % 2 == 0 ? Fidelity::Exact : Fidelity::Link;
    const StepContacts expected = answer(world, plain, way), got = answer(world, perLink, way);
    for (std::size_t link = 0; link < expected.links.size(); ++link) {
      expectSame(expected.links[link], got.links[link]);
      touched += expected.links[link].verdict != Verdict::Clear;
    }
    EXPECT_EQ(numbersOf(expected.counters), numbersOf(got.counters));
  }
  EXPECT_GT(touched, 50);
}

// In doubles a link's answer depends on nothing but its own policy; in lanes so it does while the
// least tolerance asks for no more slabs, as it does below 0.25 mm.
TEST_P(LinkPolicies, GiveEachLinkTheAnswerItHasAlone) {
  const bool inLanes = GetParam().backtracking == Backtracking::Lanes;
  const std::vector<double> tolerances =
      inLanes ? std::vector<double>{2e-4, 1e-4, 1e-5} : std::vector<double>{1e-2, 1e-4, 1e-6};
  std::array<int, 2> touched{};
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(700 + i));
    const ClutteredWorld world = someWorld(100 + i);
    QueryOptions mixed;
    mixed.surface = world.surface;
    mixed.ignored = {{2, IgnoredPair::kEveryObject}, {3, 1}};
    mixed.linkPolicies = randomPolicies(random, world.body.avatar.numLinks(), tolerances);
    const StepContacts got = answer(world, mixed, reference());
    for (LinkId link = 0; link < world.body.avatar.numLinks(); ++link) {
      SCOPED_TRACE("link " + std::to_string(link));
      const LinkPolicy policy = mixed.linkPolicies[static_cast<std::size_t>(link)];
      QueryOptions alone;
      alone.surface = world.surface;
      alone.ignored = mixed.ignored;
      alone.tolerance = policy.tolerance;
      alone.fidelity = policy.fidelity;
      const auto place = static_cast<std::size_t>(link);
      expectSame(answer(world, alone, reference()).links[place], got.links[place]);
      touched[policy.fidelity == Fidelity::Exact] += got.links[place].verdict != Verdict::Clear;
    }
    EXPECT_EQ(got.links[2].verdict, Verdict::Clear);
  }
  EXPECT_GT(touched[0], 50);
  EXPECT_GT(touched[1], 20);
}

oracle::Judge judgeOf(const ClutteredWorld& world, const oracle::Scene& scene,
                      const oracle::Motion& truth, LinkId link, Fidelity fidelity) {
  if (fidelity == Fidelity::Exact) {
    return {scene, truth, link, test::plain(world.mesh[static_cast<std::size_t>(link)])};
  }
  return {scene, truth, link, test::plainCapsules(world.body.avatar, link)};
}

TEST_P(LinkPolicies, KeepThePromiseOfEachLinkByTheOracle) {
  std::array<std::array<int, 4>, 2> verdicts{};  // by fidelity
  int beyondTheLeast = 0;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(900 + i));
    const ClutteredWorld world = someWorld(300 + i, 600, 6);
    const oracle::Scene scene(test::plain(world.raw.triangles));
    const oracle::Motion truth(
        test::plainJoints(world.body.avatar.skeleton(), world.body.from, world.body.to));
    QueryOptions mixed;
    mixed.surface = world.surface;
    mixed.linkPolicies =
        randomPolicies(random, world.body.avatar.numLinks(), {2e-2, 5e-3, 1e-4, 1e-6});
    const StepContacts got = answer(world, mixed, reference());
    for (const LinkContact& contact : got.links) {
      const LinkPolicy policy = mixed.linkPolicies[static_cast<std::size_t>(contact.link)];
      const oracle::Judgement judgement =
          judgeOf(world, scene, truth, contact.link, policy.fidelity)
              .judge(test::plain(contact), policy.tolerance);
      EXPECT_EQ(judgement.finding, oracle::Finding::Ok)
          << "link " << contact.link << " at " << policy.tolerance << ", "
          << toString(policy.fidelity) << ": " << toString(judgement.finding) << " "
          << judgement.what;
      ++verdicts[policy.fidelity == Fidelity::Exact][static_cast<std::size_t>(contact.verdict)];
      beyondTheLeast += contact.verdict == Verdict::Contact && contact.separation > 1e-4;
    }
  }
  for (const auto& ofFidelity : verdicts) {
    EXPECT_GT(ofFidelity[static_cast<std::size_t>(Verdict::Clear)], 20);
    EXPECT_GT(ofFidelity[static_cast<std::size_t>(Verdict::Contact)], 20);
    EXPECT_EQ(ofFidelity[static_cast<std::size_t>(Verdict::Undecided)], 0);
  }
  EXPECT_GT(beyondTheLeast, 10) << "coarse links are answered as coarsely as they may";
}

/// Balls of radius 0.1 in a row, all falling from 1 m above a floor to 1 m below it.
struct FallingRow {
  Avatar avatar;
  Pose from, to;
  Scene scene;
};
FallingRow fallingRow(int balls) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (int i = 0; i < balls; ++i) {
    raw.joints.push_back(
        {"ball" + std::to_string(i), kNoParent, Vector3d(0.5 * i, 1, 0), Quaternion::Identity()});
    lss.push_back({{Vector3d::Zero(), Vector3d::Zero(), 0.1}});
  }
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), lss).value();
  const Pose from = restPose(avatar.skeleton());
  Pose to = from;
  for (Vector3d& place : to.translations) place.y() = -1.0;
  RawScene scene;
  scene.objectNames = {"floor"};
  scene.objectOf = {0};
  scene.triangles = {{{Vector3d(-99, 0, -99), Vector3d(99, 0, -99), Vector3d(0, 0, 99)}}};
  return {avatar, from, to, Scene::build(std::move(scene)).value()};
}

// Height 1 - 2t, so the gap is 0.9 - 2t: contact at separation s is at t = 0.45 - s/2.
TEST_P(LinkPolicies, ReportFallingBallsEachWithinItsOwnTolerance) {
  const std::array<double, 6> tolerances{0.05, 1e-7, 5e-3, 1e-4, 1e-9, 1e-2};
  const FallingRow row = fallingRow(static_cast<int>(tolerances.size()));
  QueryOptions mixed;
  for (const double tolerance : tolerances) {
    mixed.linkPolicies.push_back({tolerance, Fidelity::Link});
  }
  const ChainMotion motion(row.avatar.skeleton(), row.from, row.to);
  const auto step = firstContacts(row.avatar, motion, row.scene, mixed, reference()).value();
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(step.links[i].verdict, Verdict::Contact);
    EXPECT_LE(step.links[i].toi, 0.45 + 1e-15) << "late";
    EXPECT_GE(step.links[i].toi, 0.45 - tolerances[i] / 2 - 1e-12) << "early";
  }
}

// Two balls alike pass 1 cm into a ledge; the mesh of each is a needle in its middle, far from it.
TEST_P(LinkPolicies, AskLssAndMeshesInOneQuery) {
  FallingRow row = fallingRow(2);
  for (Vector3d& place : row.to.translations) place.y() = 0.09;
  const Triangle needle{{Vector3d(0, 0, 0), Vector3d(0.01, 0, 0), Vector3d(0, 0.01, 0)}};
  QueryOptions mixed;
  // Of the first link no mesh is there at all: nobody asks for it.
  mixed.surface = AvatarSurface::build(row.avatar, {{}, {needle}}).value();
  mixed.linkPolicies = {{1e-3, Fidelity::Link}, {1e-3, Fidelity::Exact}};
  const ChainMotion motion(row.avatar.skeleton(), row.from, row.to);
  const auto step = firstContacts(row.avatar, motion, row.scene, mixed, reference()).value();
  EXPECT_EQ(step.links[0].verdict, Verdict::Contact);
  EXPECT_EQ(step.links[0].linkTriangle, -1);
  EXPECT_EQ(step.links[1].verdict, Verdict::Clear);
  Scratch scratch;
  EXPECT_TRUE(test::touchesAt(row.avatar, motion, 0, 1.0, row.scene, mixed, scratch));
  EXPECT_FALSE(test::touchesAt(row.avatar, motion, 1, 1.0, row.scene, mixed, scratch));
  mixed.linkPolicies[1].fidelity = Fidelity::Link;
  EXPECT_TRUE(test::touchesAt(row.avatar, motion, 1, 1.0, row.scene, mixed, scratch));
}

/// Nothing in reach at the least tolerance need not be nothing at the largest.
TEST_P(LinkPolicies, AreAllInReachByNeed) {
  FallingRow row = fallingRow(2);
  for (Vector3d& place : row.to.translations) place.y() = 0.1001;
  QueryOptions mixed;
  mixed.linkPolicies = {{1e-6, Fidelity::Link}, {1e-2, Fidelity::Link}};
  const ChainMotion motion(row.avatar.skeleton(), row.from, row.to);
  const auto step =
      firstContacts(row.avatar, motion, row.scene, mixed, reference(Descent::ByNeed)).value();
  const auto straight = firstContacts(row.avatar, motion, row.scene, mixed, reference()).value();
  EXPECT_EQ(step.links[0].verdict, Verdict::Clear);
  EXPECT_EQ(step.links[1].verdict, Verdict::Contact);
  for (std::size_t link = 0; link < 2; ++link) expectSame(straight.links[link], step.links[link]);
}

// The volume around the whole body is asked first; whatever it says, the answers stay.
TEST_P(LinkPolicies, AreAnsweredByNeedAsStraightAtAnyFidelity) {
  int touched = 0, settled = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(2100 + i));
    ClutteredWorld world = someWorld(2100 + i, i % 3 == 0 ? 1 : 1500, 5);
    QueryOptions mixed;
    mixed.surface = world.surface;
    mixed.fidelity = Fidelity::Exact;
    if (i % 2 == 0) mixed.linkPolicies = randomPolicies(random, 5, {1e-2, 1e-4});
    const StepContacts straight = answer(world, mixed, reference());
    const StepContacts byNeed = answer(world, mixed, reference(Descent::ByNeed));
    for (std::size_t link = 0; link < straight.links.size(); ++link) {
      expectSame(straight.links[link], byNeed.links[link]);
      touched += straight.links[link].verdict != Verdict::Clear;
    }
    EXPECT_EQ(byNeed.counters.rungTests, 1u);
    settled += byNeed.counters.settledAbove > 0;
  }
  EXPECT_GT(touched, 30);
  EXPECT_GT(settled, 3);
}

std::string nameOf(const testing::TestParamInfo<Way>& tested) {
  return tested.param.simd ? toString(*tested.param.simd) : "doubles";
}
INSTANTIATE_TEST_SUITE_P(EveryWay, LinkPolicies, testing::ValuesIn(everyWay()), nameOf);

TEST(LinkPoliciesOfThreads, AreAnsweredTheSameByAnyNumber) {
  std::vector<ClutteredWorld> worlds;
  std::vector<QueryOptions> options;
  for (int i = 0; i < 40; ++i) {
    Random random(static_cast<std::uint64_t>(1300 + i));
    worlds.push_back(someWorld(500));  // one scene
    RandomBody& body = worlds.back().body;
    for (auto& rotation : body.to.rotations) rotation = random.turn(0.7);
    QueryOptions mixed;
    mixed.surface = worlds.front().surface;  // whose hierarchies several threads want at once
    mixed.linkPolicies = randomPolicies(random, body.avatar.numLinks(), {1e-2, 1e-3, 1e-5});
    options.push_back(mixed);
  }
  std::vector<Query> queries;
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    queries.push_back(Query::build(worlds[i].body.avatar, worlds[0].scene, options[i]).value());
  }
  std::vector<StepTask> tasks;
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    tasks.push_back({&queries[i], &worlds[i].body.from, &worlds[i].body.to});
  }
  std::vector<StepContacts> got, expected;
  WorkerPool four = WorkerPool::start(4).value(), one = WorkerPool::start(1).value();
  ASSERT_TRUE(Query::answerAll(tasks, four, got).ok());
  ASSERT_TRUE(Query::answerAll(tasks, one, expected).ok());
  for (std::size_t i = 0; i < got.size(); ++i) {
    for (std::size_t link = 0; link < got[i].links.size(); ++link) {
      expectSame(expected[i].links[link], got[i].links[link]);
    }
    EXPECT_EQ(numbersOf(expected[i].counters), numbersOf(got[i].counters));
  }
}

/// What is said of options that are not as they should be: the option, and the link.
std::string refusalOf(const QueryOptions& options) {
  const FallingRow row = fallingRow(2);
  const ChainMotion motion(row.avatar.skeleton(), row.from, row.to);
  const auto result = firstContacts(row.avatar, motion, row.scene, options);
  if (result.ok()) return "accepted";
  return result.error().file + " " + std::to_string(result.error().index);
}

TEST(BadLinkPolicies, AreRefused) {
  QueryOptions options;
  options.linkPolicies = {{1e-3, Fidelity::Link}, {1e-3, Fidelity::Link}};
  EXPECT_EQ(refusalOf(options), "accepted");
  for (const double bad : {0.0, -1.0, 0.9e-9, 1.1e7, std::nan(""), HUGE_VAL}) {
    options.linkPolicies[1].tolerance = bad;
    EXPECT_EQ(refusalOf(options), "tolerance 1") << bad;
  }
  options.linkPolicies[1].tolerance = 1e-9;
  options.linkPolicies[1].fidelity = Fidelity::Skinned;
  EXPECT_EQ(refusalOf(options), "linkPolicies 1");
  options.linkPolicies[1].fidelity = Fidelity::Link;
  options.fidelity = Fidelity::Skinned;
  EXPECT_EQ(refusalOf(options), "linkPolicies -1");
  options.fidelity = Fidelity::Link;
  options.linkPolicies[1].fidelity = Fidelity::Exact;
  EXPECT_EQ(refusalOf(options), "fidelity -1") << "no surface";
  options.linkPolicies[1].fidelity = Fidelity::Link;
  options.fidelity = Fidelity::Exact;
  EXPECT_EQ(refusalOf(options), "accepted") << "nobody asks for a surface";
  options.linkPolicies.pop_back();
  EXPECT_EQ(refusalOf(options), "linkPolicies -1");
}

}  // namespace
}  // namespace foretouch
