// middleware/solid/certifier.h: proves small motions of a solid avatar clear, or cuts them where
// they meet something. Metres in W. Not installed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "middleware/pair/query_plan.h"
#include "middleware/query/query.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_phases.h"

namespace foretouch::internal {

/// What stopped a motion: an LSS, and a triangle or an LSS of another link.
struct SolidHit {
  LinkId link = 0;
  std::int32_t lss = -1;
  TriangleId triangle = -1;
  LinkId other = kNoParent;  ///< An own link instead of the scene.
  std::int32_t otherLss = -1;
};

struct Certified {
  bool isClear = false;   ///< The whole motion.
  double share = 0.0;     ///< How much of it is proven, and far enough from what it meets.
  bool isInside = false;  ///< It begins in contact.
  bool isOverBudget = false;
  bool hasHit = false;
  SolidHit hit;
  double clearance = 0.0;  ///< Proven lower bound on the separation over the share.
};

/// Whether own links touch each other at a place.
struct OwnTouch {
  bool isAnswered = false;  ///< False: the tick's work did not suffice.
  bool touches = false;
  LinkId link = 0, other = 0;  ///< Two that do.
};

/// What counts of the radii of two LSS of different links (PairRadius).
[[nodiscard]] double ownRadii(const QueryPlan& plan, LinkId link, std::int32_t lss, LinkId other,
                              std::int32_t otherLss);
/// The gap of the LSS and the triangle, or of the two LSS, with the links there; a lower bound.
/// `atOther` counts only for an own link.
[[nodiscard]] double gapOf(const QueryPlan& plan, const SolidHit& pair, const LinkState& atLink,
                           const LinkState& atOther);

/// For one thread. Allocates nothing once grown.
class Certifier {
 public:
  static Result<Certifier> build(const Avatar& avatar, const Scene& scene,
                                 const SolidOptions& options);

  [[nodiscard]] const QueryPlan& plan() const { return *plan_; }
  [[nodiscard]] const Avatar& avatar() const { return plan_->avatar; }
  [[nodiscard]] const Scene& scene() const { return plan_->scene; }

  /// Begins a tick with so much work to spend.
  void beginTick(std::uint64_t work);
  [[nodiscard]] std::uint64_t workLeft() const { return workLeft_; }
  [[nodiscard]] std::uint64_t workDone() const { return workDone_; }
  [[nodiscard]] std::uint32_t queries() const { return queries_; }
  void spend(std::uint64_t work);
  /// Keeps so much of the tick's work, if it is there, for giveBack(); says how much.
  [[nodiscard]] std::uint64_t keepBack(std::uint64_t work) {
    const std::uint64_t kept = std::min(work, workLeft_);
    workLeft_ -= kept;
    return kept;
  }
  void giveBack(std::uint64_t kept) { workLeft_ += kept; }
  /// Null, or what times the phases of ticks; must outlive them.
  void watch(SolidPhases* phases) { phases_ = phases; }

  /// Asks the motion from one validated pose to another. `reached` becomes `to` if it is clear,
  /// else the last pose of the share. Precondition: `reached` is neither of the two.
  Certified certify(const Pose& from, const Pose& to, Pose& reached);
  /// As certify(), but keeps the whole motion or nothing of it.
  [[nodiscard]] bool isClear(const Pose& from, const Pose& to);
  /// The clearance of a place: of the avatar while it stands still there. 0: it touches something,
  /// or the tick's work is spent.
  [[nodiscard]] double clearanceAt(const Pose& place);
  /// Whether the options ask for own links at all.
  [[nodiscard]] bool asksOwnLinks() const { return plan_->self.isAsked(); }
  /// Precondition: asksOwnLinks().
  [[nodiscard]] OwnTouch ownTouchAt(const Pose& place);

 private:
  explicit Certifier(std::shared_ptr<QueryPlan> plan, double skin);
  void run(const Pose& from, const Pose& to);
  [[nodiscard]] Certified ask(const Pose& from, const Pose& to);
  void cut(Certified& answer, double toi);
  void findSheet(const SolidHit& hit, double toi);
  [[nodiscard]] double gapAt(const SolidHit& hit, double t);
  [[nodiscard]] double roundingOfMotion() const;

  std::shared_ptr<QueryPlan> plan_;  // the query's; only the budget in it changes
  Query query_;
  double skin_;
  Scratch scratch_;
  StepContacts step_;
  ChainMotion motion_;
  MotionEvaluator evaluator_;
  struct Sheet {
    bool isMet = false;
    Eigen::Vector3d p, n;  // a point, and the unit normal to the side of the LSS
  };
  Sheet sheet_;  // that of the cut that is made
  std::uint64_t workLeft_ = 0, workDone_ = 0;
  std::uint32_t queries_ = 0;
  SolidPhases* phases_ = nullptr;
};

}  // namespace foretouch::internal
