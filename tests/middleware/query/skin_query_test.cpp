// Skins in lanes of every width against doubles: verdicts that the promise leaves no choice in are
// the same, and what lanes report is true in arithmetic of its own.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "lss/separation.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"
#include "tests/support/name_of_simd.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

class SkinQueries : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

/// A random body whose skin hangs on several links.
struct SkinnedBody {
  test::RandomBody body;
  ChainMotion motion;
  test::RandomSkin made;
  QueryOptions options;

  SkinnedBody(Random& random, int links, const Vector3d& centre, double turn = 0.0)
      : body(turned(test::bodyInClutter(random, links, centre), random, turn)),
        motion(body.motion()),
        made(test::randomSkin(body.avatar, motion, random, 40)) {
    options.fidelity = Fidelity::Skinned;
    options.skin = SkinnedSurface::build(body.avatar, made.skin, made.counts).value();
  }
  static test::RandomBody turned(test::RandomBody body, Random& random, double turn) {
    if (turn > 0.0) {
      for (auto& rotation : body.to.rotations) rotation = random.turn(turn);
    }
    return body;
  }

  [[nodiscard]] StepContacts answer(const Scene& scene, double tolerance,
                                    const ReferenceOptions& reference) const {
    QueryOptions asked = options;
    asked.tolerance = tolerance;
    return firstContacts(body.avatar, motion, scene, asked, reference).value();
  }
  [[nodiscard]] StepContacts answer(const Scene& scene, double tolerance,
                                    Backtracking backtracking) const {
    ReferenceOptions reference;
    reference.backtracking = backtracking;
    return answer(scene, tolerance, reference);
  }

  /// The reported triangle at the reported instant.
  [[nodiscard]] Triangle triangleAt(const LinkContact& contact) const {
    std::vector<LinkState> states;
    motion.statesAt(contact.toi, states);
    std::size_t index = static_cast<std::size_t>(contact.linkTriangle);
    for (LinkId link = 0; link < contact.link; ++link) {
      index += made.counts[static_cast<std::size_t>(link)];
    }
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.vertices[i].setZero();
      const std::int32_t vertex = made.skin.triangles[index][i];
      for (const SkinInfluence& share : made.skin.vertices[static_cast<std::size_t>(vertex)]) {
        triangle.vertices[i] +=
            share.weight * states[static_cast<std::size_t>(share.link)].pointAt(share.p_L);
      }
    }
    return triangle;
  }
  [[nodiscard]] double separationAt(const Scene& scene, const LinkContact& contact) const {
    return separation(Hull::of(triangleAt(contact)), Hull::of(scene.triangle(contact.triangle)))
        .upper;
  }
};

struct SkinTally {
  int clear = 0, contact = 0, start = 0;
};

void expectSameStart(const LinkContact& l, const LinkContact& s) {
  EXPECT_EQ(l.triangle, s.triangle);
  EXPECT_EQ(l.linkTriangle, s.linkTriangle);
  EXPECT_EQ(l.lss, s.lss);
  EXPECT_EQ(l.p_WScene, s.p_WScene);
  EXPECT_EQ(l.p_WLink, s.p_WLink);
  EXPECT_EQ(l.nhat_SL_W, s.nhat_SL_W);
}

void expectAgreement(const SkinnedBody& body, const Scene& scene, double tolerance,
                     SkinTally& tally) {
  const StepContacts lanes = body.answer(scene, tolerance, Backtracking::Lanes);
  const StepContacts doubles = body.answer(scene, tolerance, Backtracking::Scalar);
  // Where the tolerance is next to nothing the doubles' contact is the true one.
  const StepContacts exact = body.answer(scene, 1e-8, Backtracking::Scalar);
  for (std::size_t link = 0; link < lanes.links.size(); ++link) {
    SCOPED_TRACE("link " + std::to_string(link));
    const LinkContact& l = lanes.links[link];
    const LinkContact &s = doubles.links[link], &e = exact.links[link];
    ASSERT_NE(l.verdict, Verdict::Undecided);
    EXPECT_EQ(l.verdict == Verdict::StartsInContact, s.verdict == Verdict::StartsInContact);
    if (l.verdict == Verdict::StartsInContact) expectSameStart(l, s);
    if (e.verdict == Verdict::Contact) {
      EXPECT_EQ(l.verdict, Verdict::Contact);
      EXPECT_LE(l.toi, e.toi);
    }
    if (e.verdict == Verdict::Clear && l.verdict != Verdict::Clear) {
      EXPECT_EQ(l.verdict, Verdict::Contact) << "only a near miss may be reported";
    }
    if (l.verdict == Verdict::Contact) {
      EXPECT_LE(body.separationAt(scene, l), tolerance + 1e-11);
      EXPECT_GT(l.separation, 0.0);
    }
    tally.clear += l.verdict == Verdict::Clear;
    tally.contact += l.verdict == Verdict::Contact;
    tally.start += l.verdict == Verdict::StartsInContact;
  }
}

