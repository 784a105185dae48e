// middleware/world/system_query.h: one question about a system, asked of the span that it is at,
// and answered in the world's words. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/lanes/node_planes.h"
#include "middleware/lanes/pair_boxes.h"
#include "middleware/pair/pair_query.h"
#include "middleware/scratch.h"
#include "middleware/world/body_system.h"
#include "middleware/world/system_plan.h"
#include "middleware/world/world_contacts.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// One thread's memory for questions.
struct SystemScratch {
  std::vector<std::int64_t> key;
  LatePlans late;
  PieceMotions motions;
  SystemSpans spans;
  SystemPoses poses;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // that of the poses' roots
  Pose relativeFrom, relativeTo;
  ChainMotion motion, other;  // of the chains, or of what is seen from a mesh
  ChainMotion ofSystem;       // of the chain, where that is seen from a mesh
  StepContacts step;
  std::vector<WorldContact> met, again;  // before the window, and what becomes of them in it
  std::vector<LssIndexPair> meeting;     // in the numbers of the plan's sides
  std::vector<PlanePair> open;
  Scratch query;
};

/// For one thread. What it refers to outlives it.
class SystemQuery {
 public:
  SystemQuery(const WorldParts& world, SystemPlans& plans, SystemScratch& scratch)
      : world_(world), plans_(plans), scratch_(scratch), work_(world.options.workPerPair) {}

  /// What each question from now on may cost; WorldOptions::workPerPair to begin with.
  void limit(std::uint64_t work) { work_ = work; }
  /// The plan of the question for the span that the scratch's spans are at, and the motions of its
  /// chains there: scratch.motion and, for a second one, scratch.other; relative to scratch.origin.
  /// Null if nothing can touch. Errors: as
  /// SystemPlans::planOf().
  Result<const SystemPlan*> prepare(SystemQuestion question, BodyId a, BodyId b);
  /// The places at the span's instants are known well enough.
  [[nodiscard]] bool isResolved() const;
  /// Appends to `found` what meets in the span, unless the two links are among those from `first`
  /// on. Precondition: as prepare() has left it; not Boxes. What two bodies have not got to when
  /// the work is spent is one report: nothing is known of the two from there on. False if it was.
  bool ask(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first,
           std::vector<WorldContact>& found, QueryCounters& counters);
  /// The same for those pairs of LSS of a and b (i of a's, j of b's) alone: everything else of the
  /// two is proven apart. Pieces are those of the span's nodes. Precondition: the question is Pair.
  bool askAmong(const SystemPlan& plan, BodyId a, BodyId b, const MeetingPairs& meeting,
                const std::vector<PlanePair>& open, std::size_t first,
                std::vector<WorldContact>& found, QueryCounters& counters);
  /// The same for all LSS of those of a's own links that `met` names. Precondition: the question
  /// is Self.
  void askAgain(const SystemPlan& plan, BodyId a, const std::vector<WorldContact>& met,
                std::size_t first, std::vector<WorldContact>& found, QueryCounters& counters);
  /// The same from an instant within the span on; what meets does so then or later. False: cannot
  /// be asked in this way (PairQuery::runAmongFrom()), and nothing is found.
  [[nodiscard]] bool askAgainFrom(std::int64_t fromUs, const SystemPlan& plan, BodyId a,
                                  const std::vector<WorldContact>& met, std::size_t first,
                                  std::vector<WorldContact>& found, QueryCounters& counters);
  /// Appends that nothing is known of the two from the span's begin on, or from an instant on.
  void giveUp(BodyId a, BodyId b, std::vector<WorldContact>& found,
              UndecidedReason reason = UndecidedReason::Resolution) const;

  /// Whether, for Pair, the plan's first side is b; never for one body. Precondition: as prepare()
  /// has left it.
  [[nodiscard]] bool isTurned(BodyId a, BodyId b) const;

 private:
  [[nodiscard]] Eigen::Vector3d originOf(SystemQuestion question) const;
  void answer(const SystemPlan& plan);
  void answerAmong(const SystemPlan& plan);
  void nameAll(const SystemPlan& plan, BodyId a, const std::vector<WorldContact>& met);
  [[nodiscard]] FoundPairs foundPairs() const;
  [[nodiscard]] PairMotions beginStep(const SystemPlan& plan);
  bool keepAll(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first,
               std::vector<WorldContact>& found, QueryCounters& counters);
  void keepSeenFromMesh(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first,
                        std::vector<WorldContact>& found);
  [[nodiscard]] WorldContact inSpan(const LinkContact& contact) const;
  [[nodiscard]] WorldContact ofScene(const SystemPlan& plan, BodyId a,
                                     const LinkContact& contact) const;
  [[nodiscard]] ContactSide sideOf(const SystemPlan& plan, BodyId body, LinkId link,
                                   std::int32_t lss, std::int32_t triangle,
                                   const Eigen::Vector3d& p_W) const;
  [[nodiscard]] WorldContact ofPair(const SystemPlan& plan, BodyId a, BodyId b,
                                    const PairContact& contact) const;

  [[nodiscard]] bool isUndone(BodyId b, const LinkContact& contact);
  static WorldContact givenUp(BodyId a, BodyId b, const WorldTime& from, UndecidedReason reason);

  const WorldParts& world_;
  SystemPlans& plans_;
  SystemScratch& scratch_;
  std::uint64_t work_;
  double undoneFrom_ = 1.0;  // for the two bodies that were asked last
};

/// The same two links.
[[nodiscard]] bool areSameLinks(const WorldContact& x, const WorldContact& y);
/// Appends the contact unless the two have theirs among those from `first` on.
void keep(const WorldContact& contact, std::size_t first, std::vector<WorldContact>& found);

void addCounters(const QueryCounters& more, QueryCounters& sum);

}  // namespace foretouch::internal
