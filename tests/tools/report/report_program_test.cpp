// tests/tools/report/report_program_test.cpp: `replay --report`, `demo --report` and `view`, from
// files to pages.
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "network/log/event_log.h"
#include "network/wire/codec.h"
#include "tests/tools/program_run.h"
#include "tests/tools/report/view_reading.h"
#include "tests/tools/small_world.h"
#include "tests/tools/stream/stream_lines.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

json documentOf(const std::string& page) {
  return json::parse(documentIn(contentOf(page)));
}

bool notes(const json& document, const std::string& part) {
  for (const std::string note : document["notes"]) {
    if (note.find(part) != std::string::npos) return true;
  }
  return false;
}

TEST(ReportProgram, WritesAPageThatHoldsTheResults) {
  const SmallWorld world;
  const std::string out = world.folder / "out.jsonl", page = world.folder / "out.html";
  const Ended ended = runForetouch(world.replay({"--output", out, "--report", page}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("report:  " + page), std::string::npos) << ended.out;
  const std::string html = contentOf(page);
  EXPECT_EQ(html.substr(0, 9), "<!doctype");
  const json document = documentOf(page);
  EXPECT_EQ(document["kind"], "replay");
  EXPECT_EQ(document["scene"]["reduction"], "none");
  EXPECT_EQ(document["scene"]["objects"].size(), 2u);
  const json& avatar = document["avatars"][0];
  ASSERT_EQ(avatar["contacts"].size(), 2u);
  const json result = json::parse(linesOf(contentOf(out))[2])["contacts"][0];
  EXPECT_EQ(avatar["contacts"][0]["toi"], result["toi"]);
  EXPECT_EQ(avatar["contacts"][0]["point"], result["point"]);
  EXPECT_EQ(avatar["contacts"][0]["missed_by_poses"], true);
  EXPECT_EQ(avatar["swept"].size(), 2u);
}

TEST(ReportProgram, RefusesAReportThatWouldOverwriteSomethingElse) {
  const SmallWorld world;
  const std::string out = world.folder / "out.jsonl";
  for (const std::string& report : {out, world.folder / "./out.jsonl", world.folder / "wall.obj",
                                    world.folder / "clip.bvh", world.folder / "absent/out.html"}) {
    const Ended ended = runForetouch(world.replay({"--output", out, "--report", report}));
    EXPECT_EQ(ended.exitCode, 2) << report;
    EXPECT_NE(ended.err.find(report), std::string::npos) << ended.err;
  }
  EXPECT_EQ(contentOf(world.folder / "wall.obj"), kWallObj);
  EXPECT_EQ(world.folder.names().count("out.jsonl"), 0u);
  EXPECT_EQ(runForetouch(world.replay({"--output", out, "--report-triangles", "0"})).exitCode, 2);
}

TEST(ReportProgram, GivesStandardOutputToTheReportWhereAsked) {
  const SmallWorld world;
  const Ended ended =
      runForetouch(world.replay({"--output", world.folder / "out", "--report", "/dev/stdout"}));
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.err.find("link-steps"), std::string::npos) << ended.err;
}

