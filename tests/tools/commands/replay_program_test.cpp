// tests/tools/commands/replay_program_test.cpp: `foretouch replay` from files to files.
#include <chrono>
#include <csignal>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_inputs.h"
#include "tests/tools/small_world.h"
#include "tests/tools/stream/stream_lines.h"
#include "tools/inputs/example_folder.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

/// The results file as it would be without its latency fields.
std::string resultsWithoutLatency(const std::string& path) {
  std::string text;
  std::istringstream lines(contentOf(path));
  for (std::string line; std::getline(lines, line);) text += withoutLatency(line) + "\n";
  return text;
}

std::vector<double> toAndFro(int frames) {
  std::vector<double> places;
  for (int i = 0; i < frames; ++i) places.push_back((i % 3 - 1) * (0.3 + 1e-4 * i));
  return places;
}

TEST(ReplayProgram, WritesAHeaderAndALineAStep) {
  const SmallWorld world;
  const std::string out = world.folder / "out.jsonl";
  const Ended ended = runForetouch(world.replay({"--rate", "10", "--output", out}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_NE(ended.out.find("of 2 contacts, 2 (100.0 %) touch nothing at either pose"),
            std::string::npos)
      << ended.out;

  const std::vector<std::string> lines = linesOf(contentOf(out));
  ASSERT_EQ(lines.size(), 4u);
  const json header = json::parse(lines[0]);
  EXPECT_EQ(header["format"], "foretouch-results");
  EXPECT_EQ(header["version"], 1);
  EXPECT_EQ(header["steps"], 3);
  EXPECT_EQ(header["links"], json({"Hips", "Arm"}));
  for (std::size_t n = 0; n < 3; ++n) {
    const json step = json::parse(lines[n + 1]);
    EXPECT_EQ(step["step"], n);
    EXPECT_NEAR(step["t1"].get<double>() - step["t0"].get<double>(), 0.1, 1e-15);
    EXPECT_GE(step["latency_us"].get<double>(), 0.0);
    EXPECT_EQ(step["contacts"].size(), n == 1 ? 2u : 0u);
  }
  const json contact = json::parse(lines[2])["contacts"][0];
  EXPECT_EQ(contact["link"], "Hips");
  EXPECT_EQ(contact["verdict"], "contact");
  EXPECT_EQ(contact["object"], "wall");
  // The sphere (0.1 m) touches x = 0 at 0.3 of the way from -0.25 to 0.25, in the middle of the
  // wall.
  EXPECT_LE(contact["toi"].get<double>(), 0.3 + 1e-12);
  EXPECT_GE(contact["toi"].get<double>(), 0.3 - 2e-3);
  EXPECT_NEAR(contact["time"].get<double>(), 0.1 + 0.1 * contact["toi"].get<double>(), 1e-15);
  EXPECT_GE(contact["separation"].get<double>(), 0.0);
  EXPECT_LE(contact["separation"].get<double>(), 1e-3);
  EXPECT_NEAR(contact["point"][0].get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(contact["normal"][0].get<double>(), -1.0, 1e-9);
  EXPECT_NEAR(contact["on_link"][0].get<double>(), -contact["separation"].get<double>(), 1e-9);
  EXPECT_EQ(contact.count("penetration"), 0u);
}

// A cubic is played as pieces of a constant rate, of which each is a step of the results.
TEST(ReplayProgram, FollowsACubicBetweenPoses) {
  const SmallWorld world;
  const std::string out = world.folder / "out.jsonl";
  const Ended ended =
      runForetouch(world.replay({"--rate", "10", "--between", "cubic-late", "--output", out}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.err.find("--between cubic-late: "), std::string::npos) << ended.err;
  const std::vector<std::string> lines = linesOf(contentOf(out));
  const json header = json::parse(lines[0]);
  EXPECT_EQ(header["between"], "cubic-late");
  const auto pieces = header["pieces"].get<int>();
  EXPECT_EQ(header["steps"], 3 * pieces);
  EXPECT_LE(header["off_m"].get<double>(), 1e-3 / 8.0);
  int contacts = 0;
  for (std::size_t n = 1; n < lines.size(); ++n) {
    const json step = json::parse(lines[n]);
    if (step.count("step") == 0) continue;
    EXPECT_NEAR(step["t0"].get<double>(), 0.1 * step["step"].get<double>() / pieces, 1e-12);
    for (const json& contact : step["contacts"]) {
      if (contact["verdict"] != "contact" || contact["link"] != "Hips") continue;
      ++contacts;
      EXPECT_GT(contact["time"].get<double>(), 0.1);
      EXPECT_LT(contact["time"].get<double>(), 0.2);
      EXPECT_LE(contact["separation"].get<double>(), 1e-3);
    }
  }
  EXPECT_GT(contacts, 0);
  const Ended solid =
      runForetouch(world.replay({"--between", "cubic", "--solid", "--output", out}));
  EXPECT_NE(solid.exitCode, 0);
  EXPECT_NE(solid.err.find("--between: expected --bounds beside it"), std::string::npos)
      << solid.err;
}

TEST(ReplayProgram, TakesFilesWithoutTheirOptionsInAnyOrder) {
  const SmallWorld world;
  const TempFolder& folder = world.folder;
  const std::string named = folder / "named.jsonl", bare = folder / "bare.jsonl";
  ASSERT_EQ(runForetouch(world.replay({"-o", named})).exitCode, 0);
  const Ended ended = runForetouch(
      {"replay", folder / "clip.bvh", folder / "wall.obj", folder / "man.json", "-o", bare});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(resultsWithoutLatency(bare), resultsWithoutLatency(named));
  // By content where a name says nothing; an option beside them still counts.
  const std::string dance = folder.write("dance.txt", clipThroughWall());
  const std::string body = folder.write("body.dat", kManAvatar);
  EXPECT_EQ(
      runForetouch({"replay", dance, body, "--scene", folder / "wall.obj", "-o", bare}).exitCode,
      0);
  const auto refused = [&](std::vector<std::string> files, const std::string& message) {
    files.insert(files.begin(), "replay");
    files.insert(files.end(), {"-o", bare});
    const Ended no = runForetouch(files);
    EXPECT_EQ(no.exitCode, 2) << message;
    EXPECT_TRUE(holds(no.err, message)) << no.err;
  };
  refused({folder / "wall.obj", dance}, "--avatar is required");
  refused({folder / "wall.obj", folder / "clip.bvh", dance, body},
          "dance.txt: is a motion, and a second one of its kind");
  refused({folder / "wall.obj", body, dance, "--motion", folder / "clip.bvh"},
          "dance.txt: is a motion, and a second one of its kind; expected at most one, found "
          "--motion as well");
  refused({folder.write("odd.dat", "?"), body, dance}, "odd.dat: its name does not say what it is");
  refused({folder / "none.dat", body, dance}, "none.dat: cannot be opened");
}

/// By name, and by content where the name says nothing; a damaged one is refused as a scene.
TEST(ReplayProgram, TakesABakedSceneWithoutItsOption) {
  const SmallWorld world;
  const TempFolder& folder = world.folder;
  const std::string out = folder / "out.jsonl", baked = folder / "wall.ftscene";
  const auto stepsIn = [&](const std::string& scene) {
    const Ended ended =
        runForetouch({"replay", folder / "clip.bvh", scene, folder / "man.json", "-o", out});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    const std::string all = resultsWithoutLatency(out);
    return all.substr(all.find('\n'));  // the first line names the file
  };
  const std::string steps = stepsIn(folder / "wall.obj");
  ASSERT_EQ(runForetouch({"scene", "bake", folder / "wall.obj", "-o", baked}).exitCode, 0);
  EXPECT_EQ(stepsIn(baked), steps);
  const std::string bytes = contentOf(baked);
  EXPECT_EQ(stepsIn(folder.write("wall.dat", bytes)), steps);
  const std::string broken = folder.write("broken.ftscene", bytes.substr(0, 40));
  const Ended ended =
      runForetouch({"replay", folder / "clip.bvh", broken, folder / "man.json", "-o", out});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "broken.ftscene: ")) << ended.err;
  EXPECT_FALSE(holds(ended.err, "does not say what it is")) << ended.err;
}

/// The same step as of the whole clip, at the same time.
TEST(ReplayProgram, PlaysAPartOfAClipAtTheClipsOwnTime) {
  const SmallWorld world;
  const std::string out = world.folder / "out.jsonl", all = world.folder / "all.jsonl";
  ASSERT_EQ(runForetouch(world.replay({"--output", all})).exitCode, 0);
  ASSERT_EQ(runForetouch(world.replay({"--from", "1f", "--to", "0.2", "--output", out})).exitCode,
            0);
  const std::vector<std::string> lines = linesOf(contentOf(out)), whole = linesOf(contentOf(all));
  const json header = json::parse(lines[0]);
  EXPECT_EQ(header["first_frame"], 1);
  EXPECT_EQ(header["from"], "1f");
  EXPECT_EQ(header["to"], "0.2");
  EXPECT_EQ(header["steps"], 1);
  const json step = json::parse(lines[1]), same = json::parse(whole[2]);
  EXPECT_EQ(step["t0"], same["t0"]);
  EXPECT_EQ(step["contacts"], same["contacts"]);
  EXPECT_EQ(step["contacts"].size(), 2u);
  EXPECT_FALSE(json::parse(whole[0]).contains("first_frame"));
}

TEST(ReplayProgram, ReportsHowDeepAStepStarts) {
  const SmallWorld world;
  world.folder.write("inside.bvh", clipAlongX({0.04, 0.5}));
  const std::string out = world.folder / "out.jsonl";
  ASSERT_EQ(
      runForetouch(world.replay({"--output", out}, "wall.obj", "man.json", "inside.bvh")).exitCode,
      0);
  const json contact = json::parse(linesOf(contentOf(out))[1])["contacts"][0];
  EXPECT_EQ(contact["verdict"], "starts_in_contact");
  EXPECT_EQ(contact["toi"], 0);
  EXPECT_EQ(contact["separation"], 0);
  EXPECT_NEAR(contact["penetration"].get<double>(), 0.06, 1e-12);
}

TEST(ReplayProgram, WritesTheSameBytesForAnyThreads) {
  const SmallWorld world;
  world.folder.write("long.bvh", clipAlongX(toAndFro(600)));
  std::string first;
  for (const std::string threads : {"1", "2", "4"}) {
    const std::string out = world.folder / threads;
    ASSERT_EQ(runForetouch(world.replay({"--threads", threads, "--output", out}, "wall.obj",
                                        "man.json", "long.bvh"))
                  .exitCode,
              0);
    const std::string results = resultsWithoutLatency(out);
    if (first.empty()) first = results;
    EXPECT_EQ(results, first) << threads;
  }
  EXPECT_EQ(linesOf(first).size(), 600u);
  EXPECT_NE(first.find("\"contact\""), std::string::npos);
  EXPECT_EQ(first.find("latency"), std::string::npos);
}

/// The bundled clip in the bundled room; ends the test's part where the program fails.
void replayExample(const std::string& out, const std::vector<std::string>& more) {
  const std::string folder = tools::exampleFolder().value();
  std::vector<std::string> arguments{"replay",
                                     "--scene",
                                     folder + "/room.obj",
                                     "--avatar",
                                     folder + "/dancer.avatar.json",
                                     "--motion",
                                     folder + "/dancer.bvh",
                                     "--output",
                                     out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ended ended = runForetouch(arguments);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
}

/// What a step's line says of a link: how long it is free of contact, and whether that is all.
struct Said {
  double free = 1.0;
  bool isUndecided = false;
};

std::vector<std::map<std::string, Said>> saidIn(const std::string& path) {
  std::vector<std::map<std::string, Said>> steps;
  const std::vector<std::string> lines = linesOf(contentOf(path));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::map<std::string, Said> step;
    const json line = json::parse(lines[i]);
    for (const json& contact : line["contacts"]) {
      const bool isUndecided = contact["verdict"] == "undecided";
      if (isUndecided) {
        EXPECT_EQ(contact["reason"], "work-budget");
      }
      step[contact["link"]] = {contact[isUndecided ? "free_until" : "toi"], isUndecided};
    }
    steps.push_back(step);
  }
  return steps;
}

TEST(ReplayProgram, ProvesMoreWithALargerBudgetAndTheSameOnAnyThread) {
  const TempFolder out;
  const auto replayed = [&](const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--rate", "10"});
    replayExample(out / name, arguments);
    return saidIn(out / name);
  };
  auto before = replayed("1", {"--budget-us", "1", "--threads", "1"});
  replayed("2", {"--budget-us", "1", "--threads", "2"});
  EXPECT_EQ(resultsWithoutLatency(out / "1"), resultsWithoutLatency(out / "2"));
  EXPECT_EQ(json::parse(linesOf(contentOf(out / "1"))[0])["budget_us"], 1);
  std::size_t undecidedBefore = before.size() * 1000;
  for (const std::string budget : {"5", "20", "60000000", ""}) {
    const auto now =
        budget.empty() ? replayed("all", {}) : replayed("more", {"--budget-us", budget});
    ASSERT_EQ(now.size(), before.size());
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      for (const auto& [link, said] : now[i]) {
        undecided += said.isUndecided ? 1 : 0;
        const auto earlier = before[i].find(link);
        const double free = earlier == before[i].end() ? 1.0 : earlier->second.free;
        EXPECT_LE(free, said.free) << link << " of step " << i;
      }
    }
    EXPECT_LE(undecided, undecidedBefore);
    undecidedBefore = undecided;
    before = now;
  }
  EXPECT_EQ(undecidedBefore, 0u);
  // One that is not spent shows in the header alone.
  const auto most = linesOf(resultsWithoutLatency(out / "more"));
  const auto all = linesOf(resultsWithoutLatency(out / "all"));
  ASSERT_EQ(most.size(), all.size());
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_EQ(most[i], all[i]);
}

TEST(ReplayProgram, SaysWhereExactFidelityIsLinkFidelity) {
  const SmallWorld world;
  const std::string page = world.folder / "page.html";
  std::vector<std::string> steps;
  for (const std::string fidelity : {"link", "exact"}) {
    const std::string out = world.folder / fidelity;
    const Ended ended =
        runForetouch(world.replay({"--fidelity", fidelity, "--output", out, "--report", page}));
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    const std::string note = "none of its links at exact fidelity has a mesh";
    const bool isExact = fidelity == "exact";
    EXPECT_EQ(ended.err.find("man.json: " + note) != std::string::npos, isExact) << ended.err;
    EXPECT_EQ(contentOf(page).find(note) != std::string::npos, isExact);
    const std::string results = resultsWithoutLatency(out);
    steps.push_back(results.substr(results.find('\n')));
  }
  EXPECT_EQ(steps[0], steps[1]);
}

TEST(ReplayProgram, ObeysRateScalePlaceIgnoreAndUp) {
  const SmallWorld world;
  world.folder.write("long.bvh", clipAlongX({-75, -50, -25, 25, 50, 75, 90}));
  const std::string out = world.folder / "out.jsonl";
  const auto contactsOf = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = world.replay(options, "wall.obj", "man.json", "long.bvh");
    arguments.insert(arguments.end(), {"--output", out, "--clip-scale", "0.01"});
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    std::vector<std::string> texts;
    const auto lines = linesOf(contentOf(out));
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const json step = json::parse(lines[i]);
      for (const json& contact : step["contacts"]) {
        texts.push_back(std::to_string(i - 1) + contact["link"].get<std::string>());
      }
    }
    return texts;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(contactsOf({}), (Texts{"2Hips", "2Arm"}));
  EXPECT_EQ(contactsOf({"--rate", "5"}), (Texts{"1Hips", "1Arm"}));
  EXPECT_EQ(contactsOf({"--ignore", "Hips:wall"}), (Texts{"2Arm"}));
  EXPECT_EQ(contactsOf({"--ignore", "Hips", "--ignore", "A*:w*"}), Texts{});
  EXPECT_EQ(contactsOf({"--place", "-9,0,0"}), Texts{});
  EXPECT_EQ(contactsOf({"--place", "1,0,0,90"}), Texts{});  // turned, it moves along the wall
  EXPECT_EQ(contactsOf({"--place", "0.63,0,0,180"}), (Texts{"4Hips", "4Arm"}));
  EXPECT_EQ(contactsOf({"--up", "z", "--place", "0,9,0"}), Texts{});
}

