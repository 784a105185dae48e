#include "network/service/mail_room.h"

#include <algorithm>
#include <utility>

namespace foretouch {
namespace {

bool isPose(MailKind kind) {
  return kind == MailKind::Pose || kind == MailKind::RigidPose;
}

}  // namespace

void StepMail::keep(const StreamStep& step) {
  isAccepted = true;
  kind = step.kind;
  session = step.session;
  sequenceTo = step.sequenceTo;
  lost = step.lost;
  utimeFromUs = step.utimeFromUs;
  utimeToUs = step.utimeToUs;
  to = *step.to;
  unknown = *step.unknown;
  unknownJoints = *step.unknownJoints;
}

StreamStep StepMail::step() const {
  StreamStep step;
  step.kind = kind;
  step.session = session;
  step.sequenceTo = sequenceTo;
  step.lost = lost;
  step.utimeFromUs = utimeFromUs;
  step.utimeToUs = utimeToUs;
  step.to = &to;
  step.unknown = &unknown;
  step.unknownJoints = &unknownJoints;
  return step;
}

MailRoom::MailRoom(std::size_t avatars, std::size_t poses, std::size_t handlers, bool hasWorld)
    : maxPoses_(poses),
      maxHandled_(handlers),
      world_(hasWorld ? avatars : SIZE_MAX),
      boxes_(avatars + (hasWorld ? 1 : 0)) {
  for (Box& box : boxes_) box.mail.reserve(poses + kMaxWaitingSkeletons);
  ready_.reserve(boxes_.size());
}

bool MailRoom::isWanted(const Box& box, const Mail& mail) {
  if (mail.kind != MailKind::Pose || !box.isSelective) return true;
  const std::int64_t hash = mail.pose.skeletonHash;
  if (std::find(box.known.begin(), box.known.end(), hash) != box.known.end()) return true;
  if (box.handled == hash) return true;
  return box.skeletons > 0 &&
         std::any_of(box.mail.begin(), box.mail.end(), [&](const auto& waiting) {
           return waiting->kind == MailKind::Skeleton && waiting->skeleton.hash == hash;
         });
}

void MailRoom::know(std::size_t avatar, const std::vector<std::int64_t>& hashes) {
  const std::lock_guard lock(mutex_);
  boxes_[avatar].isSelective = true;
  boxes_[avatar].known = hashes;
}

/// Senders repeat their skeleton every second. A copy of the last waiting one would change nothing.
bool MailRoom::isRepeated(const Box& box, const Mail& mail) {
  if (mail.kind != MailKind::Skeleton) return false;
  const auto last = std::find_if(box.mail.rbegin(), box.mail.rend(), [](const auto& waiting) {
    return waiting->kind == MailKind::Skeleton;
  });
  return last != box.mail.rend() && (*last)->skeleton.hash == mail.skeleton.hash &&
         (*last)->sender == mail.sender && (*last)->skeleton.session == mail.skeleton.session &&
         (*last)->skeleton.generation == mail.skeleton.generation;
}

/// True if it dropped the oldest mail of this kind.
bool MailRoom::makeRoom(Box& box, MailKind kind) {
  if (kind == MailKind::Step) return false;
  const std::size_t most = isPose(kind)                 ? maxPoses_
                           : kind == MailKind::Skeleton ? kMaxWaitingSkeletons
                                                        : kMaxWaitingStates;
  std::size_t& waiting = isPose(kind) ? box.poses : box.skeletons;
  if (waiting < most) return false;
  const auto oldest = std::find_if(box.mail.begin(), box.mail.end(),
                                   [&](const auto& mail) { return mail->kind == kind; });
  keep(std::move(*oldest));
  box.mail.erase(oldest);
  --waiting;
  return true;
}

std::unique_ptr<Mail> MailRoom::emptyMail() {
  if (empty_.empty()) return std::make_unique<Mail>();
  auto mail = std::move(empty_.back());
  empty_.pop_back();
  return mail;
}

/// Keeps mail for reuse. Skeletons are rare and may be large: frees their memory.
void MailRoom::keep(std::unique_ptr<Mail> mail) {
  constexpr std::size_t kKeptBytes = 256u << 10;  // a pose of kMaxJoints joints
  if (mail->kind == MailKind::Skeleton) mail->skeleton = SkeletonMessage();
  if (mail->payload.capacity() > kKeptBytes) Bytes().swap(mail->payload);
  empty_.push_back(std::move(mail));
}

void MailRoom::makeReady(std::size_t avatar) {
  boxes_[avatar].isReady = true;
  ready_.push_back(avatar);
  // A leader takes the mail that it posted.
  if (!isLed_) changed_.notify_one();
}

std::size_t& MailRoom::countOf(Box& box, MailKind kind) {
  if (kind == MailKind::Step) return steps_;
  return isPose(kind) ? box.poses : box.skeletons;
}

std::size_t MailRoom::firstReady() const {
  if (handled_ < maxHandled_) return 0;
  const auto world = std::find(ready_.begin(), ready_.end(), world_);
  return static_cast<std::size_t>(world - ready_.begin());
}

MailRoom::Posted MailRoom::post(std::size_t avatar, std::unique_ptr<Mail>& mail) {
  const std::lock_guard lock(mutex_);
  // The world hears of what is answered, whatever comes.
  if (isClosed_ && mail->kind != MailKind::Step) return Posted::Closed;
  Box& box = boxes_[avatar];
  if (!isWanted(box, *mail)) return box.known.empty() ? Posted::TooEarly : Posted::Unwanted;
  if (isRepeated(box, *mail)) return Posted::Kept;
  const MailKind kind = mail->kind;
  if (kind == MailKind::Pose && steps_ >= kMaxWaitingSteps) return Posted::Behind;
  const bool dropped = makeRoom(box, kind);
  ++countOf(box, kind);
  box.mail.push_back(std::exchange(mail, emptyMail()));
  if (!box.isReady && !box.isHandled) makeReady(avatar);
  if (!dropped) return Posted::Kept;
  return isPose(kind) ? Posted::DroppedPose : Posted::DroppedSkeleton;
}

MailRoom::Taken MailRoom::takeOrLead(std::size_t& avatar, std::unique_ptr<Mail>& mail,
                                     std::chrono::milliseconds wait) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, wait, [&] { return mayTake() || mayLead() || isOver(); });
  if (mayTake() || !mayLead()) return takeNow(avatar, mail);
  isLed_ = true;
  return Taken::Lead;
}

