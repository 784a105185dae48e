// lss/single.h: doubles rounded to floats, for files that store floats.
#pragma once

#include <Eigen/Core>

namespace foretouch {

/// The nearest float, as a double; infinite above a float's range.
///
/// Through memory: GCC 12 at -O3 drops the float between two doubles when it vectorises the
/// conversions (a cast<float>().cast<double>() of vectors in a loop changed nothing), so that
/// results depend on the optimiser.
[[nodiscard]] inline double nearestFloat(double number) {
  const volatile float single = static_cast<float>(number);
  return static_cast<double>(single);
}

[[nodiscard]] inline Eigen::Vector3d nearestFloat(const Eigen::Vector3d& v) {
  return {nearestFloat(v.x()), nearestFloat(v.y()), nearestFloat(v.z())};
}

}  // namespace foretouch
