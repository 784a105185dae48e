#include "tools/replay/results_writer.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/random_geometry.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;
using test::smallInputs;

LinkContact contactOf(LinkId link, Verdict verdict, double time) {
  LinkContact contact;
  contact.link = link;
  contact.verdict = verdict;
  contact.toi = contact.freeUntil = time;
  contact.triangle = 1;
  return contact;
}

TEST(StepFormat, WritesEveryFieldOfEveryVerdict) {
  const ReplayInputs inputs = smallInputs({0, 1});
  StepAnswer answer;
  answer.step = 3;
  answer.t0S = 0.3;
  answer.t1S = 0.4;
  answer.latencyUs = 3.14;
  LinkContact starts = contactOf(1, Verdict::StartsInContact, 0.0);
  starts.penetration = 0.01;
  LinkContact contact = contactOf(0, Verdict::Contact, 0.5);
  contact.separation = 0.00031;
  contact.p_WScene = {0, 1.5, -2};
  contact.p_WLink = {0.00031, 1.5, -2};
  contact.nhat_SL_W = {1, 0, 0};
  LinkContact undecided = contactOf(1, Verdict::Undecided, 0.75);
  undecided.reason = UndecidedReason::WorkBudget;
  answer.contacts = {starts, contact, undecided};
  EXPECT_EQ(StepFormat(inputs.avatar, inputs.scene).line(answer),
            R"({"step":3,"t0":0.3,"t1":0.4,"contacts":[)"
            R"({"link":"Arm","verdict":"starts_in_contact","toi":0,"time":0.3,"separation":0,)"
            R"("penetration":0.01,"point":[0,0,0],"on_link":[0,0,0],"normal":[0,0,0],"triangle":1,)"
            R"("object":"wall"},)"
            R"({"link":"Hips","verdict":"contact","toi":0.5,"time":0.35,"separation":0.00031,)"
            R"("point":[0,1.5,-2],"on_link":[0.00031,1.5,-2],"normal":[1,0,0],"triangle":1,)"
            R"("object":"wall"},)"
            R"({"link":"Arm","verdict":"undecided","free_until":0.75,"reason":"work-budget"})"
            R"(],"latency_us":3.1})"
            "\n");
}

TEST(StepFormat, TellsOfOwnLinksOnlyWhereTheyAreAsked) {
  const ReplayInputs inputs = smallInputs({0, 1});
  StepAnswer answer;
  answer.t1S = 0.1;
  PairContact pair;
  static_cast<LinkContact&>(pair) = contactOf(0, Verdict::Contact, 0.5);
  pair.other = 1;
  pair.triangle = -1;
  PairContact undecided = pair;
  undecided.verdict = Verdict::Undecided;
  undecided.reason = UndecidedReason::WorkBudget;
  PairContact exact = pair;
  exact.triangle = 7;
  exact.linkTriangle = 3;
  answer.pairs = {pair, undecided, exact};
  EXPECT_EQ(StepFormat(inputs.avatar, inputs.scene).line(answer),
            "{\"step\":0,\"t0\":0,\"t1\":0.1,\"contacts\":[],\"latency_us\":0.0}\n");
  EXPECT_EQ(StepFormat(inputs.avatar, inputs.scene, AskedLists{false, true}).line(answer),
            R"({"step":0,"t0":0,"t1":0.1,"contacts":[],"pairs":[)"
            R"({"link":"Hips","other":"Arm","verdict":"contact","toi":0.5,"time":0.05,)"
            R"("separation":0,"point":[0,0,0],"on_link":[0,0,0],"normal":[0,0,0]},)"
            R"({"link":"Hips","other":"Arm","verdict":"undecided","free_until":0.5,)"
            R"("reason":"work-budget"},)"
            R"({"link":"Hips","other":"Arm","verdict":"contact","toi":0.5,"time":0.05,)"
            R"("separation":0,"point":[0,0,0],"on_link":[0,0,0],"normal":[0,0,0],"triangle":7,)"
            R"("link_triangle":3,"link_feature":"face","scene_feature":"face"}],"latency_us":0.0})"
            "\n");
}

