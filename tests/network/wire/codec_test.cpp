// What messages say survives the wire, bit for bit, and what no message may say is refused by name.
// The bytes as such: payload_check_test.cpp, codec_lcm_test.cpp.
#include "network/wire/codec.h"

#include <algorithm>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "network/wire/messages.h"
#include "tests/network/random_messages.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

using test::Random;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kTooLarge = std::int64_t{1} << 62;

template <typename Message>
Bytes bytesOf(const Message& message) {
  Bytes bytes;
  encode(message, bytes);
  return bytes;
}

/// Of a message changed by `change`.
template <typename Message, typename Change>
Reject rejectAfter(Message message, Change change) {
  change(message);
  Message decoded;
  return decode(bytesOf(message), decoded);
}

/// Into one message over and over, whatever the last one left there.
template <typename Message, typename Draw>
void expectRoundTrips(Draw draw) {
  Message decoded;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    SCOPED_TRACE(seed);
    const Bytes bytes = bytesOf(draw(random));
    ASSERT_EQ(decode(bytes, decoded), Reject::None);
    ASSERT_EQ(bytesOf(decoded), bytes);
  }
}

TEST(Codec, MessagesSurviveTheWireBitForBit) {
  expectRoundTrips<SkeletonMessage>(
      [](Random& r) { return test::randomSkeletonMessage(r, 1 + r.below(40)); });
  expectRoundTrips<PoseMessage>([](Random& r) { return test::randomPoseMessage(r, r.below(80)); });
  expectRoundTrips<ContactsMessage>(
      [](Random& r) { return test::randomContactsMessage(r, r.below(40)); });
  expectRoundTrips<SolidMessage>([](Random& r) {
    return test::randomSolidMessage(r, 1 + r.below(40), 1 + r.below(6), r.below(20));
  });
  expectRoundTrips<PersonMessage>(
      [](Random& r) { return test::randomPersonMessage(r, r.below(40), r.below(20)); });
  expectRoundTrips<SpeakerMessage>([](Random& r) { return test::randomSpeakerMessage(r); });
  expectRoundTrips<StatusMessage>(
      [](Random& r) { return test::randomStatusMessage(r, r.below(20)); });
  expectRoundTrips<PushesMessage>(
      [](Random& r) { return test::randomPushesMessage(r, r.below(20)); });
}

TEST(Codec, LargestMessagesSurvive) {
  Random random(1);
  SkeletonMessage skeleton;
  EXPECT_EQ(decode(bytesOf(test::randomSkeletonMessage(random, kMaxJoints)), skeleton),
            Reject::None);
  PoseMessage pose;
  EXPECT_EQ(decode(bytesOf(test::randomPoseMessage(random, kMaxJoints)), pose), Reject::None);
  ContactsMessage contacts;
  EXPECT_EQ(decode(bytesOf(test::randomContactsMessage(random, kMaxJoints)), contacts),
            Reject::None);
  SolidMessage solid =
      test::randomSolidMessage(random, kMaxSolidJoints, kMaxSolidPoses, kMaxSolidContacts);
  for (ShownContact& shown : solid.contacts) {
    shown.linkName.assign(kMaxNameBytes, 'n');
    shown.otherName.assign(kMaxTextBytes, 'o');
  }
  const Bytes bytes = bytesOf(solid);
  EXPECT_LE(bytes.size(), kMaxMessageBytes);
  EXPECT_EQ(decode(bytes, solid), Reject::None);
  PersonMessage person = test::randomPersonMessage(random, kMaxJoints, kMaxPersonBrackets);
  for (ToldBracket& told : person.brackets) {
    told.linkName.assign(kMaxNameBytes, 'n');
    told.otherName.assign(kMaxTextBytes, 'o');
  }
  const Bytes ofPerson = bytesOf(person);
  EXPECT_LE(ofPerson.size(), kMaxMessageBytes);
  EXPECT_EQ(decode(ofPerson, person), Reject::None);
}

TEST(Codec, PosesIntoReusedMemoryAllocateNothing) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  Random random(7);
  const Bytes bytes = bytesOf(test::randomPoseMessage(random, 70));
  PoseMessage pose;
  Bytes again;
  std::uint64_t before = 0;
  for (int round = 0; round < 3; ++round) {
    before = test::numAllocations();
    ASSERT_EQ(decode(bytes, pose), Reject::None);
    encode(pose, again);
  }
  EXPECT_EQ(test::numAllocations(), before);
  EXPECT_EQ(again, bytes);
}

// --- skeleton_t

/// Hips, Spine, Head in a chain.
SkeletonMessage chain() {
  SkeletonMessage message;
  message.skeleton.joints = {{"Hips", kNoParent, {0.0, 1.0, 0.0}, Quaternion::Identity()},
                             {"Spine", 0, {0.0, 0.1, 0.0}, Quaternion(0.6, 0.8, 0.0, 0.0)},
                             {"Head", 1, {0.0, 0.5, 0.0}, Quaternion::Identity()}};
  message.hash = skeletonHash(message.skeleton);
  return message;
}

