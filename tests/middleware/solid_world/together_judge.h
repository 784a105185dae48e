// tests/middleware/solid_world/together_judge.h: whether anything that is not excused is inside of
// anything else while all of it moves, at many instants of a tick: the judge's own motions, frames
// and distances. Shares no code with the product.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "judge/distance.h"
#include "judge/motion.h"
#include "judge/scene.h"
#include "judge/way_judge.h"

namespace foretouch::test {

/// A segment (count 2) or a triangle (3), within `radius`, on a link.
struct TogetherPart {
  int link = 0, count = 2;
  std::array<oracle::Vec3d, 3> corners;
  double radius = 0.0;
};

/// From one pose to another.
struct TogetherLeg {
  std::int64_t beginUs = 0, endUs = 0;
  oracle::PlainPose from, to;
};

struct TogetherBody {
  bool isSolid = false;  ///< It, and what it holds, must not be inside of anything.
  std::vector<int> parents;
  std::vector<TogetherPart> parts;
  std::vector<TogetherLeg> legs;     ///< Of the tick; between them it is not there.
  int holder = -1, holdingLink = 0;  ///< A body with a lower number; its legs are in that frame.
};

struct TogetherReading {
  std::uint64_t instants = 0;
  double least = std::numeric_limits<double>::infinity();  ///< Of what is looked at.
  std::vector<double> leastOf;                             ///< Per solid body, by body.
  std::vector<std::string> inside;
};

class TogetherJudge {
 public:
  explicit TogetherJudge(std::vector<oracle::Triangle> still) : still_(std::move(still)) {}

  std::vector<TogetherBody> bodies;
  static constexpr double kFar = 0.02;  ///< It sees no farther (m).

  /// `isExcused`: of two bodies (the second -1: the still scene) at an instant.
  using Excused = std::function<bool(int, int, std::int64_t)>;
  [[nodiscard]] TogetherReading look(std::int64_t fromUs, std::int64_t toUs, int instants,
                                     const Excused& isExcused);

 private:
  using Frame = oracle::MovingFrame<oracle::Real>;
  struct Placed {
    bool isThere = false;
    std::vector<std::array<oracle::Vec3d, 3>> corners;  // per part
    std::vector<oracle::Box> boxes;                     // per part, with its radius
    oracle::Box box;
  };
  void setOut();
  void placeBody(std::size_t body, std::int64_t us);
  void readStill(std::size_t body, TogetherReading& reading, std::int64_t us);
  void readPair(std::size_t a, std::size_t b, TogetherReading& reading, std::int64_t us);
  void keep(std::size_t a, int b, double separation, TogetherReading& reading, std::int64_t us);
  [[nodiscard]] int solidOf(std::size_t body) const;

  oracle::Scene still_;
  std::vector<std::vector<oracle::Motion>> motions_;  // per body, per leg
  std::vector<std::vector<Frame>> frames_;            // per body
  std::vector<Placed> placed_;
};

}  // namespace foretouch::test
