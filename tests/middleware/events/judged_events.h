// tests/middleware/events/judged_events.h: what a follower says of a world, held against samples of
// the judge's own from both sides: nothing touches in what is free, nothing is farther apart than
// twice the tolerance in contact.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "middleware/events/world_follower.h"
#include "tests/middleware/world/both_worlds.h"

namespace foretouch::test {

struct EventTally {
  std::uint64_t samples = 0;   ///< Two links at an instant.
  std::uint64_t touching = 0;  ///< Of these: they overlap.
  std::uint64_t parts = 0, unresolved = 0, severalParts = 0;
  std::uint64_t kinds[kNumEventKinds] = {};
  EventCounters counters;
  std::vector<std::string> problems;  ///< What broke the promise.

  void add(const EventTally& more);
};

class JudgedEvents {
 public:
  JudgedEvents(BothWorlds& both, std::int64_t fromUs, const FollowOptions& options = {});

  /// Follows until then, and adds what it is told.
  void follow(std::int64_t untilUs);
  /// Samples all that was told: `instants` of the time, and some beside every begin and end; of own
  /// links, those that the body's rules ask.
  void judge(int instants);

  std::vector<WorldEvent> events;
  EventTally tally;
  std::function<void(std::vector<WorldPart>&)> tamper;  ///< Changes parts before they are judged.

 private:
  /// Two links: body, link, body, link.
  using Links = std::tuple<BodyId, LinkId, BodyId, LinkId>;
  struct Part {
    double fromUs, toUs;  // after fromUs_
    bool isContact;
  };

  void gather();
  void judgeEvents();
  void judgeEvent(const WorldEvent& event);
  void judgePairs(BodyId a, BodyId b, const std::vector<Real>& instants);
  void judgeAt(BodyId a, BodyId b, Real us, const std::vector<Real>& separations);
  [[nodiscard]] bool isAsked(BodyId a, LinkId linkOfA, BodyId b, LinkId linkOfB) const;
  [[nodiscard]] Real after(const WorldTime& time) const;
  void say(const std::string& what);

  BothWorlds& both_;
  WorldFollower follower_;
  WorldEvents answer_;
  std::vector<WorldPart> parts_;
  std::map<Links, std::vector<Part>> partsOf_;
  std::int64_t fromUs_, untilUs_;
  double tolerance_;
};

}  // namespace foretouch::test
