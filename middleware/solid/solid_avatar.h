// middleware/solid/solid_avatar.h: an avatar that passes through nothing. Tracked poses in, shown
// poses out: each shown motion, from the last shown pose to the next, is proven clear by the query
// before it is shown. The shown pose follows the tracked one as closely as surfaces let it, by
// Gauss' least constraint on the tree of joints with a visual inertia ([Ortega07] for one rigid
// body, REFERENCES.md). The mathematics, the promise and its proof: middleware/solid/solid.md.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch {

namespace internal {
class JointRanges;
class SolidPhases;
}  // namespace internal

/// One avatar's shown pose, its scene and its memory. For one thread; any number of them may share
/// an Avatar and a Scene. The answers depend on the sequence of targets and the options only, not
/// on time, threads or vector width within the query's promise.
class SolidAvatar {
 public:
  /// Errors: options out of range; per-link options that do not fit the avatar; ignored pairs,
  /// rules of another avatar. O(links^2).
  static Result<SolidAvatar> build(const Avatar& avatar, const Scene& scene,
                                   const SolidOptions& options = {});
  ~SolidAvatar();
  SolidAvatar(SolidAvatar&&) noexcept;
  SolidAvatar& operator=(SolidAvatar&&) noexcept;

  /// One tick. Errors: a pose that is not one of this avatar (count, NaN, range), a dtS out of
  /// range: the shown pose stays, and `tick` is unchanged. Allocates nothing once memory has grown
  /// to the scene's needs. The first target is where the avatar begins; if it touches something
  /// there, the nearest free place (SolidState::Placing until one is found).
  Result<Done> follow(const SolidTarget& target, SolidTick& tick);

  /// Forgets the shown pose: the game teleported its user. The next target is the first again.
  void reset();
  /// The same, but the avatar begins at this pose, which is known to be outside of everything (a
  /// spawn point). The next target must be reached from here. Errors: as follow(); Mismatch if it
  /// touches something (then nothing has changed).
  Result<Done> reset(const Pose& place);
  /// Goes on in another scene: a door has opened. If the avatar is inside it there, it stays
  /// (SolidLimit::Inside) until a tick finds the nearest free place, as a first one.
  /// Errors: as build(), and nothing has changed.
  Result<Done> changeScene(const Scene& scene);

  /// For what leads the avatar through more than a scene (middleware/solid_world): where the last
  /// target led, its lost joints at their places and the lift included; empty before the first one.
  [[nodiscard]] const Pose& target() const;
  /// Goes on from another place, to which the caller has led the avatar by motions of its own, and
  /// for which it vouches. Precondition: a validated pose of the avatar. `before`: the same person
  /// without what the hands have taken; what was seen of the joints there stays known.
  void resume(const Pose& shown, const SolidAvatar* before = nullptr);
  /// How the tracked joints were seen to turn.
  [[nodiscard]] const internal::JointRanges& ranges() const;
  /// For benchmarks: what times the phases of ticks from now on; null: nothing does.
  void watch(internal::SolidPhases* phases);

  [[nodiscard]] const Avatar& avatar() const;
  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const SolidOptions& options() const;

  class Parts;

 private:
  explicit SolidAvatar(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace foretouch