TEST(StepFormat, ListsContactsByObjectOnlyWhereTheyAreAsked) {
  const ReplayInputs inputs = smallInputs({0, 1});
  StepAnswer answer;
  answer.t1S = 0.1;
  LinkContact undecided = contactOf(1, Verdict::Undecided, 0.75);
  undecided.reason = UndecidedReason::Resolution;
  undecided.triangle = -1;
  answer.objects = {contactOf(0, Verdict::Contact, 0.5), undecided};
  EXPECT_EQ(StepFormat(inputs.avatar, inputs.scene).line(answer),
            "{\"step\":0,\"t0\":0,\"t1\":0.1,\"contacts\":[],\"latency_us\":0.0}\n");
  EXPECT_EQ(StepFormat(inputs.avatar, inputs.scene, AskedLists{true, false}).line(answer),
            R"({"step":0,"t0":0,"t1":0.1,"contacts":[],"objects":[)"
            R"({"link":"Hips","verdict":"contact","toi":0.5,"time":0.05,"separation":0,)"
            R"("point":[0,0,0],"on_link":[0,0,0],"normal":[0,0,0],"triangle":1,"object":"wall"},)"
            R"({"link":"Arm","verdict":"undecided","free_until":0.75,"reason":"resolution"})"
            R"(],"latency_us":0.0})"
            "\n");
}

TEST(StepFormat, WritesNumbersThatReadBackAsTheSameDoubles) {
  const ReplayInputs inputs = smallInputs({0, 1});
  const StepFormat format(inputs.avatar, inputs.scene);
  for (int i = 0; i < 500; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    StepAnswer answer;
    LinkContact contact = contactOf(0, Verdict::Contact, random.uniform(0, 1));
    contact.separation = random.magnitude(1e-300, 1e-3);
    contact.p_WScene = random.magnitude(1e-9, 1e7) * random.direction();
    answer.contacts = {contact};
    const json read = json::parse(format.line(answer))["contacts"][0];
    EXPECT_EQ(read["toi"].get<double>(), contact.toi);
    EXPECT_EQ(read["separation"].get<double>(), contact.separation);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(read["point"][static_cast<std::size_t>(axis)].get<double>(),
                contact.p_WScene[axis]);
    }
  }
}

TEST(StepFormat, EscapesNamesAndReplacesWhatIsNotUtf8) {
  const ReplayInputs inputs = smallInputs({0, 1}, Eigen::Vector3d::Zero(), "w\"a\\l\nl\xff\x01");
  StepAnswer answer;
  answer.contacts = {contactOf(0, Verdict::Contact, 0.5)};
  const std::string line = StepFormat(inputs.avatar, inputs.scene).line(answer);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  EXPECT_EQ(json::parse(line)["contacts"][0]["object"], "w\"a\\l\nl\xef\xbf\xbd\x01");
}

TEST(HeaderLine, SaysWhatTheResultsDependOn) {
  ReplayInputs inputs = smallInputs({0, 1, 2}, {1, 2, 3});
  inputs.request.rateHz = 10.0;
  inputs.request.ignore = {"Arm:wall"};
  inputs.request.placement.yawDeg = 90.0;
  inputs.match.unmatchedAvatar = {"Arm"};
  const std::string line = headerLine(inputs);
  EXPECT_EQ(line.back(), '\n');
  const json header = json::parse(line);
  EXPECT_EQ(header["format"], "foretouch-results");
  EXPECT_EQ(header["version"], 1);
  EXPECT_FALSE(header["tool"].get<std::string>().empty());
  EXPECT_EQ(header["scene"], "wall.obj");
  EXPECT_EQ(header["avatar"], "man.json");
  EXPECT_EQ(header["motion"], "clip.bvh");
  EXPECT_EQ(header["rate"], 10);
  EXPECT_EQ(header["k"], 1);
  EXPECT_EQ(header["frame_time"], 0.1);
  EXPECT_EQ(header["steps"], 2);
  EXPECT_EQ(header["tolerance"], 0.001);
  EXPECT_EQ(header["fidelity"], "link");
  EXPECT_EQ(header["place"], json({1, 2, 3, 90}));
  EXPECT_EQ(header["ignore"], json({"Arm:wall"}));
  EXPECT_EQ(header["links"], json({"Hips", "Arm"}));
  EXPECT_EQ(header["unmatched_joints"], json({"Arm"}));
}

TEST(HeaderLine, WritesNullForAnOmittedRate) {
  EXPECT_TRUE(json::parse(headerLine(smallInputs({0, 1})))["rate"].is_null());
}

}  // namespace
}  // namespace foretouch::tools
