// middleware/bracket/axis_places.h: where poses have the ends of an avatar's axes, and how far two
// places, or a bend of three, are apart, link by link. Metres in W.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"

namespace foretouch {

/// The ends of all axes, link by link.
using AxisPlaces = std::vector<std::array<Eigen::Vector3d, 2>>;

/// For one thread; keeps its memory. The avatar outlives it.
class AxisPlacer {
 public:
  explicit AxisPlacer(const Avatar& avatar);
  void place(const Pose& pose, AxisPlaces& places);
  /// The most that two places differ, per link.
  void differences(const AxisPlaces& one, const AxisPlaces& other, std::vector<double>& most) const;
  /// |x0 - 2 x1 + x2|, the mean over the bends that are given, the largest per link.
  struct Bend {
    const AxisPlaces *x0, *x1, *x2;
  };
  void bends(const std::vector<Bend>& given, std::vector<double>& most) const;

 private:
  const Avatar& avatar_;
  std::vector<LinkId> linkOf_;
  ChainMotion motion_;
  std::vector<LinkState> states_;
};

}  // namespace foretouch
