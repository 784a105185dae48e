// middleware/edges/edge_query.h: the question of a motion planner: is the straight line in joint
// coordinates from q0 to q1 free, and if not, how far? Proven, rounding included
// (articulated/robot.md). Lengths in metres in W; t is 0 at q0 and 1 at q1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/robot.h"
#include "articulated/skeleton.h"
#include "middleware/contact.h"
#include "middleware/near/clearance.h"
#include "middleware/query/query.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"
#include "middleware/worker_pool.h"

namespace foretouch {

namespace internal {
class ClearanceSearch;
}  // namespace internal

/// A rigid thing in the way whose place may change between questions: EdgeQuery::place().
struct EdgeProp {
  Scene scene;                                  ///< In the prop's own frame P.
  std::optional<RigidPose> X_WP = RigidPose{};  ///< Nothing: it is not there.
  std::vector<IgnoredPair> ignored;             ///< Links and objects of this prop's scene.
};

struct EdgeOptions {
  double tolerance = kDefaultTolerance;  ///< Metres, as QueryOptions::tolerance.
  /// Clear proves that the robot keeps more than this (m, >= 0) away from the scene, and that asked
  /// pairs of own links keep it between them. Contact is then a separation that comes down to it.
  double clearance = 0.0;
  /// Own links: of the robot's avatar; nothing: not asked.
  std::optional<PairRules> self;
  std::vector<IgnoredPair> ignored;
  /// Obstacles beside the scene, each with a place of its own.
  std::vector<EdgeProp> props;
  /// For clearance(): how far its bounds may be apart, and how far it looks (ClearanceOptions).
  double clearanceTolerance = kDefaultTolerance;
  double clearanceWithin = std::numeric_limits<double>::infinity();
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
  /// The prop that is met, whose scene has the contact's triangle; -1: none.
  std::int32_t prop = -1;
  /// An end outside the joints' limits, which the verdict does not look at.
  LimitBreach breachAt0, breachAt1;

  /// Proven free, and both ends within limits: a planner may use it.
  [[nodiscard]] bool isUsable() const {
    return verdict == Verdict::Clear && !breachAt0.isAny() && !breachAt1.isAny();
  }
};

/// How near an edge comes to the scene and to the props that are there.
struct EdgeClearance : Clearance {
  std::int32_t prop = -1;  ///< The prop whose scene has the triangle; -1: the query's own.
};

/// How far a path is free: a list of configurations, with an edge from each to the next.
struct PathAnswer {
  std::size_t edge = 0;  ///< The first edge that is not Clear; the number of edges: all are.
  /// The path keeps its clearance on [0, freeUntil), never too late: `edge` plus how far that one
  /// is free. The number of edges if all are Clear.
  double freeUntil = 0.0;
  EdgeAnswer answer;  ///< That edge's; the last one's if all are Clear.
};

/// Checked and resolved once. Copies are cheap; any number of threads may ask one, each with a
/// scratch of its own.
class EdgeQuery {
 public:
  /// Errors: as Query::build(), also of a prop and its scene; a clearance that is not from 0 to
  /// 1e7 m; those of place() (Error::index is the prop).
  static Result<EdgeQuery> build(const Robot& robot, const Scene& scene,
                                 const EdgeOptions& options = {});

  /// Moves a prop; nothing is built anew. A copy of this query has places of its own. Not while
  /// another thread asks. Errors: no such prop; a rotation that is not unit, or a place that is not
  /// finite or beyond kMostPropDistance. Then it is where it was.
  Result<Done> place(std::size_t prop, const std::optional<RigidPose>& X_WP);
  /// How far a prop may be along each axis of W (m): its own frame is known to rounding there.
  static constexpr double kMostPropDistance = 1e4;
  [[nodiscard]] std::size_t numProps() const { return props_.size(); }

  [[nodiscard]] const Robot& robot() const { return *robot_; }
  [[nodiscard]] const Scene& scene() const { return scene_->scene(); }
  /// As given to build().
  [[nodiscard]] const EdgeOptions& options() const { return *options_; }
  /// Errors: as Robot::checked(). `count`: the numbers in each of q0 and q1. An edge from q to q
  /// asks whether q is free.
  [[nodiscard]] Result<EdgeAnswer> answer(const double* q0, const double* q1, std::size_t count,
                                          Scratch& scratch) const;
  [[nodiscard]] Result<EdgeAnswer> answer(const std::vector<double>& q0,
                                          const std::vector<double>& q1, Scratch& scratch) const;

  /// Many edges on the pool's threads: q0 and q1 each hold `count` configurations one after the
  /// other, of `robot().numCoordinates()` numbers. Resizes `answers`. An edge takes no lock and,
  /// once the threads' memory has grown, allocates nothing. Errors: as answer() of the first edge
  /// with one (Error::index is the edge), before any is asked; memory runs out: then the edges that
  /// were broken off are Undecided from 0.
  Result<Done> answerAll(const double* q0, const double* q1, std::size_t count, WorkerPool& pool,
                         std::vector<EdgeAnswer>& answers) const;
  /// `count` configurations one after the other, at least two. Asks no more edges than lie before
  /// the first one that is not Clear, but for those that other threads have begun. Errors as above.
  Result<PathAnswer> answerPath(const double* q, std::size_t count, WorkerPool& pool) const;

  /// How near the edge comes: its separation from the scene and from the props that are there is
  /// never below `lower`, and at most `upper` at `t`. EdgeOptions::clearance and own links have no
  /// part in it; what the query ignores has none either. `slope0` and `slope1`: where not null,
  /// `count` numbers each, how `upper` changes with the coordinates of q0 and q1 (m per rad or m);
  /// for one of several, where Clearance::isAlone is false. Errors: as answer(), and an edge of
  /// more than kMostParts parts.
  [[nodiscard]] Result<EdgeClearance> clearance(const double* q0, const double* q1,
                                                std::size_t count, Scratch& scratch,
                                                double* slope0 = nullptr,
                                                double* slope1 = nullptr) const;
  /// Many of them on the pool's threads, as answerAll().
  Result<Done> clearanceAll(const double* q0, const double* q1, std::size_t count, WorkerPool& pool,
                            std::vector<EdgeClearance>& answers, double* slopes0 = nullptr,
                            double* slopes1 = nullptr) const;

  /// An edge is cut into at most so many parts, of Robot::kMostTurn each; else it is undecided.
  static constexpr int kMostParts = Robot::kMostParts;

 private:
  struct Prop {
    Query query;
    ClearanceQuery clearance;
    std::optional<RigidPose> X_WP;  // its rotation normalised
  };
  EdgeQuery() = default;
  Result<Done> addProps(const EdgeOptions& options);
  void answerPart(Scratch& scratch, EdgeAnswer& answer, int part, int parts) const;
  void answerProps(Scratch& scratch, EdgeAnswer& answer) const;
  void lookAt(internal::ClearanceSearch& search, Scratch& scratch, double begin,
              double share) const;
  void findSlopes(const EdgeClearance& answer, const double* q0, const double* q1, Scratch& scratch,
                  double* slope0, double* slope1) const;

  std::shared_ptr<const Robot> robot_;
  std::shared_ptr<const EdgeOptions> options_;
  std::vector<Prop> props_;
  std::optional<ClearanceQuery> clearance_;
  std::optional<Query> scene_, self_;  // own links have other radii with a clearance
};

}  // namespace foretouch
