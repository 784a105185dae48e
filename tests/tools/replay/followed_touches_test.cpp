// The touches of replays that are followed, held against samples of the judge's own motion and
// distances: nothing touches outside of them, and nothing is farther apart within them than twice
// the tolerance.
#include "tools/replay/followed_touches.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "judge/scene.h"
#include "tests/support/judged.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_inputs.h"
#include "tools/inputs/example_folder.h"
#include "tools/replay/replay.h"
#include "tools/replay/replay_touches.h"

namespace foretouch::test {
namespace {

using tools::ReplayInputs;
using tools::Touch;
using Words = std::vector<std::string>;

struct Tally {
  std::int64_t samples = 0, touching = 0, inTouches = 0, missed = 0, tooFar = 0;
};

std::vector<Touch> touchesOf(const ReplayInputs& inputs) {
  auto touches = std::move(tools::ReplayTouches::start(inputs)).value();
  EXPECT_TRUE(touches.areFollowed());
  EXPECT_TRUE(tools::replay(inputs, 1, [&](const tools::ReplayedStep& step) {
                return touches.add(step.answer).ok();
              }).ok());
  EXPECT_TRUE(touches.finish().ok());
  return touches.listed();
}

/// All that has one name.
std::map<std::string, oracle::Scene> objectsOf(const Scene& scene) {
  std::map<std::string, std::vector<Triangle>> triangles;
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    const auto id = static_cast<TriangleId>(i);
    if (!isFinite(scene.triangle(id))) continue;
    triangles[scene.objectNames()[slotOf(scene.object(id))]].push_back(scene.triangle(id));
  }
  std::map<std::string, oracle::Scene> objects;
  for (const auto& [name, list] : triangles)
    objects.emplace(name, oracle::Scene(tools::plain(list)));
  return objects;
}

std::vector<oracle::Hull> hullsOf(const Avatar& avatar, LinkId link) {
  std::vector<oracle::Hull> hulls;
  for (const Lss& lss : avatar.lss(link)) {
    hulls.push_back({link, 2, {plain(lss.a), plain(lss.b), {}}, lss.radius});
  }
  return hulls;
}

class Judged {
 public:
  Judged(const ReplayInputs& inputs, const std::vector<Touch>& touches)
      : inputs_(inputs), tolerance_(inputs.query.tolerance), objects_(objectsOf(inputs.scene)) {
    for (const Touch& touch : touches) {
      touches_[{touch.link, touch.other, touch.object}].emplace_back(touch.beginS, touch.endS);
    }
  }

  Tally judge(int instants) {
    for (std::int64_t step = 0; step < inputs_.steps.count; ++step) {
      const oracle::Motion motion = motionOf(step);
      for (LinkId link = 0; link < inputs_.avatar.numLinks(); ++link) {
        if (inputs_.avatar.lss(link).empty()) continue;
        judgeScene(motion, link, {step, instants});
        if (inputs_.query.self) judgeOwn(motion, link, {step, instants});
      }
    }
    return tally_;
  }

 private:
  using Pair = std::tuple<LinkId, LinkId, std::string>;
  struct Sampled {
    std::int64_t step = 0;
    int instants = 0;
  };

  oracle::Motion motionOf(std::int64_t step) const {
    const auto pose = [&](std::int64_t at) {
      return tools::poseAtFrame(inputs_, inputs_.steps.frameOf(at)).value();
    };
    return oracle::Motion(plainJoints(inputs_.avatar.skeleton(), pose(step), pose(step + 1)));
  }

  void judgeScene(const oracle::Motion& motion, LinkId link, const Sampled& sampled) {
    const auto capsules = plainCapsules(inputs_.avatar, link);
    for (const auto& [name, object] : objects_) {
      judgePair(oracle::Judge(object, motion, link, capsules), {link, -1, name}, sampled);
    }
  }

  void judgeOwn(const oracle::Motion& motion, LinkId link, const Sampled& sampled) {
    for (LinkId other = link + 1; other < inputs_.avatar.numLinks(); ++other) {
      const bool isAsked = inputs_.query.self->reasonOf(link, other) == PairReason::Asked;
      if (!isAsked || inputs_.avatar.lss(other).empty()) continue;
      const oracle::Judge judge(motion, hullsOf(inputs_.avatar, link),
                                hullsOf(inputs_.avatar, other));
      judgePair(judge, {link, other, inputs_.avatar.skeleton().name(other)}, sampled);
    }
  }

  void judgePair(const oracle::Judge& judge, const Pair& pair, const Sampled& sampled) {
    constexpr double kSameInstantS = 1e-9, kGuard = 1e-9;
    const double beginS = inputs_.timeOfStep(sampled.step);
    const double lengthS = inputs_.timeOfStep(sampled.step + 1) - beginS;
    const auto touches = touches_.find(pair);
    for (int k = 0; k < sampled.instants; ++k) {
      const double t = (k + 0.5) / sampled.instants, atS = beginS + t * lengthS;
      const auto gap =
          static_cast<double>(judge.separationAt(static_cast<oracle::Real>(t), 4.0 * tolerance_));
      bool isIn = false, isWellIn = false;
      if (touches != touches_.end()) {
        for (const auto& [from, to] : touches->second) {
          isIn = isIn || (from - kSameInstantS <= atS && atS <= to + kSameInstantS);
          isWellIn = isWellIn || (from + kSameInstantS < atS && atS < to - kSameInstantS);
        }
      }
      ++tally_.samples;
      tally_.touching += gap < -kGuard ? 1 : 0;
      tally_.inTouches += isIn ? 1 : 0;
      tally_.missed += gap < -kGuard && !isIn ? 1 : 0;
      tally_.tooFar += isWellIn && gap > 2.0 * tolerance_ + kGuard ? 1 : 0;
    }
  }