/// Of the chain changed, with the hash of what it then is.
template <typename Change>
Reject chainAfter(Change change) {
  return rejectAfter(chain(), [&](SkeletonMessage& message) {
    change(message.skeleton.joints);
    message.hash = skeletonHash(message.skeleton);
  });
}

using Joints = std::vector<RawJoint>;

TEST(DecodeSkeleton, AcceptsTheChainThatIsChangedBelow) {
  EXPECT_EQ(chainAfter([](Joints&) {}), Reject::None);
}

TEST(DecodeSkeleton, RefusesNumbersThatAreNotFinite) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(chainAfter([&](Joints& j) { j[1].offset.y() = bad; }), Reject::NonFinite);
    EXPECT_EQ(chainAfter([&](Joints& j) { j[1].rotation.z() = bad; }), Reject::NonFinite);
    EXPECT_EQ(rejectAfter(chain(), [&](SkeletonMessage& m) { m.rateHz = bad; }), Reject::NonFinite);
  }
}

TEST(DecodeSkeleton, RefusesRotationsThatAreNotUnit) {
  for (const double norm : {0.0, 0.9989, 1.0011, 1e200}) {
    EXPECT_EQ(chainAfter([&](Joints& j) { j[2].rotation.w() = norm; }), Reject::NonUnit) << norm;
  }
  EXPECT_EQ(chainAfter([](Joints& j) { j[2].rotation.w() = 1.0009; }), Reject::None);
}

TEST(DecodeSkeleton, RefusesNumbersOutOfRange) {
  EXPECT_EQ(chainAfter([](Joints& j) { j[0].offset.x() = -1.0000001e7; }), Reject::OutOfRange);
  const auto after = [](auto change) { return rejectAfter(chain(), change); };
  EXPECT_EQ(after([](SkeletonMessage& m) { m.rateHz = -1.0; }), Reject::OutOfRange);
  EXPECT_EQ(after([](SkeletonMessage& m) { m.generation = -1; }), Reject::OutOfRange);
  for (const std::int64_t bad : {std::int64_t{-1}, kTooLarge}) {
    EXPECT_EQ(after([&](SkeletonMessage& m) { m.session = bad; }), Reject::OutOfRange);
    EXPECT_EQ(after([&](SkeletonMessage& m) { m.sendUtimeUs = bad; }), Reject::OutOfRange);
  }
}

TEST(DecodeSkeleton, RefusesBadNames) {
  for (const char* const bad : {"", "Hips", "a\nb", "\x7f", "\xff", "\xc3"}) {
    EXPECT_EQ(chainAfter([&](Joints& j) { j[1].name = bad; }), Reject::BadName) << bad;
  }
}

TEST(DecodeSkeleton, RefusesBadParents) {
  for (const JointId bad : {-2, 3, std::numeric_limits<JointId>::max()}) {
    EXPECT_EQ(chainAfter([&](Joints& j) { j[1].parent = bad; }), Reject::BadIndex) << bad;
  }
  for (const JointId late : {1, 2}) {  // its own parent; a cycle
    EXPECT_EQ(chainAfter([&](Joints& j) { j[1].parent = late; }), Reject::BadHierarchy) << late;
  }
}

TEST(DecodeSkeleton, RefusesNoJointsAndChainsTooDeep) {
  EXPECT_EQ(chainAfter([](Joints& j) { j.clear(); }), Reject::Limit);
  const auto deep = [](int depth) {
    return chainAfter([&](Joints& j) {
      while (static_cast<int>(j.size()) < depth) {
        j.push_back({"J" + std::to_string(j.size()), static_cast<JointId>(j.size()) - 1, {}, {}});
        j.back().offset.setZero();
        j.back().rotation.setIdentity();
      }
    });
  };
  EXPECT_EQ(deep(kMaxChainDepth), Reject::None);
  EXPECT_EQ(deep(kMaxChainDepth + 1), Reject::Limit);
}

TEST(DecodeSkeleton, RefusesAHashOfSomethingElse) {
  EXPECT_EQ(rejectAfter(chain(), [](SkeletonMessage& m) { m.hash ^= 1; }), Reject::BadHash);
  EXPECT_EQ(
      rejectAfter(chain(), [](SkeletonMessage& m) { m.skeleton.joints[2].offset.x() = 1e-9; }),
      Reject::BadHash);
}

// --- pose_t

/// Joints 0, 1 and 4 valid, 2 not; translations of 0 and 2.
PoseMessage fourJoints() {
  PoseMessage message;
  for (const std::int32_t joint : {4, 0, 2, 1}) {
    message.joints.push_back({joint, kJointValid | kJointTracked, Quaternion(0.8, 0.0, 0.6, 0.0)});
  }
  message.joints[2].flags = kJointInferred;
  message.translations = {{2, {1.0, 2.0, 3.0}}, {0, {0.0, 1.0, 0.0}}};
  return message;
}

template <typename Change>
Reject poseAfter(Change change) {
  return rejectAfter(fourJoints(), change);
}

TEST(DecodePose, AcceptsThePoseThatIsChangedBelow) {
  EXPECT_EQ(poseAfter([](PoseMessage&) {}), Reject::None);
}

TEST(DecodePose, RefusesNumbersThatAreNotFinite) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.joints[3].rotation.x() = bad; }),
              Reject::NonFinite);
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.translations[1].translation.z() = bad; }),
              Reject::NonFinite);
  }
}

