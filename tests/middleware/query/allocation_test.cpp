// Counts every call of malloc and its kin in this program: once the memory of a thread has grown,
// queries make none.
#include <gtest/gtest.h>

#include "lss/simd.h"
#include "middleware/near/near_features.h"
#include "middleware/query/query.h"
#include "middleware/worker_pool.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

class Allocations : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  }
};

constexpr int kBodies = 30;

TEST_F(Allocations, AreCounted) {
  const std::uint64_t before = test::numAllocations();
  std::vector<int> some(100);
  EXPECT_GT(test::numAllocations(), before);
  EXPECT_EQ(some.size(), 100U);
}

const ReferenceOptions kScalar = [] {
  ReferenceOptions reference;
  reference.backtracking = Backtracking::Scalar;
  return reference;
}();

/// All bodies again and again; what the last round allocates.
std::uint64_t inSteadyState(const std::vector<test::RandomBody>& bodies, const Scene& scene,
                            const std::vector<QueryOptions>& options,
                            const ReferenceOptions& reference = {}) {
  Scratch scratch;
  ChainMotion motion;
  StepContacts step;
  std::uint64_t before = 0, contacts = 0;
  std::vector<Query> queries;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    queries.push_back(
        buildReference(bodies[i].avatar, scene, options[i % options.size()], reference).value());
  }
  for (int round = 0; round < 3; ++round) {
    before = test::numAllocations();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const test::RandomBody& body = bodies[i];
      motion.assign(body.avatar.skeleton(), body.from, body.to);
      queries[i].answer(motion, scratch, step);
      for (const LinkContact& contact : step.links) contacts += contact.verdict != Verdict::Clear;
    }
  }
  EXPECT_GT(contacts, bodies.size());
  return test::numAllocations() - before;
}

TEST_F(Allocations, OfNearQueriesAreNone) {
  Random random(5);
  const Scene scene = Scene::build(test::clutter(random, 800, 3, Vector3d::Zero())).value();
  const test::RandomBody body = test::bodyInClutter(random, 8, Vector3d::Zero());
  const NearQuery query = NearQuery::build(body.avatar, scene, {{1, 0}}).value();
  Scratch scratch;
  NearFeatures near;
  for (const Simd simd : supportedSimd()) {
    ASSERT_TRUE(useSimd(simd));
    std::uint64_t before = 0;
    std::size_t found = 0;
    for (int round = 0; round < 3; ++round) {
      before = test::numAllocations();
      for (const NearDetail detail : {NearDetail::Reduced, NearDetail::All, NearDetail::Nearest}) {
        for (const double reach : {0.01, 0.4}) {
          query.answer(body.from, reach, scratch, near, detail);
          found += near.features.size();
        }
      }
    }
    EXPECT_GT(found, 100U);
    EXPECT_EQ(test::numAllocations() - before, 0U) << toString(simd);
  }
  useSimd(std::nullopt);
}

TEST_F(Allocations, OfQueriesAtLinkFidelityAreNone) {
  Random random(3);
  const Scene scene = Scene::build(test::clutter(random, 500, 3, Vector3d::Zero())).value();
  // One avatar, many steps: as a stream of its poses is answered.
  std::vector<test::RandomBody> bodies(kBodies, test::bodyInClutter(random, 9, Vector3d::Zero()));
  for (test::RandomBody& body : bodies) {
    for (auto& rotation : body.to.rotations) rotation = random.turn(0.5);
  }
  QueryOptions options;
  options.ignored = {{2, 1}};
  for (const Simd simd : supportedSimd()) {
    ASSERT_TRUE(useSimd(simd));
    EXPECT_EQ(inSteadyState(bodies, scene, {options}), 0U) << toString(simd);
  }
  useSimd(std::nullopt);
  EXPECT_EQ(inSteadyState(bodies, scene, {options}, kScalar), 0U);
}

