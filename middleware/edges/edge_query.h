// middleware/edges/edge_query.h: the question of a motion planner: is the straight line in joint
// coordinates from q0 to q1 free, and if not, how far? Proven, rounding included
// (articulated/robot.md). Lengths in metres in W; t is 0 at q0 and 1 at q1.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/robot.h"
#include "middleware/contact.h"
#include "middleware/query/query.h"
#include "middleware/query/query_scratch.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"

namespace foretouch {

struct EdgeOptions {
  double tolerance = kDefaultTolerance;  ///< Metres, as QueryOptions::tolerance.
  /// Clear proves that the robot keeps more than this (m, >= 0) away from the scene, and that asked
  /// pairs of own links keep it between them. Contact is then a separation that comes down to it.
  double clearance = 0.0;
  /// Own links: of the robot's avatar; nothing: not asked.
  std::optional<PairRules> self;
  std::vector<IgnoredPair> ignored;
};

struct EdgeAnswer {
  /// Undecided claims nothing after `freeUntil`.
  Verdict verdict = Verdict::Undecided;
  UndecidedReason reason = UndecidedReason::None;
  /// The robot keeps its clearance on [0, freeUntil): never too late; 1 if Clear.
  double freeUntil = 0.0;
  /// What is met first; `other` is -1 for the scene. Its toi is the edge's; separation, penetration
  /// and witness points are those of the robot grown by the clearance. Nothing if Clear.
  PairContact contact;
  /// An end outside the joints' limits, which the verdict does not look at.
  LimitBreach breachAt0, breachAt1;

  /// Proven free, and both ends within limits: a planner may use it.
  [[nodiscard]] bool isUsable() const {
    return verdict == Verdict::Clear && !breachAt0.isAny() && !breachAt1.isAny();
  }
};

/// Memory of one thread.
struct EdgeScratch {
  QueryScratch query;
  ChainMotion motion;
  StepContacts step;
  Pose from, to;
  std::vector<double> q;
};

/// Checked and resolved once. Copies are cheap; any number of threads may ask one, each with a
/// scratch of its own.
class EdgeQuery {
 public:
  /// Errors: as Query::build(), and a clearance that is negative or not finite.
  static Result<EdgeQuery> build(const Robot& robot, const Scene& scene,
                                 const EdgeOptions& options = {});

  [[nodiscard]] const Robot& robot() const { return *robot_; }
  /// Errors: as Robot::checked(). `count`: of numbers in each of q0 and q1. An edge from q to q
  /// asks whether q is free.
  [[nodiscard]] Result<EdgeAnswer> answer(const double* q0, const double* q1, std::size_t count,
                                          EdgeScratch& scratch) const;
  [[nodiscard]] Result<EdgeAnswer> answer(const std::vector<double>& q0,
                                          const std::vector<double>& q1,
                                          EdgeScratch& scratch) const;

  /// An edge is cut into at most so many parts, of Robot::kMostTurn each; else it is undecided.
  static constexpr int kMostParts = 4096;

 private:
  EdgeQuery() = default;
  void answerPart(EdgeScratch& scratch, EdgeAnswer& answer, int part, int parts) const;

  std::shared_ptr<const Robot> robot_;
  std::optional<Query> scene_, self_;  // own links have other radii with a clearance
};

}  // namespace foretouch
