#include "tools/log/journal_check.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tools/stream/answer_tracker.h"

namespace foretouch::tools {
namespace {

ContactsMessage answer(std::int64_t sequence, std::int32_t avatar = 1) {
  ContactsMessage message;
  message.avatar = avatar;
  message.session = 9;
  message.sequenceFrom = sequence - 1;
  message.sequenceTo = sequence;
  message.utimeFromUs = 1000 * (sequence - 1);
  message.utimeToUs = 1000 * sequence;
  message.tolerance = 1e-3;
  message.verdicts = {Verdict::Clear, Verdict::Clear};
  return message;
}

Bytes bytesOf(const ContactsMessage& message) {
  Bytes bytes;
  encode(message, bytes);
  return bytes;
}

struct Check {
  JournalCheck check;
  void recorded(const ContactsMessage& message) { check.addRecorded(message, bytesOf(message)); }
  void replayed(const ContactsMessage& message) { check.addReplayed(message, bytesOf(message)); }
  [[nodiscard]] std::string first() const { return check.firstDifference().value_or("none"); }
};

TEST(JournalCheck, FindsEqualAnswersInEitherOrderWhateverTheirStamps) {
  Check c;
  EXPECT_FALSE(c.check.hasRecord());
  for (std::int64_t i = 1; i < 50; ++i) {
    ContactsMessage stamped = answer(i);
    stamped.receiveUtimeUs = 5 * i;
    stamped.sendUtimeUs = 6 * i;
    stamped.queryUs = 0.5;
    if (i % 3 == 0) c.recorded(stamped);
    c.replayed(answer(i));
    if (i % 3 != 0) c.recorded(stamped);
  }
  EXPECT_TRUE(c.check.isEqual());
  EXPECT_EQ(c.check.equal(), 49);
  EXPECT_EQ(c.check.recorded(), 49);
  EXPECT_EQ(c.first(), "none");
}

TEST(JournalCheck, NamesTheFirstThatDiffers) {
  Check c;
  for (std::int64_t i = 1; i < 9; ++i) {
    c.replayed(answer(i));
    ContactsMessage other = answer(i);
    if (i == 4 || i == 6) other.lost = 1;
    c.recorded(other);
  }
  EXPECT_FALSE(c.check.isEqual());
  EXPECT_EQ(c.check.equal(), 6);
  EXPECT_EQ(c.first().rfind("avatar 1, session 9, pose 4 is answered differently: ", 0), 0u)
      << c.first();
}

TEST(JournalCheck, SaysWhichOptionDiffers) {
  Check c;
  c.replayed(answer(1));
  ContactsMessage other = answer(1);
  other.tolerance = 0.002;
  c.recorded(other);
  EXPECT_EQ(c.first(),
            "avatar 1, session 9, pose 1 is answered differently: the tolerance is "
            "0.002 in the log, 0.001 here");
}

/// Both in contact, link 1 first.
ContactsMessage touching() {
  ContactsMessage message = answer(7);
  message.verdicts = {Verdict::Contact, Verdict::Contact, Verdict::Clear};
  for (const LinkId link : {1, 0}) {
    AnsweredContact answered;
    answered.linkName = link == 0 ? "Hips" : "Arm";
    answered.objectName = "wall";
    answered.contact.link = link;
    answered.contact.verdict = Verdict::Contact;
    answered.contact.toi = answered.contact.freeUntil = 0.5 - 0.1 * link;
    answered.contact.separation = 0.0003;
    answered.contact.triangle = 12;
    message.contacts.push_back(answered);
  }
  return message;
}

TEST(JournalCheck, NamesTheFieldAndBothValues) {
  const std::string lead = "avatar 1, session 9, pose 7 is answered differently: ";
  const std::string where = ", in the step from 6000 to 7000 us";
  const auto first = [&](const std::function<void(ContactsMessage&)>& change) {
    Check c;
    ContactsMessage recorded = touching();
    change(recorded);
    c.recorded(recorded);
    c.replayed(touching());
    return c.first();
  };
  EXPECT_EQ(first([](ContactsMessage& m) { m.lost = 2; }),
            lead + "the number of lost poses is 2 in the log, 0 here" + where);
  EXPECT_EQ(first([](ContactsMessage& m) { m.contacts[1].contact.separation = 0.0004; }),
            lead + "the separation of 'Hips' is 0.0004 in the log, 0.0003 here" + where);
  EXPECT_EQ(first([](ContactsMessage& m) { m.contacts[0].contact.p_WScene.y() = -0.0; }),
            lead + "the point of 'Arm' is [0, -0, 0] in the log, [0, 0, 0] here" + where);
  EXPECT_EQ(first([](ContactsMessage& m) {
              m.verdicts[0] = Verdict::Clear;
              m.contacts.pop_back();
            }),
            lead + "the verdict of 'Hips' is clear in the log, contact here" + where);
  EXPECT_EQ(first([](ContactsMessage& m) { std::swap(m.contacts[0], m.contacts[1]); }),
            lead + "the link of contact 0 is 'Hips' in the log, 'Arm' here" + where);
  EXPECT_EQ(first([](ContactsMessage& m) {
              m.contacts[0].contact.triangle = 13;
              m.contacts[0].objectName = std::string(200, 'x');
            }),
            lead + "the triangle of 'Arm' is 13 in the log, 12 here" + where);
}

SolidMessage showing(std::int64_t sequence) {
  SolidMessage message;
  message.avatar = 1;
  message.session = 9;
  message.sequence = sequence;
  message.utimeUs = 1000 * sequence;
  message.skin = 0.002;
  message.state = SolidState::Held;
  message.joints = {SolidJointState::Free};
  message.linkDeviation = {0.25};
  message.way = {{{Quaternion::Identity()}, {Eigen::Vector3d(0.0, 1.0, 0.0)}}};
  message.times = {0.0};
  return message;
}

TEST(JournalCheck, ComparesShownPosesAndNamesTheFieldAndBothValues) {
  const auto first = [](const std::function<void(SolidMessage&)>& change) {
    JournalCheck check(AnswerKind::Solid);
    for (std::int64_t i = 1; i < 5; ++i) {
      SolidMessage recorded = showing(i);
      recorded.solidUs = 7.0 * static_cast<double>(i);  // differs in every run
      recorded.sendUtimeUs = i;
      if (i == 3) change(recorded);
      Bytes before, now;
      encode(recorded, before);
      encode(showing(i), now);
      check.addReplayed(showing(i), now);
      check.addRecorded(recorded, before);
    }
    EXPECT_EQ(check.recorded(), 4);
    return check.firstDifference().value_or("none");
  };
  const std::string lead = "avatar 1, session 9, pose 3 is shown differently: ";
  EXPECT_EQ(first([](SolidMessage&) {}), "none");
  EXPECT_EQ(first([](SolidMessage& m) { m.skin = 0.004; }),
            lead + "the skin is 0.004 in the log, 0.002 here");
  EXPECT_EQ(first([](SolidMessage& m) { m.state = SolidState::Sliding; }),
            lead + "the state is sliding in the log, held here, at 3000 us");
  EXPECT_EQ(first([](SolidMessage& m) { m.way[0].translations[0].z() = -0.0; }),
            lead +
                "the translation of joint 0 in pose 0 on the way is [0, 1, -0] in the log, "
                "[0, 1, 0] here, at 3000 us");
  EXPECT_EQ(first([](SolidMessage& m) { m.counters.queries = 2; }),
            lead + "the number of queries is 2 in the log, 0 here, at 3000 us");
}

// Whatever differs, it is told in few words.
TEST(JournalCheck, IsBriefAboutLargeAnswers) {
  ContactsMessage recorded = answer(7), replayed = recorded;
  for (LinkId link = 0; link < 200; ++link) {
    AnsweredContact answered;
    answered.linkName = "a rather long name of link " + std::to_string(link);
    answered.objectName = std::string(200, 'o');
    answered.contact.link = link;
    answered.contact.verdict = Verdict::Contact;
    answered.contact.freeUntil = answered.contact.toi = 1.0 / 3.0;
    recorded.contacts.push_back(answered);
    answered.contact.p_WLink = {1.0 / 3.0, -1.0 / 7.0, 1e-300 / 3.0};
    replayed.contacts.push_back(answered);
  }
  recorded.verdicts = replayed.verdicts = std::vector<Verdict>(200, Verdict::Contact);
  Check c;
  c.recorded(recorded);
  c.replayed(replayed);
  EXPECT_NE(c.first().find("the point on the link of 'a rather long name of link 0' is [0, 0, 0]"),
            std::string::npos)
      << c.first();
  EXPECT_LT(c.first().size(), 400u) << c.first();
}

TEST(JournalCheck, NamesWhatOneSideLacks) {
  Check missing;
  missing.recorded(answer(1));
  missing.replayed(answer(1));
  missing.replayed(answer(2));
  missing.recorded(answer(3, 2));
  EXPECT_FALSE(missing.check.isEqual());
  EXPECT_EQ(missing.first(), "avatar 1, session 9, pose 2 is answered here, and not in the log");
  Check extra;
  extra.recorded(answer(5));
  extra.replayed(answer(6));
  extra.recorded(answer(6));
  EXPECT_EQ(extra.first(), "avatar 1, session 9, pose 5 is answered in the log, and not here");
}

TEST(JournalCheck, ForgivesALogThatWasCutOffWhatIsBeyondItsEnd) {
  Check c;
  for (std::int64_t i = 1; i < 8; ++i) {
    c.replayed(answer(i));
    if (i < 6) c.recorded(answer(i));
  }
  EXPECT_FALSE(c.check.isEqual());
  c.check.endIsOpen();
  EXPECT_TRUE(c.check.isEqual());
  EXPECT_EQ(c.check.equal(), 5);
  EXPECT_EQ(c.check.beyondEnd(), 2);
  Check inside;
  inside.replayed(answer(1));
  inside.replayed(answer(2));
  inside.recorded(answer(2));
  inside.check.endIsOpen();
  EXPECT_FALSE(inside.check.isEqual());  // the first is missing before the end
}

TEST(JournalCheck, PairsRepeatedSequencesInTheirOrder) {
  Check c;
  ContactsMessage second = answer(1);
  second.utimeToUs += 77;  // a sender that does not say its session was restarted
  c.recorded(answer(1));
  c.recorded(second);
  c.replayed(answer(1));
  c.replayed(second);
  EXPECT_TRUE(c.check.isEqual());
  EXPECT_EQ(c.check.equal(), 2);
  c.recorded(answer(1));
  EXPECT_FALSE(c.check.isEqual());
}

TEST(AnswerTracker, NoticesWhatTheAnswersThemselvesSayIsMissing) {
  AnswerTracker tracker;
  EXPECT_FALSE(tracker.take(answer(5)));  // who joins late has missed nothing
  EXPECT_FALSE(tracker.take(answer(6)));
  EXPECT_FALSE(tracker.take(answer(100, 2)));
  ContactsMessage gap = answer(10);
  gap.sequenceFrom = 6;  // poses were lost, answers were not
  EXPECT_FALSE(tracker.take(gap));
  const auto missing = tracker.take(answer(13));
  ASSERT_TRUE(missing);
  EXPECT_NE(missing->find("avatar 1"), std::string::npos);
  EXPECT_NE(missing->find("12"), std::string::npos) << *missing;
  ContactsMessage restarted = answer(30);
  restarted.session = 10;
  EXPECT_FALSE(tracker.take(restarted));
  ContactsMessage first = answer(90);
  first.session = 10;
  first.kind = StepKind::First;
  EXPECT_FALSE(tracker.take(first));
  EXPECT_EQ(tracker.gaps(), 1);
}

}  // namespace
}  // namespace foretouch::tools
