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

#include "verify/edges.h"
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

  /// On an edge of the statement, whose links these are.
  Motion(const std::vector<Link>& links, const EdgeStatement& statement, const Edge& edge,
         std::size_t mostWork = kMostWork);

  static constexpr std::size_t kMostWork = 4'000'000;

  /// Why the step is not a motion; empty: it is one.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  /// Halvings so far.
  [[nodiscard]] std::size_t work() const { return work_; }
  /// Adds to them. Throws beyond the most work.
  void spend(std::size_t work);

  /// At t = index / 2^level.
  /// O(level) for each link above it that is not known at that instant yet; only so many instants
  /// are kept. Throws beyond the most work: claims that ask for as much are made to keep it busy.
  [[nodiscard]] const LinkPlace& at(int level, std::int64_t index, std::size_t link);

  /// For points at a distance from a link's origin: what acceleration() bounds.
  struct Bound {
    double turns = 0.0, origin = 0.0;
    [[nodiscard]] double at(double distance) const {
      const Interval s(turns);
      return (Interval(origin) + s * s * Interval(distance)).hi;
    }
  };

  /// At least the acceleration of any point of the link at this distance from its origin, at any
  /// instant, per unit of t squared.
  ///
  /// A point of link n is o0 + R0 o1 + R0 R1 o2 + ... + R0...Rn p, each R turning evenly at w about
  /// an axis that is fixed in its parent, each o running straight. The second derivative of a
  /// product of such rotations is at most (sum of w)^2 in norm, its first at most the sum of w; so
  /// |(R0...Rk o)''| <= S^2 |o| + 2 S |o'| with S the sum of w from 0 to k, and |o| is largest at
  /// an end.
  [[nodiscard]] double acceleration(std::size_t link, double distance) const {
    return fastest_[link].at(distance);
  }

  /// The nearest link that carries both, either of them included; -1: only the world does.
  [[nodiscard]] int carrierOf(std::size_t a, std::size_t b) const;
  /// As at(), in the frame of a link that carries this one (-1: the world); nothing is kept.
  [[nodiscard]] LinkPlace in(int carrier, int level, std::int64_t index, std::size_t link);
  [[nodiscard]] const Bound& boundOf(std::size_t link) const { return fastest_[link]; }
  [[nodiscard]] Bound boundIn(int carrier, std::size_t link) const;

 private:
  struct Turn {
    Vector axis;         // unit
    Interval angle, by;  // at t = 0, and from there to t = 1
  };
  struct Joint {
    Quaternion from, to;       // in a step; on an edge both are the rotation at rest
    std::optional<Turn> turn;  // on an edge
    Vector start, drift;
    double most = 0.0;  // at least the angle by which it turns
  };
  using Places = std::vector<std::optional<LinkPlace>>;

  void add(Joint joint);
  [[nodiscard]] static Bound below(const Bound& above, const Joint& joint);
  [[nodiscard]] LinkPlace placeOf(const Joint& joint, int level, std::int64_t index) const;
  [[nodiscard]] std::size_t workAt(int level) const;
  [[nodiscard]] double turnOf(const Joint& joint) const;
  [[nodiscard]] Quaternion rotationAt(const Joint& joint, int level, std::int64_t index) const;
  [[nodiscard]] std::size_t mostInstants() const;

  const std::vector<Link>& links_;
  bool isOnEdge_ = false;
  std::vector<Joint> joints_;
  std::vector<Bound> fastest_;  // per link, in the world
  std::map<std::pair<int, std::int64_t>, Places> known_;
  std::size_t work_ = 0, mostWork_;
  std::string fault_;
};

}  // namespace verify
