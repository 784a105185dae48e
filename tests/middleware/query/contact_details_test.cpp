// More about a contact: speeds against differences of places, brackets against the true touch, up
// to four points that hold a resting body, whatever the order of the scene's triangles.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lss/separation.h"
#include "middleware/query/query.h"
#include "tessellation/swept_lss.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

Pose poseAt(const Vector3d& place) {
  return {{Quaternion::Identity()}, {place}};
}

/// One link with one LSS that moves without turning.
struct Rod {
  Rod(const Lss& lss, const Vector3d& from, const Vector3d& to)
      : avatar(Avatar::build(skeleton(), {{lss}}).value()),
        motion(avatar.skeleton(), poseAt(from), poseAt(to)) {}
  static Skeleton skeleton() {
    RawSkeleton raw;
    raw.joints.push_back({"rod", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
    return Skeleton::build(raw).value();
  }
  Avatar avatar;
  ChainMotion motion;
};

/// A square floor of side 4 m at y = 0, of two triangles.
Scene floorScene(bool isTurned) {
  RawScene raw;
  raw.objectNames = {"floor"};
  raw.triangles = {{{Vector3d(-2, 0, -2), Vector3d(2, 0, -2), Vector3d(2, 0, 2)}},
                   {{Vector3d(-2, 0, -2), Vector3d(2, 0, 2), Vector3d(-2, 0, 2)}}};
  if (isTurned) std::swap(raw.triangles[0], raw.triangles[1]);
  raw.objectOf = {0, 0};
  return Scene::build(std::move(raw)).value();
}

TEST(ContactDetails, TellTheSpeedOfAFallStraightDown) {
  const Rod rod({{-0.2, 0, 0}, {0.2, 0, 0}, 0.05}, {0, 1, 0}, {0, -1, 0});
  const Query query = Query::build(rod.avatar, floorScene(false)).value();
  Scratch scratch;
  const StepContacts step = query.answer(rod.motion, scratch);
  ASSERT_EQ(step.links[0].verdict, Verdict::Contact);
  const ContactDetails details = query.details(rod.motion, step.links[0], scratch);
  EXPECT_LT((details.v_WLink - Vector3d(0, -2, 0)).norm(), 1e-12);
  EXPECT_EQ(details.v_WOther, Vector3d(Vector3d::Zero()));
  EXPECT_NEAR(details.approachSpeed, 2.0, 1e-12);
  EXPECT_LE(details.approachLower, 2.0);
  EXPECT_GE(details.approachUpper, 2.0);
  EXPECT_LT(details.approachUpper - details.approachLower, 1e-9) << "nothing bends this path";
}

TEST(ContactDetails, HoldARodThatLiesOnTheFloorAtBothEnds) {
  for (const bool isTurned : {false, true}) {
    const Rod rod({{-0.2, 0, 0.1}, {0.2, 0, 0.1}, 0.05}, {0, 0.0505, 0}, {0, 0.0505, 0});
    const Query query = Query::build(rod.avatar, floorScene(isTurned)).value();
    Scratch scratch;
    const StepContacts step = query.answer(rod.motion, scratch);
    ASSERT_EQ(step.links[0].verdict, Verdict::Contact);
    const ContactDetails details = query.details(rod.motion, step.links[0], scratch);
    ASSERT_EQ(details.numPoints, 2U);
    double span = (details.points[0].p_WOther - details.points[1].p_WOther).norm();
    EXPECT_NEAR(span, 0.4, 1e-12);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(details.points[i].separation, 0.0005, 1e-12);
      EXPECT_NEAR(details.points[i].p_WLink.y(), 0.0005, 1e-12);
      EXPECT_EQ(details.points[i].p_WOther.y(), 0.0);
    }
    EXPECT_EQ(details.approachSpeed, 0.0);
  }
}

TEST(ContactDetails, HoldABoxAtItsFourCorners) {
  const Lss around{{-0.2, 0, 0}, {0.2, 0, 0}, 0.3};
  const Rod rod(around, {0, 0.0505, 0}, {0, 0.0505, 0});
  std::vector<Triangle> box;
  const double x = 0.2, y = -0.05, z = 0.1;
  box.push_back({{Vector3d(-x, y, -z), Vector3d(x, y, -z), Vector3d(x, y, z)}});
  box.push_back({{Vector3d(-x, y, -z), Vector3d(x, y, z), Vector3d(-x, y, z)}});
  QueryOptions options;
  options.fidelity = Fidelity::Exact;
  options.surface = AvatarSurface::build(rod.avatar, {box}).value();
  const Query query = Query::build(rod.avatar, floorScene(false), options).value();
  Scratch scratch;
  const StepContacts step = query.answer(rod.motion, scratch);
  ASSERT_EQ(step.links[0].verdict, Verdict::Contact);
  const ContactDetails details = query.details(rod.motion, step.links[0], scratch);
  ASSERT_EQ(details.numPoints, 4U);
  double lengths = 0.0;
  for (std::size_t i = 0; i < details.numPoints; ++i) {
    const ContactPoint& point = details.points[i];
    EXPECT_NEAR(point.separation, 0.0005, 1e-12);
    EXPECT_GE(point.linkTriangle, 0);
    EXPECT_NEAR(std::abs(point.p_WLink.x()), x, 1e-12);
    EXPECT_NEAR(std::abs(point.p_WLink.z()), z, 1e-12);
    for (std::size_t k = 0; k < i; ++k) {
      lengths += (point.p_WLink - details.points[k].p_WLink).norm();
    }
  }
  EXPECT_NEAR(lengths, 4.0 * (x + z) + 4.0 * std::hypot(x, z), 1e-9) << "four different corners";
}

// Random bodies in clutter: the velocities are those of the material points, and every bracket
// holds the speed at the sampled touch.
TEST(ContactDetails, KeepTheirPromisesOnRandomSteps) {
  int contacts = 0, touches = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Scene scene = Scene::build(test::clutter(random, 300, 3, Vector3d::Zero())).value();
    const test::RandomBody body = test::bodyInClutter(random, 5, Vector3d::Zero());
    const ChainMotion motion = body.motion();
    const Query query = Query::build(body.avatar, scene).value();
    Scratch scratch;
    for (const LinkContact& contact : query.answer(motion, scratch).links) {
      if (contact.verdict != Verdict::Contact) continue;
      ++contacts;
      const ContactDetails details = query.details(motion, contact, scratch);
      const LinkState at = motion.stateAt(contact.link, contact.toi);
      const Vector3d p_L = at.R_WL.transpose() * (contact.p_WLink - at.p_WL);
      const double h = 1e-6;
      const double before = std::max(0.0, contact.toi - h), after = std::min(1.0, contact.toi + h);
      const Vector3d difference = (motion.stateAt(contact.link, after).pointAt(p_L) -
                                   motion.stateAt(contact.link, before).pointAt(p_L)) /
                                  (after - before);
      EXPECT_LT((difference - details.v_WLink).norm(), 1e-4 * (1.0 + difference.norm()));
      ASSERT_GE(details.numPoints, 1U);
      EXPECT_NEAR(details.points[0].separation, contact.separation, 1e-12);
      // Where does the material point cross the plane of the contact?
      for (double t = contact.toi; t < 1.0; t += 1e-4) {
        const LinkState state = motion.stateAt(contact.link, t);
        if (contact.nhat_SL_W.dot(state.pointAt(p_L) - contact.p_WScene) > 0.0) continue;
        const double speed = -contact.nhat_SL_W.dot(state.velocityAt(p_L));
        EXPECT_GE(speed, details.approachLower - 1e-9);
        EXPECT_LE(speed, details.approachUpper + 0.05 * (1.0 + std::abs(speed)));
        ++touches;
        break;
      }
    }
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(touches, 50);
}

TEST(ContactDetails, OfOwnLinksMirrorEachOther) {
  int contacts = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::RandomMotion steps = test::randomMotion(random, 5);
    std::vector<std::vector<Lss>> lss;
    for (int link = 0; link < 5; ++link) {
      lss.push_back({{random.inBox(0.1), random.inBox(0.3), random.uniform(0.01, 0.05)}});
    }
    const Avatar avatar = Avatar::build(steps.skeleton, lss).value();
    const auto rules = PairRules::derive(avatar);
    if (!rules.ok()) continue;
    QueryOptions options;
    options.self = rules.value();
    const Query query = Query::build(avatar, floorScene(false), options).value();
    const ChainMotion motion(steps.skeleton, steps.from, steps.to);
    Scratch scratch;
    for (const PairContact& contact : query.answer(motion, scratch).pairs) {
      if (contact.verdict != Verdict::Contact) continue;
      ++contacts;
      const ContactDetails details = query.details(motion, contact, scratch);
      ASSERT_GE(details.numPoints, 1U);
      EXPECT_NEAR(details.points[0].separation, contact.separation, 1e-9);
      EXPECT_NEAR(details.approachSpeed, -contact.nhat_SL_W.dot(details.v_WLink - details.v_WOther),
                  1e-12);
      EXPECT_LE(details.approachLower, details.approachSpeed);
      EXPECT_GE(details.approachUpper, details.approachSpeed);
    }
  }
  EXPECT_GT(contacts, 50);
}

}  // namespace
}  // namespace foretouch
