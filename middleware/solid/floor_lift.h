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

  /// The avatar appears somewhere, lifted by so much.
  void reset(double lift = 0.0);
  /// Forgets remembered floors, which may no longer be there. The lift goes on from what it is.
  void forgetFloors();
  [[nodiscard]] double lift() const { return lift_; }
  /// Whether anything is lifted, or a floor is remembered: else there is nothing to ask.
  [[nodiscard]] bool isAny() const;
  /// How far a target that places the links so has to be lifted, for its feet to stand on the
  /// floors that are remembered; 0: no foot is there, or nothing is lifted and it is for the skin
  /// alone.
  [[nodiscard]] double asked(const std::vector<LinkState>& target) const;
  /// How far to lift a target whose feet ask for so much: what they asked for most of the last
  /// second, reached slowly. `isFree`: the target touches nothing as it is, whatever is remembered.
  [[nodiscard]] double update(double asked, bool isFree, double dtS);
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
  [[nodiscard]] bool isFloorKnown() const;
  void grow(double dtS);
  [[nodiscard]] double usualAsk();

  Avatar avatar_;
  Eigen::Vector3d up_;
  double skin_, most_, speed_;
  std::vector<LinkId> feet_;
  std::vector<Floor> floors_;  // per foot
  std::vector<Ask> asks_;      // those of the last second
  std::vector<double> sorted_;
  double lift_ = 0.0;
};

}  // namespace foretouch::internal
