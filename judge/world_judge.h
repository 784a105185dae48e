// judge/world_judge.h: a world of the judge's own: tracks, carriers, capsules and triangles, all in
// W and in long double. Certified: it steps by proven bounds on speed. Shares no code with the
// product.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "judge/distance.h"
#include "judge/motion.h"

namespace foretouch::oracle {

/// A part of a link's surface: a segment (count 2) or a triangle (3), within `radius`.
struct OraclePart {
  int link = 0;
  int count = 2;
  std::array<Vec3d, 3> corners;
  double radius = 0.0;
};

/// One joint's pose.
struct OraclePlace {
  std::array<double, 4> rotation{1, 0, 0, 0};  ///< w, x, y, z.
  Vec3d translation;
};

/// From an instant on, what carries a body, and its poses in that one's frame.
struct OracleEpisode {
  std::int64_t beginUs = 0;
  int carrier = -1, link = 0;
  std::vector<std::int64_t> times;
  std::vector<std::vector<OraclePlace>> poses;
};

struct OracleBody {
  std::vector<int> parents;
  std::vector<OraclePart> parts;
  std::vector<OracleEpisode> episodes;
};

enum class OracleOutcome { Free, Touch, Uncertain };
struct OracleTouch {
  OracleOutcome outcome = OracleOutcome::Free;
  Real time = 0;  ///< Microseconds after the window's begin; proven free before.
};

class OracleWorld {
 public:
  std::vector<OracleBody> bodies;
  static constexpr Real kTouch = 1e-9L;  ///< Metres: nearer is a touch.
  /// How often two links were looked at at an instant, to know until when they cannot touch.
  mutable std::uint64_t pairInstants = 0;

  /// That of two links at `us` after `fromUs`; where a body changes its carrier there: after it.
  [[nodiscard]] Real separationAt(int a, int linkOfA, int b, int linkOfB, std::int64_t fromUs,
                                  Real us) const;
  /// Those of all links of a and of b, row after row; for links that are proven farther apart than
  /// `beyond` (m), at least that. Links without parts are infinitely far apart, and of one body all
  /// but pairs of a link and a later one. `isFromLeft`: where a body changes its carrier then.
  [[nodiscard]] std::vector<Real> separationsAt(int a, int b, std::int64_t fromUs, Real us,
                                                bool isFromLeft, Real beyond) const;
  /// The first instant, of a window in which both are there, at which two links are within kTouch.
  [[nodiscard]] OracleTouch firstTouch(int a, int linkOfA, int b, int linkOfB, std::int64_t fromUs,
                                       std::int64_t toUs) const;
  /// Per link of a and of b, row after row: false if bounds on their speeds from a few hundred
  /// instants on prove that the two stay apart in the window. Much faster than firstTouch().
  [[nodiscard]] std::vector<bool> mayTouch(int a, int b, std::int64_t fromUs,
                                           std::int64_t toUs) const;
  /// The parts of a link in W, to rounding of doubles; all links for -1. Where a body changes its
  /// carrier: after it.
  [[nodiscard]] std::vector<OraclePart> partsAt(int body, int link, std::int64_t fromUs,
                                                Real us) const;
  /// A link's frame in W; `isFromLeft`: as above.
  [[nodiscard]] MovingFrame<Real> frameAt(int body, int link, std::int64_t fromUs, Real us,
                                          bool isFromLeft) const;
  /// The distance of a point in W and the surface of a link.
  [[nodiscard]] Real distanceToSurface(int body, int link, const Vec3d& p_W, std::int64_t fromUs,
                                       Real us) const;

 private:
  /// Bounds on a link's motion, per microsecond.
  struct Speed {
    Real ofOrigin = 0, ofTurn = 0;
  };
  /// A ball around all parts of a link.
  struct Ball {
    Vec3<Real> middle;
    Real radius = -1;
  };
  struct Moving {
    std::vector<MovingFrame<Real>> frames;  // of all links, in W
    std::vector<Speed> speeds;              // the same
    Real untilUs = 0;                       // they hold until then
  };
  [[nodiscard]] std::vector<Ball> ballsOf(int body, const Moving& moving) const;
  /// All links of a body at an instant; where it changes its carrier there, from the left or right.
  [[nodiscard]] Moving movingAt(int body, std::int64_t fromUs, Real us, bool isFromLeft) const;
  [[nodiscard]] Real separation(int a, const Moving& atA, int linkOfA, int b, const Moving& atB,
                                int linkOfB) const;
  [[nodiscard]] Real speedOf(int body, const Moving& moving, int link) const;
  [[nodiscard]] Real reachOf(int body, int link) const;
  [[nodiscard]] const OracleBody& body(int id) const {
    return bodies[static_cast<std::size_t>(id)];
  }
};

}  // namespace foretouch::oracle