TEST(ReportProgram, SaysWhatItShowsOfAHeavyScene) {
  const SmallWorld world;
  const std::string page = world.folder / "out.html";
  const Ended ended =
      runForetouch(world.replay({"--output", world.folder / "out", "--report", page,
                                 "--report-triangles", "3", "--ignore", "*:floor"}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const json document = documentOf(page);
  EXPECT_EQ(document["scene"]["reduction"], "clipped");  // the floor is more than two metres below
  EXPECT_EQ(document["scene"]["objects"].size(), 1u);
  EXPECT_TRUE(notes(document, "has 4 triangles: only the 2 within"));
}

TEST(DemoReport, IsBesideTheResults) {
  const SmallWorld world;
  world.folder.write("room.obj", kWallObj);
  world.folder.write("dancer.avatar.json", kManAvatar);
  world.folder.write("dancer.bvh", clipThroughWall());
  const std::vector<std::string> examples{"FORETOUCH_EXAMPLES=" + (world.folder / ".")};
  const std::string out = world.folder / "demo.jsonl", other = world.folder / "other.html";
  const Ended ended = runForetouch({"demo", "--output", out}, examples);
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find(world.folder / "demo.html"), std::string::npos) << ended.out;
  EXPECT_EQ(documentOf(world.folder / "demo.html")["avatars"][0]["contacts"].size(), 2u);
  ASSERT_EQ(runForetouch({"demo", "--output", out, "--report", other}, examples).exitCode, 0);
  EXPECT_EQ(documentOf(other)["title"], "dancer.bvh in room.obj");
}

/// Two avatars in one log: 1 and 2 swing through the wall, 2 half a swing behind. `lose` says which
/// poses, by avatar and number, are not in it.
template <typename Lose>
std::string logOfTwo(const SmallWorld& world, Lose lose) {
  std::vector<double> places, others;
  for (int i = 0; i < 30; ++i) {
    places.push_back(0.4 * std::sin(0.9 * i));
    others.push_back(0.4 * std::sin(0.9 * i + 1.5));
  }
  world.folder.write("one.bvh", clipAlongX(places));
  world.folder.write("two.bvh", clipAlongX(others));
  auto writer = EventLogWriter::create(world.folder / "both.lcmlog").value();
  std::map<std::int32_t, int> poses;
  for (const std::string name : {"one", "two"}) {
    const std::string log = world.folder / (name + ".lcmlog");
    EXPECT_EQ(runForetouch({"publish", world.folder / (name + ".bvh"), "--avatar",
                            world.folder / "man.json", "--id", name == "one" ? "1" : "2", "--start",
                            "1000000", "--output", log})
                  .exitCode,
              0);
    auto reader = EventLogReader::open(log).value();
    LogEvent event;
    while (reader.next(event).value()) {
      PoseMessage pose;
      const bool isPose =
          event.channel == kPoseChannel && decode(event.payload, pose) == Reject::None;
      if (isPose && lose(pose.avatar, poses[pose.avatar]++)) continue;
      EXPECT_TRUE(writer.write(event.utimeUs, event.channel, event.payload).ok());
    }
  }
  EXPECT_TRUE(writer.close().ok());
  return world.folder / "both.lcmlog";
}

json reportOfLog(const SmallWorld& world, const std::string& log) {
  const std::string page = world.folder / "log.html";
  const Ended ended = runForetouch({"replay", "--scene", world.folder / "wall.obj", "--avatar",
                                    "1=" + (world.folder / "man.json"), "--avatar",
                                    "2=" + (world.folder / "man.json"), "--motion", log, "--output",
                                    world.folder / "log.jsonl", "--report", page});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  return documentOf(page);
}

/// Every contact of every avatar is of one touch, which is of that avatar.
void expectTouches(const json& document) {
  std::vector<std::size_t> rows(document["avatars"].size());
  double before = 0.0;
  for (const json& touch : document["touches"]) {
    const auto index = touch.value("avatar", std::size_t{0});
    const json& contacts = document["avatars"].at(index)["contacts"];
    for (const json& row : touch["rows"]) {
      const json& contact = contacts.at(row.get<std::size_t>());
      EXPECT_EQ(contact["link"], touch["link"]);
      EXPECT_GE(contact["step"], touch["steps"][0]);
      EXPECT_LE(contact["step"], touch["steps"][1]);
      ++rows[index];
    }
    EXPECT_GE(touch["begin"].get<double>(), before);
    before = touch["begin"];
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i], document["avatars"][i]["contacts"].size());
    EXPECT_GT(rows[i], 0u);
  }
}