TEST_P(SkinQueries, AgreeWithDoubles) {
  SkinTally tally;
  for (int i = 0; i < 120; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d centre =
        i % 6 == 0 ? Vector3d(1e4 * random.direction()) : Vector3d(random.inBox(2));
    const Scene scene = Scene::build(test::clutter(random, 800, 3, centre)).value();
    const SkinnedBody body(random, 8, centre);
    expectAgreement(body, scene, std::array<double, 4>{1e-2, 1e-3, 1e-5, 1e-7}[i % 4], tally);
  }
  EXPECT_GT(tally.clear, 100);
  EXPECT_GT(tally.contact, 50);
  EXPECT_GT(tally.start, 50);
}

TEST_P(SkinQueries, AgreeWithDoublesInManySlabs) {
  SkinTally tally;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(700 + i));
    const Scene scene = Scene::build(test::clutter(random, 200, 3, Vector3d::Zero())).value();
    // Nearly half a turn of every joint: polynomials of the whole step would be far off.
    const SkinnedBody body(random, 7, Vector3d::Zero(), 3.0);
    expectAgreement(body, scene, i % 2 == 0 ? 1e-3 : 1e-6, tally);
  }
  EXPECT_GT(tally.contact, 30);
}

TEST_P(SkinQueries, LeaveOutWhatIsIgnored) {
  int contacts = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(1500 + i));
    const Scene scene = Scene::build(test::clutter(random, 800, 3, Vector3d::Zero())).value();
    SkinnedBody body(random, 6, Vector3d::Zero());
    body.options.ignored = {{1, IgnoredPair::kEveryObject}, {2, 0}, {3, 1}};
    SkinTally tally;
    expectAgreement(body, scene, 1e-3, tally);
    contacts += tally.contact + tally.start;
    for (const LinkContact& l : body.answer(scene, 1e-3, Backtracking::Lanes).links) {
      if (l.verdict == Verdict::Clear) continue;
      EXPECT_NE(l.link, 1);
      EXPECT_FALSE(l.link == 2 && scene.object(l.triangle) == 0);
      EXPECT_FALSE(l.link == 3 && scene.object(l.triangle) == 1);
    }
  }
  EXPECT_GT(contacts, 40);
}

TEST_P(SkinQueries, OfTheAvatarsFirstContactAreItsLinksEarliest) {
  int touched = 0, free = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(2500 + i));
    const Scene scene = Scene::build(test::clutter(random, 150, 3, Vector3d::Zero())).value();
    SkinnedBody body(random, 5, Vector3d::Zero());
    const StepContacts every = body.answer(scene, 1e-3, Backtracking::Lanes);
    body.options.scope = Scope::FirstOfAvatar;
    const StepContacts first = body.answer(scene, 1e-3, Backtracking::Lanes);
    double earliest = 2.0;
    for (const LinkContact& contact : every.links) {
      if (contact.verdict != Verdict::Clear) earliest = std::min(earliest, contact.toi);
    }
    for (std::size_t link = 0; link < every.links.size(); ++link) {
      const LinkContact &f = first.links[link], &e = every.links[link];
      if (e.verdict != Verdict::Clear && e.toi == earliest) {
        EXPECT_EQ(f.verdict, e.verdict);
        EXPECT_EQ(f.toi, e.toi);
        EXPECT_EQ(f.linkTriangle, e.linkTriangle);
      } else if (earliest <= 1.0) {
        EXPECT_EQ(f.reason, UndecidedReason::AfterFirst);
        EXPECT_EQ(f.freeUntil, earliest);
      } else {
        EXPECT_EQ(f.verdict, Verdict::Clear);
      }
    }
    (earliest <= 1.0 ? touched : free) += 1;
  }
  EXPECT_GT(touched, 10);
  EXPECT_GT(free, 5);
}