  const ReplayInputs& inputs_;
  double tolerance_;
  std::map<std::string, oracle::Scene> objects_;
  std::map<Pair, std::vector<std::pair<double, double>>> touches_;
  Tally tally_;
};

void expectKept(const Tally& tally, std::int64_t leastTouching) {
  std::cout << tally.samples << " samples, " << tally.touching << " touching, " << tally.inTouches
            << " in touches\n";
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.tooFar, 0);
  EXPECT_GE(tally.touching, leastTouching);
}

ReplayInputs dancer(double rateHz) {
  const std::string example = tools::exampleFolder().value();
  tools::ReplayRequest request;
  request.scenePath = example + "/room.obj";
  request.avatarPath = example + "/dancer.avatar.json";
  request.motionPath = example + "/dancer.bvh";
  request.rateHz = rateHz;
  return tools::loadReplayInputs(request).value();
}

TEST(FollowedTouches, HoldEveryTouchOfTheDancerAndNothingElse) {
  const ReplayInputs inputs = dancer(10.0);
  expectKept(Judged(inputs, touchesOf(inputs)).judge(8), 500);
}

TEST(FollowedTouches, HoldEveryTouchOfOwnLinks) {
  ReplayInputs inputs = dancer(5.0);
  inputs.query.self = PairRules::derive(inputs.avatar).value();
  expectKept(Judged(inputs, touchesOf(inputs)).judge(8), 500);
}

TEST(FollowedTouches, AreFoundOutWhereOneEndsTooSoonOrTooLate) {
  const ReplayInputs inputs = dancer(5.0);
  std::vector<Touch> touches = touchesOf(inputs);
  Touch& longest = *std::max_element(touches.begin(), touches.end(), [](auto& x, auto& y) {
    return x.endS - x.beginS < y.endS - y.beginS;
  });
  const double endS = longest.endS;
  longest.endS = 0.5 * (longest.beginS + endS);
  EXPECT_GT(Judged(inputs, touches).judge(8).missed, 0);
  longest.endS = endS + 0.2;
  EXPECT_GT(Judged(inputs, touches).judge(8).tooFar, 0);
}

/// A real clip in a real level.
ReplayInputs real(const TempFolder& folder, const std::string& clip, const std::string& scene,
                  const Words& scale, double scaleOfClip, const Eigen::Vector3d& place) {
  const std::string avatar = folder / "a.avatar.json";
  Words make{"avatar", "bvh", clip, "-o", avatar};
  make.insert(make.end(), scale.begin(), scale.end());
  EXPECT_EQ(runForetouch(make).exitCode, 0);
  tools::ReplayRequest request;
  request.scenePath = scene;
  request.avatarPath = avatar;
  request.motionPath = clip;
  request.motionScale = scaleOfClip;
  request.placement.origin = place;
  request.rateHz = 10.0;
  return tools::loadReplayInputs(request).value();
}

TEST(FollowedTouches, HoldEveryTouchOfJumpsInANavigationLevel) {
  FORETOUCH_REQUIRE_SHARED(clip, "mocap/cmu_01_01_playground_jumps.bvh");
  FORETOUCH_REQUIRE_SHARED(scene, "scenes/nav_test.obj");
  const TempFolder folder;
  const ReplayInputs inputs =
      real(folder, *clip, *scene, {"--scale", "0.0564"}, 0.0564, {15.0, -2.4, 2.0});
  expectKept(Judged(inputs, touchesOf(inputs)).judge(8), 1000);
}

TEST(FollowedTouches, HoldEveryTouchOfADanceInADungeon) {
  FORETOUCH_REQUIRE_SHARED(clip, "mocap/bandai1_dance-short_normal_001.bvh");
  FORETOUCH_REQUIRE_SHARED(scene, "scenes/dungeon.obj");
  const TempFolder folder;
  const ReplayInputs inputs =
      real(folder, *clip, *scene, {"--scale", "0.01"}, 0.01, {21.4, 9.97, -3.5});
  expectKept(Judged(inputs, touchesOf(inputs)).judge(8), 100);
}

TEST(FollowedTouches, AreNotToldOfWhatAWorldCannotAsk) {
  ReplayInputs inputs = test::smallInputs({-0.25, 0.25});
  EXPECT_TRUE(tools::StepFollower::canFollow(inputs));
  inputs.query.passSeparating = true;
  EXPECT_FALSE(tools::StepFollower::canFollow(inputs));
  EXPECT_FALSE(tools::ReplayTouches::start(inputs).value().areFollowed());
}

}  // namespace
}  // namespace foretouch::test
