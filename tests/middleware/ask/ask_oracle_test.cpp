// Random questions now and then, held against the judge's own world; and lies, which it must name.
#include <algorithm>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/middleware/ask/ask_campaign.h"

namespace foretouch {
namespace {

using test::AskTally;
using test::AskTamper;

AskTally judgeSome(int seeds, int questions, const AskTamper& tamper = {}) {
  AskTally all;
  for (int seed = 0; seed < seeds; ++seed) {
    all.add(test::judgeQuestions(static_cast<std::uint64_t>(seed), questions, tamper));
  }
  return all;
}

TEST(AskOracle, QuestionsNowAndThenAreAnsweredAsTheJudgeSees) {
  const AskTally tally = judgeSome(60, 40);
  for (const std::string& problem : tally.problems) ADD_FAILURE() << problem;
  SCOPED_TRACE(summaryOf(tally));
  for (const auto& [kind, count] : tally.questions) {
    EXPECT_GT(count, 150) << kind;
    EXPECT_GT(tally.hits.at(kind), count / 4) << kind;
    EXPECT_LT(tally.hits.at(kind), count - count / 20) << kind;
  }
  EXPECT_GT(tally.unknown, 50);
  EXPECT_GT(tally.ofLss, 200);
  EXPECT_GT(tally.ofTriangles, 1000);
  EXPECT_GT(tally.ofSkins, 400);
  EXPECT_GT(tally.ofCarried, 20);
  EXPECT_GT(tally.starts, 100);
  EXPECT_GT(tally.inside, 25);
  EXPECT_GT(tally.open, 100);
  EXPECT_LE(static_cast<double>(tally.widest), 1.01 * kAskTolerance);
}

// Of a body with a skin, a link that has no triangles of it, asked about alone, is not open.
TEST(AskOracle, ALinkBesideASkinIsNotOpen) {
  EXPECT_TRUE(test::judgeQuestions(4'000'105, 66).problems.empty());
}
// But it is if it has a surface of its own that does not close.
TEST(AskOracle, ALinkBesideASkinHasAnInsideOfItsOwn) {
  EXPECT_TRUE(test::judgeQuestions(5'001'044, 95).problems.empty());
}

// Nanometres before a triangle a plane proves the two apart, whatever rounding makes of the faces.
TEST(AskOracle, AHullIsNotSaidToEncloseWhatItIsApartFrom) {
  EXPECT_TRUE(test::judgeQuestions(30'029'667, 29).problems.empty());
}

// A skin has none, even where the triangles of a link close.
TEST(AskOracle, ASkinWhoseTrianglesCloseIsOpen) {
  EXPECT_TRUE(test::judgeQuestions(30'009'363, 74).problems.empty());
}

/// So many answers of few are found wrong.
std::size_t problemsWith(const AskTamper& tamper) {
  return judgeSome(12, 40, tamper).problems.size();
}

TEST(AskOracle, NamesAnotherInstant) {
  AskTamper tamper;
  tamper.question = [](WorldQuestion& question) {
    question.time.us += 300;
    for (AskInstant& instant : question.instants) instant.time.us += 300;
  };
  EXPECT_GT(problemsWith(tamper), 50U);
}

TEST(AskOracle, NamesInstantsOfOthers) {
  AskTamper tamper;
  tamper.question = [](WorldQuestion& question) { question.instants.clear(); };
  EXPECT_GT(problemsWith(tamper), 5U);
}

TEST(AskOracle, NamesAForgottenFilter) {
  AskTamper tamper;
  tamper.question = [](WorldQuestion& question) { question.without.clear(); };
  EXPECT_GT(problemsWith(tamper), 5U);
  tamper.question = [](WorldQuestion& question) { question.groups = ~std::uint32_t{0}; };
  EXPECT_GT(problemsWith(tamper), 5U);
}

TEST(AskOracle, NamesWhatIsLateEarlyMissedOrOfAnother) {
  const auto withHits = [](void (*change)(std::vector<WorldHit>&)) {
    AskTamper tamper;
    tamper.answer = [change](WorldAnswer& answer) {
      if (!answer.hits.empty()) change(answer.hits);
    };
    return problemsWith(tamper);
  };
  EXPECT_GT(withHits([](std::vector<WorldHit>& hits) { hits.front().distance += 1e-7; }), 50U);
  EXPECT_GT(withHits([](std::vector<WorldHit>& hits) { hits.back().distance -= 1e-7; }), 50U);
  EXPECT_GT(withHits([](std::vector<WorldHit>& hits) { hits.pop_back(); }), 50U);
  EXPECT_GT(withHits([](std::vector<WorldHit>& hits) { ++hits.front().what.link; }), 50U);
  EXPECT_GT(withHits([](std::vector<WorldHit>& hits) {
              hits.front().what.p_W += Eigen::Vector3d(1e-6, 1e-6, 1e-6);
            }),
            50U);
  EXPECT_GT(
      withHits([](std::vector<WorldHit>& hits) { hits.front().nhat_W = -hits.front().nhat_W; }),
      5U);
}

// Of rays and hulls without a radius as well, and of what is inside.
TEST(AskOracle, NamesWhatIsMissedByWhatHasNoThickness) {
  const auto missed = [](bool (*isIt)(const WorldQuestion&, const WorldHit&)) {
    WorldQuestion last;
    AskTamper tamper;
    tamper.question = [&last](WorldQuestion& question) { last = question; };
    tamper.answer = [&last, isIt](WorldAnswer& answer) {
      const auto isHidden = [&](const WorldHit& hit) { return isIt(last, hit); };
      answer.hits.erase(std::remove_if(answer.hits.begin(), answer.hits.end(), isHidden),
                        answer.hits.end());
    };
    return problemsWith(tamper);
  };
  EXPECT_GT(missed([](const WorldQuestion& question, const WorldHit& hit) {
              const bool isPoint = question.shape.a == question.shape.b && question.hull.empty();
              return isPoint && question.shape.radius == 0.0 && hit.what.triangle >= 0;
            }),
            10U);
  EXPECT_GT(missed([](const WorldQuestion& question, const WorldHit& hit) {
              return !question.hull.empty() && question.shape.radius == 0.0 &&
                     hit.what.triangle >= 0;
            }),
            20U);
  EXPECT_GT(missed([](const WorldQuestion&, const WorldHit& hit) {
              return hit.what.triangle < 0 && hit.what.lss < 0;
            }),
            3U);
}

TEST(AskOracle, FlightsHitWhatTheJudgeSeesThemHitFirst) {
  AskTally tally;
  for (std::uint64_t seed = 0; seed < 40; ++seed) tally.add(test::judgeFlights(seed, 6));
  for (const std::string& problem : tally.problems) ADD_FAILURE() << problem;
  SCOPED_TRACE(summaryOf(tally));
  EXPECT_GT(tally.hits["flight"], 60);
  EXPECT_LT(tally.hits["flight"], 220);
  EXPECT_GT(tally.ofLss, 5);
  EXPECT_GT(tally.ofTriangles, 15);
  EXPECT_GT(tally.ofCarried, 0);
  EXPECT_LT(tally.filtered, 5);  // not resolved
}

// A body's first pose puts it into the midst of a hull that flies: it is hit then, and the judge
// says so where the answer does not.
TEST(AskOracle, AHullHitsWhatComesToBeInsideOfIt) {
  constexpr std::uint64_t kSeed = 7'001'371;
  const AskTally tally = test::judgeFlights(kSeed, 14);
  for (const std::string& problem : tally.problems) ADD_FAILURE() << problem;
  const AskTally lied =
      test::judgeFlights(kSeed, 14, [](FlightQuestion& flight) { flight.groups = 0; });
  const std::string named = "seed 7001371, flight 13: body 0 link 0 touches at 3000 us";
  EXPECT_TRUE(std::any_of(lied.problems.begin(), lied.problems.end(),
                          [&](const std::string& said) { return said.find(named) == 0; }));
}

TEST(AskOracle, NamesFlightsAtAnotherTime) {
  AskTally tally;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    tally.add(test::judgeFlights(seed, 6, [](FlightQuestion& flight) {
      flight.fromUs += 300;
      flight.toUs += 300;
    }));
  }
  EXPECT_GT(tally.problems.size(), 5U);
}

}  // namespace
}  // namespace foretouch
