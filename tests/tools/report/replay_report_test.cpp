#include "tools/report/replay_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/report/view_reading.h"
#include "tests/tools/small_inputs.h"
#include "tools/replay/replay.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;
using test::numbersOf;
using test::smallInputs;

struct Reported {
  json document;
  std::vector<json> lines;  ///< Of the results file.
  std::string text;         ///< Of the document.
};

Reported report(const ReplayInputs& inputs, const ReportOptions& options = {}) {
  Reported reported;
  ReplayReport report(inputs, options);
  ReplaySummary summary(inputs);
  ReplayTouches touches = std::move(ReplayTouches::start(inputs)).value();
  EXPECT_TRUE(replay(inputs, 1, [&](const ReplayedStep& step) {
                reported.lines.push_back(json::parse(step.line));
                summary.add(step);
                EXPECT_TRUE(touches.add(step.answer).ok());
                report.add(step);
                return true;
              }).ok());
  EXPECT_TRUE(touches.finish().ok());
  summary.add(touches);
  const auto document =
      report.document(summary, touches.listed(), [](std::int64_t, std::int64_t) { return true; });
  EXPECT_TRUE(document.ok());
  reported.text = test::textOf(document.value());
  reported.document = json::parse(reported.text);
  return reported;
}

std::vector<double> swing(int poses) {
  std::vector<double> places;
  for (int i = 0; i < poses; ++i) places.push_back(0.4 * std::sin(0.9 * i));
  return places;
}

/// The contacts of the document as a results file would list them, step by step.
std::vector<json> contactsByStep(const json& document, std::size_t steps) {
  const json& avatar = document["avatars"][0];
  std::vector<json> byStep(steps, json::array());
  for (json contact : avatar["contacts"]) {
    const auto step = contact["step"].get<std::size_t>();
    contact.erase("step");
    contact.erase("missed_by_poses");
    contact["link"] = avatar["links"][contact["link"].get<std::size_t>()]["name"];
    byStep.at(step).push_back(contact);
  }
  return byStep;
}

TEST(ReplayReport, HoldsTheContactsOfOwnLinks) {
  ReplayInputs inputs = smallInputs(swing(20));
  std::string avatar = test::kManAvatar;  // with the arm 5 cm deep in the hips
  avatar.replace(avatar.find("[0,0.3,0]"), 9, "[0,0.1,0]");
  inputs.avatar = parseAvatar(avatar, "man.json").value();
  inputs.query.self = PairRules::leavingOut(inputs.avatar, {}).value();
  const Reported reported = report(inputs);
  std::size_t own = 0;
  for (const json& contact : reported.document["avatars"][0]["contacts"]) {
    if (contact.count("other") == 0) continue;
    ++own;
    EXPECT_EQ(contact["link"], 0);
    EXPECT_EQ(contact["other"], 1);
    EXPECT_EQ(contact["object"], "Arm");
    EXPECT_EQ(contact.count("missed_by_poses"), 0u);
    EXPECT_NEAR(contact["penetration"].get<double>(), 0.05, 1e-9);
  }
  EXPECT_EQ(own, reported.lines.size());
  std::size_t rows = 0;
  for (const json& row : reported.document["summary"]) {
    if (row["name"] == "start in own contact") {
      EXPECT_EQ(row["value"], "19");
      ++rows;
    }
  }
  EXPECT_EQ(rows, 1u);
}

TEST(ReplayReport, HoldsTheContactsOfTheResults) {
  const ReplayInputs inputs = smallInputs(swing(100));
  const Reported reported = report(inputs);
  const auto contacts = contactsByStep(reported.document, reported.lines.size());
  std::size_t touching = 0;
  for (std::size_t step = 0; step < reported.lines.size(); ++step) {
    EXPECT_EQ(contacts[step], reported.lines[step]["contacts"]) << step;
    touching += contacts[step].size();
  }
  EXPECT_GT(touching, 20u);
}

/// Of a document without own links: every contact is of one touch, and of the right one.
void expectTouchesOfItsContacts(const json& document) {
  const json& contacts = document["avatars"][0]["contacts"];
  std::vector<int> taken(contacts.size());
  for (const json& touch : document["touches"]) {
    EXPECT_EQ(touch.count("avatar"), 0u);
    EXPECT_EQ(touch["rows"].size(), touch["contacts"].get<std::size_t>());
    for (const json& row : touch["rows"]) {
      const json& contact = contacts.at(row.get<std::size_t>());
      ++taken[row.get<std::size_t>()];
      EXPECT_EQ(contact["link"], touch["link"]);
      EXPECT_EQ(contact["object"], touch["object"]);
      EXPECT_GE(contact["time"], touch["begin"]);
      EXPECT_LE(contact["time"], touch["end"]);
    }
    const json& first = contacts.at(touch["rows"][0].get<std::size_t>());
    EXPECT_EQ(first["step"], touch["steps"][0]);
    EXPECT_EQ(first["time"], touch["begin"]);
  }
  EXPECT_EQ(taken, std::vector<int>(contacts.size(), 1));
}

