#include "middleware/query/query_pool.h"

#include <gtest/gtest.h>

#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

struct Crowd {
  Scene scene;
  std::vector<test::RandomBody> bodies;
  QueryOptions options;
  std::vector<StepTask> tasks;
};

Crowd makeCrowd(int avatars) {
  Random random(7);
  Crowd crowd{Scene::build(test::clutter(random, 400, 3, Vector3d::Zero())).value(), {}, {}, {}};
  for (int i = 0; i < avatars; ++i) {
    crowd.bodies.push_back(test::bodyInClutter(random, 3 + i % 9, Vector3d::Zero()));
  }
  return crowd;
}

std::vector<StepTask> tasksOf(const Crowd& crowd) {
  std::vector<StepTask> tasks;
  for (const test::RandomBody& body : crowd.bodies) {
    tasks.push_back({&body.avatar, &body.from, &body.to, &crowd.options});
  }
  return tasks;
}

TEST(QueryPool, AnswersLikeSingleQueriesForAnyNumberOfThreads) {
  const Crowd crowd = makeCrowd(60);
  const std::vector<StepTask> tasks = tasksOf(crowd);
  for (const int threads : {1, 2, 3, 8}) {
    QueryPool pool = QueryPool::start(threads).value();
    EXPECT_EQ(pool.threads(), threads);
    std::vector<StepContacts> answers;
    for (int round = 0; round < 3; ++round) {
      ASSERT_TRUE(pool.answer(crowd.scene, tasks, answers).ok());
      ASSERT_EQ(answers.size(), tasks.size());
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        const test::RandomBody& body = crowd.bodies[i];
        const StepContacts alone =
            firstContacts(body.avatar, body.motion(), crowd.scene, crowd.options).value();
        ASSERT_EQ(answers[i].links.size(), alone.links.size());
        for (std::size_t link = 0; link < alone.links.size(); ++link) {
          EXPECT_EQ(answers[i].links[link].verdict, alone.links[link].verdict);
          EXPECT_EQ(answers[i].links[link].toi, alone.links[link].toi);
          EXPECT_EQ(answers[i].links[link].triangle, alone.links[link].triangle);
          EXPECT_EQ(answers[i].links[link].p_WLink, alone.links[link].p_WLink);
        }
      }
    }
  }
}

// What a worker answered last must not stand in a failed task's place.
TEST(QueryPool, TellsEveryErrorAndAnswersTheRest) {
  const Crowd crowd = makeCrowd(20);
  std::vector<StepTask> tasks = tasksOf(crowd);
  QueryOptions bad;
  bad.tolerance = -1.0;
  QueryOptions badPair;
  badPair.ignored = {{1000, 0}};
  tasks[5].options = &badPair;
  tasks[11].options = &bad;
  QueryPool pool = QueryPool::start(3).value();
  std::vector<StepContacts> answers, good;
  ASSERT_TRUE(pool.answer(crowd.scene, tasksOf(crowd), good).ok());
  EXPECT_TRUE(pool.failures().empty());
  for (int round = 0; round < 3; ++round) {
    const auto done = pool.answer(crowd.scene, tasks, answers);
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().file, "ignored");
    ASSERT_EQ(pool.failures().size(), 2U);
    EXPECT_EQ(pool.failures()[0].task, 5U);
    EXPECT_EQ(pool.failures()[1].task, 11U);
    EXPECT_EQ(pool.failures()[1].error.file, "tolerance");
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      ASSERT_EQ(answers[i].links.size(),
                static_cast<std::size_t>(crowd.bodies[i].avatar.numLinks()));
      for (std::size_t link = 0; link < answers[i].links.size(); ++link) {
        const LinkContact& got = answers[i].links[link];
        EXPECT_EQ(got.link, static_cast<LinkId>(link));
        const bool isFailed = i == 5 || i == 11;
        const LinkContact expected = isFailed ? LinkContact{} : good[i].links[link];
        EXPECT_EQ(got.verdict, expected.verdict);
        EXPECT_EQ(got.freeUntil, expected.freeUntil);
      }
    }
  }
  EXPECT_TRUE(pool.answer(crowd.scene, {}, answers).ok());
  EXPECT_TRUE(pool.failures().empty());
  EXPECT_TRUE(answers.empty());
}

TEST(QueryPool, RefusesNoThreadsAndTooMany) {
  EXPECT_FALSE(QueryPool::start(0).ok());
  EXPECT_FALSE(QueryPool::start(kMaxPoolThreads + 1).ok());
}

}  // namespace
}  // namespace foretouch
