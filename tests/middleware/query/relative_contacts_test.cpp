// A query about a body in the frame of a prop that moves, or of a tool in its own hand, judged in W
// with both sides moving: the judge knows nothing of relative motions.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/raw_skeleton.h"
#include "articulated/relative_motion.h"
#include "lss/index.h"
#include "middleware/query/query.h"
#include "tests/middleware/own_body.h"
#include "tests/support/asked.h"
#include "tests/support/judged_answer.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

/// A body and, as the last joint, a prop of triangles in the joint's frame.
struct BodyAndProp {
  test::RandomMotion steps;
  std::vector<std::vector<Lss>> lss;  // per joint; none on the prop's
  std::vector<Triangle> triangles;

  [[nodiscard]] JointId prop() const { return steps.skeleton.numJoints() - 1; }
};

/// About the prop's origin, a hand's or a chair's size.
std::vector<Triangle> randomProp(Random& random) {
  std::vector<Triangle> triangles;
  const double size = random.magnitude(0.02, 0.4);
  const int count = 1 + random.below(30);
  for (int i = 0; i < count; ++i) {
    const Vector3d middle = random.inBox(size);
    Triangle triangle;
    for (Vector3d& v : triangle.vertices) v = middle + random.inBox(0.5 * size);
    triangles.push_back(triangle);
  }
  return triangles;
}

/// The prop hangs on `holder`, or flies through W if that is none, and meets the body's place.
BodyAndProp withProp(Random& random, bool isHeld) {
  const test::OwnBody body = test::randomOwnBody(random);
  const Skeleton& skeleton = body.steps.skeleton;
  RawSkeleton raw = rawSkeleton(skeleton);
  BodyAndProp made;
  for (JointId j = 0; j < skeleton.numJoints(); ++j) made.lss.push_back(body.avatar.lss(j));
  made.steps.from = body.steps.from;
  made.steps.to = body.steps.to;
  const JointId holder = isHeld ? random.below(skeleton.numJoints()) : kNoParent;
  const Vector3d place =
      isHeld ? random.inBox(0.2) : Vector3d(body.steps.from.translations[0] + random.inBox(0.5));
  raw.joints.push_back({"prop", holder, place, Quaternion::Identity()});
  const Quaternion start = random.rotation();
  made.steps.from.rotations.push_back(start);
  made.steps.from.translations.push_back(place);
  const Quaternion end = start * random.turn(isHeld ? 0.0 : random.uniform(0.0, 3.0));
  made.steps.to.rotations.push_back(isHeld ? start : end);
  made.steps.to.translations.push_back(isHeld ? place : Vector3d(place + random.inBox(1.0)));
  made.lss.emplace_back();
  made.steps.skeleton = Skeleton::build(raw).value();
  made.steps.precise = test::plainJoints(made.steps.skeleton, made.steps.from, made.steps.to);
  made.triangles = randomProp(random);
  return made;
}