TEST(ReplayProgram, NamesWhatDoesNotMatch) {
  const SmallWorld world;
  std::string clip = clipThroughWall();
  clip.replace(clip.find("Arm"), 3, "Leg");
  world.folder.write("leg.bvh", clip);
  const std::string out = world.folder / "out.jsonl";
  const auto arguments = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--output", out});
    return world.replay(more, "wall.obj", "man.json", "leg.bvh");
  };
  const Ended ended = runForetouch(arguments({}));
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_NE(ended.err.find("keep their rest values: 'Arm'"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("drive nothing: 'Leg'"), std::string::npos) << ended.err;
  EXPECT_EQ(json::parse(linesOf(contentOf(out))[0])["unmatched_joints"], json({"Arm"}));
  const std::string map = world.folder.write("map.json", R"({"Arm": "Leg"})");
  EXPECT_EQ(runForetouch(arguments({"--map", map})).err, "");
}

TEST(ReplayProgram, NotesAWrongUnit) {
  const SmallWorld world;
  const Ended ended =
      runForetouch(world.replay({"--output", world.folder / "out.jsonl", "--scale", "0.01"}));
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_NE(ended.err.find("is --clip-scale right?"), std::string::npos) << ended.err;
}

TEST(ReplayProgram, GivesStandardOutputToTheResultsWhereAsked) {
  const SmallWorld world;
  const Ended ended = runForetouch(world.replay({"--output", "/dev/stdout"}));
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.err.find("link-steps"), std::string::npos) << ended.err;
}

