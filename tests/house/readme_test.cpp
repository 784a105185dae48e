// The six lines of README's first screen: they are these, and they find what they say.
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "assets/avatar/avatar_file.h"
#include "assets/import/scene_import.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
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

TEST_F(ReadmesFirstScreen, FindsWhatIsBetweenTwoPoses) {
  // The bundled dancer, who walks from one end of the room to the other in this step.
  const Pose rest = restPose(readAvatarFile("dancer.avatar.json").value().skeleton());
  Pose earlier = rest, later = rest;
  earlier.translations[0].x() -= 5.0;
  later.translations[0].x() += 5.0;
  std::set<LinkId> stopped;
  const auto stop = [&](LinkId link, double t, const Eigen::Vector3d& normal) {
    EXPECT_TRUE(t > 0.0 && t < 1.0);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
    stopped.insert(link);
  };
  // clang-format off
  // README begins
  const Scene room = Scene::build(importScene("room.obj").value().scene).value();
  const Avatar dancer = readAvatarFile("dancer.avatar.json").value();
  const ChainMotion motion(dancer.skeleton(), earlier, later);  // two tracked poses
  const StepContacts step = firstContacts(dancer, motion, room).value();
  for (const LinkContact& touch : step.links)
    if (touch.verdict == Verdict::Contact) stop(touch.link, touch.toi, touch.nhat_SL_W);
  // README ends
  // clang-format on
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

}  // namespace
}  // namespace foretouch::test
