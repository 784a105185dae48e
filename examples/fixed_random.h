// examples/fixed_random.h: numbers that look random and are the same everywhere. The standard
// library's distributions are not: each implementation draws them in its own way.
#pragma once

#include <cstdint>

namespace foretouch::examples {

/// splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
class FixedRandom {
 public:
  explicit FixedRandom(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [low, high), in steps of 2^-53 of the range.
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace foretouch::examples
