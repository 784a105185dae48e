// network/stream/speaker_gate.h: which sender speaks for an avatar. The one whose pose is accepted
// first does, by address and port; the messages of others go no further. Another sender takes over
//   - once the speaker has been silent for SpeakerPolicy::takeoverUs, or
//   - while the speaker has said fewer than SpeakerPolicy::confirmations accepted poses, by as many
//     poses in a row without an accepted one of the speaker in between. So one pose said in a
//     silence costs the true sender a few poses, not the whole silence.
// More would not be a defence: a sender that floods has any number of poses between two true ones.
//
// An address proves nothing where others can send under it; a key does
// (network/wire/message_key.h). Not installed.
#pragma once

#include <atomic>
#include <cstdint>

#include "network/wire/wire.h"

namespace foretouch {

inline constexpr std::int64_t kMostTakeoverUs = 3'600'000'000;  ///< An hour.

struct SpeakerPolicy {
  /// A speaker that has said nothing for so long may be replaced. 0 to kMostTakeoverUs; 0: at any
  /// time, by any sender.
  std::int64_t takeoverUs = 2'000'000;
  int confirmations = 3;  ///< As StreamPolicy's.
};

/// One thread at a time, except mayPass().
class SpeakerGate {
 public:
  explicit SpeakerGate(const SpeakerPolicy& policy) : policy_(policy) {}

  enum class Admission : std::uint8_t {
    Speaker,   ///< From the speaker, or from an unknown sender (liblcm).
    Open,      ///< No sender speaks yet.
    Takeover,  ///< From another one: if its pose is accepted, it speaks from then on.
    Refused,   ///< From another one.
  };
  /// About a pose. `utimeUs`: its receipt. Counts it as a confirmation.
  [[nodiscard]] Admission admit(const UdpmSender& sender, std::int64_t utimeUs);
  /// About any message: whether admit() might let it pass. From any thread.
  [[nodiscard]] bool mayPass(const UdpmSender& sender, std::int64_t utimeUs) const;
  [[nodiscard]] bool isSpeaker(const UdpmSender& sender) const;
  [[nodiscard]] bool isOpen() const { return speaker_.load(std::memory_order_relaxed) == kNobody; }

  /// The stream accepted a pose.
  void accepted(const UdpmSender& sender, std::int64_t utimeUs);
  /// The speaker repeated the skeleton in use.
  void heard(std::int64_t utimeUs) { heardUs_.store(utimeUs, std::memory_order_relaxed); }

 private:
  static constexpr std::uint64_t kNobody = 0;
  [[nodiscard]] bool isSilent(std::int64_t utimeUs) const;
  [[nodiscard]] bool isEstablished() const;

  SpeakerPolicy policy_;
  // Written by the thread that answers, read by the one that receives.
  std::atomic<std::uint64_t> speaker_{kNobody};  // address and port
  std::atomic<std::int64_t> heardUs_{0};         // when it last said something
  std::atomic<int> poses_{0};                    // accepted from it, up to the confirmations
  UdpmSender contender_;
  int run_ = 0;  // of the contender's poses since the speaker's last one
};

}  // namespace foretouch
