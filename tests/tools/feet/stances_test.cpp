// Oracle: PlantedWalk, whose feet are where plain arithmetic puts them. What is asked is the whole
// way from files to stances.
#include "tools/feet/stances.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"
#include "tests/tools/feet/planted_walk.h"

namespace foretouch::tools {
namespace {

using test::Place;
using test::PlantedFoot;
using test::PlantedStance;

constexpr double kFrameS = 0.01;

/// Feet in turn: each stands for 0.7 s and steps for 0.4 s.
struct Walk {
  PlantedFoot left, right;
  double endS = 0.0;

  [[nodiscard]] const PlantedFoot& foot(std::size_t i) const { return i == 0 ? left : right; }
};

/// `plant` may change each stance.
template <typename Plant>
Walk walkOf(std::size_t stances, const Plant& plant) {
  Walk walk;
  for (int side = 0; side < 2; ++side) {
    PlantedFoot& foot = side == 0 ? walk.left : walk.right;
    double x = 0.3 * side;
    for (std::size_t i = 0; i < stances; ++i) {
      PlantedStance stance;
      stance.beginS = 1.1 * static_cast<double>(i) + (side == 0 ? 0.0 : 0.55);
      stance.endS = stance.beginS + 0.7;
      stance.from = stance.to = {x, 0.0, 0.2 * side};
      plant(stance);
      x = stance.to.x + 0.6;
      foot.stances.push_back(stance);
      walk.endS = std::max(walk.endS, stance.endS);
    }
  }
  return walk;
}

/// A box from one corner to the opposite one, as lines of an OBJ file; `boxes`: those before it.
std::string boxObj(const char* name, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                   int boxes) {
  std::string text = std::string("o ") + name + "\n";
  for (int i = 0; i < 8; ++i) {
    text += "v";
    for (int axis = 0; axis < 3; ++axis) {
      text += " " + std::to_string((i >> (2 - axis)) % 2 == 0 ? low[axis] : high[axis]);
    }
    text += "\n";
  }
  constexpr int kFaces[6][4] = {{1, 2, 4, 3}, {5, 7, 8, 6}, {1, 5, 6, 2},
                                {3, 4, 8, 7}, {1, 3, 7, 5}, {2, 6, 8, 4}};
  for (const auto& face : kFaces) {
    text += "f";
    for (const int corner : face) text += " " + std::to_string(corner + 8 * boxes);
    text += "\n";
  }
  return text;
}

/// `scene`: an OBJ; empty: a plain floor.
FeetInputs inputsOf(const Walk& walk, double frameS = kFrameS, const std::string& scene = "") {
  std::vector<Place> left, right;
  for (int frame = 0; frame * frameS <= walk.endS; ++frame) {
    left.push_back(walk.left.soleAt(frame * frameS));
    right.push_back(walk.right.soleAt(frame * frameS));
  }
  const test::TempFolder folder;
  FeetRequest request;
  request.avatarPath = folder.write("walker.json", test::kWalkerAvatar);
  request.motionPath = folder.write("walk.bvh", test::walkBvh(left, right, frameS));
  if (!scene.empty()) request.scenePath = folder.write("scene.obj", scene);
  auto inputs = loadFeetInputs(request);
  EXPECT_TRUE(inputs.ok()) << describe(inputs.error());
  return std::move(inputs).value();
}

FeetAnswer answerOf(const FeetInputs& inputs) {
  auto answer = stancesOf(inputs, [](std::int64_t) { return true; });
  EXPECT_TRUE(answer.ok());
  return std::move(answer).value();
}

/// The answer's stance of a part that lies around the middle of a planted one.
const FootStance* stanceAround(const FeetInputs& inputs, const FeetAnswer& answer, std::size_t limb,
                               PartOfLimb part, double timeS) {
  for (const FootStance& stance : answer.stances) {
    const RestingPart& of = inputs.body.parts[stance.part];
    const bool isIt = of.limb == limb && of.part == part && stance.kind != StanceKind::Hovers;
    if (isIt && stance.fromS <= timeS && timeS <= stance.toS) return &stance;
  }
  return nullptr;
}

constexpr PartOfLimb kParts[] = {PartOfLimb::Heel, PartOfLimb::Ball, PartOfLimb::Toe};

TEST(Stances, FindEachPlantedSlideAndDepthWithinAMillimetre) {
  int slides = 0, depths = 0;
  double worstSlide = 0.0, worstDepth = 0.0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> millimetres(0.001, 0.05), angle(0.0, 6.2831853);
    const Walk walk = walkOf(6, [&](PlantedStance& stance) {
      const double slide = seed % 2 == 0 ? millimetres(random) : 0.0, way = angle(random);
      stance.to.x += slide * std::cos(way);
      stance.to.z += slide * std::sin(way);
      stance.from.y = stance.to.y = seed % 3 == 0 ? 0.0 : -millimetres(random);
    });
    const FeetInputs inputs = inputsOf(walk);
    const FeetAnswer answer = answerOf(inputs);
    for (std::size_t limb = 0; limb < 2; ++limb) {
      for (const PlantedStance& truth : walk.foot(limb).stances) {
        for (const PartOfLimb part : kParts) {
          SCOPED_TRACE(testing::Message() << "seed " << seed << " limb " << limb << " "
                                          << toString(part) << " at " << truth.beginS);
          const double middleS = 0.5 * (truth.beginS + truth.endS);
          const FootStance* const found = stanceAround(inputs, answer, limb, part, middleS);
          ASSERT_NE(found, nullptr);
          EXPECT_NEAR(found->slide, truth.slide(), 0.001);
          EXPECT_NEAR(found->depth, -truth.from.y, 0.001);
          if (truth.slide() > 0.003) {
            EXPECT_GE(found->slide, kSlides);
          }
          if (truth.from.y < -0.003) {
            EXPECT_GE(found->depth, kSinks);
          }
          worstSlide = std::max(worstSlide, std::abs(found->slide - truth.slide()));
          worstDepth = std::max(worstDepth, std::abs(found->depth + truth.from.y));
          slides += truth.slide() > 0.003 ? 1 : 0;
          depths += truth.from.y < -0.003 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(slides, 150);
  EXPECT_GT(depths, 150);
  std::printf("planted: %d slides, worst error %.2f mm; %d depths, worst error %.2f mm\n", slides,
              1e3 * worstSlide, depths, 1e3 * worstDepth);
}

TEST(Stances, InventNothingOnACleanWalk) {
  const Walk walk = walkOf(8, [](PlantedStance&) {});
  for (const double frameS : {1.0 / 30.0, 0.01, 1.0 / 120.0}) {
    const FeetInputs inputs = inputsOf(walk, frameS);
    const FeetAnswer answer = answerOf(inputs);
    std::size_t touches = 0;
    for (const FootStance& stance : answer.stances) {
      EXPECT_EQ(stance.kind, StanceKind::Touches) << stance.fromS;
      EXPECT_LT(stance.slide, 0.001) << inputs.body.nameOf(inputs.body.parts[stance.part]);
      EXPECT_LT(stance.depth, 0.001);
      ++touches;
    }
    EXPECT_EQ(touches, 2u * 8u * 3u) << "one per foot, stance and part";
  }
}

/// Each foot rolls over its toes before it leaves: what turns in place slides not.
TEST(Stances, TakeNoRollForASlide) {
  for (const double heelOffDeg : {15.0, 40.0}) {
    Walk walk = walkOf(6, [](PlantedStance&) {});
    walk.left.heelOffDeg = walk.right.heelOffDeg = heelOffDeg;
    const FeetInputs inputs = inputsOf(walk);
    double toes = 0.0, soles = 0.0;
    for (const FootStance& stance : answerOf(inputs).stances) {
      const bool isToe = inputs.body.parts[stance.part].part == PartOfLimb::Toe;
      double& worst = isToe ? toes : soles;
      worst = std::max(worst, stance.slide);
    }
    std::printf("rolls by %g degrees: slides of toes %.2f mm, of heel and ball %.2f mm\n",
                heelOffDeg, 1e3 * toes, 1e3 * soles);
    EXPECT_LT(toes, 0.001);
    EXPECT_LT(soles, 0.001);
  }
}

/// Of touches: proven free before, and there at the tolerance.
TEST(Stances, BeginAndEndWhereTheFootPassesTheTolerance) {
  const Walk walk = walkOf(4, [](PlantedStance&) {});
  const FeetInputs inputs = inputsOf(walk);
  const FeetAnswer answer = answerOf(inputs);
  int looked = 0;
  for (const FootStance& stance : answer.stances) {
    const std::size_t limb = inputs.body.parts[stance.part].limb;
    if (stance.beganBefore || limb != 0) continue;
    const auto heightAt = [&](double timeS) {  // as the clip moves: straight between two frames
      const double frame = std::floor(timeS / kFrameS), share = timeS / kFrameS - frame;
      const double a = walk.left.soleAt(frame * kFrameS).y;
      return a + share * (walk.left.soleAt((frame + 1.0) * kFrameS).y - a);
    };
    EXPECT_LE(heightAt(stance.fromS), inputs.request.tolerance + 1e-6);
    EXPECT_GT(heightAt(stance.fromS), 0.0);
    if (stance.goesOn) continue;
    EXPECT_GE(heightAt(stance.toS), inputs.request.tolerance - 1e-6);
    EXPECT_LE(heightAt(stance.toS), 2.0 * inputs.request.tolerance + 1e-6);
    ++looked;
  }
  EXPECT_GE(looked, 6);
}

TEST(Stances, TellFeetThatHoverAndFeetBelowTheGround) {
  const Walk hovering = walkOf(4, [](PlantedStance& s) { s.from.y = s.to.y = 0.012; });
  const FeetInputs inputs = inputsOf(hovering);
  int hovers = 0;
  for (const FootStance& stance : answerOf(inputs).stances) {
    if (stance.kind != StanceKind::Hovers) continue;
    EXPECT_NEAR(stance.hover, 0.012, 0.001);
    ++hovers;
  }
  EXPECT_EQ(hovers, 8);
  const Walk under = walkOf(2, [](PlantedStance& s) { s.from.y = s.to.y = -0.2; });
  const FeetInputs sunk = inputsOf(under);
  int below = 0;
  for (const FootStance& stance : answerOf(sunk).stances) {
    if (stance.kind != StanceKind::Under) continue;
    EXPECT_NEAR(stance.depth, 0.2, 0.001);
    ++below;
  }
  EXPECT_EQ(below, 2 * 3) << "per foot and part: its steps do not reach the ground either";
}

/// A floor, and a board 9 to 13 cm above it over the front of the feet, as of a kitchen's cabinet.
TEST(Stances, FeetBelowABoardStandOnTheFloor) {
  const std::string scene = boxObj("floor", {-5, -0.1, -5}, {5, 0, 5}, 0) +
                            boxObj("board", {-5, 0.09, 0.1}, {5, 0.13, 5}, 1);
  for (const double sunk : {0.0, 0.008}) {
    Walk walk = walkOf(1, [&](PlantedStance& s) {
      s.from.y = s.to.y = -sunk;
      s.from.z = s.to.z = 0.0;
    });
    const FeetInputs inputs = inputsOf(walk, kFrameS, scene);
    const FeetAnswer answer = answerOf(inputs);
    ASSERT_EQ(answer.stances.size(), inputs.body.parts.size());
    for (const FootStance& stance : answer.stances) {
      EXPECT_EQ(stance.kind, StanceKind::Touches);
      EXPECT_NEAR(stance.depth, sunk, 1e-6) << inputs.body.nameOf(inputs.body.parts[stance.part]);
    }
  }
}

/// A thin floor with a room underneath: its other side is no ceiling to who sank through it.
TEST(Stances, FeetThatSankThroughAThinFloorAreBelowIt) {
  const std::string scene = boxObj("ground", {-5, -1.1, -5}, {5, -1, 5}, 0) +
                            boxObj("stage", {-5, -0.02, -5}, {5, 0, 5}, 1);
  const Walk walk = walkOf(2, [&](PlantedStance& s) { s.from.y = s.to.y = -0.05; });
  const FeetInputs inputs = inputsOf(walk, kFrameS, scene);
  int deep = 0;
  for (const FootStance& stance : answerOf(inputs).stances) {
    if (stance.depth < 0.01) continue;
    EXPECT_NEAR(stance.depth, 0.05, 1e-6);
    ++deep;
  }
  EXPECT_EQ(deep, 2 * 2 * 3) << "per foot, stance and part";
}

/// Of frames: found and true, found, and true.
struct Score {
  double hits = 0.0, found = 0.0, truths = 0.0;

  void add(bool isFound, bool isTrue) {
    hits += isFound && isTrue ? 1.0 : 0.0;
    found += isFound ? 1.0 : 0.0;
    truths += isTrue ? 1.0 : 0.0;
  }
  [[nodiscard]] double precision() const { return hits / found; }
  [[nodiscard]] double recall() const { return hits / truths; }
};

/// Contact of feet by frames, and slides by stances: as found, and by the rule of thumb (a joint
/// below 5 cm and slower than 0.3 m/s), whose slide is how far the toe's joint moves meanwhile.
TEST(Stances, BeatTheRuleOfThumbOfTheField) {
  Score ours, rule, ourSlides, ruleSlides;
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> millimetres(0.004, 0.05);
    std::bernoulli_distribution isFaulty(0.5);
    const Walk walk = walkOf(6, [&](PlantedStance& stance) {
      if (isFaulty(random)) stance.to.z += millimetres(random);
      if (isFaulty(random)) stance.from.y = stance.to.y = -millimetres(random);
    });
    const FeetInputs inputs = inputsOf(walk);
    const FeetAnswer answer = answerOf(inputs);
    const std::size_t parts = inputs.body.parts.size();
    for (std::size_t limb = 0; limb < 2; ++limb) {
      const PlantedFoot& foot = walk.foot(limb);
      std::vector<bool> inRule;
      for (std::int64_t step = 0; step <= inputs.steps(); ++step) {
        bool touches = false, byRule = false;
        for (std::size_t part = 0; part < parts; ++part) {
          if (inputs.body.parts[part].limb != limb) continue;
          touches = touches || answer.sample(step, part, parts).touches;
          byRule = byRule || answer.sample(step, part, parts).byRule;
        }
        const double timeS = inputs.timeOf(step);
        if (timeS > foot.stances.back().endS) break;
        const bool isDown = foot.soleAt(timeS).y <= 1e-6;
        ours.add(touches, isDown);
        rule.add(byRule, isDown);
        inRule.push_back(byRule);
      }
      for (const PlantedStance& truth : foot.stances) {
        const FootStance* const found =
            stanceAround(inputs, answer, limb, PartOfLimb::Ball, 0.5 * (truth.beginS + truth.endS));
        ASSERT_NE(found, nullptr);
        ourSlides.add(found->slide >= kSlides, truth.slide() > 0.0);
        double moved = 0.0;
        for (std::size_t i = 0; i + 1 < inRule.size(); ++i) {
          const double timeS = static_cast<double>(i) * kFrameS;
          if (timeS < truth.beginS - 0.2 || timeS > truth.endS + 0.2 || !inRule[i]) continue;
          const Place a = foot.soleAt(timeS), b = foot.soleAt(timeS + kFrameS);
          moved += std::hypot(b.x - a.x, b.z - a.z);
        }
        ruleSlides.add(moved >= kSlides, truth.slide() > 0.0);
      }
    }
  }
  std::printf("contact of feet: precision %.3f, recall %.3f; rule of thumb: %.3f, %.3f\n",
              ours.precision(), ours.recall(), rule.precision(), rule.recall());
  std::printf("slides of 3 mm: precision %.3f, recall %.3f; rule of thumb: %.3f, %.3f\n",
              ourSlides.precision(), ourSlides.recall(), ruleSlides.precision(),
              ruleSlides.recall());
  EXPECT_GT(ours.precision(), 0.9);
  EXPECT_EQ(ours.recall(), 1.0);
  EXPECT_EQ(ourSlides.precision(), 1.0);
  EXPECT_EQ(ourSlides.recall(), 1.0);
  EXPECT_GE(ourSlides.precision(), ruleSlides.precision());
}

}  // namespace
}  // namespace foretouch::tools
