#include "tests/network/world_stream/crowd_late.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "lss/index.h"

namespace foretouch::test {
namespace {

class Lateness {
 public:
  Lateness(const CrowdTruth& truth, const std::vector<HeardState>& heard, BodyNumber body)
      : truth_(truth), heard_(heard), body_(body) {}

  [[nodiscard]] TimeSpans spans(const TimeSpan& whole) const;

 private:
  [[nodiscard]] bool isMisread(double us, const CrowdState& believed,
                               const std::set<std::int64_t>& heard) const;
  [[nodiscard]] bool isLate(double us) const;

  const CrowdTruth& truth_;
  const std::vector<HeardState>& heard_;
  BodyNumber body_;
};

/// Whether the poses beside that instant, between which a motion goes, are in other frames than
/// was believed, or something that was not heard lies between them. What a change itself says of
/// its place has to be heard first.
bool Lateness::isMisread(double us, const CrowdState& believed,
                         const std::set<std::int64_t>& heard) const {
  double fromUs = -kEver, toUs = kEver;
  std::array<const CrowdState*, 2> beside{};
  for (const oracle::OracleEpisode& episode : truth_.world.bodies[slotOf(body_)].episodes) {
    const CrowdState* const state = truth_.stateAt(body_, episode.beginUs);
    for (std::size_t i = 1; state->hasPoses() && i < episode.times.size(); ++i) {
      const double poseUs = after(episode.times[i]);
      if (poseUs <= us) {
        fromUs = poseUs;
        beside[0] = state;
      } else if (toUs == kEver) {
        toUs = poseUs;
        beside[1] = state;
      }
    }
  }
  const auto isUnheard = [&](const CrowdState& state) { return heard.count(state.sinceUs) == 0; };
  const bool isOtherFrame = std::any_of(beside.begin(), beside.end(), [&](const CrowdState* state) {
    return state != nullptr && isUnheard(*state) &&
           (state->carrier != believed.carrier || state->link != believed.link);
  });
  // Beyond that the body is silent.
  if (isOtherFrame || toUs - fromUs > kCrowdWaitUs) return isOtherFrame;
  const std::vector<CrowdState>& states = truth_.states[slotOf(body_)];
  return std::any_of(states.begin(), states.end(), [&](const CrowdState& state) {
    return isUnheard(state) && after(state.sinceUs) >= fromUs && after(state.sinceUs) < toUs;
  });
}

/// What the world had been told of the body when it answered that instant, beside the truth.
bool Lateness::isLate(double us) const {
  const CrowdState* believed = nullptr;
  std::set<std::int64_t> heard;
  for (const HeardState& next : heard_) {
    if (next.answeredUs >= 0 && after(next.answeredUs) >= us) break;
    heard.insert(next.state.sinceUs);
    if (after(next.state.sinceUs) <= us) believed = &next.state;
  }
  if (believed == nullptr || !believed->isPresent) return false;
  if (believed->hasPoses()) return isMisread(us, *believed, heard);
  const CrowdState* const truth = truth_.stateAt(body_, microsecond(us));
  return truth == nullptr || truth->sinceUs != believed->sinceUs;
}

TimeSpans Lateness::spans(const TimeSpan& whole) const {
  std::set<double> changes{whole.from, whole.to};
  for (const HeardState& heard : heard_) {
    changes.insert(after(heard.state.sinceUs));
    if (heard.answeredUs >= 0) changes.insert(after(heard.answeredUs));
  }
  for (const CrowdState& state : truth_.states[slotOf(body_)]) changes.insert(after(state.sinceUs));
  for (const oracle::OracleEpisode& episode : truth_.world.bodies[slotOf(body_)].episodes) {
    for (const std::int64_t poseUs : episode.times) changes.insert(after(poseUs));
  }
  TimeSpans late;
  for (auto next = std::next(changes.begin()); next != changes.end(); ++next) {
    const TimeSpan span{*std::prev(next), *next};
    if (isLate(0.5 * (span.from + span.to))) late.push_back(span);
  }
  return late;
}

}  // namespace

TimeSpans lateSpans(const CrowdTruth& truth, const std::vector<HeardState>& heard, BodyNumber body,
                    const TimeSpan& whole) {
  return Lateness(truth, heard, body).spans(whole);
}

}  // namespace foretouch::test
