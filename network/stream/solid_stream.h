// network/stream/solid_stream.h: the solid avatar of one avatar's stream: each step becomes one
// SolidMessage. Pure apart from the clock that measures solidUs: the shown poses follow from the
// steps and the options alone, so that a recorded stream repeats them.
//
// - A joint that the later pose does not know (missing, invalid, stale, or not the sender's) is
//   lost: it keeps its place on its parent. Until all roots have been known at once, the avatar has
//   no place: SolidState::Placing, nothing is proven, and the solver is not asked.
// - The shown pose goes on from where it was, whatever the step is: across lost poses, and at the
//   first pose of another timeline, session or skeleton. So it never jumps through anything.
// - The length of a tick is the time between the two captures, at most kMostSolidStepUs: what was
//   not seen is not time in which to catch up. A first pose has none, and counts as
//   kFirstSolidStepUs.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_avatar.h"
#include "network/stream/avatar_stream.h"
#include "network/wire/messages.h"

namespace foretouch {

inline constexpr std::int64_t kMostSolidStepUs = 1'000'000;
inline constexpr std::int64_t kFirstSolidStepUs = 10'000;

class SolidStream {
 public:
  /// `id`: the avatar's number in messages. Errors: as SolidAvatar::build(); an avatar of more than
  /// kMaxSolidJoints joints, which no message can hold.
  static Result<SolidStream> make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                  const SolidOptions& options);

  /// Follows the step of one accepted pose, in the order of acceptance; fills `answer`, but for the
  /// stamps of receiving and sending. A way of more than kMaxSolidPoses poses does not travel: the
  /// message then has only its end, not certified.
  void follow(const StreamStep& step, SolidMessage& answer);

  [[nodiscard]] const SolidOptions& options() const { return solid_.options(); }
  /// What was shown before the last step; at the first one, what it showed.
  [[nodiscard]] const Pose& shownBefore() const { return before_; }

 private:
  SolidStream(std::int32_t id, SolidAvatar solid);
  void tick(const StreamStep& step, SolidMessage& answer);
  void fillHead(const StreamStep& step, SolidMessage& answer) const;

  std::int32_t id_ = 0;
  SolidAvatar solid_;
  std::int64_t avatarHash_ = 0;
  bool hasRoots_ = false;  // have been known at once
  std::vector<std::uint8_t> isTracked_;
  SolidTick tick_;
  Pose shown_, before_;
};

}  // namespace foretouch
