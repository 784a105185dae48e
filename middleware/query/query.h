// middleware/query/query.h: the question Foretouch answers: what does each link meet first between
// two poses? And, where asked, more about a contact: how fast the two sides approach, and
// up to four points where they are near. Lengths in metres in the world W; t is normalised, 0 at
// the earlier pose and 1 at the later; velocities per unit of t. The promise, its proof and the
// constants in it: docs/guarantees.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/contact.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"
#include "middleware/worker_pool.h"

namespace foretouch {

/// Two points, one of each side, that are near at the contact's instant.
struct ContactPoint {
  Eigen::Vector3d p_WLink = Eigen::Vector3d::Zero();   ///< On the link's surface.
  Eigen::Vector3d p_WOther = Eigen::Vector3d::Zero();  ///< On the scene, or the other link.
  double separation = 0.0;         ///< As computed; below zero where the two overlap.
  TriangleId triangle = -1;        ///< In the scene, or in the other link's mesh.
  std::int32_t lss = -1;           ///< Index among the link's LSS.
  std::int32_t linkTriangle = -1;  ///< In the link's mesh; -1 at link fidelity.
};

struct ContactDetails {
  static constexpr std::size_t kMostPoints = 4;

  /// Velocities of the material points at the two witness points, at the contact's instant.
  Eigen::Vector3d v_WLink = Eigen::Vector3d::Zero(), v_WOther = Eigen::Vector3d::Zero();
  /// Along the contact's normal, above zero while the two approach; 0 without a normal.
  double approachSpeed = 0.0;
  /// If these two points touch in this step, within the tolerance from here, they do so at a speed
  /// between these along this normal. A lower bound below zero: perhaps they never touch (a graze).
  double approachLower = 0.0, approachUpper = 0.0;
  /// Among the pairs of the same two sides (the link and the object, or both links) within
  /// the tolerance then: the nearest first; then the one farthest from it, the one that spans the
  /// largest triangle with both, and the one farthest on the other side of that. Not in an order
  /// that depends on how the scene's triangles are numbered.
  std::array<ContactPoint, kMostPoints> points;
  std::size_t numPoints = 0;
};

/// For the query's own sources (Query::details()).
namespace internal {
struct QueryPlan;
[[nodiscard]] ContactDetails detailsOf(const QueryPlan& plan, const ChainMotion& motion,
                                       const LinkContact& contact, std::vector<TriangleId>& found);
[[nodiscard]] ContactDetails detailsOf(const QueryPlan& plan, const ChainMotion& motion,
                                       const PairContact& contact);
}  // namespace internal

namespace internal {
struct QueryPlan;
}

class Query;

/// One avatar's step among many. What it points to must outlive the call; poses are validated ones
/// of the query's avatar.
struct StepTask {
  const Query* query = nullptr;
  const Pose* from = nullptr;
  const Pose* to = nullptr;
};

/// A task that was broken off, by its place in the list, and why: memory ran out.
struct FailedTask {
  std::size_t task = 0;
  Error error;
};

/// A question to ask again and again: which avatar, in which scene, with which options. Checked and
/// resolved once; from then on every motion of the avatar has an answer. Copies are cheap, and any
/// number of threads may ask one Query, each with scratch memory of its own.
class Query {
 public:
  /// Errors: options out of range (a tolerance, a policy, an ignored pair, a deadline), or without
  /// what they need (the surface or the skin of this avatar). O(links + LSS).
  static Result<Query> build(const Avatar& avatar, const Scene& scene,
                             const QueryOptions& options = {});

  [[nodiscard]] const Avatar& avatar() const;
  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const QueryOptions& options() const;

  /// The first contact of every link while the avatar moves as `motion` says. Cannot fail: geometry
  /// that cannot be decided is a verdict. Allocates nothing once scratch and step have grown to the
  /// scene's needs. Precondition: a motion of the avatar's skeleton (asserted; one with another
  /// number of links leaves every link Undecided, free until 0).
  void answer(const ChainMotion& motion, Scratch& scratch, StepContacts& step) const;
  [[nodiscard]] StepContacts answer(const ChainMotion& motion, Scratch& scratch) const;

  /// Many avatars, many steps: answers all tasks on the pool's threads and returns when the last
  /// one is done; resizes and reuses `answers`. A task takes no lock and, once the threads' memory
  /// has grown, allocates nothing. The error is that of the first task that failed; `failures`, if
  /// not null, gets them all, in order. Every link of a failed task is Undecided, free until 0; the
  /// other tasks have their answers.
  static Result<Done> answerAll(const std::vector<StepTask>& tasks, WorkerPool& pool,
                                std::vector<StepContacts>& answers,
                                std::vector<FailedTask>* failures = nullptr);

  /// More about a contact that this query answered for this motion. Preconditions: its verdict is
  /// Contact or StartsInContact (asserted; others have no details); link or exact fidelity, for
  /// `points`: elsewhere there are none. Not meant for every contact of every step: it looks at the
  /// near pairs once more, in doubles.
  [[nodiscard]] ContactDetails details(const ChainMotion& motion, const LinkContact& contact,
                                       Scratch& scratch) const;
  [[nodiscard]] ContactDetails details(const ChainMotion& motion, const PairContact& contact,
                                       Scratch& scratch) const;

  /// What a discrete check sees: does the link's surface touch a triangle at this one instant? It
  /// skips ignored pairs; it needs no tolerance, no scope and no budget. The computed distance
  /// decides (no claim within rounding of zero).
  /// Preconditions: as for answer(); a link of the avatar; t in [0, 1].
  [[nodiscard]] bool touchesAt(const ChainMotion& motion, LinkId link, double t,
                               Scratch& scratch) const;

  /// For the query's own sources.
  explicit Query(std::shared_ptr<const internal::QueryPlan> plan) : plan_(std::move(plan)) {}
  [[nodiscard]] const internal::QueryPlan& plan() const { return *plan_; }

 private:
  std::shared_ptr<const internal::QueryPlan> plan_;
};

/// Builds a Query and asks it once. Errors: as Query::build(), or a motion of another avatar.
[[nodiscard]] Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                                 const Scene& scene,
                                                 const QueryOptions& options = {});

}  // namespace foretouch
