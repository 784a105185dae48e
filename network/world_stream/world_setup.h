// network/world_stream/world_setup.h: what a live world is made of: the shapes that messages name,
// the avatars that pose_t is about, and how long a body is waited for. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/track.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_options.h"
#include "middleware/world/world.h"
#include "network/wire/world_messages.h"

namespace foretouch {

/// A shape that bodies may have: exactly one of the first two after its name is there.
struct WorldShape {
  std::string name;
  std::optional<Avatar> avatar;  ///< Or a rigid prop made of LSS: one link.
  std::optional<Scene> mesh;
  BodyGroup group = 0;
  std::optional<PairRules> self;
};

/// The hash of what touches, as defined in docs/formats.md ("Shape hash"): XXH64 of the names,
/// parents, rest pose and LSS of its links, or of its triangles. Never 0.
[[nodiscard]] std::int64_t shapeHash(const WorldShape& shape);

struct WorldSetup {
  std::optional<Scene> still;  ///< What never moves; solid bodies need one.
  WorldOptions options;
  /// Tells an empty world what is asked; none: everything. Called again where a timeline begins
  /// anew.
  std::function<Result<Done>(World&)> ask;
  std::vector<WorldShape> shapes;  ///< Names differ.
  struct ServedAvatar {
    BodyNumber number = 0;  ///< As in pose_t.
    std::size_t shape = 0;
    /// It is solid: its tracked poses are targets, and what is in the world is what it shows.
    std::optional<SolidOptions> solid{};
  };
  std::vector<ServedAvatar> avatars;  ///< Numbers differ.
};
/// Whether any body of the world is solid.
[[nodiscard]] bool hasSolidBodies(const WorldSetup& setup);
/// The options of a solid body; null: it is not solid.
[[nodiscard]] const SolidOptions* solidOptionsOf(const WorldSetup& setup, BodyNumber body);

/// Times in microseconds.
struct WorldPolicy {
  /// A body that has said nothing captured in the last `waitUs` before the newest receipt is silent
  /// (unless `whenSilent` is Wait): the watermark goes on without it. So clocks of senders must
  /// agree with the service's within this. 1 to kMostWorldWaitUs.
  std::int64_t waitUs = 200'000;
  /// What silence means. Wait: the watermark waits for ever.
  WhenSilent whenSilent = WhenSilent::Undecided;
  /// A pose captured later than this after its receipt is refused. 0 to kMostWorldWaitUs.
  std::int64_t aheadUs = 1'000'000;
  /// A body that no sender speaks of for so long is gone. At least `waitUs`.
  std::int64_t forgetUs = 60'000'000;
  /// Bodies that are there at a time, avatars included. 1 to kMaxToldBodies.
  std::size_t maxBodies = 1024;
};
inline constexpr std::int64_t kMostWorldWaitUs = 60'000'000;
/// Accepted poses of a body that wait for the watermark; more are refused (Overrun).
inline constexpr std::size_t kMostWaitingKnots = 1024;
/// Changes of what carries a body that wait for the watermark; more are refused (Overrun).
inline constexpr std::size_t kMostWaitingChanges = 64;
/// What a served world's WorldOptions should be: ten milliseconds per window, perhaps, whatever is
/// there; and no body is asked about more neighbours than a crowd of people has.
inline constexpr std::uint64_t kServedWorkPerWindow = 1'000'000;
inline constexpr std::size_t kServedMostNear = 64;
/// One advance follows the world from pose to pose, but in at most so many windows.
inline constexpr std::uint64_t kMostWindowsPerAdvance = 64;
/// The watermark moves by at least so much (us): a sender that sends more often, or much of many
/// bodies by turns, does not cause as many answers, each of which lists all bodies.
inline constexpr std::int64_t kLeastAdvanceUs = 1000;
/// How many bodies may hang on one another.
inline constexpr int kMostCarriers = 8;
/// Solid bodies of one world: each may cost a tick its whole budget.
inline constexpr std::size_t kMostSolidBodies = 64;
/// Solid bodies go from pose to pose, but in at most so many ticks per advance; once so much work
/// is done, the next tick goes to its end: 50 ms, perhaps.
inline constexpr std::size_t kMostTicksPerAdvance = 16;
inline constexpr std::uint64_t kSolidWorkPerAdvance = 5'000'000;
/// The group of what shows to solid worlds how late it is; no body may have it.
inline constexpr BodyGroup kClockGroup = kNumBodyGroups - 1;

}  // namespace foretouch
