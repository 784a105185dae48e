// tests/network/recorded_stream.h: what a bound stream records, and a replay of it by a solver that
// knows of no sender, as `foretouch replay` does it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "network/stream/bound_stream.h"
#include "network/wire/codec.h"

namespace foretouch::test {

class RecordedStream final : public StreamRecord {
 public:
  enum class Kind : std::uint8_t { Speaker, Skeleton, Pose };
  struct Entry {
    Kind kind = Kind::Pose;
    Bytes payload;
  };
  void speaker(const SpeakerMessage& message) override {
    entries.push_back({Kind::Speaker, {}});
    encode(message, entries.back().payload);
  }
  void skeleton(ByteView payload, std::int64_t) override {
    entries.push_back({Kind::Skeleton, Bytes(payload.data, payload.data + payload.size)});
  }
  void pose(ByteView payload, std::int64_t) override {
    entries.push_back({Kind::Pose, Bytes(payload.data, payload.data + payload.size)});
  }
  void leftOut() override { ++numLeftOut; }

  /// The verdicts of a solver that takes all entries.
  [[nodiscard]] std::vector<Bytes> replayedBy(StreamSolver solver) const {
    std::vector<Bytes> verdicts;
    for (const Entry& entry : entries) {
      SkeletonMessage skeleton;
      PoseMessage pose;
      ContactsMessage answer;
      if (entry.kind == Kind::Speaker) solver.changeSpeaker();
      if (entry.kind == Kind::Skeleton && decode(entry.payload, skeleton) == Reject::None) {
        static_cast<void>(solver.take(skeleton));
      }
      if (entry.kind != Kind::Pose || decode(entry.payload, pose) != Reject::None) continue;
      if (solver.take(pose, answer) == Reject::None) verdicts.push_back(verdictsOf(answer));
    }
    return verdicts;
  }
  static Bytes verdictsOf(const ContactsMessage& answer) {
    Bytes payload;
    encode(answer, payload);
    const ByteView view = verdictBytes(payload);
    return {view.data, view.data + view.size};
  }

  std::vector<Entry> entries;
  std::size_t numLeftOut = 0;
};

}  // namespace foretouch::test