MailRoom::Taken MailRoom::takeNow(std::size_t& avatar, std::unique_ptr<Mail>& mail) {
  if (!mayTake()) return isOver() ? Taken::Closed : Taken::Nothing;
  const auto first = ready_.begin() + static_cast<std::ptrdiff_t>(firstReady());
  avatar = *first;
  ready_.erase(first);
  Box& box = boxes_[avatar];
  box.isReady = false;
  box.isHandled = true;
  if (isCounted(avatar)) ++handled_;
  keep(std::exchange(mail, std::move(box.mail.front())));
  box.mail.erase(box.mail.begin());
  --countOf(box, mail->kind);
  if (mail->kind == MailKind::Skeleton) box.handled = mail->skeleton.hash;
  return Taken::Mail;
}

void MailRoom::endLead(bool isForGood) {
  const std::lock_guard lock(mutex_);
  isLed_ = false;
  isLeadOver_ = isLeadOver_ || isForGood;
  // Wakes one to lead; the others if there is more mail than the caller takes.
  if (isForGood || ready_.size() > 1) {
    changed_.notify_all();
  } else {
    changed_.notify_one();
  }
}

void MailRoom::waitForLastLead() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return isLeadOver_; });
}

void MailRoom::finish(std::size_t avatar) {
  const std::lock_guard lock(mutex_);
  Box& box = boxes_[avatar];
  box.isHandled = false;
  box.handled.reset();
  if (isCounted(avatar)) --handled_;
  if (!box.mail.empty()) makeReady(avatar);
  if (isClosed_ && handled_ == 0 && !isWorldHandled()) changed_.notify_all();
}

void MailRoom::close() {
  const std::lock_guard lock(mutex_);
  isClosed_ = true;
  changed_.notify_all();
}

}  // namespace foretouch
