// ft_brackets against the library's own answers, and what it refuses.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <foretouch/person.h>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/bounds/bounds_file.h"
#include "middleware/bracket/bracket.h"
#include "tests/bindings/c_world.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

struct ReleaseBrackets {
  void operator()(ft_brackets* brackets) const { ft_brackets_destroy(brackets); }
};
using BracketsHandle = std::unique_ptr<ft_brackets, ReleaseBrackets>;

BracketsHandle makeBrackets(const test::SceneHandle& scene, const test::AvatarHandle& avatar,
                            const ft_bracket_options* options = nullptr) {
  ft_brackets* made = nullptr;
  EXPECT_EQ(ft_brackets_create(scene.get(), avatar.get(), options, &made), FT_OK)
      << ft_last_error();
  return BracketsHandle(made);
}

using List = decltype(&ft_brackets_links);

std::vector<ft_link_bracket> listOf(List list, const BracketsHandle& brackets) {
  return test::listed<ft_link_bracket>(
      [&](ft_link_bracket* found, std::size_t capacity, std::size_t* required) {
        return list(brackets.get(), found, capacity, required);
      });
}

void expectSame(const std::vector<ft_link_bracket>& got, const std::vector<LinkBracket>& wanted,
                const Scene& scene) {
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].size, sizeof got[i]);
    EXPECT_EQ(got[i].link, wanted[i].link);
    EXPECT_EQ(got[i].other, wanted[i].other);
    EXPECT_EQ(got[i].verdict, static_cast<int>(wanted[i].verdict));
    EXPECT_EQ(got[i].triangle, wanted[i].triangle);
    EXPECT_EQ(got[i].object, wanted[i].triangle < 0 ? -1 : scene.object(wanted[i].triangle));
    EXPECT_EQ(got[i].possible_from, wanted[i].possibleFrom);
    EXPECT_EQ(got[i].possible_until, wanted[i].possibleUntil);
    EXPECT_EQ(got[i].certain_from, wanted[i].certainFrom);
    EXPECT_EQ(got[i].certain_until, wanted[i].certainUntil);
    EXPECT_EQ(got[i].growth, wanted[i].growth);
  }
}

/// A step of a body in clutter that goes on as it went, and what may be claimed of it.
struct Walk {
  Walk(test::Random& random, int links)
      : body(test::bodyInClutter(random, links, Vector3d::Zero())),
        c(links),
        cpp(static_cast<std::size_t>(links)) {
    for (std::size_t i = 0; i < cpp.size(); ++i) {
      cpp[i] = {1e-3, 40.0, 2e-3, 0.5, 3.0, 0.2, 30.0};
      c[i] = {1e-3, 40.0, 2e-3, 0.5, 3.0, 0.2, 30.0};
    }
  }
  test::RandomBody body;
  std::vector<ft_link_bound> c;
  std::vector<LinkBound> cpp;
};

TEST(CPerson, AnswersAreThoseOfTheLibrary) {
  test::Random random(47);
  const RawScene raw = test::clutter(random, 400, 3, Vector3d::Zero());
  const Scene scene = Scene::build(raw).value();
  const auto sceneHandle = test::makeScene(raw);
  int seen[4] = {0, 0, 0, 0};
  for (int round = 0; round < 12; ++round) {
    const Walk walk(random, 5);
    const auto avatarHandle = test::makeAvatar(walk.body.avatar);
    auto options = test::initialised(ft_bracket_options_init);
    const ft_ignored_pair ignored{1, 2};
    options.ignored = &ignored;
    options.ignored_count = 1;
    options.resolution = 1e-4;
    if (round % 4 == 3) options.work_budget = 2000;
    const auto brackets = makeBrackets(sceneHandle, avatarHandle, &options);
    BracketOptions sameOptions;
    sameOptions.ignored = {{1, 2}};
    sameOptions.resolution = 1e-4;
    if (round % 4 == 3) sameOptions.workBudget = 2000;
    const auto query = BracketQuery::build(walk.body.avatar, scene, sameOptions).value();

    const test::PoseArrays from(walk.body.from), to(walk.body.to);
    const ft_pose fromView = from.view(), toView = to.view();
    auto step = test::initialised(ft_posed_step_init);
    step.between = round % 3;
    step.from = step.before = &fromView;
    step.to = step.after = &toView;
    step.seconds = 0.1;
    step.seconds_before = 0.2;
    step.seconds_after = 0.05;
    const PosedStep sameStep{
        &walk.body.from, &walk.body.from, &walk.body.to, &walk.body.to, 0.2, 0.1, 0.05};
    Scratch scratch;
    StepBrackets expected;
    const auto expectAnswer = [&](ft_status status) {
      ASSERT_EQ(status, FT_OK) << ft_last_error();
      const auto links = listOf(ft_brackets_links, brackets);
      for (const ft_link_bracket& link : links) ++seen[link.verdict];
      expectSame(links, expected.links, scene);
      expectSame(listOf(ft_brackets_pairs, brackets), expected.pairs, scene);
    };
    ASSERT_TRUE(
        query.answer(sameStep, static_cast<MotionModel>(round % 3), walk.cpp, scratch, expected)
            .ok());
    expectAnswer(ft_brackets_answer(brackets.get(), &step, walk.c.data(), walk.c.size()));
    ASSERT_TRUE(query.answerGap(sameStep, walk.cpp, scratch, expected).ok());
    expectAnswer(ft_brackets_answer_gap(brackets.get(), &step, walk.c.data(), walk.c.size()));
    ASSERT_TRUE(query.lookAhead(sameStep, 0.3, walk.cpp, scratch, expected).ok());
    expectAnswer(ft_brackets_look_ahead(brackets.get(), &step, 0.3, walk.c.data(), walk.c.size()));
  }
  for (const int verdict : {FT_BRACKET_EXCLUDED, FT_BRACKET_POSSIBLE, FT_BRACKET_CERTAIN}) {
    EXPECT_GT(seen[verdict], 0) << verdict;
  }
}

