// Lanes of every width against the scalar reference: verdicts that the promise leaves no choice in
// are the same, and what lanes report of a contact is true in the reference's own arithmetic.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "lss/separation.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tessellation/swept_lss.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"
#include "tests/support/name_of_simd.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

class LaneQueries : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

StepContacts answer(const test::RandomBody& body, const Scene& scene, double tolerance,
                    Backtracking backtracking) {
  QueryOptions options;
  options.tolerance = tolerance;
  ReferenceOptions reference;
  reference.backtracking = backtracking;
  return firstContacts(body.avatar, body.motion(), scene, options, reference).value();
}

/// Separation of the reported LSS and triangle at the reported instant.
double separationAt(const test::RandomBody& body, const Scene& scene, const LinkContact& contact) {
  const Lss& lss = body.avatar.lss(contact.link)[static_cast<std::size_t>(contact.lss)];
  const AxisEnds ends = axisEnds(lss, body.motion().stateAt(contact.link, contact.toi));
  return separation(Hull::segment(ends.a, ends.b), Hull::of(scene.triangle(contact.triangle)))
             .upper -
         lss.radius;
}

struct Tally {
  int clear = 0, contact = 0, start = 0;
};

void expectAgreement(const test::RandomBody& body, const Scene& scene, double tolerance,
                     Tally& tally) {
  constexpr double kRounding = 1e-11;
  const StepContacts lanes = answer(body, scene, tolerance, Backtracking::Lanes);
  const StepContacts scalar = answer(body, scene, tolerance, Backtracking::Scalar);
  // Where the tolerance is next to nothing the reference's contact is the true one.
  const StepContacts exact = answer(body, scene, 1e-8, Backtracking::Scalar);
  for (std::size_t link = 0; link < lanes.links.size(); ++link) {
    SCOPED_TRACE("link " + std::to_string(link));
    const LinkContact& l = lanes.links[link];
    const LinkContact &s = scalar.links[link], &e = exact.links[link];
    EXPECT_EQ(l.verdict == Verdict::StartsInContact, s.verdict == Verdict::StartsInContact);
    if (l.verdict == Verdict::StartsInContact) {
      // The same contact, by the same code, whatever culled and ordered the pairs.
      EXPECT_EQ(l.triangle, s.triangle);
      EXPECT_EQ(l.penetration, s.penetration);
      EXPECT_EQ(l.p_WScene, s.p_WScene);
    }
    if (e.verdict == Verdict::Contact) {
      EXPECT_EQ(l.verdict, Verdict::Contact);
      EXPECT_LE(l.toi, e.toi);
    }
    if (e.verdict == Verdict::Clear && l.verdict != Verdict::Clear) {
      EXPECT_EQ(l.verdict, Verdict::Contact) << "only a near miss may be reported";
    }
    if (l.verdict == Verdict::Contact) {
      EXPECT_LE(separationAt(body, scene, l), tolerance + kRounding);
      EXPECT_GT(l.separation, 0.0);
    }
    tally.clear += l.verdict == Verdict::Clear;
    tally.contact += l.verdict == Verdict::Contact;
    tally.start += l.verdict == Verdict::StartsInContact;
  }
}

TEST_P(LaneQueries, AgreeWithTheScalarReference) {
  Tally tally;
  for (int i = 0; i < 250; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d centre =
        i % 6 == 0 ? Vector3d(1e4 * random.direction()) : Vector3d(random.inBox(2));
    const Scene scene = Scene::build(test::clutter(random, 300, 3, centre)).value();
    const test::RandomBody body = test::bodyInClutter(random, 10, centre);
    expectAgreement(body, scene, std::array<double, 4>{1e-2, 1e-3, 1e-5, 1e-7}[i % 4], tally);
  }
  EXPECT_GT(tally.clear, 100);
  EXPECT_GT(tally.contact, 100);
  EXPECT_GT(tally.start, 100);
}

TEST_P(LaneQueries, TakeIgnoredPairsAndManySlabs) {
  int contacts = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(500 + i));
    const Scene scene = Scene::build(test::clutter(random, 300, 3, Vector3d::Zero())).value();
    test::RandomBody body = test::bodyInClutter(random, 8, Vector3d::Zero());
    // Nearly half a turn of every joint: polynomials of the whole step would be far off.
    for (auto& rotation : body.to.rotations) rotation = random.turn(3.0);
    QueryOptions options;
    options.ignored = {{1, IgnoredPair::kEveryObject}, {2, 0}, {3, 1}};
    for (const double tolerance : {1e-3, 1e-6}) {
      options.tolerance = tolerance;
      ReferenceOptions reference;
      reference.backtracking = Backtracking::Lanes;
      const auto lanes =
          firstContacts(body.avatar, body.motion(), scene, options, reference).value();
      reference.backtracking = Backtracking::Scalar;
      options.tolerance = 1e-8;
      const auto exact =
          firstContacts(body.avatar, body.motion(), scene, options, reference).value();
      for (std::size_t link = 0; link < lanes.links.size(); ++link) {
        const LinkContact &l = lanes.links[link], &e = exact.links[link];
        EXPECT_NE(l.verdict, Verdict::Undecided);
        if (e.verdict == Verdict::Contact) {
          EXPECT_EQ(l.verdict, Verdict::Contact);
          EXPECT_LE(l.toi, e.toi);
        }
        if (l.verdict == Verdict::Contact) {
          ++contacts;
          EXPECT_LE(separationAt(body, scene, l), tolerance + 1e-11);
        }
        if (l.verdict == Verdict::Clear) continue;
        EXPECT_NE(l.link, 1);
        EXPECT_FALSE(l.link == 2 && scene.object(l.triangle) == 0);
        EXPECT_FALSE(l.link == 3 && scene.object(l.triangle) == 1);
      }
    }
  }
  EXPECT_GT(contacts, 100);
}

