// tests/middleware/world/both_worlds.h: a world and the judge's own, told the same, and every
// answer of the one held against the other.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "judge/world_judge.h"
#include "middleware/world/world.h"
#include "tests/support/judged.h"

namespace foretouch::test {

using oracle::OracleBody;
using oracle::OracleEpisode;
using oracle::OracleOutcome;
using oracle::OraclePart;
using oracle::OraclePlace;
using oracle::OracleTouch;
using oracle::OracleWorld;
using oracle::Real;

/// How many answers there were of each kind, over all pairs of links.
struct WorldTally {
  int clear = 0, contact = 0, start = 0, undecided = 0, grazing = 0;
};

class BothWorlds {
 public:
  explicit BothWorlds(double tolerance);
  BothWorlds(const std::optional<Scene>& still, const WorldOptions& options);

  BodyId add(const Avatar& avatar, const BodyOptions& options = {});
  BodyId add(const Scene& mesh, const BodyOptions& options = {});
  void push(BodyId body, std::int64_t utimeUs, const Pose& pose);
  void push(BodyId body, std::int64_t utimeUs, const RigidPose& pose);
  void attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs, const Pose& pose);
  void attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs, const RigidPose& pose);
  void detach(BodyId body, std::int64_t utimeUs, const RigidPose& pose);

  /// Asks, and judges every pair of links of the given bodies; adds to `problems`.
  void judge(BodyId a, BodyId b, std::int64_t fromUs, std::int64_t toUs);
  /// The same for every two bodies, for own links where a body asks for these, and for the static
  /// scene.
  void judgeAll(std::int64_t fromUs, std::int64_t toUs);

  /// One carries the other at some time, and so they are not asked: all of what is held fast, the
  /// roots of what moves in the frame.
  [[nodiscard]] bool areJoined(BodyId a, LinkId linkOfA, BodyId b, LinkId linkOfB) const;

  World world;
  OracleWorld oracle;
  Scratch scratch;
  WorldContacts answer;
  WorldTally tally;
  std::vector<std::string> problems;           ///< What broke the promise.
  std::function<void(WorldContacts&)> tamper;  ///< Changes answers before they are judged.

 private:
  void ask(std::int64_t fromUs, std::int64_t toUs);
  void judgePair(BodyId a, BodyId b, std::int64_t fromUs, std::int64_t toUs);
  void judgeOwn(BodyId body, const PairRules& rules, std::int64_t fromUs, std::int64_t toUs);
  void judgeStill(BodyId body, std::int64_t fromUs, std::int64_t toUs);
  void judgeLinks(BodyId a, LinkId linkOfA, BodyId b, LinkId linkOfB, std::int64_t fromUs,
                  const OracleTouch& truth);
  [[nodiscard]] bool hasParts(BodyId body, LinkId link) const;
  [[nodiscard]] std::string problemOf(const WorldContact& contact, const OracleTouch& truth,
                                      std::int64_t fromUs) const;
  [[nodiscard]] int placeInOracle(BodyId body) const;
  OracleEpisode& episode(BodyId body, std::int64_t utimeUs);

  double tolerance_;
  std::set<std::tuple<BodyId, BodyId, LinkId>> heldFast_;  ///< By carrier and its link.
  OracleBody still_;  ///< Not among the judge's bodies but while it is judged: then the last one.
};

}  // namespace foretouch::test
