// network/stream/stream_solver.h: answers one avatar's stream: each accepted pose becomes one
// ContactsMessage. Pure apart from the query. The service, the replay of a log and the simulator
// all run it, so their answers are equal, byte for byte.
//
// SolidStream is the solid avatar of one avatar's stream: each step becomes one
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

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/query/query.h"
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

class StreamSolver {
 public:
  /// `id`: the avatar's number in messages. Errors: options that a query refuses, a Scope other
  /// than EveryLink (another link's contact would hide an unknown link), a deadline (no clock
  /// decides), a bad policy.
  static Result<StreamSolver> make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                   const QueryOptions& options, const StreamPolicy& policy);

  /// As AvatarStream; a message for another avatar is UnknownAvatar.
  [[nodiscard]] Reject take(const SkeletonMessage& message);
  /// None if it accepted the pose and filled `answer` (measures queryUs; does not touch the stamps
  /// of receiving and sending). A link is
  ///   - Undecided, freeUntil 0, if the step marks it as unknown, whatever the query found; at
  ///     skinned fidelity also if a link that moves its triangles is unknown;
  ///   - Undecided (Gap), freeUntil 0, if the query found it clear or undecided across a gap;
  ///   - else as the query found it. A contact across a gap is one of the in-between motion of the
  ///     two poses that arrived; it does not claim that nothing was touched before.
  [[nodiscard]] Reject take(const PoseMessage& message, ContactsMessage& answer);

  /// From now on there is a solid avatar beside the answers. Errors: as SolidStream::make().
  Result<Done> makeSolid(const SolidOptions& options);
  /// Null: there is none. Give it lastStep() once for each answered pose, after take().
  [[nodiscard]] SolidStream* solid() { return solid_ ? &*solid_ : nullptr; }
  [[nodiscard]] const SolidStream* solid() const { return solid_ ? &*solid_ : nullptr; }

  /// As AvatarStream.
  void changeSpeaker() { stream_.changeSpeaker(); }

  [[nodiscard]] std::int32_t id() const { return id_; }
  [[nodiscard]] const Avatar& avatar() const { return query_.avatar(); }
  [[nodiscard]] const StreamCounts& counts() const { return stream_.counts(); }
  /// As AvatarStream.
  [[nodiscard]] bool leftTrace() const { return stream_.leftTrace(); }
  [[nodiscard]] std::array<std::optional<std::int64_t>, 2> knownHashes() const {
    return stream_.knownHashes();
  }
  [[nodiscard]] const QueryOptions& options() const { return query_.options(); }
  /// The step that the last answered pose ended; valid until the next take().
  [[nodiscard]] const StreamStep& lastStep() const { return lastStep_; }

 private:
  StreamSolver(std::int32_t id, Query query, AvatarStream stream);
  void fill(const StreamStep& step, ContactsMessage& answer);
  /// Why we claim nothing about the link, whatever the query found; None: the query's answer
  /// stands.
  [[nodiscard]] UndecidedReason notClaimed(const LinkContact& found, const StreamStep& step) const;
  [[nodiscard]] UndecidedReason unknownOf(LinkId link, const StreamStep& step) const;
  void list(const LinkContact& contact, AnsweredContact& listed) const;

  std::int32_t id_ = 0;
  Query query_;
  AvatarStream stream_;
  std::optional<SolidStream> solid_;
  /// At skinned fidelity, per link: the links that move its triangles.
  std::vector<std::vector<LinkId>> movedBy_;
  StreamStep lastStep_;
  double lastQueryUs_ = 0.0;
  // Scratch.
  ChainMotion motion_;
  Scratch scratch_;
  StepContacts contacts_;
  std::vector<LinkId> reported_;
};

}  // namespace foretouch
