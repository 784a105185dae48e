// middleware/ask/moving_body.h: a body on its way through a span of world time, between its poses
// and those of all that carry it: where its links' pieces are, how fast they are, and how fast that
// changes at most. Metres, W; microseconds. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "articulated/motion.h"
#include "lss/separation.h"
#include "middleware/depth/body_places.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// A piece of a link at an instant of the span.
struct MovingPiece {
  Hull hull;
  double rounding = 0.0;                      ///< No point is farther from where it is given.
  std::array<Eigen::Vector3d, 3> velocities;  ///< The hull's points', per us; zero: not known.
  /// The true velocities differ from these by no more; and change by no more per us.
  double ofVelocity = 0.0, acceleration = 0.0;
};

/// For one thread; keeps its memory.
class MovingBody {
 public:
  /// Begins the span at an instant, up to toUs at most. Unless it returns Known or Assumed, nothing
  /// else may be asked.
  [[nodiscard]] PlaceKnown begin(const WorldParts& world, BodyId body, std::int64_t utimeUs,
                                 std::int64_t toUs);
  /// The end of the span; where the body is not known, the end of what is not known.
  [[nodiscard]] std::int64_t endUs() const { return endUs_; }
  [[nodiscard]] bool isCarried() const { return chain_.size() > 1; }
  /// The piece of the motion of a body that is not carried.
  [[nodiscard]] const BodyPiece& piece() const { return piece_; }

  /// The piece `us` after the span's begin. O(depth of the link); of a carried body, O(joints).
  [[nodiscard]] MovingPiece at(LinkId link, const Hull& hull_L, double us);

 private:
  struct Speed {
    double ofOrigin = 0.0, ofTurn = 0.0;  // at most, per us
  };
  void findSpeeds();
  [[nodiscard]] MovingPiece alone(LinkId link, const Hull& hull_L, double us) const;
  [[nodiscard]] MovingPiece carried(LinkId link, const Hull& hull_L, double us);

  const WorldParts* world_ = nullptr;
  BodyId body_ = 0;
  std::int64_t beginUs_ = 0, endUs_ = 0;
  std::vector<BodyId> chain_;
  BodyPiece piece_;
  ChainMotion above_;          // memory: that of its carriers
  ChainMotion motion_;         // of the body itself
  double durationUs_ = 1.0;    // of its piece
  std::vector<Speed> speeds_;  // per link, of a body that is carried
  double placesUs_ = -1.0;     // of these
  std::vector<LinkPlace> places_;
  BodyPlaces bodyPlaces_;
};

}  // namespace foretouch::internal
