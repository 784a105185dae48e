// middleware/ask/flight.h: what a shape that flies straight hits first while the bodies move: their
// true motion and its own through a time, not a cast against where they were at one instant. The
// proof: ask.md 6. Metres, in W; world time in microseconds.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "lss/lss.h"
#include "middleware/ask/ask.h"
#include "middleware/scratch.h"
#include "middleware/world/world.h"

namespace foretouch {

/// A sphere, capsule or convex solid on its way, at constant speed and without a turn; filters as
/// in a question.
struct FlightQuestion : AskWhom {
  Lss shape;                                      ///< Where it is at `fromUs`.
  std::vector<Eigen::Vector3d> hull;              ///< As in a question.
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  ///< To where it is at `toUs`. Zero: it waits.
  std::int64_t fromUs = 0, toUs = 0;
};

/// Of the first of all.
struct FlightHit {
  WorldHit hit;    ///< `distance`: along the way; places at that time.
  WorldTime time;  ///< Rounded down: nothing is hit before.
};

struct FlightAnswer {
  std::optional<FlightHit> first;
  /// Bodies that were asked about and are not known all through; of a Silent body, what is known of
  /// it was asked.
  std::vector<UnknownBody> unknown;

  [[nodiscard]] AskVerdict verdict() const;
};

/// Replaces `answer`. Never missed and never late, in time as in place; at the hit's time the two
/// are at most kAskTolerance apart, where doubles resolve it. Errors: as askWorld(); a time without
/// length.
Result<Done> askFlight(const World& world, const FlightQuestion& question, Scratch& scratch,
                       FlightAnswer& answer);

}  // namespace foretouch