TEST(DecodePose, RefusesRotationsThatAreNotUnit) {
  for (const double w : {0.0, 0.7986, 0.8014, 1e200}) {
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.joints[0].rotation.w() = w; }), Reject::NonUnit);
  }
}

TEST(DecodePose, TakesAnythingForJointsThatAreNotValid) {
  PoseMessage message = fourJoints();
  message.joints[2].rotation = Quaternion(kNaN, 1e300, kInfinity, 0.0);
  message.translations[0].translation = {kNaN, 1e300, -kInfinity};
  PoseMessage decoded;
  ASSERT_EQ(decode(bytesOf(message), decoded), Reject::None);
  EXPECT_EQ(decoded.joints[2].joint, 2);
  EXPECT_EQ(decoded.joints[2].flags, kJointInferred);
  EXPECT_EQ(decoded.joints[2].rotation.coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(decoded.translations[0].translation, Eigen::Vector3d::Zero());
  PoseMessage again;
  ASSERT_EQ(decode(bytesOf(decoded), again), Reject::None);
  EXPECT_EQ(bytesOf(again), bytesOf(decoded));
}

TEST(DecodePose, RefusesNumbersOutOfRange) {
  EXPECT_EQ(poseAfter([](PoseMessage& m) { m.translations[1].translation.x() = 1.0000001e7; }),
            Reject::OutOfRange);
  for (const std::uint8_t flags : {std::uint8_t{8}, std::uint8_t{128}, std::uint8_t{255}}) {
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.joints[2].flags = flags; }), Reject::OutOfRange);
  }
  for (const std::int64_t bad : {std::int64_t{-1}, kTooLarge}) {
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.session = bad; }), Reject::OutOfRange);
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.sequence = bad; }), Reject::OutOfRange);
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.utimeUs = bad; }), Reject::OutOfRange);
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.sendUtimeUs = bad; }), Reject::OutOfRange);
  }
}

TEST(DecodePose, RefusesJointsThatNoSkeletonHasOrThatAreThereTwice) {
  for (const std::int32_t bad : {-1, kMaxJoints, std::numeric_limits<std::int32_t>::max(), 0}) {
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.joints[3].joint = bad; }), Reject::BadIndex) << bad;
  }
  EXPECT_EQ(poseAfter([](PoseMessage& m) { m.joints[3].joint = kMaxJoints - 1; }), Reject::None);
}

TEST(DecodePose, RefusesTranslationsOfJointsThatAreNotListed) {
  for (const std::int32_t bad : {-1, 3, kMaxJoints, 2}) {  // 2: twice
    EXPECT_EQ(poseAfter([&](PoseMessage& m) { m.translations[1].joint = bad; }), Reject::BadIndex)
        << bad;
  }
}

// --- contacts_t

/// Links: clear, in contact, undecided, clear.
ContactsMessage fourLinks() {
  ContactsMessage message;
  message.sequenceFrom = 7;
  message.sequenceTo = 8;
  message.utimeFromUs = 100;
  message.utimeToUs = 200;
  message.tolerance = 1e-3;
  message.verdicts = {Verdict::Clear, Verdict::Contact, Verdict::Undecided, Verdict::Clear};
  message.contacts.resize(2);
  AnsweredContact& undecided = message.contacts[0];
  undecided.linkName = "Hand";
  undecided.contact.link = 2;
  undecided.contact.verdict = Verdict::Undecided;
  undecided.contact.freeUntil = 0.0;
  undecided.contact.reason = UndecidedReason::MissingJoint;
  AnsweredContact& touching = message.contacts[1];
  touching.linkName = "Arm";
  touching.objectName = "table";
  touching.contact.link = 1;
  touching.contact.verdict = Verdict::Contact;
  touching.contact.toi = touching.contact.freeUntil = 0.25;
  touching.contact.triangle = 3;
  touching.contact.nhat_SL_W = {0.0, 1.0, 0.0};
  return message;
}

template <typename Change>
Reject contactsAfter(Change change) {
  return rejectAfter(fourLinks(), change);
}

TEST(DecodeContacts, AcceptsTheAnswerThatIsChangedBelow) {
  EXPECT_EQ(contactsAfter([](ContactsMessage&) {}), Reject::None);
}

TEST(DecodeContacts, GivesTheTimeOfImpactOfContactsAlone) {
  ContactsMessage decoded;
  ASSERT_EQ(decode(bytesOf(fourLinks()), decoded), Reject::None);
  EXPECT_EQ(decoded.contacts[0].contact.toi, 0.0);  // as freeUntil
  EXPECT_EQ(decoded.contacts[0].contact.freeUntil, 0.0);
  EXPECT_EQ(decoded.contacts[1].contact.toi, 0.25);
  EXPECT_EQ(decoded.contacts[1].contact.lss, -1);
}