TEST_F(Allocations, OfQueriesAtExactFidelityAreNone) {
  Random random(4);
  const Scene scene = Scene::build(test::clutter(random, 500, 3, Vector3d::Zero())).value();
  std::vector<test::RandomBody> bodies(kBodies, test::bodyInClutter(random, 9, Vector3d::Zero()));
  for (test::RandomBody& body : bodies) {
    for (auto& rotation : body.to.rotations) rotation = random.turn(0.5);
  }
  QueryOptions options;
  options.fidelity = Fidelity::Exact;
  options.surface =
      AvatarSurface::build(bodies[0].avatar, test::meshWithin(bodies[0].avatar, random, 12, 0.9))
          .value();
  EXPECT_EQ(inSteadyState(bodies, scene, {options}), 0U);
}

TEST_F(Allocations, OfQueriesAtSkinnedFidelityAreNone) {
  Random random(8);
  const Scene scene = Scene::build(test::clutter(random, 500, 3, Vector3d::Zero())).value();
  std::vector<test::RandomBody> bodies(kBodies, test::bodyInClutter(random, 9, Vector3d::Zero()));
  const test::RandomSkin made = test::randomSkin(bodies[0].avatar, bodies[0].motion(), random);
  for (test::RandomBody& body : bodies) {
    for (auto& rotation : body.to.rotations) rotation = random.turn(0.5);
  }
  QueryOptions options;
  options.fidelity = Fidelity::Skinned;
  options.skin = SkinnedSurface::build(bodies[0].avatar, made.skin, made.counts).value();
  EXPECT_EQ(inSteadyState(bodies, scene, {options}), 0U);
}

TEST_F(Allocations, OfQueriesAboutOwnLinksAreNone) {
  Random random(11);
  const Scene scene = Scene::build(test::clutter(random, 400, 3, Vector3d::Zero())).value();
  std::vector<test::RandomBody> bodies;
  std::vector<QueryOptions> options;
  while (bodies.size() < kBodies) {
    test::RandomBody body = test::bodyInClutter(random, 8, Vector3d::Zero());
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    options.emplace_back();
    options.back().self = rules.value();
    if (bodies.size() % 2 == 0) options.back().scope = Scope::EveryObject;
    if (bodies.size() % 3 == 0) options.back().passSeparating = true;
    bodies.push_back(std::move(body));
  }
  EXPECT_EQ(inSteadyState(bodies, scene, options), 0U);
}

TEST_F(Allocations, OfQueriesWhoseLinksDifferAreNone) {
  Random random(4);
  const Scene scene = Scene::build(test::clutter(random, 500, 3, Vector3d::Zero())).value();
  std::vector<test::RandomBody> bodies(kBodies, test::bodyInClutter(random, 9, Vector3d::Zero()));
  for (test::RandomBody& body : bodies) {
    for (auto& rotation : body.to.rotations) rotation = random.turn(0.5);
  }
  QueryOptions options;
  options.surface =
      AvatarSurface::build(bodies[0].avatar, test::meshWithin(bodies[0].avatar, random, 12, 0.9))
          .value();
  for (int link = 0; link < 9; ++link) {
    options.linkPolicies.push_back(
        {link % 2 == 0 ? 1e-4 : 5e-3, link % 3 == 0 ? Fidelity::Exact : Fidelity::Link});
  }
  QueryOptions alike;
  EXPECT_EQ(inSteadyState(bodies, scene, {options}), 0U);
  EXPECT_EQ(inSteadyState(bodies, scene, {options, alike}), 0U);
  for (LinkPolicy& policy : options.linkPolicies) policy.fidelity = Fidelity::Link;
  EXPECT_EQ(inSteadyState(bodies, scene, {options}, kScalar), 0U);
}

