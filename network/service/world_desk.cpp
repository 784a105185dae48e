#include "network/service/world_desk.h"

#include <chrono>

namespace foretouch::internal {

WorldDesk::WorldDesk(WorldSolver solver, const SpeakerPolicy& policy, const std::string& suffix,
                     const Clock& clock, Outlet& outlet)
    : bodyChannel_(kBodyChannel + suffix),
      rigidChannel_(kRigidPoseChannel + suffix),
      eventsChannel_(kEventsChannel + suffix),
      speakerChannel_(kSpeakerChannel + suffix),
      clock_(clock),
      outlet_(outlet),
      world_(std::move(solver), policy) {}

void WorldDesk::take(Mail& mail) {
  const Heard heard{mail.sender, mail.receiveUtimeUs, mail.payload};
  const std::lock_guard lock(mutex_);
  const Reject reason = mail.kind == MailKind::Body ? world_.take(heard, mail.body, *this)
                                                    : world_.take(heard, mail.rigid, *this);
  if (reason == Reject::None) advance(mail.receiveUtimeUs);
}

void WorldDesk::refused(MailKind kind, std::size_t poses, Reject reason) {
  const std::lock_guard lock(mutex_);
  if (kind == MailKind::Body) return world_.solver().refusedState(reason);
  for (std::size_t i = 0; i < poses; ++i) world_.solver().refusedPose(kNoBody, reason, 0);
}

void WorldDesk::take(HeldRecords& held, BodyNumber avatar, const StreamStep* step,
                     std::int64_t receiveUtimeUs) {
  const std::lock_guard lock(mutex_);
  held.flush(outlet_);
  if (step == nullptr) return;
  if (world_.solver().take(avatar, *step, receiveUtimeUs) != Reject::None) return;
  advance(receiveUtimeUs);
}

void WorldDesk::advance(std::int64_t receiveUtimeUs) {
  const auto start = std::chrono::steady_clock::now();
  world_.solver().advance(answers_);
  for (EventsMessage& answer : answers_) {
    answer.receiveUtimeUs = receiveUtimeUs;
    answer.sendUtimeUs = clock_.utimeUs();
    encode(answer, payload_);
    outlet_.publish(eventsChannel_, payload_);
    outlet_.record(answer.sendUtimeUs, eventsChannel_, payload_);
  }
  if (answers_.empty()) return;
  times_.latency.record(static_cast<double>(clock_.utimeUs() - receiveUtimeUs));
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  times_.advance.record(took.count());
}

WorldReport WorldDesk::report() const {
  const std::lock_guard lock(mutex_);
  return {world_.solver().counts(), times_};
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