TEST(ReplayProgram, ReplacesOlderResultsOnlyOnSuccess) {
  const SmallWorld world;
  const std::string out = world.folder.write("out.jsonl", "older\n");
  EXPECT_EQ(runForetouch(world.replay({"--rate", "99", "--output", out})).exitCode, 2);
  EXPECT_EQ(contentOf(out), "older\n");
  EXPECT_EQ(runForetouch(world.replay({"--output", out})).exitCode, 0);
  EXPECT_EQ(linesOf(contentOf(out)).size(), 4u);
}

TEST(ReplayProgram, LeavesNothingWhenInterrupted) {
  const SmallWorld world;
  world.folder.write("long.bvh", clipAlongX(toAndFro(400'000)));
  const auto before = world.folder.names();
  for (const int signal : {SIGINT, SIGTERM}) {
    ProgramRun run(world.replay({"--threads", "2", "--output", world.folder / "out.jsonl"},
                                "wall.obj", "man.json", "long.bvh"));
    // Once its unfinished file is there, and stays there, the replay is under way. (The trial that
    // comes before is there for less than a millisecond.)
    int seen = 0;
    for (int i = 0; i < 30'000 && seen < 5; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      seen = world.folder.names().size() > before.size() ? seen + 1 : 0;
    }
    ASSERT_EQ(seen, 5);
    run.send(signal);
    const Ended ended = run.ended();
    EXPECT_EQ(ended.signal, signal) << "exit code " << ended.exitCode << ended.err;
    EXPECT_EQ(world.folder.names(), before);
  }
}

}  // namespace
}  // namespace foretouch::test