TEST(DecodeContacts, RefusesCodesThatDoNotExist) {
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.verdicts[0] = static_cast<Verdict>(4); }),
            Reject::OutOfRange);
  for (const int bad : {-1, 3, 127}) {
    EXPECT_EQ(contactsAfter([&](ContactsMessage& m) { m.kind = static_cast<StepKind>(bad); }),
              Reject::OutOfRange);
  }
  const auto first = [](int bad) {
    return contactsAfter([&](ContactsMessage& m) {
      m.contacts[0].contact.reason = static_cast<UndecidedReason>(bad);
    });
  };
  EXPECT_EQ(first(kNumUndecidedReasons), Reject::OutOfRange);
  EXPECT_EQ(first(0), Reject::OutOfRange);  // undecided without a reason
  const auto second = [](auto change) {
    return contactsAfter([&](ContactsMessage& m) { change(m.contacts[1]); });
  };
  EXPECT_EQ(second([](AnsweredContact& c) { c.contact.reason = UndecidedReason::Gap; }),
            Reject::OutOfRange);
  const auto beyond = static_cast<FeatureKind>(3);
  EXPECT_EQ(second([&](AnsweredContact& c) { c.contact.linkFeature = beyond; }),
            Reject::OutOfRange);
  EXPECT_EQ(second([&](AnsweredContact& c) { c.contact.sceneFeature = beyond; }),
            Reject::OutOfRange);
  EXPECT_EQ(second([](AnsweredContact& c) { c.contact.triangle = -2; }), Reject::OutOfRange);
  EXPECT_EQ(second([](AnsweredContact& c) { c.contact.linkTriangle = -2; }), Reject::OutOfRange);
}

TEST(DecodeContacts, RefusesFidelitiesThatDoNotExist) {
  Bytes bytes = bytesOf(fourLinks());
  const std::string word = "link";
  const auto place = std::search(bytes.begin(), bytes.end(), word.begin(), word.end());
  ASSERT_NE(place, bytes.end());
  *place = 'L';
  ContactsMessage decoded;
  EXPECT_EQ(decode(bytes, decoded), Reject::OutOfRange);
}

TEST(DecodeContacts, RefusesLinksThatDoNotFitTheVerdicts) {
  for (const LinkId bad :
       {-1, 4, std::numeric_limits<LinkId>::max(), 0, 2}) {  // 0: clear; 2: twice
    EXPECT_EQ(contactsAfter([&](ContactsMessage& m) { m.contacts[1].contact.link = bad; }),
              Reject::BadIndex)
        << bad;
  }
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.contacts.pop_back(); }), Reject::BadIndex);
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.verdicts[3] = Verdict::Undecided; }),
            Reject::BadIndex);
}

TEST(DecodeContacts, RefusesBadNames) {
  for (const char* const bad : {"", "a\nb", "\xff"}) {
    EXPECT_EQ(contactsAfter([&](ContactsMessage& m) { m.contacts[0].linkName = bad; }),
              Reject::BadName);
  }
}

