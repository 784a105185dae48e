// examples/track.h: a number that changes smoothly through keyframes.
#pragma once

#include <vector>

namespace foretouch::examples {

/// A cubic between any two keys, monotone there: it never overshoots, so a value stays constant
/// between two equal keys. Slopes as in Fritsch and Carlson (SIAM J. Numer. Anal. 17(2), 1980), by
/// the harmonic mean.
class Track {
 public:
  /// Keys come in order of time. One at the time of the last key replaces it.
  void key(double timeS, double value);

  /// Before the first and after the last key: their values. At least one key.
  [[nodiscard]] double at(double timeS) const;

  /// The value of the last key.
  [[nodiscard]] double last() const { return keys_.back().value; }

 private:
  struct Key {
    double timeS, value;
  };
  [[nodiscard]] double slopeAt(std::size_t k) const;

  std::vector<Key> keys_;
};

}  // namespace foretouch::examples
