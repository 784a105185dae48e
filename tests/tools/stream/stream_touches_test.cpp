#include "tools/stream/stream_touches.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tools/stream/touch_lines.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

constexpr std::int64_t kStartUs = 1'700'000'000'000'000, kStepUs = 20'000;

AnsweredContact contact(Verdict verdict, double toi = 0.0, const std::string& object = "table") {
  AnsweredContact answered;
  answered.contact.link = 3;
  answered.contact.verdict = verdict;
  answered.contact.toi = answered.contact.freeUntil = toi;
  answered.linkName = "LeftHand";
  answered.objectName = object;
  return answered;
}

/// The answer to pose `to`, 20 ms after the one before.
ContactsMessage answer(std::int64_t to, const std::vector<AnsweredContact>& contacts = {},
                       StepKind kind = StepKind::Consecutive) {
  ContactsMessage message;
  message.avatar = 1;
  message.session = kStartUs;
  message.kind = kind;
  message.sequenceFrom = kind == StepKind::First ? to : to - 1;
  message.sequenceTo = to;
  message.utimeToUs = kStartUs + kStepUs * to;
  message.utimeFromUs = kStartUs + kStepUs * message.sequenceFrom;
  message.contacts = contacts;
  return message;
}

/// The lines for people of these answers, without who and where.
std::vector<std::string> told(const std::vector<ContactsMessage>& messages) {
  StreamTouches touches;
  std::vector<std::string> lines;
  for (const ContactsMessage& message : messages) {
    TouchEvents events;
    touches.take(message, {}, events);
    const std::string text = touchesText(message, events);
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at), words = text.find(": ", at) + 2;
      lines.push_back(text.substr(words, end - words));
      at = end + 1;
    }
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(StreamTouches, SayWhereATouchBeginsAndEndsAndNothingBetween) {
  EXPECT_EQ(told({answer(0, {}, StepKind::First), answer(1), answer(2),
                  answer(3, {contact(Verdict::Contact, 0.5)}),
                  answer(4, {contact(Verdict::StartsInContact)}),
                  answer(5, {contact(Verdict::StartsInContact)}), answer(6), answer(7)}),
            (Lines{"the first", "'LeftHand' touches 'table' at 50 % of 20.0 ms",
                   "'LeftHand' leaves 'table' after 0.030 s"}));
}

TEST(StreamTouches, GoOnFromTheFirstPose) {
  EXPECT_EQ(told({answer(0, {contact(Verdict::StartsInContact)}, StepKind::First),
                  answer(1, {contact(Verdict::StartsInContact)}), answer(2)}),
            (Lines{"the first", "'LeftHand' is in 'table'", "'LeftHand' leaves 'table'"}));
}

TEST(StreamTouches, EndAsOpenWhereWhatFollowsIsNotKnown) {
  const std::vector<AnsweredContact> in{contact(Verdict::StartsInContact)};
  const std::string open = "whether 'LeftHand' still touches 'table' is not known";
  const std::string inside = "'LeftHand' is in 'table'";
  const ContactsMessage first = answer(0, in, StepKind::First);
  // An answer is missing; a link is unknown; a timeline begins; another session.
  EXPECT_EQ(told({first, answer(2, in)}), (Lines{"the first", inside, open, inside}));
  EXPECT_EQ(told({first, answer(1, {contact(Verdict::Undecided)}), answer(2)}),
            (Lines{"the first", inside, open}));
  EXPECT_EQ(told({first, answer(1, in, StepKind::First)}),
            (Lines{"the first", inside, open, "the first", inside}));
  ContactsMessage other = answer(1, in);
  ++other.session;
  EXPECT_EQ(told({first, other}), (Lines{"the first", inside, open, inside}));
}

TEST(StreamTouches, ClaimNothingAcrossLostPoses) {
  ContactsMessage across = answer(4, {contact(Verdict::StartsInContact)}, StepKind::AcrossGap);
  across.sequenceFrom = 0;
  across.utimeFromUs = kStartUs;
  across.lost = 3;
  const std::vector<AnsweredContact> in{contact(Verdict::StartsInContact)};
  EXPECT_EQ(
      told({answer(0, in, StepKind::First), across, answer(5, in)}),
      (Lines{"the first", "'LeftHand' is in 'table'", "3 lost before it",
             "whether 'LeftHand' still touches 'table' is not known", "'LeftHand' is in 'table'"}));
}

TEST(StreamTouches, AreLinesOfJsonWithTheClockOfTheStream) {
  StreamTouches touches;
  TouchEvents events;
  touches.take(answer(0, {}, StepKind::First), {}, events);
  touches.take(answer(1, {contact(Verdict::Contact, 0.25)}), {true}, events);
  ASSERT_EQ(events.begun.size(), 1u);
  const json begun = json::parse(begunTouchLine(events.begun[0]))["touch_begins"];
  touches.take(answer(2, {contact(Verdict::StartsInContact)}), {true}, events);
  touches.take(answer(3), {}, events);
  ASSERT_EQ(events.ended.size(), 1u);
  const std::string line = endedTouchLine(events.ended[0]);
  EXPECT_EQ(line.back(), '\n');
  EXPECT_EQ(json::parse(line), json::parse(R"({"touch":{"avatar":1,"session":1700000000000000,
    "link":"LeftHand","object":"table","utime":[1700000000005000,1700000000020000],
    "sequence":[1,2],"begins":"contact","ends":"left","contacts":2,"separation":0.0,
    "penetration":null,"ground":true}})"));
  EXPECT_EQ(begun["utime"], json({1700000000005000, 1700000000005000}));
  EXPECT_EQ(begun["sequence"], json({1, 1}));
  EXPECT_EQ(begun["contacts"], 1);
}

TEST(StreamTouches, StayBoundedWhateverArrives) {
  StreamTouches touches;
  TouchEvents events;
  std::size_t ended = 0, begun = 0;
  constexpr std::int64_t kAnswers = 4'500;
  for (std::int64_t i = 0; i < kAnswers; ++i) {
    // Each hides the object before: none of them ends by itself.
    events = {};
    touches.take(answer(i + 1, {contact(Verdict::StartsInContact, 0.0, std::to_string(i))}), {},
                 events);
    begun += events.begun.size();
    ended += events.ended.size();
  }
  EXPECT_EQ(begun, static_cast<std::size_t>(kAnswers));
  EXPECT_GT(ended, 4'000u);
  events = {};
  touches.breakOff(events);
  EXPECT_EQ(ended + events.ended.size(), begun);
}

}  // namespace
}  // namespace foretouch::tools
