#include "network/stream/speaker_gate.h"

namespace foretouch {
namespace {

constexpr int kPortBits = 16;

std::uint64_t numberOf(const UdpmSender& sender) {
  return std::uint64_t{sender.address} << kPortBits | sender.port;
}

}  // namespace

bool SpeakerGate::isSilent(std::int64_t utimeUs) const {
  // A clock that was set back must not make a silence longer.
  const std::int64_t heard = heardUs_.load(std::memory_order_relaxed);
  const auto later = static_cast<std::uint64_t>(utimeUs > heard ? utimeUs : heard);
  const auto earlier = static_cast<std::uint64_t>(utimeUs > heard ? heard : utimeUs);
  return later - earlier >= static_cast<std::uint64_t>(policy_.takeoverUs);
}

bool SpeakerGate::isEstablished() const {
  return poses_.load(std::memory_order_relaxed) >= policy_.confirmations;
}

bool SpeakerGate::isSpeaker(const UdpmSender& sender) const {
  return numberOf(sender) == speaker_.load(std::memory_order_relaxed);
}

bool SpeakerGate::mayPass(const UdpmSender& sender, std::int64_t utimeUs) const {
  return sender == UdpmSender() || isOpen() || isSpeaker(sender) || isSilent(utimeUs) ||
         !isEstablished();
}

SpeakerGate::Admission SpeakerGate::admit(const UdpmSender& sender, std::int64_t utimeUs) {
  if (sender == UdpmSender() || isSpeaker(sender)) return Admission::Speaker;
  if (isOpen()) return Admission::Open;
  if (isSilent(utimeUs)) return Admission::Takeover;
  if (isEstablished()) return Admission::Refused;
  run_ = sender == contender_ ? run_ + 1 : 1;
  contender_ = sender;
  return run_ >= policy_.confirmations ? Admission::Takeover : Admission::Refused;
}

void SpeakerGate::accepted(const UdpmSender& sender, std::int64_t utimeUs) {
  if (sender == UdpmSender()) return;
  run_ = 0;
  heard(utimeUs);
  const int poses = isSpeaker(sender) ? poses_.load(std::memory_order_relaxed) : 0;
  if (poses < policy_.confirmations) poses_.store(poses + 1, std::memory_order_relaxed);
  speaker_.store(numberOf(sender), std::memory_order_relaxed);
}

}  // namespace foretouch
