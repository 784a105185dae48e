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

/// Millimetres per metre.
inline constexpr double kFeetMm = 1e3;

/// A part that comes down or lifts faster than this (m/s, along the ground's normal) is on its way
/// and does not rest: what it moves along the ground is not a slide. A step of 0.1 m height that
/// takes 0.4 s passes this speed within 0.3 mm of the ground.
inline constexpr double kRestNormalSpeed = 0.05;
/// Slides are measured by a divider that is opened this far (m): shaking within it is not a path.
inline constexpr double kSlideRuler = 0.0005;
/// A slide, or a depth, is reported from here on (m): errors are below a millimetre, so one of
/// 3 mm is always reported, and a foot that stays never is.
inline constexpr double kSlides = 0.002, kSinks = 0.002;
/// A resting foot that is at most this far above the ground hovers (m); a higher one is lifted.
inline constexpr double kHighestHover = 0.03;

enum class StanceKind : std::uint8_t {
  Touches,  ///< Its begin and its end are proven.
  Under,    ///< The same, and in between all of it is below the ground, by poses.
  Hovers,   ///< It rests above the ground, by poses.
};
/// "touches", "hovers", "under".
[[nodiscard]] const char* toString(StanceKind kind);

/// What counts for a part's slide at an instant between two poses, while the part rests.
struct RestLook {
  std::int64_t step = 0;
  LinkId link = 0;                                     ///< A link of RestingBody::avatar.
  std::size_t corner = 0;                              ///< Which of the part's corners.
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();       ///< The slowest point.
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();  ///< The ground's normal.
  Eigen::Vector3d way_W = Eigen::Vector3d::Zero();     ///< How far it slid in this look (m).
};

struct FootStance {
  StanceKind kind = StanceKind::Touches;
  std::size_t part = 0;
  ObjectId object = 0;
  double fromS = 0.0, toS = 0.0;
  std::int64_t fromFrame = 0, toFrame = 0;   ///< The clip's frames nearest to them.
  bool beganBefore = false, goesOn = false;  ///< As in PartContact.
  double slide = 0.0;  ///< Path along the ground of what touches it, while it rests.
  double moved = 0.0;  ///< Its greatest distance from where it began.
  double depth = 0.0;  ///< The greatest depth, along the ground's normal.
  double depthAtS = 0.0;
  /// At that instant no shorter translation clears it, in any direction: proven (depth.h).
  double leastWay = 0.0;
  double underS = 0.0;                   ///< As in PartContact.
  double hover = 0.0;                    ///< Mean height above the ground, for Hovers.
  std::vector<Eigen::Vector3d> trace_W;  ///< The way that it slid, from where it began.
  std::vector<RestLook> looks;           ///< By step, if FeetInputs::keepsLooks.

  [[nodiscard]] double durationS() const { return toS - fromS; }
};

/// A part at a pose.
struct PartSample {
  /// Above the ground; a hand's is above the nearest surface within kFarthestSurface. NaN: a void.
  float height = std::numeric_limits<float>::quiet_NaN();
  float depth = 0.0F;  ///< In the ground; a hand's is in what it touches.
  float slide =
      0.0F;  ///< m/s along the ground, until the next pose; 0 unless it rests and touches.
  float speed = 0.0F;  ///< m/s of its lowest sphere, until the next pose.
  bool touches = false;
  bool isUnder = false;  ///< All of it is below the ground.
  bool byRule = false;   ///< In contact by the field's rule of thumb (field_metrics.h).
};
/// Hands search no farther than this for a surface (m).
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
