// The same answers from both cullers, from any order of triangles, with used or fresh scratch
// memory, and from several threads at once; bit for bit.
#include <algorithm>
#include <numeric>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "lss/segment_triangle.h"
#include "middleware/query/query.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"
#include "tests/support/asked.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

void expectSame(const LinkContact& x, const LinkContact& y) {
  EXPECT_EQ(x.verdict, y.verdict);
  EXPECT_EQ(x.reason, y.reason);
  EXPECT_EQ(x.toi, y.toi);
  EXPECT_EQ(x.freeUntil, y.freeUntil);
  EXPECT_EQ(x.separation, y.separation);
  EXPECT_EQ(x.penetration, y.penetration);
  EXPECT_EQ(x.lss, y.lss);
  EXPECT_EQ(x.p_WScene, y.p_WScene);
  EXPECT_EQ(x.p_WLink, y.p_WLink);
  EXPECT_EQ(x.nhat_SL_W, y.nhat_SL_W);
}

StepContacts answer(const test::RandomBody& body, const Scene& scene, Culler culler,
                    Scratch& scratch) {
  QueryOptions options;
  ReferenceOptions reference;
  reference.culler = culler;
  options.tolerance = 1e-4;
  return test::answerOf(body.avatar, body.motion(), scene, options, reference, scratch);
}

/// The scene with its triangles in another order; order[i] is the old place of the new i-th.
RawScene shuffled(const RawScene& raw, const std::vector<int>& order) {
  RawScene result;
  result.objectNames = raw.objectNames;
  for (const int old : order) {
    result.triangles.push_back(raw.triangles[static_cast<std::size_t>(old)]);
    result.objectOf.push_back(raw.objectOf[static_cast<std::size_t>(old)]);
  }
  return result;
}

TEST(Determinism, CullersAndTriangleOrderDoNotShow) {
  int contacts = 0, starting = 0;
  Scratch used;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center =
        i % 5 == 0 ? Vector3d(1e4 * random.direction()) : Vector3d(random.inBox(2));
    // One object, so that coincident triangles cannot differ in anything but their number.
    const RawScene raw = test::clutter(random, 400, 1, center);
    std::vector<int> order(raw.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(static_cast<unsigned>(i)));
    const Scene scene = Scene::build(raw).value();
    const Scene other = Scene::build(shuffled(raw, order)).value();
    const test::RandomBody body = test::bodyInClutter(random, 12, center);
    Scratch fresh;
    const StepContacts expected = answer(body, scene, Culler::FlatBvh, used);
    const StepContacts byPointQuery = answer(body, scene, Culler::PointQuery, fresh);
    const StepContacts reordered = answer(body, other, Culler::FlatBvh, fresh);
    for (std::size_t link = 0; link < expected.links.size(); ++link) {
      SCOPED_TRACE("link " + std::to_string(link));
      expectSame(expected.links[link], byPointQuery.links[link]);
      EXPECT_EQ(expected.links[link].triangle, byPointQuery.links[link].triangle);
      expectSame(expected.links[link], reordered.links[link]);
      contacts += expected.links[link].verdict == Verdict::Contact;
      starting += expected.links[link].verdict == Verdict::StartsInContact;
    }
    EXPECT_EQ(expected.counters.advancements, byPointQuery.counters.advancements);
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(starting, 50);
}

TEST(Determinism, CoincidentTrianglesGoToTheLowest) {
  RawScene raw;
  raw.objectNames = {"a", "b"};
  for (int i = 0; i < 4; ++i) {
    raw.triangles.push_back({{Vector3d(-9, 0, -9), Vector3d(9, 0, -9), Vector3d(0, 0, 9)}});
    raw.objectOf.push_back(i % 2);
  }
  RawSkeleton skeleton;
  skeleton.joints.push_back({"ball", kNoParent, Vector3d(0, 1, 0), Quaternion::Identity()});
  const Avatar avatar = Avatar::build(Skeleton::build(skeleton).value(),
                                      {{{Vector3d::Zero(), Vector3d::Zero(), 0.1}}})
                            .value();
  const Pose from = restPose(avatar.skeleton());
  Pose to = from;
  to.translations[0] = Vector3d(0, -1, 0);
  const auto result =
      firstContacts(avatar, ChainMotion(avatar.skeleton(), from, to), Scene::build(raw).value());
  EXPECT_EQ(result.value().links[0].verdict, Verdict::Contact);
  EXPECT_EQ(result.value().links[0].triangle, 0);
}

// Of everything that is touched at t = 0 the nearest to the axis is reported, whatever was passed
// over on the way to it.
TEST(Determinism, StartInContactReportsTheDeepest) {
  int starting = 0;
  Scratch scratch;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RawScene raw = test::clutter(random, 600, 1, Vector3d::Zero());
    const Scene scene = Scene::build(raw).value();
    const test::RandomBody body = test::bodyInClutter(random, 6, Vector3d::Zero());
    const ChainMotion motion = body.motion();
    const StepContacts step = answer(body, scene, Culler::FlatBvh, scratch);
    for (const LinkContact& contact : step.links) {
      if (contact.verdict != Verdict::StartsInContact) continue;
      ++starting;
      const LinkState state = motion.stateAt(contact.link, 0.0);
      double deepest = 1.0;
      for (const Lss& lss : body.avatar.lss(contact.link)) {
        for (std::size_t t = 0; t < raw.triangles.size(); ++t) {
          const Triangle& triangle = scene.triangle(static_cast<TriangleId>(t));
          const double gap =
              closestPoints(state.pointAt(lss.a), state.pointAt(lss.b), triangle).distance -
              lss.radius;
          deepest = std::min(deepest, gap);
        }
      }
      EXPECT_NEAR(contact.penetration, -deepest, 1e-12);
    }
  }
  EXPECT_GT(starting, 50);
}

TEST(Determinism, ThreadsDoNotShow) {
  Random random(11);
  const Scene scene = Scene::build(test::clutter(random, 3000, 2, Vector3d::Zero())).value();
  std::vector<test::RandomBody> bodies;
  for (int i = 0; i < 40; ++i) bodies.push_back(test::bodyInClutter(random, 8, Vector3d::Zero()));
  const auto runAll = [&](Culler culler) {
    std::vector<StepContacts> answers;
    Scratch scratch;
    for (const auto& body : bodies) answers.push_back(answer(body, scene, culler, scratch));
    return answers;
  };
  const auto expected = runAll(Culler::FlatBvh);
  std::vector<std::vector<StepContacts>> got(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < got.size(); ++i) {
    threads.emplace_back(
        [&, i] { got[i] = runAll(i % 2 == 0 ? Culler::FlatBvh : Culler::PointQuery); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& answers : got) {
    for (std::size_t i = 0; i < answers.size(); ++i) {
      for (std::size_t link = 0; link < answers[i].links.size(); ++link) {
        expectSame(expected[i].links[link], answers[i].links[link]);
      }
    }
  }
}

}  // namespace
}  // namespace foretouch
