#include "tests/network/world_stream/crowd_simulation.h"

#include "lss/index.h"
#include "network/wire/codec.h"
#include "tests/network/world_stream/crowd_stranger.h"

namespace foretouch::test {
namespace {

Bytes verdictsOf(const EventsMessage& answer) {
  Bytes bytes;
  encode(answer, bytes);
  const ByteView view = verdictBytes(bytes);
  return {view.data, view.data + view.size};
}

bool areSame(const std::vector<EventsMessage>& one, const std::vector<EventsMessage>& other) {
  if (one.size() != other.size()) return false;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (verdictsOf(one[i]) != verdictsOf(other[i])) return false;
  }
  return true;
}

/// Windows follow one another.
bool hasGaps(const std::vector<EventsMessage>& answers) {
  for (std::size_t i = 1; i < answers.size(); ++i) {
    if (answers[i].fromUs != answers[i - 1].toUs) return true;
  }
  return false;
}

}  // namespace

CrowdRun simulateCrowd(std::uint64_t seed, CrowdMutation mutation, bool hasStranger) {
  Crowd crowd = drawCrowd(seed);
  std::size_t bodies = crowd.truth.states.size();
  if (hasStranger) {
    addStranger(seed, crowd);
    bodies += countOf(kStrangersBodies);
  }
  CrowdRun run;
  run.isFaulty = crowd.isFaulty;
  WorldPolicy policy;
  policy.waitUs = kCrowdWaitUs;
  policy.whenSilent = seed % 2 == 0 ? WhenSilent::Undecided : WhenSilent::HoldStill;
  CrowdTold told = tellCrowd(crowd.setup, bodies, crowd.arrivals, policy, mutation);
  if (hasGaps(told.answers)) run.violations.emplace_back("windows do not follow one another");
  const CrowdTold again = tellCrowd(crowd.setup, bodies, told.accepted, policy, mutation);
  if (!areSame(again.answers, told.answers))
    run.violations.emplace_back("a replay tells otherwise");
  leaveStranger(crowd, told);
  judgeCrowd(crowd, told, run.tally, run.violations);
  return run;
}

}  // namespace foretouch::test
