// The six lines of README's first screen: they are these, and they find what they say.
#include <algorithm>
#include <filesystem>
#include <foretouch/foretouch.hpp>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/house/source_files.h"

namespace foretouch::test {
namespace {

/// The bundled example's folder for as long as the test runs: the lines name its files.
class InTheExampleFolder : public testing::Test {
 protected:
  InTheExampleFolder() { std::filesystem::current_path(FORETOUCH_EXAMPLE_FOLDER); }
  ~InTheExampleFolder() override { std::filesystem::current_path(before_); }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
};

using ReadmesFirstScreen = InTheExampleFolder;

int findsWhatIsBetween(const Avatar& dancer, const Scene& room, const Pose& earlier,
                       const Pose& later, std::set<LinkId>& stopped) {
  const auto stop = [&](LinkId link, double t, const Eigen::Vector3d& normal) {
    EXPECT_TRUE(t > 0.0 && t < 1.0);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
    stopped.insert(link);
  };
  // clang-format off
  // README begins
  // dancer and room: read from files, or made of arrays, and checked once
  const ChainMotion motion(dancer.skeleton(), earlier, later);  // two tracked poses
  const Result<StepContacts> step = firstContacts(dancer, motion, room);
  if (!step.ok()) { std::cerr << describe(step.error()) << '\n'; return 1; }
  for (const LinkContact& touch : step.value().links)
    if (touch.verdict == Verdict::Contact) stop(touch.link, touch.toi, touch.nhat_SL_W);
  // README ends
  // clang-format on
  return 0;
}

TEST_F(ReadmesFirstScreen, FindsWhatIsBetweenTwoPoses) {
  // The bundled dancer, who walks from one end of the room to the other in this step.
  const Avatar dancer = readAvatarFile("dancer.avatar.json").value();
  const Scene room = Scene::build(importScene("room.obj").value().scene).value();
  Pose earlier = restPose(dancer.skeleton()), later = earlier;
  earlier.translations[0].x() -= 5.0;
  later.translations[0].x() += 5.0;
  std::set<LinkId> stopped;
  EXPECT_EQ(findsWhatIsBetween(dancer, room, earlier, later, stopped), 0);
  EXPECT_GT(stopped.size(), 5u);
}

/// The lines between the two marks of this file, as they look in a document.
std::string linesAbove() {
  const std::string begin = "  // README begins\n", end = "  // README ends\n";
  const std::string source =
      house::contentOf(std::string(FORETOUCH_SOURCE_DIR) + "/tests/house/readme_test.cpp");
  const std::size_t from = source.find("\n" + begin) + 1 + begin.size();
  const std::string indented = source.substr(from, source.find("\n" + end) + 1 - from);
  std::string lines;
  for (std::size_t at = 0, next = 0; at < indented.size(); at = next) {
    next = indented.find('\n', at) + 1;
    lines += indented.substr(at + 2, next - at - 2);
  }
  return lines;
}

TEST(Readme, FirstScreenShowsTheLinesThatAreRun) {
  const std::string readme = house::contentOf(std::string(FORETOUCH_SOURCE_DIR) + "/README.md");
  const std::string lines = linesAbove();
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 6);
  EXPECT_EQ(lines.find("{{"), std::string::npos);
  const std::size_t first = readme.find("```");
  EXPECT_EQ(readme.substr(first, lines.size() + 10), "```cpp\n" + lines + "```");
}

TEST(Library, PageShowsTheProgramThatIsBuiltAndRun) {
  const std::string root(FORETOUCH_SOURCE_DIR);
  const std::string program = house::contentOf(root + "/examples/cpp/play_clip.cpp");
  ASSERT_FALSE(program.empty());
  EXPECT_NE(house::contentOf(root + "/docs/api.md").find("```cpp\n" + program + "```"),
            std::string::npos);
}

/// The first block of a language below a heading of a document, its lines indented as they are in
/// the program.
std::string blockOf(const std::string& document, const std::string& heading,
                    const std::string& language = "cpp", const std::string& indent = "  ") {
  const std::string open = "```" + language + "\n";
  const std::size_t from =
      document.find(open, document.find("\n## " + heading + "\n")) + open.size();
  std::istringstream lines(document.substr(from, document.find("```", from) - from));
  std::string block;
  for (std::string line; std::getline(lines, line);)
    block += (line.empty() ? "" : indent) + line + "\n";
  return block;
}

TEST(GameLoop, PageShowsLinesOfTheProgramsThatAreRun) {
  const std::string root(FORETOUCH_SOURCE_DIR);
  const std::string page = house::contentOf(root + "/docs/game-loop.md");
  for (const auto& [heading, program] :
       {std::pair{"The loop", "game_loop.cpp"}, std::pair{"A solid hand", "solid_hand.cpp"},
        std::pair{"Head and two controllers", "vr_hands.cpp"}}) {
    const std::string block = blockOf(page, heading);
    EXPECT_GT(std::count(block.begin(), block.end(), '\n'), 10);
    EXPECT_NE(house::contentOf(root + "/examples/cpp/" + program).find(block), std::string::npos)
        << block;
  }
}

TEST(MovingWorlds, PageShowsLinesOfTheProgramsThatAreRun) {
  const std::string root(FORETOUCH_SOURCE_DIR);
  const std::string page = house::contentOf(root + "/docs/moving.md");
  struct Shown {
    const char *language, *indent, *program;
  };
  for (const Shown& shown : {Shown{"cpp", "  ", "/examples/cpp/swinging_door.cpp"},
                             Shown{"c", "  ", "/bindings/c/example/swinging_door.c"},
                             Shown{"python", "", "/bindings/python/example/swinging_door.py"},
                             Shown{"js", "", "/bindings/wasm/example/swinging_door.mjs"}}) {
    const std::string block = blockOf(page, "The loop", shown.language, shown.indent);
    EXPECT_GT(std::count(block.begin(), block.end(), '\n'), 10);
    EXPECT_NE(house::contentOf(root + shown.program).find(block), std::string::npos) << block;
  }
}

}  // namespace
}  // namespace foretouch::test
