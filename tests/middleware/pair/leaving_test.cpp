// What happens at and after the first contact: a body that was stopped may leave again, and a hand
// that rests on the table still meets the cup.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/asked.h"
#include "tests/support/name_of_simd.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

class Leaving : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

/// A hand, 10 cm above a table's height for a place of (0, 0.1, 0), as one ball of 5 cm.
Avatar hand() {
  RawSkeleton raw;
  raw.joints.push_back({"hand", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  return Avatar::build(Skeleton::build(raw).value(), {{{Vector3d::Zero(), Vector3d::Zero(), 0.05}}})
      .value();
}

ChainMotion moved(const Avatar& avatar, const Vector3d& from, const Vector3d& to) {
  return {avatar.skeleton(), {{Quaternion::Identity()}, {from}}, {{Quaternion::Identity()}, {to}}};
}

/// A table at y = 0 and the side of a cup at x = 0.5.
Scene tableAndCup() {
  RawScene raw;
  raw.objectNames = {"table", "cup"};
  raw.triangles = {{{Vector3d(-2, 0, -2), Vector3d(2, 0, -2), Vector3d(0, 0, 4)}},
                   {{Vector3d(0.5, 0, -0.1), Vector3d(0.5, 0, 0.1), Vector3d(0.5, 0.3, 0)}}};
  raw.objectOf = {0, 1};
  return Scene::build(std::move(raw)).value();
}

LinkContact onlyContact(const Scene& scene, const Avatar& avatar, const ChainMotion& motion,
                        const QueryOptions& options) {
  Scratch scratch;
  return test::answerOf(avatar, motion, scene, options, scratch).links[0];
}

TEST_P(Leaving, AStoppedHandThatRetreatsIsFree) {
  const Scene scene = tableAndCup();
  const Avatar avatar = hand();
  QueryOptions options;
  const ChainMotion down = moved(avatar, {0, 0.3, 0}, {0, -0.3, 0});
  const LinkContact stop = onlyContact(scene, avatar, down, options);
  ASSERT_EQ(stop.verdict, Verdict::Contact);
  Pose stopped;
  down.poseAt(stop.toi, stopped);
  const Pose up{{Quaternion::Identity()}, {Vector3d(0, 0.3, 0)}};
  const ChainMotion away(avatar.skeleton(), stopped, up);
  const LinkContact held = onlyContact(scene, avatar, away, options);
  EXPECT_EQ(held.verdict, Verdict::Contact);
  EXPECT_EQ(held.toi, 0.0);
  options.passSeparating = true;
  EXPECT_EQ(onlyContact(scene, avatar, away, options).verdict, Verdict::Clear);
  // Further down it is still held, and along the table it goes until it meets the cup.
  const Pose below{{Quaternion::Identity()}, {Vector3d(0, -0.3, 0)}};
  const LinkContact again =
      onlyContact(scene, avatar, ChainMotion(avatar.skeleton(), stopped, below), options);
  EXPECT_EQ(again.verdict, Verdict::Contact);
  EXPECT_EQ(again.toi, 0.0);
  Pose beyond = stopped;
  beyond.translations[0].x() = 1.0;
  const LinkContact cup =
      onlyContact(scene, avatar, ChainMotion(avatar.skeleton(), stopped, beyond), options);
  ASSERT_EQ(cup.verdict, Verdict::Contact);
  EXPECT_NEAR(cup.toi, 0.45, 2e-3);
  EXPECT_EQ(scene.object(cup.triangle), 1);
}

TEST_P(Leaving, AHandThatTouchesIsNotLetThrough) {
  const Scene scene = tableAndCup();
  const Avatar avatar = hand();
  QueryOptions options;
  options.passSeparating = true;
  for (const double y : {0.04, 0.05, 0.05 + 1e-9}) {
    const LinkContact contact =
        onlyContact(scene, avatar, moved(avatar, {0, y, 0}, {0, 0.3, 0}), options);
    EXPECT_NE(contact.verdict, Verdict::Clear) << y;
    EXPECT_EQ(contact.freeUntil, 0.0) << y;
  }
}

// Leaving never lets anything touch: with the option, a link that begins apart stays free until
// what is said, and what is said is within a quarter of what it began with.
TEST_P(Leaving, KeepsThePromiseOnRandomSteps) {
  int left = 0, held = 0;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Scene scene = Scene::build(test::clutter(random, 150, 3, Vector3d::Zero())).value();
    const test::RandomBody body = test::bodyInClutter(random, 4, Vector3d::Zero());
    QueryOptions options;
    options.tolerance = 0.03;
    Scratch scratch;
    const StepContacts plain = test::answerOf(body.avatar, body.motion(), scene, options, scratch);
    options.passSeparating = true;
    const StepContacts passed = test::answerOf(body.avatar, body.motion(), scene, options, scratch);
    QueryOptions tiny;
    tiny.tolerance = 1e-7;
    const StepContacts truth = test::answerOf(body.avatar, body.motion(), scene, tiny, scratch);
    for (std::size_t link = 0; link < plain.links.size(); ++link) {
      const LinkContact &before = plain.links[link], &after = passed.links[link];
      if (before.verdict != Verdict::Contact || before.toi != 0.0) {
        EXPECT_EQ(before.freeUntil, after.freeUntil);
        EXPECT_EQ(before.verdict, after.verdict);
        continue;
      }
      const LinkContact& touch = truth.links[link];
      EXPECT_LE(after.freeUntil, touch.verdict == Verdict::Clear ? 1.0 : touch.freeUntil + 1e-6);
      if (after.verdict == Verdict::Contact && after.toi > 0.0) {
        EXPECT_LE(after.separation, 0.25 * before.separation);
      }
      (after.freeUntil > 0.0 ? left : held) += 1;
    }
  }
  EXPECT_GT(left, 20);
  EXPECT_GT(held, 20);
}

TEST_P(Leaving, EveryObjectHasItsOwnFirstContact) {
  for (const bool isExact : {false, true}) {
    int several = 0;
    for (int i = 0; i < (isExact ? 500 : 150); ++i) {
      SCOPED_TRACE(i);
      Random random(static_cast<std::uint64_t>(i));
      const Scene scene = Scene::build(test::clutter(random, 500, 4, Vector3d::Zero())).value();
      const test::RandomBody body = test::bodyInClutter(random, 4, Vector3d::Zero());
      QueryOptions options;
      if (isExact) {
        options.fidelity = Fidelity::Exact;
        options.surface =
            AvatarSurface::build(body.avatar, test::meshWithin(body.avatar, random, 5, 0.9))
                .value();
      }
      Scratch scratch;
      const StepContacts plain =
          test::answerOf(body.avatar, body.motion(), scene, options, scratch);
      options.scope = Scope::EveryObject;
      const StepContacts all = test::answerOf(body.avatar, body.motion(), scene, options, scratch);
      EXPECT_TRUE(std::is_sorted(all.perObject.begin(), all.perObject.end(), isReportedBefore));
      std::map<std::pair<LinkId, ObjectId>, LinkContact> found;
      std::map<LinkId, int> objects;
      for (const LinkContact& contact : all.perObject) {
        ASSERT_NE(contact.verdict, Verdict::Undecided);
        EXPECT_TRUE(
            found.emplace(std::make_pair(contact.link, scene.object(contact.triangle)), contact)
                .second);
        if (++objects[contact.link] == 2) ++several;
      }
      options.scope = Scope::EveryLink;
      for (LinkId link = 0; link < body.avatar.numLinks(); ++link) {
        EXPECT_EQ(all.links[static_cast<std::size_t>(link)].verdict,
                  plain.links[static_cast<std::size_t>(link)].verdict);
        EXPECT_EQ(all.links[static_cast<std::size_t>(link)].toi,
                  plain.links[static_cast<std::size_t>(link)].toi);
      }
      // The same as asked with every other object ignored.
      for (ObjectId object = 0; object < 4; ++object) {
        options.ignored.clear();
        for (LinkId link = 0; link < body.avatar.numLinks(); ++link) {
          for (ObjectId other = 0; other < 4; ++other) {
            if (other != object) options.ignored.push_back({link, other});
          }
        }
        const StepContacts alone =
            test::answerOf(body.avatar, body.motion(), scene, options, scratch);
        for (const LinkContact& contact : alone.links) {
          const auto same = found.find({contact.link, object});
          ASSERT_EQ(same != found.end(), contact.verdict != Verdict::Clear);
          if (same == found.end()) continue;
          EXPECT_EQ(same->second.verdict, contact.verdict);
          EXPECT_EQ(same->second.toi, contact.toi);
          EXPECT_EQ(same->second.triangle, contact.triangle);
        }
      }
    }
    EXPECT_GT(several, 20);
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, Leaving, testing::ValuesIn(supportedSimd()), test::nameOfSimd);

}  // namespace
}  // namespace foretouch
