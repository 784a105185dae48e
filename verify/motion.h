// verify/motion.h: where the links of a step are, by intervals that surely hold the true motion:
// every joint turns evenly on the shorter arc (slerp) and its translation runs straight, in its
// parent's frame. Only sums, products, quotients and square roots: the pose in the middle of two
// unit quaternions is their sum made unit, so that any instant k / 2^level is found by halving.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "verify/interval.h"
#include "verify/statement.h"

namespace verify {

struct LinkPlace {
  Matrix rotation;  ///< Link to world.
  Vector origin;
};

class Motion {
 public:
  /// `mostWork`: at() takes no more halvings of rotations.
  Motion(const std::vector<Link>& links, const Step& step, std::size_t mostWork = kMostWork);

  static constexpr std::size_t kMostWork = 4'000'000;

  /// What makes the step no motion; empty: nothing.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  /// Halvings so far.
  [[nodiscard]] std::size_t work() const { return work_; }

  /// At t = index / 2^level.
  /// O(level) for each link above it that is not known at that instant yet; only so many instants
  /// are kept. Throws beyond the most work: whoever asks for as much wants it to take its time.
  [[nodiscard]] const LinkPlace& at(int level, std::int64_t index, std::size_t link);

  /// At least the acceleration of any point of the link at this distance from its origin, at any
  /// instant, per unit of t squared.
  ///
  /// A point of link n is o0 + R0 o1 + R0 R1 o2 + ... + R0...Rn p, each R turning evenly at w about
  /// an axis that is fixed in its parent, each o running straight. The second derivative of a
  /// product of such rotations is at most (sum of w)^2 in norm, its first at most the sum of w; so
  /// |(R0...Rk o)''| <= S^2 |o| + 2 S |o'| with S the sum of w from 0 to k, and |o| is largest at
  /// an end.
  [[nodiscard]] double acceleration(std::size_t link, double distance) const;

 private:
  struct Joint {
    Quaternion from, to;
    Vector start, drift;
  };
  using Places = std::vector<std::optional<LinkPlace>>;

  [[nodiscard]] static double turnOf(const Joint& joint);
  [[nodiscard]] static Quaternion rotationAt(const Joint& joint, int level, std::int64_t index);
  [[nodiscard]] std::size_t mostInstants() const;

  const std::vector<Link>& links_;
  std::vector<Joint> joints_;
  std::vector<double> turns_, accelerations_;  // of the chain down to each link; of its origin
  std::map<std::pair<int, std::int64_t>, Places> known_;
  std::size_t work_ = 0, mostWork_;
  std::string fault_;
};

}  // namespace verify
