// tests/tools/world/world_events_test.cpp: `foretouch world replay --events`: its lines, on a world
// that is computed by hand, and read by their documented rules alone.
#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_inputs.h"
#include "tests/tools/world/followed_stage.h"

namespace foretouch::test {
namespace {

constexpr double kTolerance = 1e-3;
constexpr double kSpeed = 5.0;  // of the man, m/s

using WorldEventsFile = FollowedStage;

/// Hips of 0.1 m at x = -0.75 + 5 t pass a ball of 0.05 m at x = -0.3, and a trigger around it.
TEST_F(WorldEventsFile, TellsOfAContactFromEnterToLeave) {
  const std::string world =
      stage_.write("[scene]\nfile = \"wall.obj\"\n" + kManWalks +
                   sphereNamed("ball", "mass = 0.4\nposition = [-0.3, 0, 0]\n") +
                   "[[trigger]]\nname = \"zone\"\nsphere = 0.2\nposition = [-0.3, 0, 0]\n"
                   "watches = [{body = \"man\", link = \"Hips\"}]\n");
  const EventsFile file = follow(world);
  EXPECT_EQ(file.header["format"], "foretouch-events");
  EXPECT_EQ(file.header["version"], 1);
  EXPECT_EQ(file.header["bodies"].size(), 2u);
  ASSERT_EQ(file.header["triggers"].size(), 1u);
  EXPECT_EQ(file.header["triggers"][0]["watches"][0]["link"], "Hips");

  const double enterS = 0.06, leaveS = 0.12;
  const json& enter = find(file.events, "enter", "man Hips, ball  ");
  EXPECT_LE(enter["time"].get<double>(), enterS);  // never late
  EXPECT_GE(enter["time"].get<double>(), enterS - kTolerance / kSpeed - 1e-9);
  EXPECT_NEAR(enter["a"]["point"][0].get<double>(), -0.35, 2.0 * kTolerance);
  EXPECT_NEAR(enter["b"]["point"][0].get<double>(), -0.35, 1e-9);
  EXPECT_NEAR(enter["normal"][0].get<double>(), -1.0, 1e-9);
  EXPECT_NEAR(enter["velocity"][0].get<double>(), kSpeed, 1e-9);
  EXPECT_LE(enter["approach"]["lower"].get<double>(), kSpeed);
  EXPECT_GE(enter["approach"]["upper"].get<double>(), kSpeed);
  EXPECT_NEAR(enter["approach"]["upper"].get<double>(), kSpeed, 1e-3);
  EXPECT_NEAR(enter["effective_mass"].get<double>(), 0.4, 1e-9);  // the man has none: tracked
  ASSERT_GE(enter["points"].size(), 1u);
  EXPECT_LE(enter["points"][0]["separation"].get<double>(), kTolerance);

  const json& leave = find(file.events, "leave", "man Hips, ball  ");
  EXPECT_GE(leave["time"].get<double>(), leaveS);  // never early
  EXPECT_LE(leave["time"].get<double>(), leaveS + 2.0 * kTolerance / kSpeed + 1e-9);
  EXPECT_EQ(exactTime(leave["since"]), exactTime(enter));
  EXPECT_LT(leave["approach"]["speed"].get<double>(), 0.0);

  // Centres 0.3 m apart, 0.03 s from the middle at 0.09 s.
  const json& in = find(file.events, "enter", "zone: man Hips");
  EXPECT_LE(in["time"].get<double>(), 0.03);
  EXPECT_GE(in["time"].get<double>(), 0.03 - kTolerance / kSpeed - 1e-9);
  const json& out = find(file.events, "leave", "zone: man Hips");
  EXPECT_GE(out["time"].get<double>(), 0.15);
  EXPECT_LE(out["time"].get<double>(), 0.15 + 2.0 * kTolerance / kSpeed + 1e-9);
  ASSERT_EQ(file.stays.size(), 1u);
  EXPECT_EQ(exactTime(file.stays[0]["from"]), exactTime(in));
  EXPECT_EQ(exactTime(file.stays[0]["to"]), exactTime(out));
  for (const json& event : file.events)
    EXPECT_EQ(event.dump().find("\"body\":\"zone\""), std::string::npos);
}

/// What is said twice agrees: events in order, and the intervals and counts that follow from them.
void expectConsistent(const EventsFile& file) {
  std::map<std::string, json> open;
  std::vector<std::tuple<std::string, std::pair<std::int64_t, double>, bool>> told, expected;
  std::tuple<std::int64_t, double, int> before{INT64_MIN, 0.0, 0};
  std::map<std::string, std::int64_t> counts, ofTriggers;
  for (const json& event : file.events) {
    const auto [us, fraction] = exactTime(event);
    const std::string kind = event["event"];
    const std::tuple now{us, fraction, orderOf(kind)};
    EXPECT_LE(before, now) << event;
    before = now;
    const bool isTrigger = event.count("trigger") != 0;
    ++(isTrigger ? ofTriggers : counts)[kind];
    if (isTrigger) continue;
    const std::string pair = pairOf(event);
    if (kind == "leave") {
      ASSERT_EQ(open.count(pair), 1u) << event;
      EXPECT_EQ(exactTime(event["since"]), exactTime(open[pair])) << event;
      expected.emplace_back(pair, exactTime(open[pair]), false);
      open.erase(pair);
    } else if (kind == "enter" || kind == "starts_inside") {
      EXPECT_EQ(open.count(pair), 0u) << event;
      open[pair] = event;
    }
  }
  for (const auto& [pair, event] : open) expected.emplace_back(pair, exactTime(event), true);
  for (const json& interval : file.intervals) {
    ASSERT_EQ(interval["kind"], "contact") << interval;
    told.emplace_back(pairOf(interval), exactTime(interval["from"]),
                      interval.value("goes_on", false));
    EXPECT_LE(exactTime(interval["from"]), exactTime(interval["to"]));
  }
  std::sort(told.begin(), told.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(told, expected);
  for (const auto& [kind, count] : counts) EXPECT_EQ(file.summary["events"][kind], count) << kind;
  for (const auto& [kind, count] : ofTriggers) {
    EXPECT_EQ(file.summary["trigger_events"][kind], count) << kind;
  }
  EXPECT_EQ(file.summary["intervals"], file.intervals.size());
  EXPECT_EQ(file.summary["stays"], file.stays.size());
}

TEST_F(WorldEventsFile, OfTheBundledStageAgreesWithItself) {
  const EventsFile file = follow(std::string(FORETOUCH_EXAMPLE_FOLDER) + "/stage.toml");
  expectConsistent(file);
  EXPECT_GT(file.summary["events"]["enter"].get<int>(), 100);
  std::map<std::string, int> stays;
  for (const json& stay : file.stays) {
    ++stays[stay["trigger"].get<std::string>() + ": " + stay["who"]["body"].get<std::string>()];
  }
  EXPECT_GE(stays["doorway: anna"], 1);
  EXPECT_GE(stays["doorway: ball"], 1);
  EXPECT_GE(stays["anna's space: ben"], 1);
}

/// How windows are cut, and who asks besides, changes nothing.
TEST_F(WorldEventsFile, DoesNotDependOnWindows) {
  const std::string world = stage_.write("[scene]\nfile = \"wall.obj\"\n" + kManWalks +
                                         sphereNamed("ball", "position = [-0.3, 0, 0]\n"));
  const EventsFile poses = follow(world), fine = follow(world, {"--rate", "1000"});
  EXPECT_EQ(poses.events, fine.events);
  EXPECT_EQ(poses.intervals, fine.intervals);
}

/// The lift is known until 0.1 s; who rides on it, in contact with a post, lets go at 0.2 s.
TEST_F(WorldEventsFile, SaysWhereNothingIsKnown) {
  const std::string world =
      stage_.write(sphereNamed("lift", "when_silent = \"undecided\"\n" + poseAt(0, "0, 9, 0") +
                                           poseAt(0.1, "0, 9, 0")) +
                   sphereNamed("rider",
                               "[[body.attach]]\ntime = 0\nto = \"lift\"\nposition = [0, 1, 0]\n"
                               "[[body.detach]]\ntime = 0.2\nposition = [0, 10, 0]\n") +
                   sphereNamed("post", poseAt(0, "0.05, 10, 0") + poseAt(0.3, "0.05, 10, 0")));
  const EventsFile file = follow(world);
  std::vector<std::string> told;
  for (const json& event : file.events) {
    const std::string kind = event["event"];
    told.push_back(kind + " " + std::to_string(event["utime"].get<std::int64_t>()));
    const bool isTold = kind == "starts_inside";
    EXPECT_EQ(event.count("reason"), isTold ? 0u : 1u) << event;
    for (const char* key : {"separation", "normal", "velocity", "approach", "points"}) {
      EXPECT_EQ(event.count(key), isTold ? 1u : 0u) << event;
    }
    EXPECT_EQ(event.value("reason", "gap"), "gap");
  }
  EXPECT_EQ(told, (std::vector<std::string>{"starts_inside 0", "unresolved_from 100000",
                                            "unresolved_from 100000", "unresolved_to 200000",
                                            "starts_inside 200000"}));
  const json &lift = file.events.at(1), &rider = file.events.at(2), &again = file.events.at(3);
  EXPECT_EQ(lift["a"], (json{{"body", "lift"}}));
  EXPECT_EQ(lift["b"], (json{{"everybody", true}}));
  EXPECT_EQ(rider["a"], (json{{"body", "rider"}}));
  EXPECT_EQ(rider["b"], (json{{"body", "post"}}));
  EXPECT_EQ(again["since"]["utime"], 100000);
  EXPECT_EQ(again["a"], rider["a"]);
  std::map<std::string, std::vector<std::int64_t>> unresolved;
  for (const json& interval : file.intervals) {
    if (interval["kind"] != "unresolved") continue;
    EXPECT_EQ(interval["reason"], "gap");
    unresolved[interval["a"]["body"]] = {interval["from"]["utime"], interval["to"]["utime"]};
  }
  EXPECT_EQ(unresolved, (std::map<std::string, std::vector<std::int64_t>>{
                            {"lift", {100000, 300000}}, {"rider", {100000, 200000}}}));
  EXPECT_EQ(file.summary["events"]["unresolved_from"], 2);
  EXPECT_EQ(file.summary["events"]["unresolved_to"], 1);
}

/// A contact that becomes unresolved ends without a leave.
TEST_F(WorldEventsFile, ClaimsNoLeaveOfWhoFallsSilent) {
  const std::string world = stage_.write(
      kManWalks + sphereNamed("ball", "when_silent = \"undecided\"\n" + poseAt(0, "-0.3, 0, 0") +
                                          poseAt(0.08, "-0.3, 0, 0")));
  const EventsFile file = follow(world);
  find(file.events, "enter", "man Hips, ball  ");
  for (const json& event : file.events) EXPECT_NE(event["event"], "leave") << event;
  ASSERT_GE(file.intervals.size(), 2u);
  const json& contact = file.intervals[0];
  EXPECT_EQ(contact["kind"], "contact");
  EXPECT_EQ(contact["to"]["utime"], 80000);
  EXPECT_EQ(contact.count("goes_on"), 0u);
}

/// The cup lies where the man's hips are at 0.2 s, where he takes it.
TEST_F(WorldEventsFile, SaysWhyAContactEndsThatNobodyAsksAbout) {
  const std::string world =
      stage_.write(kManWalks +
                   sphereNamed("cup",
                               "position = [0.3, 0, 0]\n[[body.attach]]\ntime = 0.2\nto = "
                               "\"man\"\nlink = \"Hips\"\n") +
                   sphereNamed("ball", "position = [-0.3, 0, 0]\n"));
  const EventsFile file = follow(world);
  const json& taken = find(file.events, "leave", "man Hips, cup  ");
  EXPECT_EQ(taken["cause"], "not_asked");
  EXPECT_EQ(taken["utime"], 200000);
  EXPECT_EQ(find(file.events, "leave", "man Hips, ball  ").count("cause"), 0u);
}

/// The cup lies in the ball until the man takes it to where it is 5 m away.
TEST_F(WorldEventsFile, SaysWhereAContactEndsWithAJump) {
  const std::string world = stage_.write(
      kManWalks +
      sphereNamed("cup",
                  "position = [9, 0, 0]\n[[body.attach]]\ntime = 0.2\nto = \"man\"\nlink = "
                  "\"Hips\"\nposition = [0, 5, 0]\n") +
      sphereNamed("ball", "position = [9, 0.06, 0]\n"));
  const EventsFile file = follow(world);
  const json& moved = find(file.events, "leave", "cup , ball  ");
  EXPECT_EQ(moved["cause"], "moved");
  EXPECT_EQ(moved["utime"], 200000);
  EXPECT_NEAR(moved["penetration"].get<double>(), 0.04, 1e-9);
  EXPECT_NEAR(moved["a"]["point"][0].get<double>(), 9.0, 1e-9);
  EXPECT_NEAR(moved["a"]["point"][1].get<double>(), 0.05, 1e-9);
  EXPECT_NEAR(moved["b"]["point"][1].get<double>(), 0.01, 1e-9);
}

/// The ball is known until 0.05 s, and taken to stay; the man meets it at 0.06 s.
TEST_F(WorldEventsFile, MarksWhatRestsOnWhoHoldsStill) {
  const std::string ball =
      sphereNamed("ball", "when_silent = \"hold-still\"\n" + poseAt(0, "-0.3, 0, 0") +
                              poseAt(0.05, "-0.3, 0, 0"));
  const std::string wall = "[scene]\nfile = \"wall.obj\"\n";
  const EventsFile file = follow(stage_.write(wall + kManWalks + ball));
  EXPECT_EQ(find(file.events, "enter", "man Hips, ball  ")["assumed"], true);
  EXPECT_EQ(find(file.events, "enter", "man Hips,  wall wall").count("assumed"), 0u);
  int assumed = 0;
  for (const json& interval : file.intervals) {
    if (interval["b"].value("body", "") != "ball") continue;
    EXPECT_EQ(interval.value("assumed", false), true);
    ++assumed;
  }
  EXPECT_EQ(assumed, 1);
}

/// From within a contact on: it was there already; and it goes on at the end.
TEST_F(WorldEventsFile, SaysWhatStartsInsideAndWhatGoesOn) {
  const std::string world =
      stage_.write(kManWalks + sphereNamed("ball", "position = [-0.3, 0, 0]\n") +
                   "[[trigger]]\nname = \"zone\"\nbox = {low = [-1, -1, -1], high = [1, 1, 1]}\n"
                   "by_link = true\n");
  const EventsFile file = follow(world, {"--from", "0.08", "--until", "0.1"});
  const json& inside = find(file.events, "starts_inside", "man Hips, ball  ");
  EXPECT_EQ(inside["time"], 0.08);
  EXPECT_GT(inside["penetration"].get<double>(), 0.0);
  ASSERT_GE(file.intervals.size(), 1u);
  EXPECT_TRUE(file.intervals[0].value("starts_inside", false));
  EXPECT_TRUE(file.intervals[0].value("goes_on", false));
  EXPECT_EQ(file.intervals[0]["to"]["utime"], 100000);
  ASSERT_EQ(file.stays.size(), 3u);  // two links, and the ball
  for (const json& stay : file.stays) {
    EXPECT_TRUE(stay.value("starts_inside", false)) << stay;
    EXPECT_TRUE(stay.value("goes_on", false)) << stay;
  }
}

/// Triggers are nobody for who asks who touches whom. Their poses cut the time of who is followed,
/// so that roundings differ.
TEST_F(WorldEventsFile, TriggersChangeNoResults) {
  const std::string bodies = "[scene]\nfile = \"wall.obj\"\n" + kManWalks +
                             sphereNamed("ball", "position = [-0.3, 0, 0]\n");
  struct Results {
    std::string windows;
    std::vector<json> touches;
  };
  const auto resultsOf = [&](const std::string& text) {
    const std::string out = folder_ / "out.jsonl";
    const Ended ended = runForetouch({"world", "replay", stage_.write(text), "-o", out});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    Results results;
    std::istringstream stream(contentOf(out));
    for (std::string line; std::getline(stream, line);) {
      const json one = json::parse(line);
      if (one.count("touch") != 0) {
        results.touches.push_back(one["touch"]);
      } else {
        results.windows += withoutLatency(line) + "\n";
      }
    }
    return results;
  };
  const Results without = resultsOf(bodies);
  const Results with = resultsOf(bodies + "[[trigger]]\nname = \"zone\"\nsphere = 0.4\n" +
                                 "[[trigger.pose]]\ntime = 0.017\nposition = [-0.3, 0, 0]\n"
                                 "[[trigger.pose]]\ntime = 0.21\nposition = [-0.3, 0.1, 0]\n");
  EXPECT_EQ(without.windows, with.windows);
  ASSERT_EQ(without.touches.size(), with.touches.size());
  ASSERT_EQ(without.touches.size(), 3u);
  for (std::size_t i = 0; i < with.touches.size(); ++i) {
    EXPECT_EQ(without.touches[i]["a"], with.touches[i]["a"]);
    EXPECT_EQ(without.touches[i]["b"], with.touches[i]["b"]);
    EXPECT_EQ(without.touches[i]["contacts"], with.touches[i]["contacts"]);
    for (const char* end : {"begin", "end"}) {
      EXPECT_NEAR(without.touches[i][end].get<double>(), with.touches[i][end].get<double>(), 1e-9);
    }
  }
}

TEST_F(WorldEventsFile, SaysWhatIsWrongWithATrigger) {
  const auto refused = [&](const std::string& text, const std::string& message) {
    const Ended ended = runForetouch({"world", "check", stage_.write(kManWalks + text)});
    EXPECT_EQ(ended.exitCode, 2) << text;
    EXPECT_TRUE(holds(ended.err, message)) << ended.err;
  };
  refused("[[trigger]]\nname = \"z\"\nsphere = 0.2\nmass = 3\n",
          "world.toml:11: unknown key 'mass' in [[trigger]]");
  refused("[[trigger]]\nname = \"z\"\n",
          "[[trigger]]: expected exactly one of mesh, sphere, lss and box, found 0");
  refused("[[trigger]]\nname = \"man\"\nsphere = 0.2\n",
          "world.toml:8: [[trigger]] name: expected one that no other body has");
  refused(
      "[[trigger]]\nname = \"z\"\nsphere = 0.2\nwatches = [{body = \"mann\"}]\n",
      "[[trigger.watches]] body: expected the name of a body, found 'mann'; did you mean 'man'");
  refused("[[trigger]]\nname = \"z\"\nsphere = 0.2\nwatches = [{body = \"man\", link = \"Leg\"}]\n",
          "[[trigger.watches]] link: expected a link of 'man', found 'Leg'");
  refused("[[trigger]]\nname = \"z\"\nmesh = \"wall.obj\"\n",
          "world.toml:8: [[trigger]] 'z': expected a closed mesh");
  refused("[[trigger]]\nname = \"z\"\nsphere = 0.2\n[[trigger.attach]]\ntime = 0\nto = \"men\"\n",
          "[[trigger.attach]] to: expected the name of a body, found 'men'");
}

/// Refused by name, and nothing is written.
TEST_F(WorldEventsFile, IsRefusedWhereMeshesMayMeet) {
  const std::string world = stage_.write("ask_meshes = true\n" + kManWalks);
  const std::string events = folder_ / "none.jsonl", out = folder_ / "o.jsonl";
  const Ended ended = runForetouch({"world", "replay", world, "-o", out, "--events", events});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "world.toml: expected ask_meshes = false")) << ended.err;
  EXPECT_EQ(contentOf(events), "");
  for (const char* input : {"world.toml", "man.json", "clip.bvh"}) {
    EXPECT_EQ(runForetouch({"world", "replay", stage_.write(kManWalks), "-o", out, "--events",
                            stage_.folder / input})
                  .exitCode,
              2)
        << input;
  }
}

}  // namespace
}  // namespace foretouch::test
