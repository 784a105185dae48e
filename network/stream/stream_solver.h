// network/stream/stream_solver.h: one avatar's stream answered: each accepted pose becomes one
// ContactsMessage. Pure apart from the query: what the service, the replay of a log and the
// simulator all run, so that they answer alike, byte for byte.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "network/stream/avatar_stream.h"
#include "network/wire/messages.h"

namespace foretouch {

class StreamSolver {
 public:
  /// `id` is what messages call the avatar. Errors: options that a query refuses, Scope other than
  /// EveryLink (a link that cannot be known would hide behind another's contact), a rung above the
  /// links (likewise), a deadline (no clock decides), a bad policy.
  static Result<StreamSolver> make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                   const QueryOptions& options, const StreamPolicy& policy);

  /// As AvatarStream; a message of another avatar is UnknownAvatar.
  [[nodiscard]] Reject take(const SkeletonMessage& message);
  /// None where the pose was accepted and `answer` filled (its stamps of receiving and sending are
  /// left as they are; queryUs is measured). A link is
  ///   Undecided, freeUntil 0, where the step says that it is unknown, whatever the query found; at
  ///   skinned fidelity also where a link that moves its triangles is;
  ///   Undecided (Gap), freeUntil 0, where the query found it clear or undecided across a gap;
  ///   else what the query found. A contact across a gap is one of the motion in between the two
  ///   poses that arrived: that nothing was touched before it is not claimed.
  [[nodiscard]] Reject take(const PoseMessage& message, ContactsMessage& answer);

  [[nodiscard]] std::int32_t id() const { return id_; }
  [[nodiscard]] const Avatar& avatar() const { return avatar_; }
  [[nodiscard]] const StreamCounts& counts() const { return stream_.counts(); }
  [[nodiscard]] const QueryOptions& options() const { return options_; }
  /// That the last answered pose ended; valid until the next message is taken.
  [[nodiscard]] const StreamStep& lastStep() const { return lastStep_; }
  /// Of the last answered pose: the query alone, for measurements.

 private:
  StreamSolver(std::int32_t id, const Avatar& avatar, const Scene& scene,
               const QueryOptions& options, AvatarStream stream);
  [[nodiscard]] Result<Done> query(const Pose& from, const Pose& to);
  void fill(const StreamStep& step, ContactsMessage& answer);
  /// Why nothing is claimed of the link, whatever the query found; None where what it found is.
  [[nodiscard]] UndecidedReason notClaimed(const LinkContact& found, const StreamStep& step) const;
  [[nodiscard]] UndecidedReason unknownOf(LinkId link, const StreamStep& step) const;
  void list(const LinkContact& contact, AnsweredContact& listed) const;

  std::int32_t id_ = 0;
  Avatar avatar_;
  Scene scene_;
  QueryOptions options_;
  AvatarStream stream_;
  /// At skinned fidelity, per link: the links that move its triangles.
  std::vector<std::vector<LinkId>> movedBy_;
  StreamStep lastStep_;
  double lastQueryUs_ = 0.0;
  // Scratch.
  ChainMotion motion_;
  QueryScratch scratch_;
  StepContacts contacts_;
  std::vector<LinkId> reported_;
};

}  // namespace foretouch