TEST(DecodeContacts, RefusesNumbersThatAreNotFinite) {
  const auto after = [](auto change) {
    return contactsAfter([&](ContactsMessage& m) { change(m.contacts[1].contact); });
  };
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.tolerance = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.queryUs = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(after([](LinkContact& c) { c.freeUntil = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(after([](LinkContact& c) { c.separation = kInfinity; }), Reject::NonFinite);
  EXPECT_EQ(after([](LinkContact& c) { c.penetration = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(after([](LinkContact& c) { c.p_WScene.y() = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(after([](LinkContact& c) { c.p_WLink.z() = -kInfinity; }), Reject::NonFinite);
  EXPECT_EQ(after([](LinkContact& c) { c.nhat_SL_W.x() = kNaN; }), Reject::NonFinite);
}

TEST(DecodeContacts, RefusesNumbersOutOfRange) {
  const auto after = [](auto change) {
    return contactsAfter([&](ContactsMessage& m) { change(m.contacts[1].contact); });
  };
  EXPECT_EQ(after([](LinkContact& c) { c.freeUntil = 1.0000001; }), Reject::OutOfRange);
  EXPECT_EQ(after([](LinkContact& c) { c.freeUntil = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(after([](LinkContact& c) { c.separation = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(after([](LinkContact& c) { c.penetration = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.tolerance = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.queryUs = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.sequenceFrom = 9; }), Reject::OutOfRange);
  EXPECT_EQ(contactsAfter([](ContactsMessage& m) { m.utimeFromUs = 201; }), Reject::OutOfRange);
  for (auto ContactsMessage::*const field :
       {&ContactsMessage::session, &ContactsMessage::sequenceFrom, &ContactsMessage::sequenceTo,
        &ContactsMessage::utimeFromUs, &ContactsMessage::utimeToUs, &ContactsMessage::lost,
        &ContactsMessage::workBudget, &ContactsMessage::receiveUtimeUs,
        &ContactsMessage::sendUtimeUs}) {
    for (const std::int64_t bad : {std::int64_t{-1}, kTooLarge}) {
      EXPECT_EQ(contactsAfter([&](ContactsMessage& m) { m.*field = bad; }), Reject::OutOfRange);
    }
  }
}

TEST(DecodeContacts, WritesNothingOfAContactWhereThereIsNone) {
  ContactsMessage message = fourLinks();
  LinkContact& undecided = message.contacts[0].contact;
  undecided.separation = undecided.penetration = 1.0;
  undecided.p_WScene = undecided.p_WLink = undecided.nhat_SL_W = {1.0, 2.0, 3.0};
  undecided.triangle = undecided.linkTriangle = 5;
  message.contacts[0].objectName = "table";
  EXPECT_EQ(bytesOf(message), bytesOf(fourLinks()));
}

TEST(DecodeContacts, VerdictsAreAllButStampsAndTimeTaken) {
  ContactsMessage message = fourLinks();
  const Bytes bytes = bytesOf(message);
  message.receiveUtimeUs = 12345;
  message.sendUtimeUs = 67890;
  message.queryUs = 55.5;
  const Bytes later = bytesOf(message);
  const ByteView verdicts = verdictBytes(bytes);
  EXPECT_EQ(verdicts.size, bytes.size() - 24);
  EXPECT_TRUE(std::equal(verdicts.data, verdicts.data + verdicts.size, later.data()));
  message.lost = 1;
  const Bytes other = bytesOf(message);
  EXPECT_FALSE(std::equal(verdicts.data, verdicts.data + verdicts.size, other.data()));
  EXPECT_EQ(verdictBytes(ByteView(bytes.data(), 23)).size, 0u);
}

// --- person_t

/// Two links, of which one surely touched the scene, and perhaps the other; a broken bound.
PersonMessage twoBrackets() {
  PersonMessage message;
  message.kind = StepKind::Consecutive;
  message.sequenceTo = message.utimeToUs = 2;
  message.aheadUs = 100;
  message.verdicts = {BracketVerdict::Excluded, BracketVerdict::Certain};
  message.notBeforeUs = {102, -1};
  message.brackets.resize(2);
  for (ToldBracket& told : message.brackets) {
    told.linkName = "Hand";
    told.otherName = "table";
    told.bracket.link = 1;
    told.bracket.verdict = BracketVerdict::Certain;
  }
  message.brackets[0].bracket.triangle = 3;
  message.brackets[1].bracket.other = 0;
  message.brackets[1].bracket.verdict = BracketVerdict::Possible;
  message.broken = {{1, BrokenBound::Claim::Ahead, 0.01}};
  return message;
}

template <typename Change>
Reject personAfter(Change change) {
  return rejectAfter(twoBrackets(), change);
}

TEST(DecodePerson, AcceptsTheMessageThatIsChangedBelow) {
  EXPECT_EQ(personAfter([](PersonMessage&) {}), Reject::None);
}

TEST(DecodePerson, RefusesCodesThatDoNotExist) {
  using M = PersonMessage;
  const auto out = Reject::OutOfRange;
  EXPECT_EQ(personAfter([](M& m) { m.model = static_cast<MotionModel>(3); }), out);
  EXPECT_EQ(personAfter([](M& m) { m.kind = static_cast<StepKind>(3); }), out);
  EXPECT_EQ(personAfter([](M& m) { m.verdicts[0] = static_cast<BracketVerdict>(4); }), out);
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].bracket.verdict = BracketVerdict::Excluded; }),
            out);
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].bracket.verdict = BracketVerdict::Unclaimed; }),
            out);
  EXPECT_EQ(personAfter([](M& m) { m.broken[0].claim = static_cast<BrokenBound::Claim>(2); }), out);
}

/// The decoder of LCM is used again, and leaves arrays of no length as they were.
TEST(DecodePerson, KeepsNothingOfTheMessageBefore) {
  Bytes bytes;
  PersonMessage read;
  encode(twoBrackets(), bytes);
  ASSERT_EQ(decode(bytes, read), Reject::None);
  ASSERT_FALSE(read.notBeforeUs.empty());
  PersonMessage none = twoBrackets();
  none.verdicts.clear();
  none.notBeforeUs.clear();
  none.brackets.clear();
  none.broken.clear();
  encode(none, bytes);
  ASSERT_EQ(decode(bytes, read), Reject::None);
  EXPECT_TRUE(read.notBeforeUs.empty());
  EXPECT_TRUE(read.verdicts.empty());
  EXPECT_TRUE(read.brackets.empty());
}

TEST(DecodePerson, RefusesNumbersOutOfRange) {
  using M = PersonMessage;
  const auto out = Reject::OutOfRange;
  EXPECT_EQ(personAfter([](M& m) { m.sequenceFrom = 3; }), out);
  EXPECT_EQ(personAfter([](M& m) { m.utimeFromUs = 3; }), out);
  EXPECT_EQ(personAfter([](M& m) { m.notBeforeUs[1] = -2; }), out);
  EXPECT_EQ(personAfter([](M& m) { m.aheadUs = -1; }), out);
  EXPECT_EQ(personAfter([](M& m) { m.bracketsLeftOut = -1; }), out);
  EXPECT_EQ(personAfter([](M& m) { m.resolution = -1.0; }), out);
  EXPECT_EQ(personAfter([](M& m) { m.resolution = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(personAfter([](M& m) { m.personUs = kInfinity; }), Reject::NonFinite);
  EXPECT_EQ(personAfter([](M& m) { m.broken[0].beyond = -0.1; }), out);
  EXPECT_EQ(personAfter([](M& m) { m.broken[0].beyond = kNaN; }), Reject::NonFinite);
  for (double LinkBracket::*const t : {&LinkBracket::possibleFrom, &LinkBracket::possibleUntil,
                                       &LinkBracket::certainFrom, &LinkBracket::certainUntil}) {
    EXPECT_EQ(personAfter([&](M& m) { m.brackets[0].bracket.*t = 1.5; }), out);
    EXPECT_EQ(personAfter([&](M& m) { m.brackets[0].bracket.*t = -0.1; }), out);
    EXPECT_EQ(personAfter([&](M& m) { m.brackets[0].bracket.*t = kNaN; }), Reject::NonFinite);
  }
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].bracket.growth = -1e-9; }), out);
}

TEST(DecodePerson, RefusesLinksThatAreNone) {
  using M = PersonMessage;
  const auto bad = Reject::BadIndex;
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].bracket.link = 2; }), bad);
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].bracket.link = -1; }), bad);
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].bracket.triangle = -2; }), bad);
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].bracket.other = 0; }), bad);  // both
  EXPECT_EQ(personAfter([](M& m) { m.brackets[1].bracket.other = 1; }), bad);
  EXPECT_EQ(personAfter([](M& m) { m.brackets[1].bracket.other = 2; }), bad);
  EXPECT_EQ(personAfter([](M& m) { m.broken[0].link = 2; }), bad);
  EXPECT_EQ(personAfter([](M& m) { m.brackets[0].linkName.clear(); }), Reject::BadName);
}

