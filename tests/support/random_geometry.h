// tests/support/random_geometry.h: random inputs, many of them awkward. The seed is the case's
// index, so a failing case replays alone. Draw one by one, not as arguments of one call or one
// product: compilers choose the order of these, and would draw other cases on other machines.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace foretouch::test {

inline constexpr double kPi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(std::uint64_t seed)
      : engine_(0x9e3779b97f4a7c15u ^ (seed * 0xbf58476d1ce4e5b9u)) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  /// Log-uniform: every order of magnitude equally often.
  double magnitude(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  Eigen::Vector3d inBox(double half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
  }
  Eigen::Vector3d direction() {
    for (;;) {
      const Eigen::Vector3d v = inBox(1.0);
      if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
  }
  /// In any direction, of any length between these.
  Eigen::Vector3d arrow(double least, double most) {
    const Eigen::Vector3d along = direction();
    return uniform(least, most) * along;
  }
  Eigen::Quaternion<double, Eigen::DontAlign> rotation() { return turn(uniform(0.0, 3.1)); }
  Eigen::Quaternion<double, Eigen::DontAlign> turn(double angle) {
    const Eigen::Vector3d axis = direction();
    const double s = std::sin(0.5 * angle);
    return {std::cos(0.5 * angle), s * axis.x(), s * axis.y(), s * axis.z()};
  }

 private:
  std::mt19937_64 engine_;
};

/// Segment and triangle within about `size` of `center`; three in ten degenerate or nearly so.
struct RandomPair {
  Eigen::Vector3d a, b;
  std::array<Eigen::Vector3d, 3> v;
};

inline RandomPair randomPair(Random& random, double size, const Eigen::Vector3d& center) {
  RandomPair p;
  p.a = center + random.inBox(size);
  p.b = center + random.inBox(size);
  for (auto& vertex : p.v) vertex = center + random.inBox(size);
  switch (random.below(20)) {
    case 0: p.b = p.a; break;                                  // a sphere
    case 1: p.v[2] = p.v[1]; break;                            // a segment
    case 2: p.v[1] = p.v[2] = p.v[0]; break;                   // a point
    case 3: p.v[2] = p.v[0] + 0.5 * (p.v[1] - p.v[0]); break;  // no area (to rounding)
    case 4:                                                    // sliver
      p.v[2] = p.v[0] + random.uniform(0, 1) * (p.v[1] - p.v[0]) +
               random.magnitude(1e-13, 1e-3) * random.inBox(size);
      break;
    case 5: p.b = p.a + (p.v[1] - p.v[0]); break;  // parallel to an edge
    case 6:                                        // nearly parallel to an edge
      p.b = p.a + (p.v[1] - p.v[0]) + random.magnitude(1e-14, 1e-3) * random.inBox(size);
      break;
    case 7: p.a = p.v[0]; break;  // touching a vertex
    case 8: p.a = p.v[0] + 0.3 * (p.v[1] - p.v[0]) + 0.3 * (p.v[2] - p.v[0]); break;  // on the face
    case 9:  // close above the face
      p.a = p.v[0] + 0.3 * (p.v[1] - p.v[0]) + 0.3 * (p.v[2] - p.v[0]) +
            random.magnitude(1e-12, 1e-2) * random.direction();
      break;
    default: break;
  }
  return p;
}

/// Of a span's own time, [-1, 1]; its ends among others.
inline float randomInstant(Random& random) {
  if (random.chance(0.2)) return random.chance(0.5) ? -1.0F : 1.0F;
  return static_cast<float>(random.uniform(-1.0, 1.0));
}

}  // namespace foretouch::test
