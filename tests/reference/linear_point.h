// tests/reference/linear_point.h: a point that moves along a straight line at constant speed.
#pragma once

#include <Eigen/Core>

namespace foretouch {

/// from + t*(to - from), exactly: of the two doubles as real numbers.
struct LinearPoint {
  Eigen::Vector3d from, to;
};

}  // namespace foretouch
