// network/service/mail_room.h: the messages that wait for an answer: a bounded mailbox per avatar,
// and one for all of a world.
// Any number of threads take mail; one thread at a time handles an avatar's mail, in order, so that
// its answers depend on its own messages alone.
//
// One thread at a time is the leader, which fetches mail from outside and posts it. A leader that
// has posted something stops leading and takes it itself, while another thread becomes the leader:
// the thread that a message woke answers it. (The pattern is known as leader and followers.)
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "articulated/skeleton.h"
#include "network/service/held_records.h"
#include "network/stream/avatar_stream.h"
#include "network/wire/codec.h"
#include "network/wire/messages.h"
#include "network/wire/wire.h"
#include "network/wire/world_messages.h"

namespace foretouch {

enum class MailKind : std::uint8_t {
  Skeleton,
  Pose,
  Body,
  RigidPose,
  Step,
  Silence  ///< An avatar's: no pose has come for long, or none will.
};

/// What an avatar's stream has to tell the world: records, and the step that an accepted pose
/// ended.
struct StepMail {
  internal::HeldRecords held;
  BodyNumber avatar = kNoBody;
  bool isAccepted = false;  ///< Else there is no step.
  StepKind kind = StepKind::First;
  std::int64_t session = 0, sequenceTo = 0, lost = 0;
  std::int64_t utimeFromUs = 0, utimeToUs = 0;
  Pose to;
  std::vector<UndecidedReason> unknown, unknownJoints;

  void keep(const StreamStep& step);
  /// The step; lives as long as this.
  [[nodiscard]] StreamStep step() const;
};

/// A valid message. Its memory is reused.
struct Mail {
  MailKind kind = MailKind::Pose;
  SkeletonMessage skeleton;
  PoseMessage pose;
  BodyMessage body;
  RigidPoseMessage rigid;
  StepMail step;
  Bytes payload;  ///< As it came.
  std::int64_t receiveUtimeUs = 0;
  UdpmSender sender;
  std::int64_t sentUtimeUs = 0;  ///< By its signature; 0: not signed.
};

/// Different skeletons that wait for one avatar: more than a few mean that somebody floods. The
/// oldest is then dropped, like a pose.
inline constexpr std::size_t kMaxWaitingSkeletons = 8;
/// States that wait, of all bodies of a world together.
inline constexpr std::size_t kMaxWaitingStates = 1024;
/// Steps that a world has not been told of. They are answered, and so none is dropped: beyond so
/// many no poses of avatars are taken.
inline constexpr std::size_t kMaxWaitingSteps = 8192;

class MailRoom {
 public:
  /// At most `poses` (> 0) poses wait for each of `avatars`; threads handle the mail of at most
  /// `handlers` avatars at a time. With a world its box comes after theirs, and no avatar waits
  /// while it is handled. With one thread more than handlers, and one for the world, one is always
  /// free to lead.
  MailRoom(std::size_t avatars, std::size_t poses, std::size_t handlers = SIZE_MAX,
           bool hasWorld = false);

  enum class Posted : std::uint8_t {
    Kept,             ///< Nothing was dropped; also a skeleton that repeats a waiting one.
    DroppedPose,      ///< The oldest waiting pose was dropped.
    DroppedSkeleton,  ///< The oldest waiting skeleton was dropped.
    Unwanted,         ///< A pose of another skeleton than those that are known: see know().
    TooEarly,         ///< The same, before any skeleton is known.
    Behind,           ///< A pose while the world is kMaxWaitingSteps behind.
    Closed,           ///< The room takes no more mail.
  };
  /// Takes the mail and leaves an empty one in `mail` for the next message. Never waits for a
  /// worker.
  Posted post(std::size_t avatar, std::unique_ptr<Mail>& mail);

  /// From now on a pose for the avatar is refused at once, and takes no other's place, unless its
  /// hash is one of these, or that of a skeleton that waits or is being handled. Without a call of
  /// this, every pose is taken.
  void know(std::size_t avatar, const std::vector<std::int64_t>& hashes);

  enum class Taken : std::uint8_t { Mail, Lead, Nothing, Closed };
  /// Exchanges `mail` for the next mail of an avatar that no thread handles; waits up to `wait` for
  /// one. The caller owns the avatar until finish(). If there is no such mail and no leader, the
  /// caller becomes the leader until endLead(). Closed: no mail is left and none will come.
  Taken takeOrLead(std::size_t& avatar, std::unique_ptr<Mail>& mail,
                   std::chrono::milliseconds wait);
  void finish(std::size_t avatar);
  /// `isForGood`: no thread leads from now on, because nothing more will come.
  void endLead(bool isForGood);
  /// Waits until a leader has ended for good.
  void waitForLastLead();

  /// Takes no more mail; still returns the waiting mail.
  void close();

 private:
  struct Box {
    std::vector<std::unique_ptr<Mail>> mail;  // oldest first; short, so that erasing is cheap
    std::size_t poses = 0, skeletons = 0;     // with rigid poses, and with states of bodies
    bool isReady = false;                     // in ready_
    bool isHandled = false;                   // by a thread, now
    bool isSelective = false;
    std::vector<std::int64_t> known;
    std::optional<std::int64_t> handled;  // the hash of the skeleton that a thread handles now
  };
  static bool isWanted(const Box& box, const Mail& mail);
  static bool isRepeated(const Box& box, const Mail& mail);
  bool makeRoom(Box& box, MailKind kind);
  std::size_t& countOf(Box& box, MailKind kind);
  std::unique_ptr<Mail> emptyMail();
  void keep(std::unique_ptr<Mail> mail);
  void makeReady(std::size_t avatar);
  [[nodiscard]] bool isCounted(std::size_t box) const { return box != world_; }
  /// Place in ready_ of the first box that may be taken; its size: none.
  [[nodiscard]] std::size_t firstReady() const;
  [[nodiscard]] bool mayTake() const { return firstReady() < ready_.size(); }
  [[nodiscard]] bool mayLead() const { return !isLed_ && !isLeadOver_ && !isClosed_; }
  [[nodiscard]] bool isWorldHandled() const {
    return world_ < boxes_.size() && boxes_[world_].isHandled;
  }
  /// While a thread handles an avatar, more of its mail may become ready.
  [[nodiscard]] bool isOver() const {
    return isClosed_ && ready_.empty() && handled_ == 0 && !isWorldHandled();
  }
  Taken takeNow(std::size_t& avatar, std::unique_ptr<Mail>& mail);

  const std::size_t maxPoses_, maxHandled_, world_;  // without a world the last one is not a box
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Box> boxes_;
  std::vector<std::size_t> ready_;  // avatars with mail and no thread, longest waiting first
  std::vector<std::unique_ptr<Mail>> empty_;
  std::size_t handled_ = 0, steps_ = 0;  // avatars in hand; steps that wait
  bool isLed_ = false, isLeadOver_ = false;
  bool isClosed_ = false;
};

}  // namespace foretouch