// --- solid_t

/// Two joints, two poses on the way, a contact with the scene and one of the own links.
SolidMessage twoPoses() {
  SolidMessage message;
  message.state = SolidState::Sliding;
  message.isCertified = true;
  message.joints = {SolidJointState::Free, SolidJointState::Sliding};
  message.linkDeviation = {0.0, 0.01};
  const Pose pose{{Quaternion::Identity(), Quaternion(0.6, 0.8, 0.0, 0.0)},
                  {Eigen::Vector3d(0.0, 1.0, 0.0), Eigen::Vector3d(0.0, 0.4, -0.0)}};
  message.way = {pose, pose};
  message.times = {0.5, 1.0};
  message.contacts.resize(2);
  for (ShownContact& shown : message.contacts) {
    shown.linkName = "Hand";
    shown.otherName = "table";
    shown.contact.link = 1;
    shown.contact.nhat_W = {0.0, 1.0, 0.0};
  }
  message.contacts[0].contact.triangle = 3;
  message.contacts[1].contact.other = 0;
  return message;
}

template <typename Change>
Reject solidAfter(Change change) {
  return rejectAfter(twoPoses(), change);
}

TEST(DecodeSolid, AcceptsTheMessageThatIsChangedBelow) {
  EXPECT_EQ(solidAfter([](SolidMessage&) {}), Reject::None);
}

TEST(DecodeSolid, KeepsEveryBitOfPosesThatAreUnit) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const SolidMessage message = test::randomSolidMessage(random, 5, 3, 0);
    SolidMessage decoded;
    ASSERT_EQ(decode(bytesOf(message), decoded), Reject::None);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < 5; ++j) {
        ASSERT_EQ(decoded.way[k].rotations[j].coeffs(), message.way[k].rotations[j].coeffs());
        ASSERT_EQ(decoded.way[k].translations[j], message.way[k].translations[j]);
      }
    }
  }
}

TEST(DecodeSolid, RefusesCodesThatDoNotExist) {
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.state = static_cast<SolidState>(7); }),
            Reject::OutOfRange);
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.limit = static_cast<SolidLimit>(4); }),
            Reject::OutOfRange);
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.kind = static_cast<StepKind>(3); }),
            Reject::OutOfRange);
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.joints[1] = static_cast<SolidJointState>(4); }),
            Reject::OutOfRange);
}

TEST(DecodeSolid, RefusesTimesThatDoNotAscendToOne) {
  for (const auto& times :
       {std::vector<double>{0.5, 0.5}, {0.6, 0.5}, {0.5, 1.0000001}, {-0.5, 1.0}, {0.5, kNaN}}) {
    EXPECT_EQ(solidAfter([&](SolidMessage& m) { m.times = times; }), Reject::OutOfRange);
  }
  EXPECT_EQ(solidAfter([](SolidMessage& m) {
              m.way.resize(1);
              m.times = {0.0};
            }),
            Reject::None);
}

TEST(DecodeSolid, RefusesPosesThatAreNone) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(solidAfter([&](SolidMessage& m) { m.way[0].rotations[1].x() = bad; }),
              Reject::NonFinite);
    EXPECT_EQ(solidAfter([&](SolidMessage& m) { m.way[1].translations[0].z() = bad; }),
              Reject::NonFinite);
  }
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.way[0].rotations[0].w() = 1.0011; }),
            Reject::NonUnit);
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.way[0].translations[0].x() = 1.0000001e7; }),
            Reject::OutOfRange);
}

