#include "network/stream/stream_solver.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/query/query.h"
#include "network/wire/codec.h"
#include "tests/network/small_stream.h"
#include "tests/support/allocation_count.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::kStepUs;
using test::nthPose;
using test::Random;
using test::skeletonMessage;
using test::smallAvatar;
using test::smallSkeleton;

constexpr std::int32_t kAvatar = 7;

/// A wall across x = 1 and, out of reach, a floor.
Scene wall() {
  RawScene raw;
  raw.objectNames = {"a wall of bricks", "floor"};
  raw.triangles.push_back({Vector3d(1, -5, -5), Vector3d(1, 9, -5), Vector3d(1, 0, 9)});
  raw.triangles.push_back({Vector3d(-5, -9, -5), Vector3d(5, -9, -5), Vector3d(0, -9, 5)});
  raw.objectOf = {0, 1};
  return Scene::build(raw).value();
}

PoseMessage poseAt(double x, std::int64_t sequence, std::int64_t utimeUs) {
  PoseMessage message = test::poseMessage(smallSkeleton(), sequence, utimeUs);
  message.avatar = kAvatar;
  message.translations[0].translation = {x, 1.0, 0.0};
  return message;
}

class Solver : public testing::Test {
 protected:
  Solver() : solver_(StreamSolver::make(kAvatar, smallAvatar(), wall(), options(), {}).value()) {
    SkeletonMessage message = skeletonMessage(smallSkeleton());
    message.avatar = kAvatar;
    EXPECT_EQ(solver_.take(message), Reject::None);
  }
  static QueryOptions options() { return {}; }

  /// Answered at these places, one pose after another.
  void move(double x, std::int64_t sequence) {
    ASSERT_EQ(solver_.take(poseAt(x, sequence, sequence * kStepUs), answer_), Reject::None);
  }
  [[nodiscard]] const AnsweredContact& contactOf(LinkId link) const {
    for (const AnsweredContact& contact : answer_.contacts) {
      if (contact.contact.link == link) return contact;
    }
    static const AnsweredContact none;
    return none;
  }

  StreamSolver solver_;
  ContactsMessage answer_;
};

TEST(StreamSolverOptions, ThatAreRefused) {
  const auto fieldOf = [](const QueryOptions& options, const StreamPolicy& policy = {}) {
    const auto made = StreamSolver::make(kAvatar, smallAvatar(), wall(), options, policy);
    return made.ok() ? std::string() : made.error().file;
  };
  EXPECT_EQ(fieldOf({}), "");
  QueryOptions options;
  options.scope = Scope::FirstOfAvatar;
  EXPECT_EQ(fieldOf(options), "scope");
  options = {};
  options.tolerance = -1.0;
  EXPECT_EQ(fieldOf(options), "tolerance");
  options = {};
  options.fidelity = Fidelity::Exact;
  EXPECT_EQ(fieldOf(options), "fidelity");
  options = {};
  options.ignored.push_back({40, 0});
  EXPECT_EQ(fieldOf(options), "ignored");
  StreamPolicy policy;
  policy.confirmations = 0;
  EXPECT_EQ(fieldOf({}, policy), "confirmations");
}

TEST_F(Solver, KnowsNoOtherAvatar) {
  SkeletonMessage skeleton = skeletonMessage(smallSkeleton());
  skeleton.avatar = kAvatar + 1;
  EXPECT_EQ(solver_.take(skeleton), Reject::UnknownAvatar);
  PoseMessage pose = poseAt(0.0, 0, 0);
  pose.avatar = kAvatar + 1;
  EXPECT_EQ(solver_.take(pose, answer_), Reject::UnknownAvatar);
  EXPECT_EQ(solver_.counts().poses, 0U);
  EXPECT_EQ(solver_.id(), kAvatar);
}

TEST_F(Solver, AnswersTheFirstPoseAsAnInstant) {
  answer_.receiveUtimeUs = 5;
  answer_.sendUtimeUs = 6;
  move(-1.0, 3);
  EXPECT_EQ(answer_.avatar, kAvatar);
  EXPECT_EQ(answer_.kind, StepKind::First);
  EXPECT_EQ(answer_.sequenceFrom, 3);
  EXPECT_EQ(answer_.sequenceTo, 3);
  EXPECT_EQ(answer_.utimeFromUs, answer_.utimeToUs);
  EXPECT_EQ(answer_.verdicts, std::vector<Verdict>(4, Verdict::Clear));
  EXPECT_TRUE(answer_.contacts.empty());
  EXPECT_EQ(answer_.tolerance, options().tolerance);
  EXPECT_EQ(answer_.workBudget, 0);
  EXPECT_EQ(answer_.skeletonHash, skeletonHash(smallSkeleton()));
  EXPECT_EQ(answer_.receiveUtimeUs, 5);
  EXPECT_EQ(answer_.sendUtimeUs, 6);
}