/// Runs the example of docs/person.md: what it prints.
std::string documented(const ft_scene* scene, const ft_avatar* avatar, const ft_pose* poses) {
  std::string told;
  const auto must = [](ft_status status) { ASSERT_EQ(status, FT_OK) << ft_last_error(); };
  const auto print = [&told](const char* format, int link, double from, double to) {
    char line[128];
    std::snprintf(line, sizeof line, format, link, from, to);
    told += line;
  };
#define printf print
#include "person_example.inc"
#undef printf
  return told;
}

TEST(CPerson, ThePagesExampleRuns) {
  const test::SmallWorld world;
  const test::TempFolder folder;
  folder.write("anna.bounds.json",
               R"({"format": "foretouch-bounds", "version": 1, "bounds": [{"part": "all",
                   "model": "cubic-late", "rate_hz": 30, "acceleration_m_s2": 0.1}]})");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / ".");
  // It goes down in a line.
  std::vector<ft_pose> poses(4, world.up());
  const double places[4][3] = {{0, 2.5, 0}, {0, 1, 0}, {0, -0.5, 0}, {0, -2, 0}};
  for (std::size_t i = 0; i < 4; ++i) poses[i].translations = places[i];
  const std::string told = documented(world.scene.get(), world.avatar.get(), poses.data());
  std::filesystem::current_path(before);
  double from = 0.0, to = 0.0;
  int link = -1;
  ASSERT_EQ(std::sscanf(told.c_str(), "link %d: a touch began between t = %lf and %lf", &link,
                        &from, &to),
            3)
      << told;
  EXPECT_EQ(link, 0);
  EXPECT_GT(from, 0.0);
  EXPECT_LE(from, to);
  EXPECT_LT(to, 1.0);
}

/// The small world's link, lowered into the floor.
struct Lowering {
  Lowering() {
    step = test::initialised(ft_posed_step_init);
    step.from = &up;
    step.to = &lowered;
    step.seconds = 1.0;
    EXPECT_EQ(ft_link_bound_init(&bound), FT_OK);
  }
  test::SmallWorld world;
  ft_pose up = world.up(), lowered = world.lowered();
  ft_posed_step step;
  ft_link_bound bound;
};

TEST(CPerson, WhereNothingIsClaimedNothingIsSaid) {
  const Lowering lowering;
  const auto brackets = makeBrackets(lowering.world.scene, lowering.world.avatar);
  ASSERT_EQ(ft_brackets_answer(brackets.get(), &lowering.step, &lowering.bound, 1), FT_OK);
  EXPECT_EQ(listOf(ft_brackets_links, brackets)[0].verdict, FT_BRACKET_UNCLAIMED);
}

