#include "tools/stream/contacts_line.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "judge/plain_motion.h"
#include "tests/support/random_geometry.h"
#include "tests/tools/small_inputs.h"
#include "tools/replay/results_writer.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

LinkContact contactWith(LinkId link, Verdict verdict, double time) {
  LinkContact contact;
  contact.link = link;
  contact.verdict = verdict;
  contact.toi = contact.freeUntil = time;
  contact.triangle = 1;
  contact.p_WScene = {0.1, -1e-17, 3};
  contact.nhat_SL_W = {0, 1, 0};
  return contact;
}

ContactsMessage smallMessage() {
  ContactsMessage message;
  message.avatar = 7;
  message.session = 1'700'000'000'000'000;
  message.sequenceFrom = 41;
  message.sequenceTo = 42;
  message.utimeFromUs = 1'000'000;
  message.utimeToUs = 1'100'000;
  return message;
}

TEST(ContactsLine, WritesEveryField) {
  ContactsMessage message = smallMessage();
  message.kind = StepKind::AcrossGap;
  message.lost = 3;
  message.receiveUtimeUs = 5;
  message.sendUtimeUs = 6;
  message.queryUs = 1.5;
  LinkContact gap = contactWith(1, Verdict::Undecided, 0.0);
  gap.reason = UndecidedReason::Gap;
  message.contacts = {{gap, "Arm", ""}, {contactWith(0, Verdict::Contact, 0.5), "Hi\"ps", "wall"}};
  EXPECT_EQ(
      contactsLine(message, Stamps::With),
      R"({"avatar":7,"session":1700000000000000,"sequence":[41,42],"utime":[1000000,1100000],)"
      R"("kind":"across-gap","lost":3,"contacts":[)"
      R"({"link":"Arm","verdict":"undecided","free_until":0,"reason":"gap"},)"
      R"({"link":"Hi\"ps","verdict":"contact","toi":0.5,"utime":1050000,"separation":0,)"
      R"("point":[0.1,-1e-17,3],"on_link":[0,0,0],"normal":[0,1,0],"triangle":1,)"
      R"("object":"wall"}],"receive_utime":5,"send_utime":6,"query_us":1.5})"
      "\n");
  const std::string without = contactsLine(message, Stamps::Without);
  EXPECT_EQ(without.find("receive_utime"), std::string::npos);
  EXPECT_EQ(without.find("query_us"), std::string::npos);
  EXPECT_EQ(json::parse(without)["contacts"].size(), 2u);
}

/// A field and its number, cut out of a text.
std::string without(std::string text, const std::string& field) {
  for (;;) {
    const std::size_t at = text.find("\"" + field + "\":");
    if (at == std::string::npos) return text;
    text.erase(at, text.find(',', at) + 1 - at);
  }
}

// The same contacts as a results file and as an answer say them: but for the time the same text.
TEST(ContactsLine, HasTheContactsOfAResultsFile) {
  const ReplayInputs inputs = test::smallInputs({0, 1});
  StepAnswer answer;
  answer.t1S = 0.1;
  ContactsMessage message = smallMessage();
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const auto verdict = static_cast<Verdict>(1 + random.below(3));
    LinkContact contact = contactWith(random.below(2), verdict, random.uniform(0.0, 1.0));
    contact.separation = random.magnitude(1e-9, 1e-3);
    contact.penetration = random.magnitude(1e-9, 1.0);
    contact.p_WLink = random.direction();
    contact.linkTriangle = random.chance(0.5) ? random.below(99) : -1;
    contact.linkFeature = static_cast<FeatureKind>(random.below(3));
    contact.reason =
        verdict == Verdict::Undecided ? UndecidedReason::Resolution : UndecidedReason::None;
    answer.contacts.push_back(contact);
    message.contacts.push_back({contact, inputs.avatar.skeleton().name(contact.link), "wall"});
  }
  const std::string file = StepFormat(inputs.avatar, inputs.scene).line(answer);
  const std::string line = contactsLine(message, Stamps::Without);
  const auto contactsIn = [](const std::string& text) {
    const std::size_t begin = text.find("\"contacts\":["), end = text.find("}]");
    return text.substr(begin, end - begin);
  };
  EXPECT_EQ(without(contactsIn(line), "utime"), without(contactsIn(file), "time"));
}

// Oracle: fifty digits. Instants that a product in doubles would round up are among them.
TEST(UtimeOf, IsNeverAfterTheContactAndLessThanAMicrosecondBefore) {
  using Real = oracle::Precise;
  test::Random random(5);
  int roundedUp = 0;
  for (int i = 0; i < 20000; ++i) {
    ContactsMessage message = smallMessage();
    const std::int64_t span =
        random.chance(0.5) ? 1 + random.below(1000) : random.below(10'000'000);
    message.utimeToUs = message.utimeFromUs + span;
    double toi = random.uniform(0.0, 1.0);
    if (random.chance(0.5) && span > 0) {  // right below a whole microsecond
      toi = std::nextafter(
          static_cast<double>(random.below(static_cast<int>(span)) + 1) / static_cast<double>(span),
          0.0);
    }
    const Real truth = Real(toi) * Real(span);
    const auto got = utimeOf(message, toi) - message.utimeFromUs;
    EXPECT_LE(Real(got), truth) << toi << " " << span;
    EXPECT_GT(Real(got + 1), truth) << toi << " " << span;
    roundedUp += Real(std::floor(toi * static_cast<double>(span))) > truth ? 1 : 0;
  }
  EXPECT_GT(roundedUp, 100);  // the correction is really needed
}

TEST(ContactsText, SaysWhatIsTouchedAndKeepsControlSequencesOut) {
  ContactsMessage message = smallMessage();
  EXPECT_EQ(contactsText(message), "avatar 7, pose 42: clear\n");
  message.contacts = {{contactWith(0, Verdict::Contact, 0.25), "Hand", "ta\x1b[2Jble"},
                      {undecidedContact(0, 0.0, UndecidedReason::MissingJoint), "Foot", ""}};
  message.kind = StepKind::AcrossGap;
  message.lost = 2;
  EXPECT_EQ(contactsText(message),
            "avatar 7, pose 42 (after 2 lost): 'Hand' touches 'ta\\x1b[2Jble' at 25 % of 100.0 ms; "
            "'Foot' undecided (missing-joint)\n");
}

TEST(StatusLine, IsOneObject) {
  StatusMessage status;
  status.scene = "room \"one\".obj";
  status.received = 10;
  status.counts = {{"out-of-order", 2}, {"duplicate", 0}};
  status.latencyP50Us = 12.5;
  const json object = json::parse(statusLine(status))["status"];
  EXPECT_EQ(object["scene"], "room \"one\".obj");
  EXPECT_EQ(object["received"], 10);
  EXPECT_EQ(object["reasons"], json({{"out-of-order", 2}, {"duplicate", 0}}));
  EXPECT_EQ(object["latency_us"]["p50"], 12.5);
  EXPECT_NE(statusText(status).find("'out-of-order' 2"), std::string::npos);
  EXPECT_EQ(statusText(status).find("duplicate"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::tools
