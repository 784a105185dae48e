// tests/tools/bad_input_test.cpp: whatever is wrong with what a replay is given, it ends with exit
// code 2, one line that says what is wrong where, and no file left behind.
#include <functional>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

struct BadInput {
  std::string name;
  /// Changes the world for the worse and gives the arguments of the replay.
  std::function<std::vector<std::string>(const SmallWorld&)> prepare;
  std::string expected;  ///< Part of the error.
};

void PrintTo(const BadInput& input, std::ostream* out) {
  *out << input.name;
}

/// The three lists below: a file of this name and content takes the place of a good one.
BadInput badFile(const std::string& name, const std::string& option, const std::string& file,
                 const std::string& content, const std::string& expected) {
  return {name,
          [=](const SmallWorld& world) {
            if (content != "(absent)") world.folder.write(file, content);
            return world.replay(
                {"--output", world.folder / "out.jsonl"}, option == "--scene" ? file : "wall.obj",
                option == "--avatar" ? file : "man.json", option == "--motion" ? file : "clip.bvh");
          },
          expected};
}

BadInput badOption(const std::string& name, const std::vector<std::string>& options,
                   const std::string& expected) {
  return {
      name,
      [=](const SmallWorld& world) {
        std::vector<std::string> arguments = world.replay({"--output", world.folder / "out.jsonl"});
        arguments.insert(arguments.end(), options.begin(), options.end());
        return arguments;
      },
      expected};
}

BadInput badOutput(const std::string& name,
                   const std::function<std::string(const SmallWorld&)>& output,
                   const std::string& expected) {
  return {name,
          [=](const SmallWorld& world) {
            return world.replay({"--output", output(world)});
          },
          expected};
}

std::string binary() {
  std::string bytes;
  for (int i = 0; i < 5000; ++i) bytes += static_cast<char>((i * 7919) % 251);
  return bytes;
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) ADD_FAILURE() << "no " << part;
  return text.replace(at, part.size(), by);
}

std::vector<BadInput> badScenes() {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  return {
      badFile("SceneMissing", "--scene", "absent.obj", "(absent)", "absent.obj: "),
      badFile("SceneEmpty", "--scene", "empty.obj", "", "empty.obj: "),
      badFile("SceneTruncated", "--scene", "cut.ply", ply + "0 0 0\n1 0", "cut.ply: "),
      badFile("SceneBinary", "--scene", "noise.obj", binary(), "noise.obj: "),
      badFile("SceneHuge", "--scene", "huge.ply",
              replaced(ply, "vertex 3", "vertex 4000000000") + "0 0 0\n", "huge.ply: "),
      badFile("SceneNotFinite", "--scene", "nan.obj", "v nan nan nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
              "nan.obj: "),
      badFile("SceneOutOfRange", "--scene", "far.obj", "v 1e9 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
              "far.obj: "),
      badFile("SceneOfWrongType", "--scene", "man.json", kManAvatar, "man.json: "),
      badFile("SceneWithoutTriangles", "--scene", "points.obj", "v 0 0 0\nv 1 0 0\n",
              "points.obj: "),
  };
}

std::vector<BadInput> badAvatars() {
  const std::string man = kManAvatar;
  return {
      badFile("AvatarMissing", "--avatar", "absent.json", "(absent)", "absent.json: "),
      badFile("AvatarEmpty", "--avatar", "empty.json", "", "empty.json:1: "),
      badFile("AvatarTruncated", "--avatar", "cut.json", man.substr(0, man.size() / 2),
              "cut.json:2: "),
      badFile("AvatarBinary", "--avatar", "noise.json", binary(), "noise.json:1: "),
      badFile("AvatarDeep", "--avatar", "deep.json", std::string(1'000'000, '['), "deep.json:1: "),
      badFile("AvatarCyclic", "--avatar", "cycle.json",
              replaced(man, "\"parent\":null", "\"parent\":\"Arm\""), "cycle.json:2: "),
      badFile("AvatarNotFinite", "--avatar", "nan.json", replaced(man, "0.05", "1e999"),
              "nan.json:3: "),
      badFile("AvatarOfWrongType", "--avatar", "clip.bvh", clipThroughWall(), "clip.bvh:1: "),
      badFile("AvatarOfNoJointOfTheClip", "--avatar", "other.json",
              replaced(replaced(replaced(man, "Hips", "A"), "Hips", "A"), "Arm", "B"),
              "clip.bvh: no joint of the avatar"),
  };
}

