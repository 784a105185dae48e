// Own links that touch each other: sound and tight at sampled instants, at every width, for chains,
// trees and several roots; the same whatever carries the body; and what is refused.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "lss/separation.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tessellation/swept_lss.h"
#include "tests/middleware/own_body.h"
#include "tests/support/asked.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::farScene;
using test::OwnBody;
using test::Random;
using test::randomOwnBody;

/// Of the LSS of two links at an instant, their radii counted.
double separationAt(const Avatar& avatar, const std::vector<LinkState>& states, LinkId a,
                    LinkId b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Lss& one : avatar.lss(a)) {
    const AxisEnds x = axisEnds(one, states[slotOf(a)]);
    for (const Lss& other : avatar.lss(b)) {
      const AxisEnds y = axisEnds(other, states[slotOf(b)]);
      least =
          std::min(least, separation(Hull::segment(x.a, x.b), Hull::segment(y.a, y.b)).distance -
                              (one.radius + other.radius));
    }
  }
  return least;
}

struct Tally {
  int clear = 0, contact = 0, start = 0, undecided = 0;
};

/// Every asked pair at sampled instants: nothing touches before its contact, and at its contact it
/// is within the tolerance.
void expectPromise(const OwnBody& body, const PairRules& rules, const StepContacts& step,
                   double tolerance, Tally& tally) {
  constexpr int kSamples = 200;
  constexpr double kRounding = 1e-10;
  std::map<std::pair<LinkId, LinkId>, const PairContact*> found;
  for (const PairContact& contact : step.pairs) {
    EXPECT_LT(contact.link, contact.other);
    EXPECT_TRUE(found.emplace(std::make_pair(contact.link, contact.other), &contact).second);
    EXPECT_EQ(rules.reasonOf(contact.link, contact.other), PairReason::Asked);
  }
  const ChainMotion motion = body.motion();
  std::vector<LinkState> states;
  for (int k = 0; k <= kSamples; ++k) {
    const double t = static_cast<double>(k) / kSamples;
    motion.statesAt(t, states);
    for (LinkId a = 0; a < body.avatar.numLinks(); ++a) {
      for (LinkId b = a + 1; b < body.avatar.numLinks(); ++b) {
        if (body.avatar.lss(a).empty() || body.avatar.lss(b).empty() ||
            rules.reasonOf(a, b) != PairReason::Asked) {
          continue;
        }
        const auto contact = found.find({a, b});
        const double free = contact == found.end() ? 2.0 : contact->second->freeUntil;
        if (t < free) {
          EXPECT_GT(separationAt(body.avatar, states, a, b), -kRounding)
              << a << ' ' << b << " at " << t;
        }
      }
    }
  }
  for (const auto& [links, contact] : found) {
    SCOPED_TRACE(std::to_string(links.first) + " and " + std::to_string(links.second));
    motion.statesAt(contact->freeUntil, states);
    const double separation = separationAt(body.avatar, states, links.first, links.second);
    if (contact->verdict == Verdict::Contact) {
      ++tally.contact;
      EXPECT_LE(separation, tolerance + kRounding);
      EXPECT_GE(separation, -kRounding);
      EXPECT_NEAR(contact->separation, separation, kRounding + 1e-9 * tolerance);
      EXPECT_NEAR((contact->p_WLink - contact->p_WScene).dot(contact->nhat_SL_W), separation, 1e-9);
    } else if (contact->verdict == Verdict::StartsInContact) {
      ++tally.start;
      EXPECT_LE(separation, kRounding);
      EXPECT_NEAR(contact->penetration, -separation, kRounding);
    } else {
      ++tally.undecided;
    }
  }
  tally.clear += static_cast<int>(rules.numAsked()) - static_cast<int>(found.size());
}

class SelfQueries : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

TEST_P(SelfQueries, AreSoundAndTight) {
  Tally tally;
  QueryScratch scratch;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = randomOwnBody(random);
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    QueryOptions options;
    options.tolerance = random.magnitude(1e-7, 1e-2);
    options.self = rules.value();
    const StepContacts step =
        test::answerOf(body.avatar, body.motion(), farScene(), options, scratch);
    ASSERT_TRUE(step.arePairsAnswered);
    expectPromise(body, rules.value(), step, options.tolerance, tally);
  }
  EXPECT_GT(tally.clear, 2000);
  EXPECT_GT(tally.contact, 200);
  EXPECT_GT(tally.start, 200);
  EXPECT_EQ(tally.undecided, 0);
}

std::string nameOf(const testing::TestParamInfo<Simd>& tested) {
  return toString(tested.param);
}
INSTANTIATE_TEST_SUITE_P(Widths, SelfQueries, testing::ValuesIn(supportedSimd()), nameOf);

}  // namespace
}  // namespace foretouch
