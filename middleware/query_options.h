// middleware/query_options.h: what a query can answer, and how: fidelity, tolerance, what is
// ignored; settings for a link with an object, or for many of both, resolved to these; and how much
// work a time limit is. A budget counts evaluations in lanes, so the wall clock decides no verdict
// and a replay repeats every one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch {

/// What counts as a link's surface. Clear at Link implies no contact at Exact, and Link never
/// reports a contact later than Exact does.
enum class Fidelity : std::uint8_t {
  Link,     ///< Its LSS.
  Exact,    ///< The triangles of its mesh, and LSS that contain no triangle. A subset of Link's
            ///< contacts, never earlier.
  Skinned,  ///< The triangles of a skin, whose vertices follow a blend of several links; a link
            ///< without triangles keeps its LSS.
};

/// "link", "exact", "skinned".
[[nodiscard]] const char* toString(Fidelity fidelity);

/// Says that "limb", "avatar" and "ellipsoid", volumes around several links that older versions
/// had, are gone, why, and what to use instead. Empty for any other name.
[[nodiscard]] std::string whyFidelityIsGone(const std::string& name);

/// Which contacts of a step the query reports.
enum class Scope : std::uint8_t {
  EveryLink,      ///< Every link's own first contact.
  FirstOfAvatar,  ///< Only the earliest contacts of the whole avatar. All other links are Undecided
                  ///< (AfterFirst), free until that instant, even if they touch nothing in the
                  ///< step; only links without a surface are Clear.
  EveryObject,    ///< Every link's own first contact with each object of the scene:
                  ///< StepContacts::perObject. A hand that rests on a table still meets the cup.
                  ///< At link and exact fidelity, without a budget.
};

/// "links", "avatar", "objects".
[[nodiscard]] const char* toString(Scope scope);

/// A link, or a link and one object, whose contacts the query ignores.
struct IgnoredPair {
  LinkId link = 0;
  ObjectId object = kEveryObject;
  static constexpr ObjectId kEveryObject = -1;
};

/// A query refuses a tolerance below this (m). Above it, the coordinates decide (UndecidedReason).
inline constexpr double kMinTolerance = 1e-9;
/// It also refuses one above this (m): boxes grown by more need not fit into floats.
inline constexpr double kMaxTolerance = kMaxCoordinate;
/// Metres. The one place that spells it for C++, C, Python and the commands.
inline constexpr double kDefaultTolerance = 1e-3;

/// One link's own tolerance and fidelity, if links differ. Its verdict keeps the promise for this
/// tolerance and the surface of this fidelity, whatever those of the others are.
struct LinkPolicy {
  double tolerance = kDefaultTolerance;  ///< Metres; kMinTolerance to kMaxTolerance.
  Fidelity fidelity = Fidelity::Link;    ///< Link or Exact.
};

/// Query::build() refuses by name what its fidelity cannot honour.
struct QueryOptions {
  double tolerance = kDefaultTolerance;  ///< eps in metres; kMinTolerance to kMaxTolerance.
  Fidelity fidelity = Fidelity::Link;
  /// The same avatar's. Fidelity::Exact needs it, for all links or for one. Where no link needs it,
  /// it is not looked at; nor is the skin.
  std::optional<AvatarSurface> surface;
  std::optional<SkinnedSurface> skin;  ///< The same avatar's. Fidelity::Skinned needs it.
  Scope scope = Scope::EveryLink;
  /// A link that begins within the tolerance of the scene without touching it, and whose witness
  /// point does not approach the scene's, is not stopped there: its first contact is the next one
  /// within a quarter of the separation that it began with. So a body that was stopped at `toi` can
  /// leave again, and never comes nearer than that quarter. Below a separation of 4 nm it is
  /// stopped all the same. At link and exact fidelity.
  bool passSeparating = false;
  std::vector<IgnoredPair> ignored;
  /// One per link, in order. They replace `tolerance` and `fidelity`; `fidelity` must still be Link
  /// or Exact. Empty: all links alike. If all policies are equal, the answer is that without
  /// policies, bit for bit.
  std::vector<LinkPolicy> linkPolicies;
  /// Asks, too, whether own links touch each other: StepContacts::pairs. The same avatar's; at link
  /// and exact fidelity, not with Scope::FirstOfAvatar. Two links with policies meet by the smaller
  /// tolerance, each by the surface of its own fidelity.
  std::optional<PairRules> self;
  /// Work that the step may cost, all links together, in evaluations of a pair in lanes (about 10
  /// ns; middleware/pair/work_meter.h converts other work). Links without an answer by then are
  /// Undecided, free as far as proven; more work never proves less. A step that costs at most seven
  /// eighths of it gets the answer that it gets without a budget. Counted, not timed: the same
  /// query gives the same answer.
  std::uint64_t workBudget = std::numeric_limits<std::uint64_t>::max();
  /// The same by the clock, in microseconds from the start of the query, which reads the clock
  /// between pieces of work of a few microseconds. Which links get an answer in time depends on the
  /// machine and its load.
  double deadlineUs = std::numeric_limits<double>::infinity();
};

/// Microseconds per evaluation of a pair in lanes, or as much other work: about its time on a 2.x
/// GHz server core. On other machines a budget takes more or less time, but the same work.
inline constexpr double kEvaluationUs = 0.01;

/// QueryOptions::workBudget of a step that may take about `budgetUs`; at least 1.
/// Precondition: budgetUs > 0 and finite.
[[nodiscard]] inline std::uint64_t workBudget(double budgetUs) {
  constexpr double kMost = 1e15;  // beyond any query; a whole number as a double
  const double work = budgetUs / kEvaluationUs;
  if (!(work > 1.0)) return 1;
  return static_cast<std::uint64_t>(work < kMost ? work : kMost);
}

/// What it leaves out stays as it was.
struct ObjectPolicy {
  std::vector<LinkId> links;         ///< None: every link.
  std::vector<ObjectId> objects;     ///< None: every object.
  std::optional<double> tolerance;   ///< Metres, kMinTolerance to kMaxTolerance.
  std::optional<Fidelity> fidelity;  ///< Link or Exact; only without objects.
  std::optional<bool> ignore;        ///< False: no longer ignored.
};

/// More than all pairs of a body of a hundred links and a scene of ten thousand objects.
inline constexpr std::size_t kMaxResolvedPairs = std::size_t{1} << 20;

/// Applies the policies in order, later ones over earlier ones and all of them over the options.
/// Fills the options' ignored pairs, in as few as possible. If any policy sets a tolerance or
/// fidelity:
///   - A link's tolerance is the least of its tolerances for the objects that it does not ignore,
///     so a contact with any of them is within that object's tolerance.
///   - The options' own tolerance becomes the largest of the links', and their fidelity Exact if
///     any link's is, else Link. Links that are ignored altogether do not count.
///   - The options get link policies only if links differ.
/// Errors: a tolerance or an ignored pair of the options out of range; and, with the policy's place
/// in the list as index: a link or an object that is not there, a
/// tolerance out of range, a fidelity other than Link and Exact or beside objects, a tolerance or
/// fidelity while the options' fidelity is neither Link nor Exact or while they have link policies,
/// more than kMaxResolvedPairs pairs. O(policies * links * objects).
[[nodiscard]] Result<Done> applyObjectPolicies(const std::vector<ObjectPolicy>& policies,
                                               std::int32_t numLinks, std::int32_t numObjects,
                                               QueryOptions& options);

}  // namespace foretouch
