#include "network/service/world_desk.h"

#include <chrono>
#include <thread>

namespace foretouch::internal {
namespace {

/// What watches over a service asks every second, and must hear of one that is busy.
constexpr std::chrono::milliseconds kReportWait{100}, kReportLook{1};

}  // namespace

WorldDesk::WorldDesk(WorldSolver solver, const SpeakerPolicy& policy, const std::string& suffix,
                     const Clock& clock, Outlet& outlet, SolidCounter& solids)
    : bodyChannel_(kBodyChannel + suffix),
      rigidChannel_(kRigidPoseChannel + suffix),
      eventsChannel_(kEventsChannel + suffix),
      speakerChannel_(kSpeakerChannel + suffix),
      solidChannel_(kSolidChannel + suffix),
      pushesChannel_(kPushesChannel + suffix),
      clock_(clock),
      outlet_(outlet),
      solids_(solids),
      world_(std::move(solver), policy) {}

void WorldDesk::take(Mail& mail) {
  const std::lock_guard lock(mutex_);
  if (tell(mail) == Reject::None) advance(mail.receiveUtimeUs);
}

Reject WorldDesk::tell(Mail& mail) {
  const Heard heard{mail.sender, mail.receiveUtimeUs, mail.payload};
  if (mail.kind == MailKind::Body) return world_.take(heard, mail.body, *this);
  if (mail.kind == MailKind::RigidPose) return world_.take(heard, mail.rigid, *this);
  StepMail& step = mail.step;
  step.held.flush(outlet_);
  if (!step.isAccepted) return Reject::UnknownAvatar;
  return world_.solver().take(step.avatar, step.step(), mail.receiveUtimeUs);
}

void WorldDesk::refused(MailKind kind, std::size_t poses, Reject reason) {
  const std::lock_guard lock(mutex_);
  if (kind == MailKind::Body) return world_.solver().refusedState(reason);
  for (std::size_t i = 0; i < poses; ++i) world_.solver().refusedPose(kNoBody, reason, 0);
}

template <typename Message>
void WorldDesk::send(Message& message, const std::string& channel, std::int64_t receiveUtimeUs) {
  message.receiveUtimeUs = receiveUtimeUs;
  message.sendUtimeUs = clock_.utimeUs();
  encode(message, payload_);
  outlet_.publish(channel, payload_);
  outlet_.record(message.sendUtimeUs, channel, payload_);
}

/// What is shown comes before the events that are about it.
void WorldDesk::show(std::int64_t receiveUtimeUs) {
  for (ShownBody& body : world_.solver().shown()) {
    send(body.solid, solidChannel_, receiveUtimeUs);
    send(body.pushes, pushesChannel_, receiveUtimeUs);
    solids_.shown(body.solid, &body.pushes);
  }
}

void WorldDesk::advance(std::int64_t receiveUtimeUs) {
  const auto start = std::chrono::steady_clock::now();
  world_.solver().advance(answers_);
  show(receiveUtimeUs);
  for (EventsMessage& answer : answers_) send(answer, eventsChannel_, receiveUtimeUs);
  if (answers_.empty()) return;
  times_.latency.record(static_cast<double>(clock_.utimeUs() - receiveUtimeUs));
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  times_.advance.record(took.count());
}

WorldReport WorldDesk::report() const {
  // No timed mutex: ThreadSanitizer of GCC 12 does not see those being locked.
  std::unique_lock lock(mutex_, std::try_to_lock);
  const auto until = std::chrono::steady_clock::now() + kReportWait;
  while (!lock.owns_lock() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(kReportLook);
    static_cast<void>(lock.try_lock());
  }
  if (!lock.owns_lock()) {
    const std::lock_guard last(reportMutex_);
    return lastReport_;
  }
  WorldReport report{world_.solver().counts(), times_};
  lock.unlock();
  const std::lock_guard last(reportMutex_);
  lastReport_ = report;
  return report;
}

void WorldDesk::speaker(const SpeakerMessage& message) {
  Bytes payload;
  encode(message, payload);
  outlet_.record(message.utimeUs, speakerChannel_, payload);
}

void WorldDesk::body(ByteView payload, std::int64_t receiveUtimeUs) {
  outlet_.record(receiveUtimeUs, bodyChannel_, payload);
}

void WorldDesk::rigidPose(ByteView payload, std::int64_t receiveUtimeUs) {
  outlet_.record(receiveUtimeUs, rigidChannel_, payload);
}

}  // namespace foretouch::internal
