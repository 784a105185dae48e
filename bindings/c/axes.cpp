// bindings/c/axes.cpp: engines' floats and our doubles. A mirroring M of space takes a rotation R
// to M R M, so its axis, which is a pseudovector, to -M axis.
#include <cmath>
#include <limits>

#include "bindings/c/status.h"

namespace foretouch::c {
namespace {

/// Our coordinate `axis` is the engine's coordinate from[axis], times sign[axis].
struct Axes {
  int from[3];
  double sign[3];
  double metres;      // of the engine's unit
  double handedness;  // -1: space is mirrored
};

constexpr double kMetresPerCentimetre = 0.01;
constexpr Axes kAxes[] = {
    {{0, 1, 2}, {1.0, 1.0, 1.0}, 1.0, 1.0},                    // FT_AXES_Y_UP_RIGHT
    {{0, 1, 2}, {1.0, 1.0, -1.0}, 1.0, -1.0},                  // FT_AXES_Y_UP_LEFT
    {{0, 2, 1}, {1.0, 1.0, 1.0}, kMetresPerCentimetre, -1.0},  // FT_AXES_Z_UP_LEFT
};
static_assert(FT_AXES_Y_UP_RIGHT == 0 && FT_AXES_Y_UP_LEFT == 1 && FT_AXES_Z_UP_LEFT == 2);

/// A value beyond floats becomes an infinity: a cast would be undefined.
float toFloat(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (std::abs(value) > kLargest) {
    return value > 0.0 ? std::numeric_limits<float>::infinity()
                       : -std::numeric_limits<float>::infinity();
  }
  return static_cast<float>(value);
}

template <typename Convert>
ft_status converted(const char* function, const void* in, std::size_t count, std::int32_t axes,
                    const void* out, const Convert& convert) {
  return guarded(function, [&]() -> ft_status {
    if (axes < FT_AXES_Y_UP_RIGHT || axes > FT_AXES_Z_UP_LEFT) {
      return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "axes: expected one of FT_AXES_*, found %d",
                     axes);
    }
    constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max() / (8 * sizeof(double));
    if (const auto s = neededArray(in, count, kMost, "input"); s != FT_OK) return s;
    if (const auto s = neededArray(out, count, kMost, "output"); s != FT_OK) return s;
    for (std::size_t i = 0; i < count; ++i) convert(kAxes[axes], i);
    return FT_OK;
  });
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch::c;

ft_status ft_positions_from_floats(const float* xyz, size_t count, int32_t axes,
                                   double* positions) {
  return converted(__func__, xyz, count, axes, positions, [&](const Axes& a, std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      positions[3 * i + k] = a.sign[k] * a.metres * double{xyz[3 * i + a.from[k]]};
    }
  });
}

ft_status ft_positions_to_floats(const double* positions, size_t count, int32_t axes, float* xyz) {
  return converted(__func__, positions, count, axes, xyz, [&](const Axes& a, std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      xyz[3 * i + a.from[k]] = toFloat(a.sign[k] * positions[3 * i + k] / a.metres);
    }
  });
}

ft_status ft_rotations_from_floats(const float* xyzw, size_t count, int32_t axes, double* wxyz) {
  return converted(__func__, xyzw, count, axes, wxyz, [&](const Axes& a, std::size_t i) {
    wxyz[4 * i] = double{xyzw[4 * i + 3]};
    for (std::size_t k = 0; k < 3; ++k) {
      wxyz[4 * i + 1 + k] = a.handedness * a.sign[k] * double{xyzw[4 * i + a.from[k]]};
    }
  });
}

ft_status ft_rotations_to_floats(const double* wxyz, size_t count, int32_t axes, float* xyzw) {
  return converted(__func__, wxyz, count, axes, xyzw, [&](const Axes& a, std::size_t i) {
    xyzw[4 * i + 3] = toFloat(wxyz[4 * i]);
    for (std::size_t k = 0; k < 3; ++k) {
      xyzw[4 * i + a.from[k]] = toFloat(a.handedness * a.sign[k] * wxyz[4 * i + 1 + k]);
    }
  });
}
