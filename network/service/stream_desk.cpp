#include "network/service/stream_desk.h"

#include <utility>

#include "network/wire/codec.h"

namespace foretouch::internal {
namespace {

/// A pose that has not come so long after the last one is not waited for (docs/streaming.md).
constexpr std::chrono::milliseconds kSilence{1000};

}  // namespace

StreamDesk::StreamDesk(StreamSolver solver, const SpeakerPolicy& policy, std::size_t index,
                       const StreamSurroundings& surroundings)
    : service_(surroundings), stream_(std::move(solver), policy), index_(index) {
  service_.room.know(index_, {});
}

Reject StreamDesk::refusal(const Mail& mail, bool isSigned) {
  const bool isPose = mail.kind == MailKind::Pose;
  if (isSigned) {
    ReplayGuard& guard = isPose ? poses_ : skeletons_;
    const Reject old = guard.take(mail.sentUtimeUs, mail.receiveUtimeUs);
    if (old != Reject::None) return old;
  }
  if (!isPose) return Reject::None;
  if (!stream_.mayPass(mail.sender, mail.receiveUtimeUs)) return Reject::OtherSender;
  posedAt_ = std::chrono::steady_clock::now();
  return Reject::None;
}

bool StreamDesk::waitsInVain(std::chrono::steady_clock::time_point now, bool isOver) {
  if (person_ == nullptr || !posedAt_ || (!isOver && now - *posedAt_ < kSilence)) return false;
  posedAt_.reset();
  return true;
}

void StreamDesk::take(const Mail& mail, StreamMemory& memory) {
  if (isBroken_) return reject(mail.kind, Reject::Overrun);
  isCounted_ = false;
  if (mail.kind == MailKind::Silence) return endWait(mail, memory);
  HeldStream record(service_.channels, service_.counter, memory.held);
  if (mail.kind == MailKind::Pose) return answer(mail, memory, record);
  const Heard heard{mail.sender, mail.receiveUtimeUs, mail.payload};
  const Reject reason = stream_.take(heard, mail.skeleton, record);
  settle(mail, nullptr, memory);
  tellKnown();
  if (reason != Reject::None) service_.counter.rejectedSkeleton(reason);
}

void StreamDesk::abandon(MailKind kind) {
  isBroken_ = true;
  if (!isCounted_) reject(kind, Reject::Overrun);
}

void StreamDesk::answer(const Mail& mail, StreamMemory& memory, StreamRecord& record) {
  const Heard heard{mail.sender, mail.receiveUtimeUs, mail.payload};
  ContactsMessage& answer = memory.answer;
  const Reject reason = stream_.take(heard, mail.pose, answer, record);
  addUp();
  tellKnown();
  if (reason != Reject::None) {
    settle(mail, nullptr, memory);
    isCounted_ = true;
    return service_.counter.rejectedPose(reason);
  }
  answer.receiveUtimeUs = mail.receiveUtimeUs;
  answer.sendUtimeUs = service_.clock.utimeUs();
  encode(answer, memory.payload);
  service_.outlet.publish(service_.channels.contacts, memory.payload);
  const std::int64_t sentUtimeUs = service_.clock.utimeUs();
  memory.held.add(answer.sendUtimeUs, service_.channels.contacts, memory.payload);
  isCounted_ = true;
  service_.counter.answeredPose(static_cast<double>(sentUtimeUs - mail.receiveUtimeUs),
                                answer.queryUs);
  if (stream_.solid() != nullptr) show(*stream_.solid(), mail, memory);
  if (person_ != nullptr) {
    person_->follow(stream_.solver().lastStep());
    sayPerson(mail, memory);
  }
  settle(mail, &stream_.solver().lastStep(), memory);
  observe(memory);
}

void StreamDesk::observe(const StreamMemory& memory) {
  StepObserver* const observer = service_.observer;
  if (observer == nullptr || !observer->wants(index_)) return;
  const StreamStep& step = stream_.solver().lastStep();
  const SolidStream* const solid = stream_.solid();
  if (solid == nullptr) return observer->observe(index_, step, memory.answer, nullptr, person_);
  const ShownStep shown{solid->shownBefore(), memory.shown};
  observer->observe(index_, step, memory.answer, &shown, person_);
}

/// Records what the stream said and was answered. Where there is a world, in the order in which it
/// is told, by the thread that tells it: no stream waits for it.
void StreamDesk::settle(const Mail& mail, const StreamStep* step, StreamMemory& memory) {
  if (!service_.worldBox) return memory.held.flush(service_.outlet);
  Mail& told = *memory.step;
  told.kind = MailKind::Step;
  told.receiveUtimeUs = mail.receiveUtimeUs;
  std::swap(told.step.held, memory.held);
  told.step.avatar = stream_.solver().id();
  told.step.isAccepted = false;
  if (step != nullptr) told.step.keep(*step);
  static_cast<void>(service_.room.post(*service_.worldBox, memory.step));
}

template <typename Message>
void StreamDesk::send(const Message& message, const std::string& channel, StreamMemory& memory) {
  encode(message, memory.payload);
  service_.outlet.publish(channel, memory.payload);
  memory.held.add(message.sendUtimeUs, channel, memory.payload);
}

/// After the answer has gone out, so that it waits for nothing new.
void StreamDesk::show(SolidStream& solid, const Mail& mail, StreamMemory& memory) {
  solid.follow(stream_.solver().lastStep(), memory.shown);
  memory.shown.receiveUtimeUs = mail.receiveUtimeUs;
  memory.shown.sendUtimeUs = service_.clock.utimeUs();
  send(memory.shown, service_.channels.solid, memory);
  service_.solids.shown(memory.shown);
}

void StreamDesk::endWait(const Mail& mail, StreamMemory& memory) {
  person_->endWait();
  sayPerson(mail, memory);
  settle(mail, nullptr, memory);
}

void StreamDesk::sayPerson(const Mail& mail, StreamMemory& memory) {
  for (std::size_t i = 0; i < person_->numSaid(); ++i) {
    PersonMessage& said = person_->said(i);
    said.receiveUtimeUs = mail.receiveUtimeUs;
    said.sendUtimeUs = service_.clock.utimeUs();
    send(said, service_.channels.person, memory);
    service_.persons.said(said);
  }
}

void StreamDesk::addUp() {
  const StreamCounts& counts = stream_.solver().counts();
  if (counts.lost == added_.lost && counts.gaps == added_.gaps) return;
  service_.counter.lostPoses(counts.lost - added_.lost, counts.gaps - added_.gaps,
                             counts.vastGaps - added_.vastGaps);
  added_ = counts;
}

/// Poses of skeletons that no sender has said need not wait.
void StreamDesk::tellKnown() {
  stream_.listKnownHashes(nowKnown_);
  if (known_ == nowKnown_) return;
  known_ = nowKnown_;
  service_.room.know(index_, known_);
}

void StreamDesk::reject(MailKind kind, Reject reason) {
  if (kind == MailKind::Silence) return;  // no sender sent it
  kind == MailKind::Pose ? service_.counter.rejectedPose(reason)
                         : service_.counter.rejectedSkeleton(reason);
}

}  // namespace foretouch::internal