std::vector<BadInput> badMotions() {
  const std::string clip = clipThroughWall();
  const std::string lastRow = "0.750000 0 0 0 0 0 0 0 0\n";
  return {
      badFile("MotionMissing", "--motion", "absent.bvh", "(absent)", "absent.bvh: "),
      badFile("MotionEmpty", "--motion", "empty.bvh", "", "empty.bvh"),
      badFile("MotionTruncated", "--motion", "cut.bvh", replaced(clip, lastRow, "0.750000 0 0"),
              "cut.bvh:"),
      badFile("MotionTruncatedInHierarchy", "--motion", "cut.bvh", clip.substr(0, 80), "cut.bvh:"),
      badFile("MotionBinary", "--motion", "noise.bvh", binary(), "noise.bvh"),
      badFile("MotionNotFinite", "--motion", "nan.bvh", replaced(clip, "0.250000", "nan"),
              "nan.bvh:"),
      badFile("MotionTooFar", "--motion", "far.bvh", replaced(clip, "0.250000", "1e30"), "far.bvh"),
      badFile("MotionOfWrongType", "--motion", "wall.obj", kWallObj, "wall.obj:1: "),
      badFile("MotionOfOneFrame", "--motion", "one.bvh", clipAlongX({0.5}),
              "one.bvh: expected at least 2 frames"),
      badFile("MotionOfNoFrame", "--motion", "none.bvh", clipAlongX({}), "none.bvh"),
  };
}

std::vector<BadInput> badOptions() {
  return {
      badOption("RateAboveTheClips", {"--rate", "11"}, "at most the clip's own 10 Hz"),
      badOption("RateZero", {"--rate", "0"}, "--rate: "),
      badOption("RateNegative", {"--rate", "-5"}, "--rate: "),
      badOption("RateNotANumber", {"--rate", "nan"}, "--rate: "),
      badOption("RateTooLow", {"--rate", "0.1"}, "less than one step"),
      badOption("ToleranceZero", {"--tolerance", "0"}, "--tolerance: "),
      badOption("ToleranceNegative", {"--tolerance", "-0.001"}, "--tolerance: "),
      badOption("ToleranceNotANumber", {"--tolerance", "nan"}, "--tolerance: "),
      badOption("ThreadsZero", {"--threads", "0"}, "--threads: "),
      badOption("ThreadsNegative", {"--threads", "-1"}, "--threads: "),
      badOption("ThreadsAbsurd", {"--threads", "1000000"}, "--threads: "),
      badOption("IgnoreUnknownLink", {"--ignore", "Hps"}, "did you mean 'Hips'?"),
      badOption("IgnoreUnknownObject", {"--ignore", "Hips:wal"}, "did you mean 'wall'?"),
      badOption("PlaceOfTwoNumbers", {"--place", "1,2"}, "--place: "),
      badOption("PlaceNotFinite", {"--place", "1,2,inf"}, "--place: "),
      badOption("ScaleZero", {"--clip-scale", "0"}, "--clip-scale: "),
      badOption("ScaleZeroByItsFormerName", {"--scale", "0"}, "--clip-scale: "),
      badOption("SceneScaleNegative", {"--scene-scale", "-1"}, "--scene-scale: "),
      badOption("UpUnknown", {"--scene-up", "x"}, "--scene-up: "),
      badOption("UpUnknownByItsFormerName", {"--up", "x"}, "--scene-up: "),
      badOption("MotionUpUnknown", {"--clip-up", "w"}, "--clip-up: "),
      badOption("CullerIsGone", {"--culler", "point-query"},
                "--culler: is gone: the answers never depended on it"),
      badOption("LeavesAreGone", {"--leaves", "cubics"},
                "foretouch-bench latency --fidelity exact --leaves cubics"),
      badOption("CompareRigidIsGone", {"--compare-rigid"},
                "--compare-rigid: is gone: foretouch-bench compare counts that"),
      badOption("CompareLinkIsGone", {"--compare-link"}, "--compare-link: is gone: "),
      badOption("RaysAreGone", {"--rays"},
                "--rays: is gone: foretouch-bench latency times rays beside steps"),
      badOption("LeavesAreGoneAlone", {"--leaves"}, "--leaves: is gone: "),
      badOption(
          "FidelityIsGone", {"--fidelity", "limb"},
          "--fidelity: limb is gone: a volume around several links was slower and coarser than "
          "the links' own in every row measured (docs/trade.md); use link"),
      badOption("SelfOfTwoNeighbours", {"--self"}, "--self: expected at least one pair"),
      badOption("PairsWithoutSelf", {"--pairs", "p.json"}, "--pairs requires --self"),
      badOption("FidelityUnknown", {"--fidelity", "best"}, "--fidelity: "),
      badOption("MapMissing", {"--map", "/absent/map.json"}, "/absent/map.json: "),
      badOption("OptionUnknown", {"--sceen", "x"},
                "unknown option '--sceen'; did you mean '--scene'? See foretouch replay --help"),
  };
}

