// tests/tools/commands/demo_test.cpp: `foretouch demo` on an example of the tests' own.
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

class DemoOfASmallWorld : public testing::Test {
 protected:
  DemoOfASmallWorld() {
    world_.folder.write("room.obj", kWallObj);
    world_.folder.write("dancer.avatar.json", kManAvatar);
    world_.folder.write("dancer.bvh", clipThroughWall());
  }

  [[nodiscard]] Ended demo(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"demo", "--output", out_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(arguments, {examples_});
  }

  SmallWorld world_;
  std::string out_ = world_.folder / "demo.jsonl", page_ = world_.folder / "demo.html";
  std::string examples_ = "FORETOUCH_EXAMPLES=" + (world_.folder / ".");
};

TEST_F(DemoOfASmallWorld, SaysInFiveLinesWhatADiscreteCheckMissesAndWhereThePageIs) {
  const Ended ended = demo();
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.out,
            "The bundled dancer moves through the bundled room, known only 10 times a second.\n"
            "The dancer touches the room twice. Checking the poses alone would miss both.\n"
            "page:    " +
                page_ + "   (open it in a browser)\nresults: " + out_ + "\n");
  EXPECT_EQ(contentOf(out_).rfind("{\"format\":\"foretouch-results\"", 0), 0u);
  EXPECT_NE(contentOf(page_).find("<html"), std::string::npos);
}

TEST_F(DemoOfASmallWorld, SaysTheRestIfAsked) {
  const Ended ended = demo({"--details"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.out.rfind(demo().out, 0), 0u) << ended.out;
  for (const char* part :
       {"triangles", "without area", "links", "volume of all LSS",
        "at step 1 'Hips' met 'wall' at t=0.", "a discrete check at the two poses saw nothing"}) {
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  }
}

/// On a terminal, which `script` makes, with an xdg-open that writes down what it is to open.
TEST_F(DemoOfASmallWorld, OffersToOpenThePageOnATerminalButNeverInCi) {
  const std::string opened = world_.folder / "opened";
  world_.folder.script("xdg-open", "echo \"$1\" >'" + opened + "'");
  const auto answered = [&](const std::string& answer, const std::string& variables) {
    std::filesystem::remove(opened);
    const std::string command = "echo '" + answer + "' | env -u CI " + variables +
                                " DISPLAY=:9 PATH='" + (world_.folder / ".") +
                                "':\"$PATH\" script -qec '" + FORETOUCH_PROGRAM + " demo -o " +
                                out_ + "' /dev/null";
    const Ended ended = ProgramRun({"-c", command}, {examples_}, "", "sh").ended();
    EXPECT_EQ(ended.exitCode, 0) << ended.err << ended.out;
    // The opener outlives the program.
    const auto isWritten = [&] {
      return std::filesystem::exists(opened) && std::filesystem::file_size(opened) > 0;
    };
    const bool isAwaited = answer == "y" && variables.empty();
    for (int i = 0; i < 200 && isAwaited && !isWritten(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return std::pair(ended.out.find("Open the page now?") != std::string::npos,
                     isWritten() ? contentOf(opened) : "");
  };
  if (ProgramRun({"-c", "command -v script"}, {}, "", "sh").ended().exitCode != 0) {
    GTEST_SKIP() << "no program `script` here";
  }
  EXPECT_EQ(answered("y", ""), std::pair(true, page_ + "\n"));
  EXPECT_EQ(answered("n", ""), std::pair(true, std::string()));
  EXPECT_EQ(answered("y", "CI=true"), std::pair(false, std::string()));
}

TEST(Demo, SaysWhereItLookedForTheExample) {
  const TempFolder folder;
  const Ended ended = runForetouch({"demo", "--output", folder / "out.jsonl"},
                                   {"FORETOUCH_EXAMPLES=" + (folder / "nowhere")});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find(folder / "nowhere"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("FORETOUCH_EXAMPLES"), std::string::npos) << ended.err;
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace foretouch::test
