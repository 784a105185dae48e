#include "tests/network/world_stream/crowd_stranger.h"

#include <algorithm>
#include <utility>

#include "tests/network/world_stream/crowd_spans.h"
#include "tests/network/world_stream/small_world.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

constexpr std::int64_t kMostAheadUs = 999'000;

class Stranger {
 public:
  Stranger(std::uint64_t seed, Crowd& crowd)
      : random_(seed ^ 0x5712A46E52ULL),
        crowd_(crowd),
        first_(static_cast<BodyNumber>(crowd.truth.world.bodies.size())),
        aheadUs_(random_.chance(0.5) ? random_.below(static_cast<int>(kMostAheadUs)) : 0) {}

  void speak() {
    std::int64_t us = kCrowdBeginUs - random_.below(300'000);
    for (BodyNumber i = 0; i < kStrangersBodies; ++i) say(us, i, kNoBody, us);
    for (; us < kCrowdBeginUs + kCrowdLengthUs; us += 2'000 + random_.below(20'000)) {
      pose(us);
      if (random_.chance(0.4)) handOver(us);
      if (random_.chance(0.2)) {
        say(us, random_.below(kStrangersBodies), random_.below(kStrangersBodies),
            us + random_.below(1'000'000) - 300'000);
      }
    }
  }

 private:
  /// A by B, then B by A, with or without a pause in between, or with one too few of the changes.
  void handOver(std::int64_t us) {
    const BodyNumber a = random_.below(kStrangersBodies);
    const BodyNumber b = (a + 1 + random_.below(kStrangersBodies - 1)) % kStrangersBodies;
    std::int64_t atUs = us + random_.below(200'000) - 20'000;
    const auto next = [&] { return atUs += 1 + random_.below(15'000); };
    say(us, a, b, next());
    if (random_.chance(0.9)) say(us, a, kNoBody, next());
    if (random_.chance(0.5)) atUs -= random_.below(10'000);
    say(us, b, a, next());
    if (random_.chance(0.9)) say(us, b, kNoBody, next());
  }

  void say(std::int64_t us, BodyNumber body, BodyNumber carrier, std::int64_t sinceUs) {
    BodyMessage message;
    message.body = first_ + body;
    message.session = 77;
    message.sequence = sequence_++;
    message.shape = "ball";
    message.carrier = carrier == kNoBody ? kNoBody : first_ + carrier;
    message.movesInFrame = carrier != kNoBody && random_.chance(0.5);
    message.pose.translation = random_.inBox(1.0);
    message.utimeUs = us;
    message.sinceUs = sinceUs;
    add(us, std::move(message));
  }

  void pose(std::int64_t us) {
    RigidPoseMessage message;
    message.session = 77;
    message.sequence = sequence_++;
    message.utimeUs = us + aheadUs_ - (random_.chance(0.1) ? random_.below(400'000) : 0);
    for (BodyNumber i = 0; i < kStrangersBodies; ++i) {
      if (random_.chance(0.3)) continue;
      message.bodies.push_back(
          {first_ + i, kTrackedNow, {Quaternion::Identity(), random_.inBox(0.5)}});
    }
    if (!message.bodies.empty()) add(us, std::move(message));
  }

  template <typename Message>
  void add(std::int64_t us, Message message) {
    crowd_.arrivals.push_back({us + random_.below(3'000), std::move(message)});
  }

  Random random_;
  Crowd& crowd_;
  BodyNumber first_;
  std::int64_t aheadUs_;
  std::int64_t sequence_ = 0;
};

}  // namespace

void addStranger(std::uint64_t seed, Crowd& crowd) {
  Stranger(seed, crowd).speak();
  std::stable_sort(
      crowd.arrivals.begin(), crowd.arrivals.end(),
      [](const CrowdArrival& x, const CrowdArrival& y) { return x.timeUs < y.timeUs; });
}

void leaveStranger(const Crowd& crowd, CrowdTold& told) {
  const auto first = static_cast<BodyNumber>(crowd.truth.world.bodies.size());
  for (EventsMessage& answer : told.answers) {
    auto& events = answer.events;
    events.erase(std::remove_if(events.begin(), events.end(),
                                [&](const ToldEvent& event) {
                                  return event.event.a.body >= first || event.event.b.body >= first;
                                }),
                 events.end());
    auto& unknown = answer.unknown;
    unknown.erase(std::remove_if(unknown.begin(), unknown.end(),
                                 [&](const UnknownPart& part) { return part.body >= first; }),
                  unknown.end());
  }
}

}  // namespace foretouch::test