TEST(DecodeSolid, RefusesContactsOfNothing) {
  const auto after = [](auto change) {
    return solidAfter([&](SolidMessage& m) { change(m.contacts[0].contact); });
  };
  EXPECT_EQ(after([](SolidContact& c) { c.link = 2; }), Reject::BadIndex);
  EXPECT_EQ(after([](SolidContact& c) { c.link = -1; }), Reject::BadIndex);
  EXPECT_EQ(after([](SolidContact& c) { c.lss = -2; }), Reject::BadIndex);
  EXPECT_EQ(after([](SolidContact& c) { c.triangle = -1; }), Reject::BadIndex);
  EXPECT_EQ(after([](SolidContact& c) { c.other = 0; }), Reject::BadIndex);  // both
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.contacts[1].contact.other = 1; }),
            Reject::BadIndex);  // itself
  EXPECT_EQ(after([](SolidContact& c) { c.gap = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(after([](SolidContact& c) { c.push = kInfinity; }), Reject::NonFinite);
  EXPECT_EQ(after([](SolidContact& c) { c.p_W.y() = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(after([](SolidContact& c) { c.nhat_W.y() = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(after([](SolidContact& c) { c.nhat_W *= 1.001; }), Reject::OutOfRange);
  EXPECT_EQ(after([](SolidContact& c) { c.push = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(after([](SolidContact& c) { c.slipSpeed = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.contacts[0].linkName = "\xff"; }), Reject::BadName);
}

TEST(DecodeSolid, RefusesNumbersOutOfRange) {
  for (auto SolidMessage::*const field :
       {&SolidMessage::skin, &SolidMessage::tolerance, &SolidMessage::catchUp,
        &SolidMessage::deviation, &SolidMessage::lift, &SolidMessage::clearance,
        &SolidMessage::solidUs}) {
    EXPECT_EQ(solidAfter([&](SolidMessage& m) { m.*field = kNaN; }), Reject::NonFinite);
    EXPECT_EQ(solidAfter([&](SolidMessage& m) { m.*field = -1e-9; }), Reject::OutOfRange);
  }
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.linkDeviation[1] = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.linkDeviation[1] = -1.0; }), Reject::OutOfRange);
  for (auto SolidMessage::*const field :
       {&SolidMessage::session, &SolidMessage::sequence, &SolidMessage::utimeUs,
        &SolidMessage::lost, &SolidMessage::stepUs, &SolidMessage::workBudget,
        &SolidMessage::receiveUtimeUs, &SolidMessage::sendUtimeUs}) {
    for (const std::int64_t bad : {std::int64_t{-1}, kTooLarge}) {
      EXPECT_EQ(solidAfter([&](SolidMessage& m) { m.*field = bad; }), Reject::OutOfRange);
    }
  }
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.snapInUs = -2; }), Reject::OutOfRange);
  EXPECT_EQ(solidAfter([](SolidMessage& m) { m.contactsLeftOut = -1; }), Reject::OutOfRange);
}

// --- pushes_t

/// A body that presses and crushes another one.
PushesMessage onePush() {
  PushesMessage message;
  message.avatar = 1;
  message.contacts.resize(1);
  message.contacts[0].linkName = "Hand";
  message.contacts[0].contact.body = 2;
  message.contacts[0].contact.link = 3;
  message.contacts[0].contact.nhat_W = {0.0, 1.0, 0.0};
  message.crushes.resize(1);
  message.crushes[0].linkName = "Hand";
  message.crushes[0].crush.body = 2;
  return message;
}

template <typename Change>
Reject pushesAfter(Change change) {
  return rejectAfter(onePush(), change);
}

TEST(DecodePushes, RefusesPairsThatAreNone) {
  EXPECT_EQ(pushesAfter([](PushesMessage&) {}), Reject::None);
  const auto push = [](auto change) {
    return pushesAfter([&](PushesMessage& m) { change(m.contacts[0].contact); });
  };
  EXPECT_EQ(push([](SolidBodyContact& c) { c.body = -1; }), Reject::BadIndex);
  EXPECT_EQ(push([](SolidBodyContact& c) { c.body = 1; }), Reject::BadIndex);  // itself
  EXPECT_EQ(push([](SolidBodyContact& c) { c.link = -1; }), Reject::BadIndex);
  EXPECT_EQ(push([](SolidBodyContact& c) { c.link = kMaxJoints; }), Reject::BadIndex);
  EXPECT_EQ(push([](SolidBodyContact& c) { c.lss = -2; }), Reject::BadIndex);
  EXPECT_EQ(push([](SolidBodyContact& c) { c.triangle = -2; }), Reject::BadIndex);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.crushes[0].crush.body = 1; }), Reject::BadIndex);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.crushes[0].crush.link = -1; }), Reject::BadIndex);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.avatar = -1; }), Reject::BadIndex);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.contacts[0].linkName = "\xff"; }),
            Reject::BadName);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.crushes[0].linkName.clear(); }), Reject::BadName);
}

