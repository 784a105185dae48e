// middleware/query_options.h: what a query can answer, and how.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "articulated/pair_rules.h"
#include "articulated/skeleton.h"
#include "middleware/fidelity.h"
#include "middleware/scene/triangle_id.h"
#include "middleware/surface/avatar_surface.h"
#include "middleware/surface/skinned_surface.h"

namespace foretouch {

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
  /// Of the same avatar. Fidelity::Exact needs it, for all links or for one. Where nobody needs it,
  /// it is not looked at; nor is the skin.
  std::optional<AvatarSurface> surface;
  std::optional<SkinnedSurface> skin;  ///< Of the same avatar. Fidelity::Skinned needs it.
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
  /// Asks whether own links touch each other, too: StepContacts::pairs. Of the same avatar; at link
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

}  // namespace foretouch