TEST_F(Solver, FindsAContactBetweenTwoPosesThatTouchNothing) {
  move(0.0, 0);
  ASSERT_TRUE(answer_.contacts.empty());
  move(2.0, 1);
  EXPECT_EQ(answer_.kind, StepKind::Consecutive);
  EXPECT_EQ(answer_.verdicts, std::vector<Verdict>(4, Verdict::Contact));
  ASSERT_EQ(answer_.contacts.size(), 4U);
  // The arm and the hand are 0.2 m before the hips, the leg 0.1 m; of the two the lower link first.
  std::vector<std::string> names;
  for (const AnsweredContact& contact : answer_.contacts) names.push_back(contact.linkName);
  EXPECT_EQ(names, (std::vector<std::string>{"Arm", "Hand", "Leg", "Hips"}));
  const AnsweredContact& hips = answer_.contacts.back();
  EXPECT_EQ(hips.objectName, "a wall of bricks");
  EXPECT_EQ(hips.contact.reason, UndecidedReason::None);
  EXPECT_EQ(hips.contact.lss, -1);
  EXPECT_NEAR(hips.contact.toi, 0.475, 1e-3);
  EXPECT_LE(hips.contact.toi, 0.475);
}

TEST_F(Solver, ClaimsNothingAcrossAGapButContacts) {
  move(0.0, 0);
  move(0.0, 4);
  EXPECT_EQ(answer_.kind, StepKind::AcrossGap);
  EXPECT_EQ(answer_.lost, 3);
  EXPECT_EQ(answer_.verdicts, std::vector<Verdict>(4, Verdict::Undecided));
  ASSERT_EQ(answer_.contacts.size(), 4U);
  for (const AnsweredContact& contact : answer_.contacts) {
    EXPECT_EQ(contact.contact.reason, UndecidedReason::Gap);
    EXPECT_EQ(contact.contact.freeUntil, 0.0);
  }
  move(0.85, 7);  // arm and hand reach the wall
  EXPECT_EQ(answer_.verdicts[test::kArm], Verdict::Contact);
  EXPECT_EQ(contactOf(test::kHips).contact.reason, UndecidedReason::Gap);
  EXPECT_EQ(answer_.contacts[0].linkName, "Hips");  // at 0, before what touches later
  move(0.85, 8);
  EXPECT_EQ(answer_.verdicts[test::kArm], Verdict::StartsInContact);
  EXPECT_EQ(answer_.verdicts[test::kHips], Verdict::Clear);
}

TEST_F(Solver, ClaimsNothingBelowAnUnknownJoint) {
  move(0.0, 0);
  PoseMessage pose = poseAt(2.0, 1, kStepUs);  // all go through the wall
  pose.joints[test::kArm].flags = kJointValid;
  ASSERT_EQ(solver_.take(pose, answer_), Reject::None);
  EXPECT_EQ(answer_.verdicts, (std::vector<Verdict>{Verdict::Contact, Verdict::Undecided,
                                                    Verdict::Undecided, Verdict::Contact}));
  EXPECT_EQ(contactOf(test::kHand).contact.reason, UndecidedReason::StaleJoint);
  EXPECT_EQ(contactOf(test::kHand).contact.freeUntil, 0.0);
  EXPECT_EQ(contactOf(test::kHand).contact.triangle, -1);
}

TEST_F(Solver, AllocatesNothingAnAnswerOnceItHasGrown) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  std::vector<PoseMessage> poses;
  for (std::int64_t n = 0; n < 100; ++n) {  // to and fro through the wall: four contacts each
    poses.push_back(poseAt(n % 2 == 0 ? 0.0 : 2.0, n, n * kStepUs));
  }
  std::uint64_t before = 0;
  for (const PoseMessage& pose : poses) {
    if (pose.sequence == 3) before = test::numAllocations();
    ASSERT_EQ(solver_.take(pose, answer_), Reject::None);
  }
  EXPECT_EQ(test::numAllocations(), before);
  EXPECT_EQ(answer_.contacts.size(), 4U);
}

TEST(StreamSolverOptions, RefuseWhatAStreamCannotBeAnsweredWith) {
  const auto refusal = [](auto change) {
    QueryOptions options;
    change(options);
    const auto solver = StreamSolver::make(0, smallAvatar(), wall(), options, {});
    return solver.ok() ? std::string() : solver.error().file;
  };
  EXPECT_EQ(refusal([](QueryOptions&) {}), "");
  EXPECT_EQ(refusal([](QueryOptions& o) { o.scope = Scope::FirstOfAvatar; }), "scope");
  EXPECT_EQ(refusal([](QueryOptions& o) { o.deadlineUs = 100.0; }), "deadline");
}

TEST(StreamSolverBudget, IsSaidAndItsReasonPassedOn) {
  QueryOptions options;
  options.workBudget = 1;
  StreamSolver solver = StreamSolver::make(0, smallAvatar(), wall(), options, {}).value();
  ASSERT_EQ(solver.take(skeletonMessage(smallSkeleton())), Reject::None);
  ContactsMessage answer;
  PoseMessage pose = poseAt(0.0, 0, 0);
  pose.avatar = 0;
  ASSERT_EQ(solver.take(pose, answer), Reject::None);
  pose = poseAt(2.0, 1, kStepUs);
  pose.avatar = 0;
  ASSERT_EQ(solver.take(pose, answer), Reject::None);
  EXPECT_EQ(answer.workBudget, 1);
  ASSERT_FALSE(answer.contacts.empty());
  EXPECT_EQ(answer.contacts[0].contact.verdict, Verdict::Undecided);
  EXPECT_EQ(answer.contacts[0].contact.reason, UndecidedReason::WorkBudget);
}