TEST(DecodePushes, RefusesNumbersThatAreNone) {
  const auto push = [](auto change) {
    return pushesAfter([&](PushesMessage& m) { change(m.contacts[0].contact); });
  };
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(push([&](SolidBodyContact& c) { c.push = bad; }), Reject::NonFinite);
    EXPECT_EQ(push([&](SolidBodyContact& c) { c.p_W.y() = bad; }), Reject::NonFinite);
    EXPECT_EQ(push([&](SolidBodyContact& c) { c.nhat_W.y() = bad; }), Reject::NonFinite);
    EXPECT_EQ(push([&](SolidBodyContact& c) { c.gap = bad; }), Reject::NonFinite);
    EXPECT_EQ(pushesAfter([&](PushesMessage& m) { m.crushes[0].crush.depth = bad; }),
              Reject::NonFinite);
    EXPECT_EQ(pushesAfter([&](PushesMessage& m) { m.tickUs = bad; }), Reject::NonFinite);
  }
  EXPECT_EQ(push([](SolidBodyContact& c) { c.push = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(push([](SolidBodyContact& c) { c.slipSpeed = -1e-9; }), Reject::OutOfRange);
  EXPECT_EQ(push([](SolidBodyContact& c) { c.nhat_W *= 1.001; }), Reject::OutOfRange);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.crushes[0].crush.depth = -1e-9; }),
            Reject::OutOfRange);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.crushes[0].crush.sinceUs = -1; }),
            Reject::OutOfRange);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.contactsLeftOut = -1; }), Reject::OutOfRange);
  EXPECT_EQ(pushesAfter([](PushesMessage& m) { m.crushesLeftOut = -1; }), Reject::OutOfRange);
  for (auto PushesMessage::*const field :
       {&PushesMessage::session, &PushesMessage::sequence, &PushesMessage::utimeUs,
        &PushesMessage::stepUs, &PushesMessage::timeline, &PushesMessage::receiveUtimeUs,
        &PushesMessage::sendUtimeUs}) {
    for (const std::int64_t bad : {std::int64_t{-1}, kTooLarge}) {
      EXPECT_EQ(pushesAfter([&](PushesMessage& m) { m.*field = bad; }), Reject::OutOfRange);
    }
  }
}

TEST(DecodePushes, LargestSurvives) {
  Random random(1);
  PushesMessage message = test::randomPushesMessage(random, kMaxToldPushes);
  for (ToldPush& told : message.contacts) told.linkName.assign(kMaxNameBytes, 'n');
  for (ToldCrush& told : message.crushes) told.linkName.assign(kMaxNameBytes, 'n');
  const Bytes bytes = bytesOf(message);
  EXPECT_LE(bytes.size(), kMaxMessageBytes);
  EXPECT_EQ(decode(bytes, message), Reject::None);
}

// --- status_t

template <typename Change>
Reject statusAfter(Change change) {
  StatusMessage message;
  message.counts = {{"length", 3}};
  return rejectAfter(message, change);
}

TEST(DecodeStatus, RefusesCountsOutOfRange) {
  EXPECT_EQ(statusAfter([](StatusMessage&) {}), Reject::None);
  for (const std::int64_t bad : {std::int64_t{-1}, kTooLarge}) {
    for (auto StatusMessage::*const field :
         {&StatusMessage::utimeUs, &StatusMessage::startUtimeUs, &StatusMessage::received,
          &StatusMessage::answered, &StatusMessage::rejected, &StatusMessage::lost,
          &StatusMessage::gaps, &StatusMessage::waiting, &StatusMessage::publishFailures,
          &StatusMessage::journalFailures, &StatusMessage::kernelDrops}) {
      EXPECT_EQ(statusAfter([&](StatusMessage& m) { m.*field = bad; }), Reject::OutOfRange);
    }
    EXPECT_EQ(statusAfter([&](StatusMessage& m) { m.counts[0].count = bad; }), Reject::OutOfRange);
  }
  EXPECT_EQ(statusAfter([](StatusMessage& m) { m.numAvatars = -1; }), Reject::OutOfRange);
  EXPECT_EQ(statusAfter([](StatusMessage& m) { m.numWorkers = -1; }), Reject::OutOfRange);
}

TEST(DecodeStatus, RefusesLatenciesThatAreNone) {
  for (auto StatusMessage::*const field :
       {&StatusMessage::latencyP50Us, &StatusMessage::latencyP99Us, &StatusMessage::latencyMaxUs,
        &StatusMessage::queryP50Us, &StatusMessage::queryP99Us, &StatusMessage::queryMaxUs}) {
    EXPECT_EQ(statusAfter([&](StatusMessage& m) { m.*field = kNaN; }), Reject::NonFinite);
    EXPECT_EQ(statusAfter([&](StatusMessage& m) { m.*field = -1.0; }), Reject::OutOfRange);
  }
}

TEST(DecodeRigidPose, RefusesABodyTwiceAndForgetsItInTheNextMessage) {
  RigidPoseMessage message, read;
  message.bodies = {{1, kJointValid | kJointTracked, {}}, {2, 0, {}}};
  Bytes bytes;
  encode(message, bytes);
  EXPECT_EQ(decode(bytes, read), Reject::None);
  message.bodies[1].body = 1;
  encode(message, bytes);
  EXPECT_EQ(decode(bytes, read), Reject::BadIndex);
  message.bodies.clear();
  encode(message, bytes);
  EXPECT_EQ(decode(bytes, read), Reject::None) << "the decoder of LCM leaves arrays of no length";
  EXPECT_TRUE(read.bodies.empty());
}

}  // namespace
}  // namespace foretouch