TEST_P(SkinQueries, ReportTheSameForBothCullers) {
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(900 + i));
    const Scene scene = Scene::build(test::clutter(random, 800, 3, Vector3d::Zero())).value();
    const SkinnedBody body(random, 6, Vector3d::Zero());
    ReferenceOptions reference;
    const StepContacts flat = body.answer(scene, 1e-3, reference);
    reference.culler = Culler::PointQuery;
    const StepContacts point = body.answer(scene, 1e-3, reference);
    for (std::size_t link = 0; link < flat.links.size(); ++link) {
      EXPECT_EQ(flat.links[link].verdict, point.links[link].verdict);
      EXPECT_EQ(flat.links[link].toi, point.links[link].toi);
      EXPECT_EQ(flat.links[link].triangle, point.links[link].triangle);
      EXPECT_EQ(flat.links[link].linkTriangle, point.links[link].linkTriangle);
    }
  }
}

TEST_P(SkinQueries, WithASpentBudgetAreUndecidedAndNeverLate) {
  int undecided = 0, decided = 0, partly = 0;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(3500 + i));
    const Scene scene = Scene::build(test::clutter(random, 200, 3, Vector3d::Zero())).value();
    SkinnedBody body(random, 6, Vector3d::Zero(), 1.0);
    const StepContacts exact = body.answer(scene, 1e-8, Backtracking::Scalar);
    for (const std::uint64_t budget : {0U, 2000U, 4000U, 8000U, 16000U, 40000U, 4000000U}) {
      SCOPED_TRACE(budget);
      body.options.workBudget = budget;
      for (const LinkContact& got : body.answer(scene, 1e-3, Backtracking::Lanes).links) {
        const LinkContact& e = exact.links[static_cast<std::size_t>(got.link)];
        const bool hasContact = e.verdict != Verdict::Clear;
        if (got.verdict == Verdict::Clear) {
          EXPECT_FALSE(hasContact);
        }
        if (hasContact) {
          EXPECT_LE(got.freeUntil, e.toi) << "late";
        }
        const bool isOpen = got.verdict == Verdict::Undecided;
        if (isOpen) {
          EXPECT_EQ(got.reason, UndecidedReason::WorkBudget);
        }
        undecided += isOpen ? 1 : 0;
        partly += isOpen && got.freeUntil > 0.0 ? 1 : 0;
        decided += isOpen ? 0 : 1;
      }
    }
  }
  EXPECT_GT(undecided, 100);
  EXPECT_GT(decided, 100);
  // Doubles look at a link as a whole, lanes slab by slab.
  EXPECT_GT(partly, GetParam() == Simd::Scalar ? 0 : 20);
}

TEST_P(SkinQueries, AskLinksWithoutTrianglesByTheirOwnLss) {
  int touched = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(4500 + i));
    const Scene scene = Scene::build(test::clutter(random, 800, 3, Vector3d::Zero())).value();
    SkinnedBody body(random, 6, Vector3d::Zero());
    auto& counts = body.made.counts;
    auto& triangles = body.made.skin.triangles;
    triangles.resize(triangles.size() - counts[4] - counts[5]);
    counts[4] = counts[5] = 0;
    body.options.skin = SkinnedSurface::build(body.body.avatar, body.made.skin, counts).value();
    const StepContacts lanes = body.answer(scene, 1e-3, Backtracking::Lanes);
    const StepContacts exact = body.answer(scene, 1e-8, Backtracking::Scalar);
    for (std::size_t link = 4; link < 6; ++link) {
      const LinkContact &l = lanes.links[link], &e = exact.links[link];
      EXPECT_EQ(l.linkTriangle, -1);
      EXPECT_EQ(l.verdict == Verdict::StartsInContact, e.verdict == Verdict::StartsInContact);
      if (e.verdict != Verdict::Clear) {
        EXPECT_NE(l.verdict, Verdict::Clear);
        EXPECT_LE(l.toi, e.toi);
        ++touched;
      }
    }
  }
  EXPECT_GT(touched, 20);
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, SkinQueries, testing::ValuesIn(supportedSimd()),
                         test::nameOfSimd);

}  // namespace
}  // namespace foretouch
