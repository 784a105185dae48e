#include "bench/person/ahead_trial.h"

#include <cmath>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

void count(AheadTally& tally, const AheadPerson::Instants& told, const AheadPerson::Instants& truth,
           const Avatar& avatar) {
  for (std::size_t link = 0; link < told.size(); ++link) {
    const bool touchesNow = truth[link] && *truth[link] == 0.0;
    if (touchesNow || avatar.lss(static_cast<LinkId>(link)).empty()) continue;
    ++tally.asked;
    if (!truth[link]) {
      if (told[link]) ++tally.alarms;
      continue;
    }
    ++tally.touched;
    if (!told[link] || *told[link] > *truth[link]) {
      ++tally.late;
    } else {
      tally.earlyMs.push_back(1e3 * (*truth[link] - *told[link]));
    }
  }
}

}  // namespace

void AheadTally::add(const AheadTally& other) {
  asked += other.asked;
  touched += other.touched;
  late += other.late;
  alarms += other.alarms;
  poses += other.poses;
  us += other.us;
  earlyMs.insert(earlyMs.end(), other.earlyMs.begin(), other.earlyMs.end());
}

std::vector<AheadTally> judgeAhead(const SolidStage& stage, const SolidActor& actor,
                                   const Placement& place, const AheadTrial& trial) {
  PersonTrial person;
  person.rateHz = trial.rateHz;
  person.model = MotionModel::ConstantRate;
  BoundedPerson given(stage, actor, place, person);
  std::vector<AheadTally> tallies(kAheadWays);
  const double frameS = actor.clip.frameTimeS;
  const auto every = static_cast<std::size_t>(std::lround(given.stepS() / frameS));
  const int frames = static_cast<int>(std::floor(trial.horizonS / frameS));
  if (frames < 2) return tallies;
  const BracketQuery query = BracketQuery::build(actor.avatar, stage.scene, {}).value();
  AheadPerson ahead(given.held(), actor.avatar, given.frames(), query, {frameS, every, frames});
  AheadBounds bounds;
  ahead.learn(AheadPerson::Learn::Speed, bounds);
  ahead.learn(AheadPerson::Learn::Rest, bounds);
  for (const HeldBackStep& step : ahead.steps()) {
    const AheadPerson::Instants truth = ahead.truth(step);
    for (std::size_t way = 0; way < kAheadWays; ++way) {
      AheadTally& tally = tallies[way];
      count(tally, ahead.told(static_cast<AheadWay>(way), step, bounds, tally.us), truth,
            actor.avatar);
      ++tally.poses;
    }
  }
  return tallies;
}

}  // namespace foretouch::tools
