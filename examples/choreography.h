// examples/choreography.h: the person's movements, as keyframes in the room's frame.
#pragma once

#include "examples/posture.h"
#include "examples/track.h"

namespace foretouch::examples {

/// Enters through the string curtain, sweeps an arm along the railing, spins beside the floor lamp,
/// kicks and reaches about the table, and leaves the same way.
class Choreography {
 public:
  static constexpr double kDurationS = 13.6;

  Choreography();
  [[nodiscard]] Posture at(double timeS) const;

 private:
  struct FootTracks {
    Track x, y, z, yaw, pitch;
    [[nodiscard]] Posture::Foot at(double timeS) const;
  };
  struct HandTracks {
    Track out, up, forward, grip;
    [[nodiscard]] Posture::Hand at(double timeS) const;
  };
  Track x_, y_, z_, yaw_, pitch_, roll_, twist_, bend_, lean_, gaze_, nod_;
  FootTracks leftFoot_, rightFoot_;
  HandTracks leftHand_, rightHand_;

  void setFeet();
};

}  // namespace foretouch::examples
