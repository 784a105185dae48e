// middleware/solid/floor_lift.h: how far tracked feet are below the floor, and by how much to lift
// the target for that (FloorPolicy::Lift). Metres, seconds. Not installed.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/solid/contact_row.h"
#include "middleware/solid/solid_options.h"

namespace foretouch::internal {

/// Remembers the floor below each foot where it was last held. Keeps its memory.
class FloorLift {
 public:
  FloorLift(const Avatar& avatar, const SolidOptions& options);

  void reset();
  /// Whether a floor is remembered: else the lift is 0, and nobody need ask.
  [[nodiscard]] bool isAny() const;
  /// How far to lift a target that places the links so: the least that its feet asked for in the
  /// last second, reached slowly; 0 where they ask for nothing now, so that a free target is shown
  /// as it is.
  [[nodiscard]] double update(const std::vector<LinkState>& target, double dtS);
  /// The rows that held the avatar in this tick.
  void remember(const std::vector<ContactRow>& rows);

 private:
  struct Floor {
    Eigen::Vector3d y, n;
    double ageS;  // < 0: none
  };
  struct Ask {
    double ageS, lift;
  };
  [[nodiscard]] double asked(const std::vector<LinkState>& target) const;

  Avatar avatar_;
  Eigen::Vector3d up_;
  double skin_, most_;
  std::vector<LinkId> feet_;
  std::vector<Floor> floors_;  // per foot
  std::vector<Ask> asks_;      // of the last second
  double lift_ = 0.0;
};

}  // namespace foretouch::internal
