// tests/tools/world/world_touches_test.cpp: the touches of a followed world, in results, report and
// GLB, against its file of events: each is one interval, with its exact ends.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/glb/glb_reader.h"
#include "tests/tools/world/followed_stage.h"

namespace foretouch::test {
namespace {

/// Sheets at x = -0.4, 0 and 0.4 m, one object: the man's hips go through all in 0.3 s.
constexpr char kSheetsObj[] =
    "o sheets\n"
    "v -0.4 -2 -2\nv -0.4 2 -2\nv -0.4 0 2\nv 0 -2 -2\nv 0 2 -2\nv 0 0 2\n"
    "v 0.4 -2 -2\nv 0.4 2 -2\nv 0.4 0 2\nf 1 2 3\nf 4 5 6\nf 7 8 9\n";

class WorldTouchesFiles : public FollowedStage {
 protected:
  /// Everything that a replay writes of the same world.
  struct Written {
    EventsFile events;
    std::vector<json> touches;
    json document, summary;
    std::string glb;
  };
  [[nodiscard]] Written replay(const std::string& world,
                               const std::vector<std::string>& more = {}) const {
    const std::string page = folder_ / "page.html", glb = folder_ / "world.glb";
    std::vector<std::string> arguments{"--report", page, "--glb", glb};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Written written;
    written.events = follow(world, arguments);
    std::istringstream lines(contentOf(folder_ / "out.jsonl"));
    for (std::string line; std::getline(lines, line);) {
      const json one = json::parse(line);
      if (one.count("touch") != 0) written.touches.push_back(one["touch"]);
      if (one.count("summary") != 0) written.summary = one["summary"];
    }
    const std::string text = contentOf(page), mark = "id=\"foretouch-view\">";
    const std::size_t begin = text.find(mark) + mark.size();
    written.document = json::parse(text.substr(begin, text.find("</script>", begin) - begin));
    written.glb = contentOf(glb);
    return written;
  }
};

using Ends = std::multiset<std::pair<double, double>>;

Ends endsOf(const std::vector<json>& touches) {
  Ends ends;
  for (const json& touch : touches) ends.emplace(touch["begin"], touch["end"]);
  return ends;
}

Ends endsOfContacts(const EventsFile& file) {
  Ends ends;
  for (const json& interval : file.intervals) {
    if (interval["kind"] != "contact") continue;
    ends.emplace(interval["from"]["time"], interval["to"]["time"]);
  }
  return ends;
}

TEST_F(WorldTouchesFiles, AreIntervalsAlsoOfOnePairSeveralTimesInOneWindow) {
  stage_.folder.write("sheets.obj", kSheetsObj);
  const std::string world = stage_.write("[scene]\nfile = \"sheets.obj\"\n" + kManWalks);
  // One window for all: its first contact alone would be one touch per link.
  const Written written = replay(world, {"--rate", "1"});
  std::map<std::string, int> of;
  for (const json& touch : written.touches) {
    ++of[touch["a"]["link"].get<std::string>()];
    EXPECT_EQ(touch["begins"], "contact");
    EXPECT_EQ(touch["ends"], "left");
    EXPECT_NEAR(touch["approach"]["speed"].get<double>(), 5.0, 1e-9);
    EXPECT_TRUE(touch["effective_mass"].is_null());
    EXPECT_EQ(touch.count("impulse"), 0u);
    EXPECT_EQ(touch["missed"], true);  // nobody who looks at 0 and 0.3 s alone sees any
  }
  EXPECT_EQ(of, (std::map<std::string, int>{{"Hips", 3}, {"Arm", 3}}));
  EXPECT_EQ(endsOf(written.touches), endsOfContacts(written.events));
  EXPECT_EQ(written.summary["touches_scene"], 6);
  EXPECT_EQ(written.summary["touches_missed"], 6);
  // Hips of 0.1 m at x = -0.75 + 5 t leave the sheet at -0.4 when they are at -0.3: 0.09 s.
  double left = 0.0;
  for (const json& touch : written.touches) {
    if (touch["a"]["link"] == "Hips" && left == 0.0) left = touch["end"];
  }
  EXPECT_GE(left, 0.09);
  EXPECT_LE(left, 0.09 + 2e-3 / 5.0 + 1e-9);
  // The page has them as well, each with the contact that begins it.
  const json& shown = written.document["touches"];
  EXPECT_EQ(endsOf(shown), endsOfContacts(written.events));
  for (const json& touch : shown) {
    ASSERT_FALSE(touch["rows"].empty());
    const json& row = written.document["avatars"][0]["contacts"][touch["rows"][0].get<int>()];
    EXPECT_EQ(row["time"], touch["begin"]);
    EXPECT_EQ(row["verdict"], "contact");
  }
}

TEST_F(WorldTouchesFiles, HaveImpulsesWhereSomebodyHasAMass) {
  const Written written = replay(
      stage_.write(kManWalks + sphereNamed("ball", "mass = 0.4\nposition = [-0.3, 0, 0]\n")));
  ASSERT_EQ(written.touches.size(), 1u);
  const json& touch = written.touches[0];
  EXPECT_NEAR(touch["effective_mass"].get<double>(), 0.4, 1e-9);
  EXPECT_NEAR(touch["impulse"].get<double>(), 0.4 * 5.0, 1e-6);
  EXPECT_EQ(written.document["touches"][0]["impulse"], touch["impulse"]);
  const GlbReader glb(written.glb);
  int markers = 0;
  for (const json& node : glb.root()["nodes"]) {
    if (node.count("extras") == 0 || node["extras"].count("touch") == 0) continue;
    ++markers;
    EXPECT_EQ(node["extras"]["touch"]["impulse"], touch["impulse"]);
  }
  EXPECT_EQ(markers, 1);
}

TEST_F(WorldTouchesFiles, TriggersAreOutlinesAndWhoIsInThemIsTold) {
  const Written written = replay(
      stage_.write(kManWalks + sphereNamed("ball", "position = [-0.3, 0, 0]\n") +
                   "[[trigger]]\nname = \"zone\"\nbox = {low = [-0.5, -1, -1], high = [0, 1, 1]}\n"
                   "[[trigger]]\nname = \"near\"\nsphere = 0.2\n[[trigger.attach]]\ntime = 0\n"
                   "to = \"man\"\nlink = \"Hips\"\nposition = [0, 0, 0]\n"));
  const json& avatars = written.document["avatars"];
  ASSERT_EQ(avatars.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(avatars[i].count("outline"), i < 2 ? 0u : 1u);
    if (i < 2) continue;
    EXPECT_TRUE(avatars[i]["lss"].empty());
    EXPECT_EQ(avatars[i].count("meshes"), 0u);
  }
  EXPECT_EQ(avatars[3]["carried"].size(), 1u);
  std::multiset<std::pair<double, double>> told, stays;
  for (const json& stay : written.document["stays"]) {
    told.emplace(stay["begin"], stay["end"]);
    EXPECT_GE(stay["trigger"].get<int>(), 2);
    EXPECT_LT(stay["avatar"].get<int>(), 2);
  }
  for (const json& stay : written.events.stays) {
    stays.emplace(stay["from"]["time"], stay["to"]["time"]);
  }
  EXPECT_GE(stays.size(), 3u);
  EXPECT_EQ(told, stays);
  // A box has twelve edges, at its corners; nobody touches a trigger.
  const GlbReader glb(written.glb);
  glb.check();
  int lines = 0;
  for (const json& mesh : glb.root()["meshes"]) {
    const json& part = mesh["primitives"][0];
    if (part.value("mode", 4) != 1) continue;
    ++lines;
    if (mesh["name"] != "zone") continue;
    const std::vector<float> points = glb.floats(part["attributes"]["POSITION"]);
    ASSERT_EQ(points.size(), 12u * 2 * 3);
    for (std::size_t i = 0; i < points.size(); i += 3) {
      EXPECT_TRUE(points[i] == -0.5f || points[i] == 0.0f);
      EXPECT_EQ(std::abs(points[i + 1]), 1.0f);
    }
  }
  EXPECT_EQ(lines, 2);
  for (const json& touch : written.document["touches"]) {
    EXPECT_LT(touch.value("other_avatar", 0), 2);
  }
}

TEST_F(WorldTouchesFiles, WhatIsUnresolvedIsNoTouch) {
  const Written written = replay(stage_.write(
      kManWalks + sphereNamed("ball", "when_silent = \"undecided\"\n" + poseAt(0, "-0.3, 0, 0") +
                                          poseAt(0.08, "-0.3, 0, 0"))));
  ASSERT_EQ(written.touches.size(), 1u);
  EXPECT_EQ(written.touches[0]["ends"], "open");
  EXPECT_EQ(written.touches[0]["end"], 0.08);
  int unresolved = 0;
  for (const json& touch : written.document["touches"]) {
    if (touch.count("unresolved") == 0) continue;
    ++unresolved;
    EXPECT_EQ(touch["unresolved"], "gap");
    EXPECT_TRUE(touch["rows"].empty());
    EXPECT_EQ(touch["begin"], 0.08);
  }
  EXPECT_GE(unresolved, 1);
}

/// Of those that touch by their triangles nobody is followed: window by window, as ever.
TEST_F(WorldTouchesFiles, OfAWorldThatIsNotFollowedAreThoseOfItsWindows) {
  const std::string out = folder_ / "out.jsonl";
  const std::string world = stage_.write("ask_meshes = true\n" + kManWalks +
                                         sphereNamed("ball", "position = [-0.3, 0, 0]\n"));
  ASSERT_EQ(
      runForetouch({"world", "replay", world, "-o", out, "--glb", folder_ / "w.glb"}).exitCode, 0);
  std::istringstream lines(contentOf(out));
  int touches = 0;
  for (std::string line; std::getline(lines, line);) {
    const json one = json::parse(line);
    if (one.count("touch") == 0) continue;
    ++touches;
    EXPECT_EQ(one["touch"].count("approach"), 0u);
  }
  EXPECT_EQ(touches, 1);
}

}  // namespace
}  // namespace foretouch::test
