// tests/middleware/triggers/both_triggers.h: a world with triggers and the judge's own, told the
// same; and what the triggers tell, held against dense samples in the judge's terms.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "judge/winding.h"
#include "middleware/events/world_follower.h"
#include "middleware/triggers/triggers.h"
#include "tests/middleware/world/both_worlds.h"

namespace foretouch::test {

/// A volume as the judge has it: LSS, or triangles that are turned alike.
struct PlainVolume {
  TriggerVolume volume;
  std::vector<OraclePart> parts;
  bool isMesh = false;
};
[[nodiscard]] PlainVolume plainBox(const Eigen::Vector3d& halfExtents);
[[nodiscard]] PlainVolume plainSphere(double radius);
[[nodiscard]] PlainVolume plainLss(const std::vector<Lss>& lss);
/// A closed mesh around the origin.
[[nodiscard]] PlainVolume plainGlobe(double radius, int rings, int segments);

struct TriggerTally {
  std::uint64_t samples = 0, inside = 0, whollyInside = 0, unresolved = 0;
  std::uint64_t kinds[kNumEventKinds] = {};
  std::uint64_t decided = 0;
  std::vector<std::string> problems;
};

class BothTriggers {
 public:
  BothTriggers(double tolerance, std::int64_t fromUs);

  TriggerId add(const PlainVolume& volume, const TriggerOptions& options = {});
  void stand(TriggerId trigger, const RigidPose& pose);
  [[nodiscard]] BodyId body(TriggerId trigger) const { return triggers.body(trigger); }
  /// Follows until then, and adds what is told.
  void follow(std::int64_t untilUs);
  /// At so many instants, and beside every event: who is inside is told to be, or unresolved; who
  /// is told to be is, but for twice the tolerance. Leaves out what was guessed when it was told.
  void judge(int instants);

  BothWorlds both;
  Triggers triggers;
  std::vector<TriggerEvent> events;
  TriggerTally tally;

 private:
  struct Told {
    double fromUs, toUs;
    bool isUnresolved;
  };
  /// The body's links, or one of them: the least separation, and whether one is wholly inside.
  struct Truth {
    Real separation = 1e30L;
    bool isInside = false;
  };
  [[nodiscard]] Truth truthOf(TriggerId trigger, BodyId body, LinkId link, Real us) const;
  [[nodiscard]] std::vector<Told> toldOf(TriggerId trigger, BodyId body, LinkId link);
  /// Whether the world had, when it told of the instant, a guess of where the body is.
  [[nodiscard]] bool isGuessed(BodyId body, Real us) const;
  void noteGuesses(std::int64_t untilUs);
  void judgeOne(TriggerId trigger, BodyId body, LinkId link, const std::vector<Real>& instants);
  void say(const std::string& what);

  std::int64_t fromUs_, untilUs_;
  double tolerance_;
  WorldFollower follower_;
  WorldEvents answer_;
  TriggerEvents told_;
  std::vector<bool> areMeshes_;
  std::vector<TriggerOptions> options_;
  /// In the order of time: a body, and from when until when nothing was known of it, though it was
  /// taken to be somewhere, or nowhere.
  std::vector<std::tuple<BodyId, std::int64_t, std::int64_t>> guesses_;
};

}  // namespace foretouch::test