Scene sceneOf(const std::vector<Triangle>& triangles) {
  RawScene raw;
  raw.triangles = triangles;
  raw.objectNames = {"prop"};
  raw.objectOf.assign(triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

struct Tally {
  int clear = 0, contact = 0, start = 0, undecided = 0;
};

class RelativeContacts : public testing::Test {
 protected:
  void judge(const BodyAndProp& both, double tolerance) {
    const Skeleton& skeleton = both.steps.skeleton;
    const RelativeChain chain = RelativeChain::build(skeleton, both.prop()).value();
    std::vector<std::vector<Lss>> lss(countOf(chain.skeleton().numJoints()));
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
      lss[slotOf(chain.linkOf(link))] = both.lss[slotOf(link)];
    }
    const Avatar avatar = Avatar::build(chain.skeleton(), lss).value();
    Pose from, to;
    chain.pose(both.steps.from, from);
    chain.pose(both.steps.to, to);
    const Scene scene = sceneOf(both.triangles);
    QueryOptions options;
    options.tolerance = tolerance;
    const StepContacts step =
        test::answerOf(avatar, ChainMotion(chain.skeleton(), from, to), scene, options, scratch_);
    const oracle::Motion truth(both.steps.precise);
    const ChainMotion world(skeleton, both.steps.from, both.steps.to);
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
      if (both.lss[slotOf(link)].empty()) continue;
      LinkContact contact = step.links[slotOf(chain.linkOf(link))];
      if (contact.verdict != Verdict::Clear && contact.verdict != Verdict::Undecided) {
        const LinkState prop = world.stateAt(both.prop(), contact.toi);
        contact.p_WLink = prop.pointAt(contact.p_WLink);
        contact.p_WScene = prop.pointAt(contact.p_WScene);
        contact.nhat_SL_W = prop.R_WL * contact.nhat_SL_W;
      }
      judgeLink(both, truth, link, contact, tolerance);
    }
  }

  void judgeLink(const BodyAndProp& both, const oracle::Motion& truth, LinkId link,
                 const LinkContact& contact, double tolerance) {
    std::vector<oracle::Hull> one, other;
    for (const Lss& lss : both.lss[slotOf(link)]) {
      one.push_back(
          {link, 2, {test::plain(lss.a), test::plain(lss.b), test::plain(lss.b)}, lss.radius});
    }
    for (const Triangle& triangle : both.triangles) {
      other.push_back({both.prop(), 3, test::plain(triangle), 0.0});
    }
    oracle::Judge judge(truth, one, other);
    const oracle::Judgement judgement = judge.judge(test::plain(contact), tolerance);
    EXPECT_EQ(judgement.finding, oracle::Finding::Ok)
        << "link " << link << ", eps " << tolerance << ": " << toString(contact.verdict) << " at "
        << contact.toi << " -> " << oracle::toString(judgement.finding) << " " << judgement.what
        << " at " << static_cast<double>(judgement.time) << ", separation "
        << static_cast<double>(judgement.separation);
    switch (contact.verdict) {
      case Verdict::Clear: ++tally_.clear; break;
      case Verdict::Contact: ++tally_.contact; break;
      case Verdict::StartsInContact: ++tally_.start; break;
      case Verdict::Undecided: ++tally_.undecided; break;
    }
  }

  Scratch scratch_;
  Tally tally_;
};

TEST_F(RelativeContacts, OfAPropThatFliesKeepThePromise) {
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    judge(withProp(random, false), random.magnitude(1e-7, 1e-2));
  }
  EXPECT_GT(tally_.clear, 300);
  EXPECT_GT(tally_.contact, 100);
  EXPECT_GT(tally_.start, 20);
  EXPECT_EQ(tally_.undecided, 0);
}

TEST_F(RelativeContacts, OfAToolInTheHandKeepThePromise) {
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(1000 + i));
    judge(withProp(random, true), random.magnitude(1e-7, 1e-2));
  }
  EXPECT_GT(tally_.clear, 200);
  EXPECT_GT(tally_.contact, 80);
  EXPECT_GT(tally_.start, 80);
  EXPECT_EQ(tally_.undecided, 0);
}

// A hand 2 cm beside a tool that both move 20 cm: each goes where the other was, and they never
// meet. A check of the space that both sweep would call it a contact.
TEST_F(RelativeContacts, AreNoneOfTwoThatMoveTogether) {
  RawSkeleton raw;
  const Quaternion rest = Quaternion::Identity();
  raw.joints = {{"hand", kNoParent, Vector3d(0.05, 0, 0), rest},
                {"tool", kNoParent, Vector3d(0, 0, 0), rest}};
  BodyAndProp both;
  both.steps.skeleton = Skeleton::build(raw).value();
  both.lss = {{{Vector3d(0, -0.1, 0), Vector3d(0, 0.1, 0), 0.03}}, {}};
  Triangle blade;
  blade.vertices = {Vector3d(0, -0.1, -0.1), Vector3d(0, -0.1, 0.1), Vector3d(0, 0.2, 0)};
  both.triangles = {blade};
  both.steps.from = both.steps.to = restPose(both.steps.skeleton);
  for (Vector3d& place : both.steps.to.translations) place.x() -= 0.2;
  both.steps.precise = test::plainJoints(both.steps.skeleton, both.steps.from, both.steps.to);
  judge(both, 1e-3);
  EXPECT_EQ(tally_.clear, 1);
}

}  // namespace
}  // namespace foretouch