std::vector<BadInput> badFilesOfAnySort() {
  std::vector<BadInput> inputs;
  for (const std::string option : {"--scene", "--avatar", "--motion"}) {
    const std::string what = option.substr(2);
    const std::string file = "folder.obj";
    inputs.push_back({what + "IsAFolder",
                      [=](const SmallWorld& world) {
                        auto arguments = world.replay({"--output", world.folder / "out.jsonl"});
                        for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
                          if (arguments[i] == option) arguments[i + 1] = world.folder / ".";
                        }
                        return arguments;
                      },
                      "foretouch: "});
  }
  // More than its limit, without taking room on the disk.
  inputs.push_back(
      {"AvatarHuge",
       [](const SmallWorld& world) {
         const std::string huge = world.folder.write("huge.json", "");
         EXPECT_EQ(::truncate(huge.c_str(), off_t{1} << 32), 0);
         return world.replay({"--output", world.folder / "out.jsonl"}, "wall.obj", "huge.json");
       },
       "huge.json: expected at most"});
  inputs.push_back({"MotionHuge",
                    [](const SmallWorld& world) {
                      const std::string huge = world.folder.write("huge.bvh", "");
                      EXPECT_EQ(::truncate(huge.c_str(), off_t{1} << 32), 0);
                      return world.replay({"--output", world.folder / "out.jsonl"}, "wall.obj",
                                          "man.json", "huge.bvh");
                    },
                    "huge.bvh: expected at most"});
  inputs.push_back({"MapNamesNoJoint",
                    [](const SmallWorld& world) {
                      world.folder.write("map.json", R"({"Tail": "Hips"})");
                      return world.replay({"--output", world.folder / "out.jsonl", "--map",
                                           world.folder / "map.json"});
                    },
                    "map.json: the joint map names 'Tail'"});
  return inputs;
}

std::vector<BadInput> badOutputs() {
  return {
      badOutput(
          "OutputInNoFolder",
          [](const SmallWorld& world) { return world.folder / "absent/out.jsonl"; },
          "absent/out.jsonl: cannot be written"),
      badOutput(
          "OutputIsAFolder", [](const SmallWorld& world) { return world.folder / "."; },
          "is a folder"),
      badOutput(
          "OutputIsAnInput", [](const SmallWorld& world) { return world.folder / "clip.bvh"; },
          "is an input as well"),
      badOutput(
          "OutputIsFull", [](const SmallWorld&) { return std::string("/dev/full"); },
          "/dev/full: writing failed"),
      badOutput(
          "OutputIsNothing", [](const SmallWorld&) { return std::string(); }, "foretouch: "),
  };
}

class ReplayRefuses : public testing::TestWithParam<BadInput> {};

TEST_P(ReplayRefuses, WithOneLineAndNoFile) {
  const SmallWorld world;
  const std::vector<std::string> arguments = GetParam().prepare(world);
  const auto before = world.folder.names();
  const std::string clip = contentOf(world.folder / "clip.bvh");
  const Ended ended = runForetouch(arguments);
  EXPECT_EQ(ended.exitCode, 2) << "signal " << ended.signal;
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
  EXPECT_EQ(ended.err.find('\n'), ended.err.size() - 1) << ended.err;
  EXPECT_NE(ended.err.find(GetParam().expected), std::string::npos) << ended.err;
  EXPECT_EQ(world.folder.names(), before);
  EXPECT_EQ(contentOf(world.folder / "clip.bvh"), clip);
}

const auto nameOf = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Scene, ReplayRefuses, testing::ValuesIn(badScenes()), nameOf);
INSTANTIATE_TEST_SUITE_P(Avatar, ReplayRefuses, testing::ValuesIn(badAvatars()), nameOf);
INSTANTIATE_TEST_SUITE_P(Motion, ReplayRefuses, testing::ValuesIn(badMotions()), nameOf);
INSTANTIATE_TEST_SUITE_P(Option, ReplayRefuses, testing::ValuesIn(badOptions()), nameOf);
INSTANTIATE_TEST_SUITE_P(File, ReplayRefuses, testing::ValuesIn(badFilesOfAnySort()), nameOf);
INSTANTIATE_TEST_SUITE_P(Output, ReplayRefuses, testing::ValuesIn(badOutputs()), nameOf);

}  // namespace
}  // namespace foretouch::test