TEST_P(LaneQueries, OfTheAvatarsFirstContactAreItsLinksEarliest) {
  int touched = 0, free = 0;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(1500 + i));
    const Scene scene = Scene::build(test::clutter(random, 60, 3, Vector3d::Zero())).value();
    const test::RandomBody body = test::bodyInClutter(random, 6, Vector3d::Zero());
    QueryOptions options;
    ReferenceOptions reference;
    reference.backtracking = i % 3 == 0 ? Backtracking::Scalar : Backtracking::Lanes;
    const auto every = firstContacts(body.avatar, body.motion(), scene, options, reference).value();
    options.scope = Scope::FirstOfAvatar;
    const auto first = firstContacts(body.avatar, body.motion(), scene, options, reference).value();
    double earliest = 2.0;
    for (const LinkContact& contact : every.links) {
      if (contact.verdict != Verdict::Clear) earliest = std::min(earliest, contact.toi);
    }
    for (std::size_t link = 0; link < every.links.size(); ++link) {
      const LinkContact &f = first.links[link], &e = every.links[link];
      if (e.verdict != Verdict::Clear && e.toi == earliest) {
        EXPECT_EQ(f.verdict, e.verdict);
        EXPECT_EQ(f.toi, e.toi);
        EXPECT_EQ(f.triangle, e.triangle);
        EXPECT_EQ(f.p_WLink, e.p_WLink);
      } else if (earliest <= 1.0) {
        EXPECT_EQ(f.verdict, Verdict::Undecided);
        EXPECT_EQ(f.reason, UndecidedReason::AfterFirst);
        EXPECT_EQ(f.freeUntil, earliest);
      } else {
        EXPECT_EQ(f.verdict, Verdict::Clear);
      }
    }
    (earliest <= 1.0 ? touched : free) += 1;
  }
  EXPECT_GT(touched, 20);
  EXPECT_GT(free, 10);
}

TEST_P(LaneQueries, TakeAvatarsOfAnyNumberOfLss) {
  constexpr int kLinks = 17;  // more LSS than a walk has numbers for
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss(kLinks);
  for (int link = 0; link < kLinks; ++link) {
    raw.joints.push_back({"j" + std::to_string(link), link - 1, Vector3d(0.0, 0.01, 0.0)});
    for (std::size_t i = 0; i < kMaxLssPerLink; ++i) {
      const double x = 1e-3 * static_cast<double>(i);
      lss[static_cast<std::size_t>(link)].push_back({{x, 0.0, 0.0}, {x, 0.0, 0.1}, 1e-3});
    }
  }
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), std::move(lss)).value();
  const Scene scene =
      Scene::build({{{{{{4.0, 0.5, 0.0}, {4.1, 0.5, 0.0}, {4.0, 0.5, 0.2}}}}}, {0}, {"plate"}})
          .value();
  const Pose from = restPose(avatar.skeleton());
  Pose to = from;
  to.translations[0].y() += 1.0;
  const ChainMotion motion(avatar.skeleton(), from, to);
  const auto step = firstContacts(avatar, motion, scene).value();
  for (const LinkContact& contact : step.links) {
    EXPECT_EQ(contact.verdict, Verdict::Contact);
    EXPECT_NEAR(contact.toi, 0.5 - 1e-3 - 0.01 * (contact.link + 1), 2e-3);
  }
}

TEST_P(LaneQueries, ReportTheSameForBothCullersAtExactFidelity) {
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(900 + i));
    const Scene scene = Scene::build(test::clutter(random, 300, 3, Vector3d::Zero())).value();
    const test::RandomBody body = test::bodyInClutter(random, 6, Vector3d::Zero());
    QueryOptions options;
    options.fidelity = Fidelity::Exact;
    options.surface =
        AvatarSurface::build(body.avatar, test::meshWithin(body.avatar, random, 12, 0.9)).value();
    const auto flat = firstContacts(body.avatar, body.motion(), scene, options).value();
    ReferenceOptions reference;
    reference.culler = Culler::PointQuery;
    const auto point = firstContacts(body.avatar, body.motion(), scene, options, reference).value();
    for (std::size_t link = 0; link < flat.links.size(); ++link) {
      EXPECT_EQ(flat.links[link].verdict, point.links[link].verdict);
      EXPECT_EQ(flat.links[link].toi, point.links[link].toi);
      EXPECT_EQ(flat.links[link].triangle, point.links[link].triangle);
      EXPECT_EQ(flat.links[link].linkTriangle, point.links[link].linkTriangle);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, LaneQueries, testing::ValuesIn(supportedSimd()),
                         test::nameOfSimd);

}  // namespace
}  // namespace foretouch
