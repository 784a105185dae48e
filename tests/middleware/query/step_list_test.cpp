#include <gtest/gtest.h>

#include "middleware/query/query.h"
#include "middleware/worker_pool.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

struct Crowd {
  Scene scene;
  std::vector<test::RandomBody> bodies;
  std::vector<Query> queries;
};

Crowd makeCrowd(int avatars) {
  Random random(7);
  Crowd crowd{Scene::build(test::clutter(random, 400, 3, Vector3d::Zero())).value(), {}, {}};
  for (int i = 0; i < avatars; ++i) {
    crowd.bodies.push_back(test::bodyInClutter(random, 3 + i % 9, Vector3d::Zero()));
    crowd.queries.push_back(Query::build(crowd.bodies.back().avatar, crowd.scene).value());
  }
  return crowd;
}

std::vector<StepTask> tasksOf(const Crowd& crowd) {
  std::vector<StepTask> tasks;
  for (std::size_t i = 0; i < crowd.bodies.size(); ++i) {
    tasks.push_back({&crowd.queries[i], &crowd.bodies[i].from, &crowd.bodies[i].to});
  }
  return tasks;
}

TEST(StepList, AnswersLikeSingleQueriesForAnyNumberOfThreads) {
  const Crowd crowd = makeCrowd(60);
  const std::vector<StepTask> tasks = tasksOf(crowd);
  for (const int threads : {1, 2, 3, 8}) {
    WorkerPool pool = WorkerPool::start(threads).value();
    EXPECT_EQ(pool.threads(), threads);
    std::vector<StepContacts> answers;
    for (int round = 0; round < 3; ++round) {
      ASSERT_TRUE(Query::answerAll(tasks, pool, answers).ok());
      ASSERT_EQ(answers.size(), tasks.size());
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        const test::RandomBody& body = crowd.bodies[i];
        const StepContacts alone = firstContacts(body.avatar, body.motion(), crowd.scene).value();
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

// One list may ask different questions: other scenes, other options.
TEST(StepList, AnswersEachTaskByItsOwnQuery) {
  Crowd crowd = makeCrowd(20);
  const std::vector<StepTask> tasks = tasksOf(crowd);
  RawScene none;
  none.triangles = {{{Vector3d(900, 0, 0), Vector3d(901, 0, 0), Vector3d(900, 1, 0)}}};
  none.objectOf = {0};
  none.objectNames = {"far away"};
  crowd.queries[5] = Query::build(crowd.bodies[5].avatar, Scene::build(none).value()).value();
  QueryOptions little;
  little.workBudget = 0;
  crowd.queries[11] = Query::build(crowd.bodies[11].avatar, crowd.scene, little).value();
  WorkerPool pool = WorkerPool::start(3).value();
  std::vector<StepContacts> answers;
  for (int round = 0; round < 3; ++round) {
    std::vector<FailedTask> failures{{7, Error::of(ErrorCode::Empty, "of an earlier list")}};
    ASSERT_TRUE(Query::answerAll(tasks, pool, answers, &failures).ok());
    EXPECT_TRUE(failures.empty());
    for (const LinkContact& contact : answers[5].links) {
      EXPECT_EQ(contact.verdict, Verdict::Clear);
    }
    for (const LinkContact& contact : answers[11].links) {
      EXPECT_TRUE(contact.verdict == Verdict::Undecided || contact.verdict == Verdict::Clear);
    }
  }
  EXPECT_TRUE(Query::answerAll({}, pool, answers).ok());
  EXPECT_TRUE(answers.empty());
}

TEST(WorkerPool, RefusesNoThreadsAndTooMany) {
  EXPECT_FALSE(WorkerPool::start(0).ok());
  EXPECT_FALSE(WorkerPool::start(kMaxPoolThreads + 1).ok());
}

}  // namespace
}  // namespace foretouch