// Of skins: a triangle that an unknown link pulls along is not known, whichever link it is told of.
TEST(StreamSolverSkin, IsUnknownWhereALinkThatMovesItIs) {
  Skin skin;
  const auto vertex = [&](double x, double y, LinkId second) {
    std::vector<SkinInfluence> influences{{test::kLeg, 0.75, {x, y, 0.0}}};
    influences.push_back({second, 0.25, {x, y, 0.0}});
    skin.vertices.push_back(influences);
  };
  vertex(0.0, 0.0, test::kHips);
  vertex(0.1, 0.0, test::kHips);
  vertex(0.0, 0.1, test::kHand);
  skin.triangles = {{0, 1, 2}};
  QueryOptions options;
  options.fidelity = Fidelity::Skinned;
  options.skin = SkinnedSurface::build(smallAvatar(), skin, {0, 0, 0, 1}).value();
  EXPECT_EQ(options.skin->linksMoving(test::kLeg), (std::vector<LinkId>{0, 2, 3}));
  EXPECT_EQ(options.skin->linksMoving(test::kArm), std::vector<LinkId>{});
  StreamSolver solver = StreamSolver::make(kAvatar, smallAvatar(), wall(), options, {}).value();
  SkeletonMessage skeleton = skeletonMessage(smallSkeleton());
  skeleton.avatar = kAvatar;
  ASSERT_EQ(solver.take(skeleton), Reject::None);
  ContactsMessage answer;
  ASSERT_EQ(solver.take(poseAt(0.0, 0, 0), answer), Reject::None);
  EXPECT_EQ(answer.verdicts[test::kLeg], Verdict::Clear);
  PoseMessage pose = poseAt(0.0, 1, kStepUs);
  pose.joints[test::kArm].flags = 0;  // above the hand
  ASSERT_EQ(solver.take(pose, answer), Reject::None);
  EXPECT_EQ(answer.verdicts, (std::vector<Verdict>{Verdict::Clear, Verdict::Undecided,
                                                   Verdict::Undecided, Verdict::Undecided}));
}

// The same verdicts as the query itself gives of the same two poses, and as a second solver gives.
TEST_F(Solver, SaysWhatTheQuerySays) {
  Random random(11);
  StreamSolver second =
      std::move(StreamSolver::make(kAvatar, smallAvatar(), wall(), {}, {})).value();
  SkeletonMessage skeleton = skeletonMessage(smallSkeleton());
  skeleton.avatar = kAvatar;
  ASSERT_EQ(second.take(skeleton), Reject::None);
  const Avatar avatar = smallAvatar();
  const Scene scene = wall();
  Pose before;
  int touching = 0;
  for (std::int64_t n = 0; n < 200; ++n) {
    PoseMessage message = poseAt(random.uniform(0.3, 1.2), n, n * kStepUs);
    Pose pose = restPose(avatar.skeleton());
    pose.translations[0] = message.translations[0].translation;
    for (std::size_t j = 0; j < 4; ++j) {
      message.joints[j].rotation = random.rotation();
      pose.rotations[j] = message.joints[j].rotation;
    }
    pose = validatedPose(avatar.skeleton(), pose).value();
    ASSERT_EQ(solver_.take(message, answer_), Reject::None);
    const auto step =
        firstContacts(avatar, ChainMotion(avatar.skeleton(), n == 0 ? pose : before, pose), scene)
            .value();
    for (const LinkContact& expected : step.links) {
      EXPECT_EQ(answer_.verdicts[static_cast<std::size_t>(expected.link)], expected.verdict);
      if (expected.verdict == Verdict::Clear) continue;
      ++touching;
      const LinkContact& got = contactOf(expected.link).contact;
      EXPECT_EQ(got.toi, expected.toi);
      EXPECT_EQ(got.separation, expected.separation);
      EXPECT_EQ(got.penetration, expected.penetration);
      EXPECT_EQ(got.triangle, expected.triangle);
      EXPECT_EQ(got.p_WLink, expected.p_WLink);
    }
    ContactsMessage again;
    ASSERT_EQ(second.take(message, again), Reject::None);
    Bytes one, other;
    encode(answer_, one);
    encode(again, other);
    const ByteView verdicts = verdictBytes(one), verdictsAgain = verdictBytes(other);
    EXPECT_EQ(std::string(verdicts.data, verdicts.data + verdicts.size),
              std::string(verdictsAgain.data, verdictsAgain.data + verdictsAgain.size));
    before = pose;
  }
  EXPECT_GT(touching, 200);
}

}  // namespace
}  // namespace foretouch
