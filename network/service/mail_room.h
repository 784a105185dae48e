// network/service/mail_room.h: what waits to be answered: a bounded mailbox for each avatar. Any
// number of threads take mail; an avatar's mail is handled by one thread at a time and in order, so
// that its answers depend on its own messages alone.
//
// One of the threads at a time is the leader, who fetches mail from outside and posts it. A leader
// that has posted something stops leading and takes it itself, while another thread becomes the
// leader: what comes is answered by the thread that it woke. (The pattern is known as leader and
// followers.)
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "network/wire/codec.h"
#include "network/wire/messages.h"

namespace foretouch {

enum class MailKind : std::uint8_t { Skeleton, Pose };

/// A message that was found sound. Its memory is used again and again.
struct Mail {
  MailKind kind = MailKind::Pose;
  SkeletonMessage skeleton;
  PoseMessage pose;
  Bytes payload;  ///< As it came.
  std::int64_t receiveUtimeUs = 0;
};

/// Different skeletons that wait for one avatar: more than a few mean that somebody floods. The
/// oldest then makes way, as a pose would.
inline constexpr std::size_t kMaxWaitingSkeletons = 8;

class MailRoom {
 public:
  /// At most `poses` (> 0) poses wait for each of `avatars`; the mail of at most `handlers` of them
  /// is handled at a time. With one thread more than handlers there is always one to lead.
  MailRoom(std::size_t avatars, std::size_t poses, std::size_t handlers = SIZE_MAX);

  enum class Posted : std::uint8_t {
    Kept,             ///< And nothing had to make way; also a skeleton that repeats one waiting.
    DroppedPose,      ///< The oldest waiting pose made way.
    DroppedSkeleton,  ///< The oldest waiting skeleton made way.
    Closed,           ///< Nothing is taken any more.
  };
  /// Takes the mail's content in exchange for memory to be used for the next. Never waits for a
  /// worker.
  Posted post(std::size_t avatar, std::unique_ptr<Mail>& mail);

  enum class Taken : std::uint8_t { Mail, Lead, Nothing, Closed };
  /// The next mail of an avatar that nobody handles, in exchange for `mail`; waits up to `wait` for
  /// one. The avatar is the caller's until finish(). Where there is none and no leader either, the
  /// caller becomes it, until endLead(). Closed: there is no mail left and none to come.
  Taken takeOrLead(std::size_t& avatar, std::unique_ptr<Mail>& mail,
                   std::chrono::milliseconds wait);
  void finish(std::size_t avatar);
  /// `isForGood`: nobody leads from now on, as nothing more will come.
  void endLead(bool isForGood);
  /// Until a leader has ended for good.
  void waitForLastLead();

  /// Takes no more mail; what waits is still given out.
  void close();

 private:
  struct Box {
    std::vector<std::unique_ptr<Mail>> mail;  // oldest first; short, so that erasing is cheap
    std::size_t poses = 0, skeletons = 0;
    bool isReady = false;    // in ready_
    bool isHandled = false;  // by a thread, now
  };
  static bool isRepeated(const Box& box, const Mail& mail);
  bool makeRoom(Box& box, MailKind kind);
  std::unique_ptr<Mail> emptyMail();
  void keep(std::unique_ptr<Mail> mail);
  void makeReady(std::size_t avatar);
  [[nodiscard]] bool mayTake() const { return !ready_.empty() && handled_ < maxHandled_; }
  [[nodiscard]] bool mayLead() const { return !isLed_ && !isLeadOver_ && !isClosed_; }
  /// While a thread handles an avatar, more of its mail may become ready.
  [[nodiscard]] bool isOver() const { return isClosed_ && ready_.empty() && handled_ == 0; }
  Taken takeNow(std::size_t& avatar, std::unique_ptr<Mail>& mail);

  const std::size_t maxPoses_, maxHandled_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Box> boxes_;
  std::vector<std::size_t> ready_;  // avatars with mail that nobody handles, the longest first
  std::vector<std::unique_ptr<Mail>> empty_;
  std::size_t handled_ = 0;
  bool isLed_ = false, isLeadOver_ = false;
  bool isClosed_ = false;
};

}  // namespace foretouch
