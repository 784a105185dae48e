// tools/feet/feet_answer.h: how each foot and hand rests: from when to when, how far it slides, how
// deep it is in the ground, and whether it hovers above it. Metres and seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/feet/field_metrics.h"
#include "tools/feet/foot_contacts.h"

namespace foretouch::tools {

/// Millimetres of a metre.
inline constexpr double kFeetMm = 1e3;

/// A part that comes down or lifts faster than this (m/s, along the ground's normal) is on its way
/// and does not rest: what it moves along the ground is no slide. A step of 0.1 m height that takes
/// 0.4 s passes this speed within 0.3 mm of the ground.
inline constexpr double kRestNormalSpeed = 0.05;
/// Slides are measured by a divider that is opened this far (m): shaking within it is no path.
inline constexpr double kSlideRuler = 0.0005;
/// From here on a slide, or a depth, is told as one (m): errors are below a millimetre, so one of
/// 3 mm is always told, and a foot that stays never.
inline constexpr double kSlides = 0.002, kSinks = 0.002;
/// A foot at most this far above the ground that rests hovers (m); farther, it is lifted.
inline constexpr double kHighestHover = 0.03;

enum class StanceKind : std::uint8_t {
  Touches,  ///< Its begin and its end are proven.
  Under,    ///< The same, and in between all of it is below the ground, by poses.
  Hovers,   ///< It rests above the ground, by poses.
};
/// "touches", "hovers", "under".
[[nodiscard]] const char* toString(StanceKind kind);

/// What of a part counted for its slide at an instant between two poses, while it rested.
struct RestLook {
  std::int64_t step = 0;
  LinkId link = 0;                                     ///< Of RestingBody::avatar.
  std::size_t corner = 0;                              ///< Of the part.
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();       ///< The slowest point.
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();  ///< Of the ground.
  Eigen::Vector3d way_W = Eigen::Vector3d::Zero();     ///< That it slid, of this look (m).
};

struct FootStance {
  StanceKind kind = StanceKind::Touches;
  std::size_t part = 0;
  ObjectId object = 0;
  double fromS = 0.0, toS = 0.0;
  std::int64_t fromFrame = 0, toFrame = 0;   ///< The clip's frames nearest to them.
  bool beganBefore = false, goesOn = false;  ///< As PartContact.
  double slide = 0.0;  ///< Path along the ground of what touches it, while it rests.
  double moved = 0.0;  ///< The farthest that it came from where it began.
  double depth = 0.0;  ///< The greatest, along the ground's normal.
  double depthAtS = 0.0;
  /// Proven at that instant: no shorter translation clears it (depth.h), in any direction.
  double leastWay = 0.0;
  double underS = 0.0;                   ///< As PartContact.
  double hover = 0.0;                    ///< Mean height above the ground, of Hovers.
  std::vector<Eigen::Vector3d> trace_W;  ///< The way that it slid, from where it began.
  std::vector<RestLook> looks;           ///< If FeetInputs::keepsLooks: by step.

  [[nodiscard]] double durationS() const { return toS - fromS; }
};

/// A part at a pose.
struct PartSample {
  /// Above the ground; of a hand above the nearest surface within kFarthestSurface. NaN: a void.
  float height = std::numeric_limits<float>::quiet_NaN();
  float depth = 0.0F;  ///< In the ground, or of a hand in what it touches.
  float slide =
      0.0F;  ///< m/s along the ground, until the next pose; 0 unless it rests and touches.
  float speed = 0.0F;  ///< m/s of its lowest sphere, until the next pose.
  bool touches = false;
  bool isUnder = false;  ///< All of it.
  bool byRule = false;   ///< In contact by the field's rule of thumb (field_metrics.h).
};
/// Hands look no farther than this for a surface (m).
inline constexpr double kFarthestSurface = 0.5;

struct FeetAnswer {
  std::vector<FootStance> stances;  ///< By part, then by time.
  std::vector<PartSample> samples;  ///< Pose by pose, in each the parts in order.
  FieldMetrics field;
  double unresolvedS = 0.0;

  [[nodiscard]] const PartSample& sample(std::int64_t step, std::size_t part,
                                         std::size_t parts) const {
    return samples[static_cast<std::size_t>(step) * parts + part];
  }
};

}  // namespace foretouch::tools
