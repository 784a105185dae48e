// tests/network/world_stream/crowd.h: a small crowd, drawn from a seed: avatars and props that are
// carried, let go of and taken away, the truth of it, and what arrives of what their senders say
// over a network that loses, delays and repeats. Senders restart, fall silent, lose joints, and
// their clocks are off. Bodies have their places in CrowdTruth::world as numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "judge/world_judge.h"
#include "network/wire/messages.h"
#include "network/wire/world_messages.h"
#include "network/world_stream/world_setup.h"

namespace foretouch::test {

inline constexpr std::int64_t kCrowdBeginUs = 1'000'000'000, kCrowdLengthUs = 1'000'000;
/// How long anybody is waited for.
inline constexpr std::int64_t kCrowdWaitUs = 100'000;
inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// Who truly carries a body since when: as body_t tells it.
struct CrowdState {
  std::int64_t sinceUs = 0;
  bool isPresent = true;
  BodyNumber carrier = kNoBody;
  LinkId link = 0;
  bool movesInFrame = false;

  [[nodiscard]] bool hasPoses() const { return isPresent && (carrier == kNoBody || movesInFrame); }
};

struct CrowdTruth {
  /// Stamps of capture are its time. A body without a sender that goes on stays where it was.
  oracle::OracleWorld world;
  std::vector<std::vector<CrowdState>> states;  ///< Per body, by time.
  std::vector<std::optional<PairRules>> self;   ///< Per body: its own links are asked.
  std::optional<oracle::OracleBody> still;      ///< The static scene.

  /// At or before the instant; nothing: it is not there.
  [[nodiscard]] const CrowdState* stateAt(BodyNumber body, std::int64_t us) const;
};

struct CrowdArrival {
  std::int64_t timeUs = 0;
  std::variant<BodyMessage, RigidPoseMessage, SkeletonMessage, PoseMessage> message;
};

struct CrowdFaults {
  double loss = 0.0, repeat = 0.0, delay = 0.0;
};

struct Crowd {
  CrowdTruth truth;
  WorldSetup setup;
  std::vector<CrowdArrival> arrivals;  ///< By time.
  bool isFaulty = false;
};

[[nodiscard]] Crowd drawCrowd(std::uint64_t seed);

}  // namespace foretouch::test
