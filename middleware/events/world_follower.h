// middleware/events/world_follower.h: follows a world (world.h) through time: from window to window
// it keeps which bodies touch, and reports every enter and leave once. World time in microseconds.
// The promise: docs/guarantees.md 17; how it is kept: events.md.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "middleware/events/world_event.h"
#include "middleware/mechanics/mass.h"
#include "middleware/world/world.h"

namespace foretouch {

struct FollowOptions {
  /// Where time is cut. 0: at every pose of any body. Else at the multiples of so many
  /// microseconds, up to kMostCutUs: less work for many bodies with clocks of their own; what is
  /// after the last multiple waits. One call follows at most kMostCuts of them.
  std::int64_t cutUs = 0;
  /// At most so many windows per call: the last one takes all that is left.
  std::uint64_t mostWindows = std::numeric_limits<std::uint64_t>::max();
  /// In [1, kMaxPoolThreads] (worker_pool.h), the calling one among them.
  int threads = 1;
};
inline constexpr std::int64_t kMostCutUs = 10'000'000;
/// A wrong clock would be followed cut by cut for years: refused, while hours at 1 ms are not.
inline constexpr std::int64_t kMostCuts = 10'000'000;

/// For one thread at a time; the world must not change while it is asked. Memory is bounded by the
/// bodies and by what touches, and nothing is allocated once it has grown.
class WorldFollower {
 public:
  /// Nothing before `fromUs` is reported: what touches there starts inside. Errors: options or an
  /// instant out of range, or the system refuses the threads.
  static Result<WorldFollower> start(std::int64_t fromUs, const FollowOptions& options = {});
  ~WorldFollower();
  WorldFollower(WorldFollower&&) noexcept;
  WorldFollower& operator=(WorldFollower&&) noexcept;

  /// What a body weighs, for WorldEvent::effectiveMass. A body without one is moved by nothing:
  /// it is tracked, or stands still. Errors: as checkedMass(); a body below 0.
  Result<Done> weigh(BodyId body, const Mass& mass);
  /// The same for an avatar that is a ragdoll.
  Result<Done> weigh(BodyId body, AvatarMass mass);

  /// Everything that happens from where the last call ended until `untilUs`; nothing if that is not
  /// later. What it reports depends on the poses alone, for any number of threads and any order in
  /// which they came; and not on the calls, as long as each ends where time is cut
  /// (World::knownUntilUs() is a pose). Until then the world must keep what it knows
  /// (World::forgetBefore()). `answer` is filled anew; its memory is kept.
  /// Errors: as World::contacts(); more than kMostCuts cuts (OutOfRange); another world than in the
  /// last call, or one that asks whether meshes meet (Mismatch). Then nothing has been followed.
  Result<Done> follow(const World& world, std::int64_t untilUs, WorldEvents& answer);

  /// The instant until which it has followed.
  [[nodiscard]] std::int64_t followedUntilUs() const;
  /// What is open, by pair: a's body and link, b's, then the object.
  [[nodiscard]] const std::vector<OpenPart>& open() const;

 private:
  struct Impl;
  explicit WorldFollower(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
