#include "network/stream/bound_stream.h"

#include <algorithm>
#include <arpa/inet.h>
#include <utility>

namespace foretouch {
namespace {

constexpr std::int64_t kUsPerS = 1'000'000;

}  // namespace

Reject sessionFault(std::int64_t session, std::int64_t receiveUtimeUs) {
  // A session of 0 or less is as good as any; the difference of others fits.
  if (session <= 0 || session <= receiveUtimeUs) return Reject::None;
  const auto ahead =
      static_cast<std::uint64_t>(session) - static_cast<std::uint64_t>(receiveUtimeUs);
  return ahead > static_cast<std::uint64_t>(kMostSessionAheadUs) ? Reject::FutureSession
                                                                 : Reject::None;
}

BoundStream::BoundStream(StreamSolver solver, const SpeakerPolicy& policy)
    : solver_(std::move(solver)), gate_(std::make_unique<SpeakerGate>(policy)) {}

Reject BoundStream::take(const Heard& heard, const SkeletonMessage& message, StreamRecord& record) {
  const bool isKnownSender = heard.sender != UdpmSender();
  const bool isOther = isKnownSender && !gate_->isOpen() && !gate_->isSpeaker(heard.sender);
  const Reject future = sessionFault(message.session, heard.receiveUtimeUs);
  if (future != Reject::None) return future;
  if (isOther) {
    keep(heard, message.hash);
    return Reject::OtherSender;
  }
  const Reject reject = solver_.take(message);
  if (isRecorded(reject, heard.receiveUtimeUs, record)) {
    tellSpeaker(record);
    record.skeleton(heard.payload, heard.receiveUtimeUs);
  }
  // One that is refused for its age may be needed yet; what fits no avatar never will.
  const bool isOfUse = reject == Reject::None || (gate_->isOpen() && solver_.leftTrace());
  if (isKnownSender && isOfUse) keep(heard, message.hash);
  if (reject == Reject::None && gate_->isSpeaker(heard.sender)) gate_->heard(heard.receiveUtimeUs);
  return reject;
}

Reject BoundStream::take(const Heard& heard, const PoseMessage& message, ContactsMessage& answer,
                         StreamRecord& record) {
  const Reject future = sessionFault(message.session, heard.receiveUtimeUs);
  if (future != Reject::None) return future;
  const SpeakerGate::Admission admission = gate_->admit(heard.sender, heard.receiveUtimeUs);
  if (admission == SpeakerGate::Admission::Refused) return Reject::OtherSender;
  const bool isUnbound = admission != SpeakerGate::Admission::Speaker;
  const bool isSaid = isUnbound && saidBy(heard.sender, message.skeletonHash) != nullptr;
  if (admission == SpeakerGate::Admission::Takeover && !isSaid && !isKnown(message.skeletonHash)) {
    return Reject::SkeletonMismatch;
  }
  const bool needsSkeleton = isSaid && !isKnown(message.skeletonHash);
  if (admission == SpeakerGate::Admission::Takeover || needsSkeleton) {
    bringIn(heard, message, record);
  }
  const Reject reject = solver_.take(message, answer);
  if (isRecorded(reject, heard.receiveUtimeUs, record)) {
    tellSpeaker(record);
    record.pose(heard.payload, heard.receiveUtimeUs);
  }
  if (reject == Reject::None) gate_->accepted(heard.sender, heard.receiveUtimeUs);
  return reject;
}

/// Makes way for a pose of a sender that does not speak yet.
void BoundStream::bringIn(const Heard& heard, const PoseMessage& message, StreamRecord& record) {
  nextSpeaker_ = {message.avatar, std::max<std::int64_t>(0, heard.receiveUtimeUs),
                  ntohl(heard.sender.address), ntohs(heard.sender.port)};
  solver_.changeSpeaker();
  Said* const said = saidBy(heard.sender, message.skeletonHash);
  if (said == nullptr || isKnown(message.skeletonHash)) return;
  SkeletonMessage skeleton;
  if (decode(said->payload, skeleton) != Reject::None) return;  // it was decoded before
  const Reject reject = solver_.take(skeleton);                 // counted by the stream
  if (isRecorded(reject, heard.receiveUtimeUs, record)) {
    tellSpeaker(record);
    record.skeleton(said->payload, said->receiveUtimeUs);
  }
  // It would be refused again, with every pose.
  if (reject != Reject::None) said->payload.clear();
}

/// Comes before whatever is recorded after a change: a record has no more of senders whose poses
/// are all refused than of those poses.
void BoundStream::tellSpeaker(StreamRecord& record) {
  if (!nextSpeaker_) return;
  record.speaker(*nextSpeaker_);
  nextSpeaker_.reset();
}

void BoundStream::keep(const Heard& heard, std::int64_t hash) {
  if (heard.payload.size > kMostKeptSkeletonBytes) return;
  const auto isOf = [&](const UdpmSender& sender) {
    return [&sender](const Said& said) { return said.sender == sender; };
  };
  auto place = std::find_if(said_.begin(), said_.end(), isOf(heard.sender));
  if (place == said_.end()) {
    // The one that was said longest ago, but never the speaker's.
    const auto age = [&](const Said& said) {
      return gate_->isSpeaker(said.sender) ? std::pair(1, said.receiveUtimeUs)
                                           : std::pair(0, said.receiveUtimeUs);
    };
    place = std::min_element(said_.begin(), said_.end(),
                             [&](const Said& x, const Said& y) { return age(x) < age(y); });
  }
  place->sender = heard.sender;
  place->hash = hash;
  place->receiveUtimeUs = heard.receiveUtimeUs;
  place->payload.assign(heard.payload.data, heard.payload.data + heard.payload.size);
}

BoundStream::Said* BoundStream::saidBy(const UdpmSender& sender, std::int64_t hash) {
  const auto said = std::find_if(said_.begin(), said_.end(), [&](const Said& each) {
    return each.sender == sender && each.hash == hash && !each.payload.empty();
  });
  return said == said_.end() ? nullptr : &*said;
}

bool BoundStream::isKnown(std::int64_t hash) const {
  const auto known = solver_.knownHashes();
  return std::any_of(known.begin(), known.end(), [&](const auto& each) { return each == hash; });
}

void BoundStream::listKnownHashes(std::vector<std::int64_t>& hashes) const {
  hashes.clear();
  for (const auto& hash : solver_.knownHashes()) {
    if (hash) hashes.push_back(*hash);
  }
  for (const Said& said : said_) {
    if (!said.payload.empty()) hashes.push_back(said.hash);
  }
}

/// What was accepted, or refused and may decide about later messages, always is.
bool BoundStream::isRecorded(Reject reject, std::int64_t receiveUtimeUs, StreamRecord& record) {
  if (reject == Reject::None || solver_.leftTrace()) return true;
  const std::int64_t second = receiveUtimeUs / kUsPerS;
  if (second != recordSecond_) refusedRecords_ = 0;
  recordSecond_ = second;
  if (++refusedRecords_ <= kMostRefusedRecords) return true;
  refusedRecords_ = kMostRefusedRecords;
  record.leftOut();
  return false;
}

}  // namespace foretouch