TEST(LogReport, ShowsEachAvatarWithItsContacts) {
  const SmallWorld world;
  const json document = reportOfLog(world, logOfTwo(world, [](int, int) { return false; }));
  EXPECT_EQ(document["kind"], "log");
  ASSERT_EQ(document["avatars"].size(), 2u);
  std::map<std::int32_t, std::vector<json>> results;  // contacts, step by step
  for (const std::string& line : linesOf(contentOf(world.folder / "log.jsonl"))) {
    const json answer = json::parse(line);
    if (answer.count("format") > 0 || answer["kind"] == "first") continue;
    results[answer["avatar"]].push_back(answer["contacts"]);
  }
  for (const json& avatar : document["avatars"]) {
    const json& track = avatar["track"];
    EXPECT_EQ(numbersOf<double>(track["pose_times"], "f64").size(), 30u);
    EXPECT_EQ(numbersOf<double>(track["pose_times"], "f64").front(), 0.0);
    EXPECT_EQ(numbersOf<std::uint32_t>(track["steps"]["from"], "u32").size(), 29u);
    const std::vector<json>& expected = results[avatar["id"]];
    ASSERT_EQ(expected.size(), 29u);
    std::size_t at = 0;
    for (std::size_t step = 0; step < expected.size(); ++step) {
      for (const json& contact : expected[step]) {
        ASSERT_LT(at, avatar["contacts"].size());
        const json& shown = avatar["contacts"][at++];
        EXPECT_EQ(shown["step"], step);
        EXPECT_EQ(avatar["links"][shown["link"].get<std::size_t>()]["name"], contact["link"]);
        for (const char* key : {"verdict", "toi", "point", "normal", "triangle", "separation"}) {
          EXPECT_EQ(shown[key], contact[key]) << key;
        }
      }
    }
    EXPECT_EQ(at, avatar["contacts"].size());
    EXPECT_GT(at, 10u);
  }
  expectTouches(document);
}

TEST(LogReport, DrawsNoMotionAcrossGaps) {
  const SmallWorld world;
  const auto lose = [](int avatar, int pose) { return avatar == 1 && pose >= 10 && pose < 15; };
  const json document = reportOfLog(world, logOfTwo(world, lose));
  const json& track = document["avatars"][0]["track"];
  EXPECT_EQ(numbersOf<double>(track["pose_times"], "f64").size(), 25u);
  const auto from = numbersOf<std::uint32_t>(track["steps"]["from"], "u32");
  const auto to = numbersOf<std::uint32_t>(track["steps"]["to"], "u32");
  ASSERT_EQ(from.size(), 23u);
  for (std::size_t i = 0; i < from.size(); ++i) {
    EXPECT_EQ(to[i], from[i] + 1);
    EXPECT_NE(from[i], 9u);
  }
  EXPECT_NEAR(numbersOf<double>(track["pose_times"], "f64")[10], 1.5, 1e-9);
  EXPECT_EQ(numbersOf<double>(document["avatars"][1]["track"]["pose_times"], "f64").size(), 30u);
}

TEST(LogReport, MovesATimelineThatGoesBackInTime) {
  const SmallWorld world;
  const std::string once = logOfTwo(world, [](int, int) { return false; });
  // The same again, as a later session of avatar 1.
  auto writer = EventLogWriter::create(world.folder / "twice.lcmlog").value();
  for (const std::int64_t session : {0, 1}) {
    auto reader = EventLogReader::open(once).value();
    LogEvent event;
    while (reader.next(event).value()) {
      PoseMessage pose;
      SkeletonMessage skeleton;
      if (event.channel == kPoseChannel && decode(event.payload, pose) == Reject::None) {
        pose.session += session;
        encode(pose, event.payload);
      } else if (decode(event.payload, skeleton) == Reject::None) {
        skeleton.session += session;
        encode(skeleton, event.payload);
      }
      EXPECT_TRUE(writer.write(event.utimeUs, event.channel, event.payload).ok());
    }
  }
  EXPECT_TRUE(writer.close().ok());
  const json document = reportOfLog(world, world.folder / "twice.lcmlog");
  EXPECT_TRUE(notes(document, "begin before the one before has ended")) << document["notes"];
  const auto times = numbersOf<double>(document["avatars"][0]["track"]["pose_times"], "f64");
  ASSERT_EQ(times.size(), 60u);
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
  EXPECT_EQ(numbersOf<std::uint32_t>(document["avatars"][0]["track"]["steps"]["to"], "u32").size(),
            58u);
}

