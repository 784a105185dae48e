// tests/tools/repair/clip_oracle.h: what a repaired clip must be, by kinematics and distances of
// the test's own: a plain reader of BVH, matrices, and looks that lie close together between the
// poses. It shares no code with the product. Metres.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "judge/vector.h"

namespace foretouch::test {

using oracle::Vec3d;

/// Euler angles as in the file, degrees; positions in its unit.
class OracleClip {
 public:
  explicit OracleClip(const std::string& bvh);

  /// Frames `first` to `last` alone.
  [[nodiscard]] OracleClip cut(std::size_t first, std::size_t last) const;
  [[nodiscard]] std::size_t frames() const { return rows_.size(); }
  [[nodiscard]] double frameTimeS() const { return frameTimeS_; }
  /// Per joint, the place of `p_L` of it; `at`: frames, with a fraction.
  [[nodiscard]] Vec3d pointAt(const std::string& joint, const Vec3d& p_L, double at) const;
  /// How far the joint's own rotation is from that of another clip of the same joints, at a frame
  /// (degrees).
  [[nodiscard]] double turnFrom(const OracleClip& other, const std::string& joint,
                                std::size_t frame) const;
  /// The numbers of a frame.
  [[nodiscard]] const std::vector<double>& row(std::size_t frame) const { return rows_[frame]; }
  [[nodiscard]] const std::vector<std::string>& joints() const { return names_; }

 private:
  struct Joint {
    int parent = -1;
    Vec3d offset;
    std::vector<std::string> channels;
    std::size_t first = 0;  // column
  };
  struct Turn {
    double w = 1, x = 0, y = 0, z = 0;
  };
  [[nodiscard]] Turn turnAt(const Joint& joint, std::size_t frame) const;
  [[nodiscard]] Vec3d placeAt(const Joint& joint, std::size_t frame) const;

  std::vector<Joint> joints_;
  std::vector<std::string> names_;
  std::map<std::string, int> number_;
  std::vector<std::vector<double>> rows_;
  double frameTimeS_ = 0.0;
};

/// A capsule of a joint.
struct OracleCapsule {
  std::string joint;
  Vec3d a, b;
  double radius = 0.0;
};

/// Looks between two poses.
inline constexpr int kOracleLooks = 16;

struct OracleFloor {
  Vec3d point, normal{0, 1, 0};
};

/// The least height of the capsule's surface above the floor, over all looks.
[[nodiscard]] double leastHeight(const OracleClip& clip, const OracleCapsule& capsule,
                                 const OracleFloor& floor = {});
/// The least distance of two capsules' surfaces; below zero: their axes are nearer than the radii.
[[nodiscard]] double leastDistance(const OracleClip& clip, const OracleCapsule& one,
                                   const OracleCapsule& other);
/// The same of a capsule and a triangle.
[[nodiscard]] double leastDistance(const OracleClip& clip, const OracleCapsule& capsule,
                                   const oracle::Triangle& triangle);
/// How far a point of a joint comes, along the floor, from where it is at `beginS`, until `endS`.
[[nodiscard]] double farthestSlide(const OracleClip& clip, const OracleCapsule& capsule,
                                   double beginS, double endS);

/// Of two clips, pose by pose and joint by joint: how far joints moved (m) and turned (degrees),
/// sorted; and the sum of their third differences, of each.
struct OracleChange {
  std::vector<double> moves, turns;
  double jerkBefore = 0.0, jerkAfter = 0.0;
  [[nodiscard]] double mean() const;
};
/// `unit`: metres of the clip's numbers.
[[nodiscard]] OracleChange changeBetween(const OracleClip& before, const OracleClip& after,
                                         double unit = 1.0);

}  // namespace foretouch::test
