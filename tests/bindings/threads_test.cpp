// Many threads, each with queries of its own, on one scene and one avatar: the same answers as one
// thread gets. Under ThreadSanitizer (./run sanitize tsan) a race fails the test.
#include "tests/support/threads.h"

#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "tests/bindings/c_world.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

constexpr int kThreads = 4, kSteps = 30;

/// The contacts of a stream back and forth.
std::vector<ft_contact> answersOf(const ft_scene* scene, const ft_avatar* avatar,
                                  const std::vector<test::PoseArrays>& poses) {
  std::vector<ft_contact> answers;
  ft_query* query = nullptr;
  ft_query_options options = test::initialised(ft_query_options_init);
  options.fidelity = FT_FIDELITY_EXACT;  // hierarchies are built by whoever comes first
  EXPECT_EQ(ft_query_create(scene, avatar, &options, &query), FT_OK) << ft_last_error();
  const test::QueryHandle owner(query);
  const ft_pose start = poses[0].view();
  EXPECT_EQ(ft_query_step(query, &start, &start), FT_OK);
  for (int i = 1; i < kSteps; ++i) {
    const ft_pose pose = poses[static_cast<std::size_t>(i) % poses.size()].view();
    EXPECT_EQ(ft_query_step(query, nullptr, &pose), FT_OK) << ft_last_error();
    std::size_t links = 0;
    EXPECT_EQ(ft_query_links(query, nullptr, 0, &links), FT_OK);
    const std::size_t before = answers.size();
    answers.resize(before + links);
    answers[before].size = sizeof(ft_contact);
    EXPECT_EQ(ft_query_links(query, &answers[before], links, nullptr), FT_OK);
  }
  return answers;
}

TEST(CThreads, GetTheAnswersOfOne) {
  if (!test::kHasThreads) GTEST_SKIP() << "no threads here";
  test::Random random(5);
  const RawScene raw = test::clutter(random, 1500, 3, Eigen::Vector3d::Zero());
  const test::RandomBody body = test::bodyInClutter(random, 6, Eigen::Vector3d::Zero());
  const auto mesh = test::meshWithin(body.avatar, random, 8, 0.9);
  const std::vector<test::PoseArrays> poses = {test::PoseArrays(body.from),
                                               test::PoseArrays(body.to)};
  const auto scene = test::makeScene(raw);
  const auto avatar = test::makeAvatar(body.avatar, mesh);
  std::vector<std::vector<ft_contact>> answers(kThreads);
  std::vector<std::thread> threads;
  for (auto& answer : answers) {
    threads.emplace_back([&] { answer = answersOf(scene.get(), avatar.get(), poses); });
  }
  for (std::thread& thread : threads) thread.join();
  const auto alone = answersOf(scene.get(), avatar.get(), poses);
  int contacts = 0;
  for (const ft_contact& contact : alone) contacts += contact.verdict != FT_VERDICT_CLEAR;
  EXPECT_GT(contacts, 0);
  for (const auto& answer : answers) {
    ASSERT_EQ(answer.size(), alone.size());
    EXPECT_EQ(std::memcmp(answer.data(), alone.data(), alone.size() * sizeof(ft_contact)), 0);
  }
}

TEST(CThreads, EachHasItsOwnLastError) {
  if (!test::kHasThreads) GTEST_SKIP() << "no threads here";
  ft_scene* scene = nullptr;
  test::expectRefused(ft_scene_create(nullptr, &scene), FT_ERROR_NULL_ARGUMENT,
                      {"ft_scene_create"});
  std::thread([] {
    EXPECT_STREQ(ft_last_error(), "");
    EXPECT_EQ(ft_last_error_index(), -1);
    EXPECT_EQ(ft_query_step(nullptr, nullptr, nullptr), FT_ERROR_NULL_ARGUMENT);
    EXPECT_EQ(std::string(ft_last_error()).rfind("ft_query_step: ", 0), 0u);
  }).join();
  EXPECT_EQ(std::string(ft_last_error()).rfind("ft_scene_create: ", 0), 0u);
}

TEST(CThreads, MayReleaseTheSceneWhileOthersQueryIt) {
  if (!test::kHasThreads) GTEST_SKIP() << "no threads here";
  test::SmallWorld world;
  std::vector<test::QueryHandle> queries;
  for (int i = 0; i < kThreads; ++i) queries.push_back(test::makeQuery(world.scene, world.avatar));
  std::vector<std::thread> threads;
  for (auto& query : queries) {
    threads.emplace_back([&query] {
      const ft_pose up =
          test::SmallWorld::poseOf(test::SmallWorld::kIdentity, test::SmallWorld::kUp);
      for (int i = 0; i < kSteps; ++i) EXPECT_EQ(ft_query_step(query.get(), &up, &up), FT_OK);
      query.reset();
    });
  }
  world.scene.reset();
  world.avatar.reset();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace foretouch