TEST(CPerson, RefusesBadArgumentsByName) {
  Lowering lowering;
  const auto refuse = [](ft_status status, ft_status expected,
                         const std::vector<std::string>& words) {
    test::expectRefused(status, expected, words);
  };
  ft_brackets* made = nullptr;
  auto options = test::initialised(ft_bracket_options_init);
  const auto create = [&] {
    return ft_brackets_create(lowering.world.scene.get(), lowering.world.avatar.get(), &options,
                              &made);
  };
  options.fidelity = 2;
  refuse(create(), FT_ERROR_OUT_OF_RANGE, {"ft_brackets_create", "fidelity"});
  options.fidelity = FT_FIDELITY_EXACT;
  refuse(create(), FT_ERROR_MISMATCH, {"fidelity", "triangles"});
  options.fidelity = FT_FIDELITY_LINK;
  options.resolution = 0.0;
  refuse(create(), FT_ERROR_OUT_OF_RANGE, {"resolution"});
  EXPECT_EQ(made, nullptr);

  const auto brackets = makeBrackets(lowering.world.scene, lowering.world.avatar);
  std::size_t count = 0;
  refuse(ft_brackets_links(brackets.get(), nullptr, 0, &count), FT_ERROR_NO_STEP,
         {"ft_brackets_answer"});
  const auto answer = [&](std::size_t bounds = 1) {
    return ft_brackets_answer(brackets.get(), &lowering.step, &lowering.bound, bounds);
  };
  refuse(answer(0), FT_ERROR_MISMATCH, {"bounds"});
  lowering.bound.acceleration = 0.01;
  ASSERT_EQ(answer(), FT_OK) << ft_last_error();
  for (const double bad : {-1.0, std::nan("")}) {
    lowering.bound.acceleration = bad;
    refuse(answer(), FT_ERROR_OUT_OF_RANGE, {"bounds"});
  }
  lowering.bound.acceleration = 1.0;
  for (const double bad : {0.0, -1.0, 1e7, std::nan("")}) {
    lowering.step.seconds = bad;
    refuse(answer(), FT_ERROR_OUT_OF_RANGE, {"seconds"});
  }
  lowering.step.seconds = 1.0;
  lowering.step.after = &lowering.lowered;
  refuse(answer(), FT_ERROR_OUT_OF_RANGE, {"seconds_after"});
  lowering.step.after = nullptr;
  lowering.step.between = 3;
  refuse(answer(), FT_ERROR_OUT_OF_RANGE, {"between"});
  lowering.step.between = FT_BETWEEN_CONSTANT_RATE;
  lowering.step.to = nullptr;
  refuse(answer(), FT_ERROR_NULL_ARGUMENT, {"to"});
  lowering.step.to = &lowering.lowered;
  for (const double bad : {0.0, 2e6, std::nan("")}) {
    refuse(ft_brackets_look_ahead(brackets.get(), &lowering.step, bad, &lowering.bound, 1),
           FT_ERROR_OUT_OF_RANGE, {"horizon"});
  }
  // What was refused has left the last answer.
  EXPECT_EQ(listOf(ft_brackets_links, brackets)[0].verdict, FT_BRACKET_CERTAIN);
}

TEST(CPerson, ReadsAFileOfBounds) {
  const test::TempFolder folder;
  const std::string path = (folder / "anna.bounds.json");
  BoundsFile file;
  BoundEntry entry;
  entry.part = "all";
  entry.model = MotionModel::Cubic;
  entry.rateHz = 30.0;
  entry.bound.acceleration = 12.5;
  file.entries = {entry};
  ASSERT_TRUE(writeBoundsFile(file, path).ok());
  const test::SmallWorld world;
  ft_link_bound bound{};
  std::size_t count = 0;
  ASSERT_EQ(
      ft_bounds_read(path.c_str(), world.avatar.get(), FT_BETWEEN_CUBIC, 30.0, &bound, 1, &count),
      FT_OK)
      << ft_last_error();
  EXPECT_EQ(count, 1U);
  EXPECT_EQ(bound.acceleration, 12.5);
  EXPECT_EQ(bound.speed, std::numeric_limits<double>::infinity());
  test::expectRefused(
      ft_bounds_read(path.c_str(), world.avatar.get(), FT_BETWEEN_CUBIC, 90.0, &bound, 1, &count),
      FT_ERROR_MISMATCH, {"anna.bounds.json", "30"});
  test::expectRefused(ft_bounds_read((folder / "none.json").c_str(), world.avatar.get(),
                                     FT_BETWEEN_CUBIC, 30.0, &bound, 1, &count),
                      FT_ERROR_FILE_NOT_FOUND, {"none.json"});
}

}  // namespace
}  // namespace foretouch