TEST(View, ShowsAnyOfSceneAvatarAndClip) {
  const SmallWorld world;
  const std::string page = world.folder / "view.html";
  const std::string scene = world.folder / "wall.obj", avatar = world.folder / "man.json",
                    clip = world.folder / "clip.bvh";
  for (int chosen = 1; chosen < 8; ++chosen) {
    std::vector<std::string> arguments{"view", "--output", page};
    if ((chosen & 1) != 0) arguments.push_back(scene);
    if ((chosen & 2) != 0) arguments.push_back(avatar);
    if ((chosen & 4) != 0) arguments.push_back(clip);
    const Ended ended = runForetouch(arguments);
    // The body hangs five metres over the floor: a check says so, and the page is there.
    ASSERT_EQ(ended.exitCode, (chosen & 1) != 0 && (chosen & 6) != 0 ? 1 : 0) << chosen << ended.err;
    const json document = documentOf(page);
    EXPECT_EQ(document["kind"], "inspection");
    EXPECT_EQ(document.count("scene"), (chosen & 1) != 0 ? 1u : 0u);
    ASSERT_EQ(document["avatars"].size(), (chosen & 6) != 0 ? 1u : 0u);
    if ((chosen & 6) == 0) continue;
    const json& track = document["avatars"][0]["track"];
    EXPECT_EQ(numbersOf<double>(track["pose_times"], "f64").size(), (chosen & 4) != 0 ? 4u : 1u);
    EXPECT_EQ(numbersOf<std::uint32_t>(track["steps"]["to"], "u32").size(),
              (chosen & 4) != 0 ? 3u : 0u);
    EXPECT_EQ(track.count("latency_us"), 0u);
    EXPECT_FALSE(document["avatars"][0]["lss"].empty());
  }
}

TEST(View, SaysWhatLooksWrong) {
  const SmallWorld world;
  const std::string page = world.folder / "view.html";
  const Ended ended = runForetouch({"view", world.folder / "wall.obj", world.folder / "man.json",
                                    world.folder / "clip.bvh", "--scale", "0.01", "--place",
                                    "200,0,0", "--output", page});
  ASSERT_EQ(ended.exitCode, 1) << ended.err;
  const json document = documentOf(page);
  EXPECT_TRUE(notes(document, "is --clip-scale right?")) << document["notes"];
  const std::string checks = document["checks"].dump();
  EXPECT_NE(checks.find("outside the scene"), std::string::npos) << checks;
  EXPECT_NE(ended.out.find("outside the scene"), std::string::npos) << ended.out;
}

TEST(View, RefusesWhatItCannotTell) {
  const SmallWorld world;
  const std::string glb = world.folder.write("thing.glb", "x");
  const std::string odd = world.folder.write("thing.odd", "x");
  const auto errorOf = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "view");
    arguments.insert(arguments.end(), {"--output", world.folder / "view.html"});
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2);
    return ended.err;
  };
  EXPECT_NE(errorOf({}).find("expected a scene, an avatar or a motion"), std::string::npos);
  EXPECT_NE(errorOf({glb}).find("thing.glb"), std::string::npos);
  EXPECT_NE(errorOf({odd}).find("does not say what it is"), std::string::npos);
  const std::string wall = world.folder / "wall.obj";
  EXPECT_NE(errorOf({wall, "--scene", wall}).find("a second one of its kind"), std::string::npos);
  EXPECT_NE(errorOf({world.folder / "absent.obj"}).find("absent.obj"), std::string::npos);
  EXPECT_EQ(runForetouch({"view", wall, "--output", wall}).exitCode, 2);
  EXPECT_EQ(contentOf(wall), kWallObj);
  EXPECT_EQ(world.folder.names().count("view.html"), 0u);
}

}  // namespace
}  // namespace foretouch::test