TEST_F(Allocations, OfAPoolAreNone) {
  Random random(5);
  const Scene scene = Scene::build(test::clutter(random, 500, 3, Vector3d::Zero())).value();
  // Avatars that differ make a thread's tables anew; copies of one share theirs.
  const std::vector<test::RandomBody> bodies(kBodies,
                                             test::bodyInClutter(random, 9, Vector3d::Zero()));
  std::vector<Query> queries;
  std::vector<StepTask> tasks;
  for (const test::RandomBody& body : bodies) {
    queries.push_back(Query::build(body.avatar, scene).value());
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    tasks.push_back({&queries[i], &bodies[i].from, &bodies[i].to});
  }
  WorkerPool pool = WorkerPool::start(2).value();
  std::vector<StepContacts> answers;
  // Which thread takes which task is chance: all of them have to have grown.
  std::uint64_t last = 1;
  for (int round = 0; round < 50 && last != 0; ++round) {
    const std::uint64_t before = test::numAllocations();
    ASSERT_TRUE(Query::answerAll(tasks, pool, answers).ok());
    last = test::numAllocations() - before;
  }
  EXPECT_EQ(last, 0U);
}

/// Every task is answered as without a failure, or not at all; how many were not.
std::size_t tasksNotAnswered(const std::vector<StepContacts>& answers,
                             const std::vector<StepContacts>& whole) {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i].links.size(), whole[i].links.size());
    const bool isMissing = !answers[i].links.empty() &&
                           answers[i].links[0].verdict == Verdict::Undecided &&
                           answers[i].links[0].reason == UndecidedReason::None;
    missing += isMissing ? 1 : 0;
    for (std::size_t link = 0; link < answers[i].links.size(); ++link) {
      const LinkContact expected = isMissing ? LinkContact{} : whole[i].links[link];
      EXPECT_EQ(answers[i].links[link].verdict, expected.verdict);
      EXPECT_EQ(answers[i].links[link].freeUntil, expected.freeUntil);
    }
  }
  return missing;
}

// A worker that is broken off, at each of its allocations in turn: what it leaves is told, and
// claims nothing; the next list is answered as ever.
TEST_F(Allocations, ThatFailInAPoolLeaveNothingClear) {
  Random random(8);
  const Scene scene = Scene::build(test::clutter(random, 300, 3, Vector3d::Zero())).value();
  std::vector<test::RandomBody> bodies;
  for (int i = 0; i < 4; ++i) bodies.push_back(test::bodyInClutter(random, 6, Vector3d::Zero()));
  std::vector<Query> queries;
  std::vector<StepTask> tasks;
  for (const test::RandomBody& body : bodies) {
    queries.push_back(Query::build(body.avatar, scene).value());
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    tasks.push_back({&queries[i], &bodies[i].from, &bodies[i].to});
  }
  std::vector<StepContacts> whole;
  WorkerPool reference = WorkerPool::start(1).value();
  ASSERT_TRUE(Query::answerAll(tasks, reference, whole).ok());
  std::size_t broken = 0;
  for (const int threads : {1, 2}) {
    bool hasFailed = true;
    for (std::int64_t allocation = 0; hasFailed; ++allocation) {
      WorkerPool pool = WorkerPool::start(threads).value();
      std::vector<StepContacts> answers;
      ASSERT_TRUE(Query::answerAll({}, pool, answers).ok());  // what lists need of each thread
      answers.resize(tasks.size());
      std::vector<FailedTask> failures;
      test::failAllocationAfter(allocation);
      const bool isDone = Query::answerAll(tasks, pool, answers, &failures).ok();
      hasFailed = test::stopFailing();
      EXPECT_NE(isDone, hasFailed) << allocation;
      EXPECT_EQ(failures.size(), tasksNotAnswered(answers, whole)) << allocation;
      EXPECT_EQ(failures.empty(), isDone);
      broken += failures.size();
      ASSERT_TRUE(Query::answerAll(tasks, pool, answers).ok());
      EXPECT_EQ(tasksNotAnswered(answers, whole), 0U);
    }
  }
  EXPECT_GT(broken, 60U);
}

}  // namespace
}  // namespace foretouch