TEST(ReplayReport, HoldsTheTouchesThatItsContactsMakeUp) {
  const Reported reported = report(smallInputs(swing(100)));
  const json& touches = reported.document["touches"];
  expectTouchesOfItsContacts(reported.document);
  EXPECT_GT(touches.size(), 20u);
  EXPECT_LT(touches.size(), reported.document["avatars"][0]["contacts"].size());
  std::map<std::string, std::string> rows;
  for (const json& row : reported.document["summary"]) rows[row["name"]] = row["value"];
  std::size_t missed = 0;
  for (const json& touch : touches) missed += touch.value("missed", false) ? 1 : 0;
  EXPECT_EQ(rows["touches"], std::to_string(touches.size()));
  EXPECT_EQ(rows["touches_missed"], std::to_string(missed));
  EXPECT_EQ(rows["touches_ground"], "0");
}

TEST(ReplayReport, SaysWhereTouchesOfTheGroundAreNotListed) {
  // The hips rest on a floor that lies 1 cm above their lowest point.
  ReplayInputs inputs = smallInputs(std::vector<double>(9, 0.0));
  const Eigen::Vector3d a(-9, -0.09, -9), b(-9, -0.09, 9), c(9, -0.09, 0);
  inputs.scene = Scene::build({{Triangle{{a, b, c}}}, {0}, {"floor"}}).value();
  EXPECT_EQ(report(inputs).document["touches"][0]["ground"], true);
  inputs.request.ground.use = GroundUse::Ignore;
  const json document = report(inputs).document;
  EXPECT_EQ(document["touches"], json::array());
  EXPECT_EQ(document["avatars"][0]["contacts"].size(), 8u);
  EXPECT_NE(document["notes"].dump().find("not listed (--ground ignore): 1."), std::string::npos)
      << document["notes"];
  inputs.request.ground.use = GroundUse::Keep;
  EXPECT_EQ(report(inputs).document["touches"][0].count("ground"), 0u);
}

TEST(ReplayReport, HoldsTheTouchesOfTheStepsThatItShows) {
  ReportOptions options;
  options.maxContacts = 41;
  const Reported reported = report(smallInputs(std::vector<double>(61, 0.02)), options);
  expectTouchesOfItsContacts(reported.document);
  ASSERT_EQ(reported.document["touches"].size(), 2u);
  EXPECT_EQ(reported.document["touches"][1]["steps"], json({0, 19}));
  EXPECT_EQ(reported.document["touches"][1]["ends"], "open");
  EXPECT_EQ(reported.document["touches"][1]["begins"], "inside");
}

TEST(ReplayReport, HoldsThePosesThatWereAsked) {
  const ReplayInputs inputs = smallInputs(swing(20), {0.25, 0.5, 0});
  const json track = report(inputs).document["avatars"][0]["track"];
  const auto times = numbersOf<double>(track["pose_times"], "f64");
  const auto rotations = numbersOf<double>(track["rotations"], "f64");
  const auto offsets = numbersOf<double>(track["translations"]["offsets"], "f64");
  const auto values = numbersOf<double>(track["translations"]["values"], "f64");
  ASSERT_EQ(times.size(), 20u);
  ASSERT_EQ(rotations.size(), 20u * 2 * 4);
  ASSERT_EQ(offsets.size(), 6u);
  EXPECT_EQ(track["translations"]["moving"], json({0}));
  ASSERT_EQ(values.size(), 20u * 3);
  for (std::size_t i = 0; i < 20; ++i) {
    const Pose pose = poseAtFrame(inputs, static_cast<std::int64_t>(i)).value();
    EXPECT_EQ(times[i], inputs.timeOfStep(static_cast<std::int64_t>(i)));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(values[3 * i + axis], pose.translations[0][static_cast<Eigen::Index>(axis)]);
    }
    EXPECT_EQ(rotations[8 * i], pose.rotations[0].w());
  }
  EXPECT_EQ(offsets[4], 0.3);
  EXPECT_EQ(numbersOf<std::uint32_t>(track["steps"]["from"], "u32").size(), 19u);
  EXPECT_EQ(numbersOf<std::uint32_t>(track["steps"]["to"], "u32").back(), 19u);
  EXPECT_EQ(numbersOf<double>(track["latency_us"], "f64").size(), 19u);
}

