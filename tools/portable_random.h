// tools/portable_random.h: random numbers from a seed, the same on every machine.
#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace foretouch::tools {

class PortableRandom {
 public:
  explicit PortableRandom(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t next() { return engine_(); }
  /// A number in [low, high); the standard's distributions differ between libraries.
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Eigen::Vector3d inBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const double x = uniform(low.x(), high.x()), y = uniform(low.y(), high.y()),
                 z = uniform(low.z(), high.z());
    return {x, y, z};
  }
  /// A point in the cube of this half edge around the origin.
  Eigen::Vector3d inBox(double half) {
    return inBox(Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace foretouch::tools