TEST(ReplayReport, SaysWhichContactsThePosesShow) {
  const Reported reported = report(smallInputs({-0.75, -0.25, 0.25, 0.75, 0.02}));
  const json& avatar = reported.document["avatars"][0];
  int missed = 0, seen = 0;
  for (const json& contact : avatar["contacts"]) {
    if (contact["verdict"] != "contact") continue;
    const bool isMissed = contact["missed_by_poses"].get<bool>();
    EXPECT_EQ(isMissed, contact["step"] == 1) << contact;
    ++(isMissed ? missed : seen);
  }
  EXPECT_EQ(missed, 2);
  EXPECT_EQ(seen, 2);
  const auto first = numbersOf<std::uint32_t>(avatar["track"]["touching_at_poses"]["first"], "u32");
  EXPECT_EQ(first, (std::vector<std::uint32_t>{0, 0, 0, 0, 0, 2}));
}

TEST(ReplayReport, SurvivesHostileNames) {
  const std::string name = "</script><script>alert(1)\xff";
  const Reported reported = report(smallInputs({-0.5, 0.5}, Eigen::Vector3d::Zero(), name));
  EXPECT_EQ(reported.text.find('<'), std::string::npos);
  const std::string shown = reported.document["scene"]["objects"][0]["name"];
  EXPECT_EQ(shown, "</script><script>alert(1)\xef\xbf\xbd");
  EXPECT_EQ(reported.document["avatars"][0]["contacts"][0]["object"], shown);
}

TEST(ReplayReport, IsFineWithoutContacts) {
  const Reported reported = report(smallInputs({5, 6}));
  EXPECT_EQ(reported.document["avatars"][0]["contacts"], json::array());
  EXPECT_EQ(reported.document["avatars"][0]["swept"], json::array());
  EXPECT_EQ(reported.document["kind"], "replay");
  EXPECT_EQ(reported.document["title"], "clip.bvh in wall.obj");
}

TEST(ReplayReport, IsTheSameEveryTimeButForLatencies) {
  const ReplayInputs inputs = smallInputs(swing(60));
  const auto withoutLatency = [](json document) {
    document["avatars"][0]["track"].erase("latency_us");
    for (json& row : document["summary"]) {
      if (row["name"] == "latency of a step") row["value"] = "";
    }
    return document.dump();
  };
  const std::string first = withoutLatency(report(inputs).document);
  EXPECT_EQ(withoutLatency(report(inputs).document), first);
}

TEST(ReplayReport, CountsAsTheSummaryDoes) {
  const Reported reported = report(smallInputs(swing(40)));
  std::size_t contacts = 0, missed = 0;
  for (const json& contact : reported.document["avatars"][0]["contacts"]) {
    contacts += contact["verdict"] == "contact" ? 1 : 0;
    missed += contact.value("missed_by_poses", false) ? 1 : 0;
  }
  std::map<std::string, std::string> rows;
  for (const json& row : reported.document["summary"]) rows[row["name"]] = row["value"];
  EXPECT_EQ(rows["contacts"], std::to_string(contacts));
  EXPECT_EQ(rows["missed by poses"], std::to_string(missed));
  EXPECT_EQ(rows["steps"], "39");
}

TEST(ReplayReport, StopsWhereThereIsNoRoomAndSaysSo) {
  // Both links touch in every step.
  std::vector<double> places;
  for (int i = 0; i < 61; ++i) places.push_back(i % 2 == 0 ? -0.5 : 0.5);
  ReportOptions contacts, poses;
  contacts.maxContacts = 41;
  poses.maxRotations = 31 * 2 * 4 + 7;
  for (const auto& [options, steps] : {std::pair(contacts, 20u), std::pair(poses, 30u)}) {
    const json document = report(smallInputs(places), options).document;
    const json& avatar = document["avatars"][0];
    EXPECT_EQ(avatar["contacts"].size(), 2u * steps);
    EXPECT_EQ(numbersOf<std::uint32_t>(avatar["track"]["steps"]["to"], "u32").back(), steps);
    EXPECT_EQ(numbersOf<double>(avatar["track"]["pose_times"], "f64").size(), steps + 1);
    EXPECT_NE(document["notes"].dump().find("first " + std::to_string(steps) + " of 60 steps"),
              std::string::npos)
        << document["notes"];
  }
}

}  // namespace
}  // namespace foretouch::tools
