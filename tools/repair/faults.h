// tools/repair/faults.h: what is wrong with a clip, interval by interval: what touches between two
// poses, feet that slide or lie under the ground, joints beyond their limits.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "middleware/scene/scene.h"
#include "tools/feet/feet_answer.h"
#include "tools/repair/stage.h"

namespace foretouch::tools {

enum class FaultKind : std::uint8_t {
  Scene,  ///< A link touches an object.
  Own,    ///< A link touches another one.
  Under,  ///< A part of a foot is below the ground, at a pose.
  Slide,  ///< A part of a foot slides while it rests.
  Limit,  ///< A joint is beyond its limits, at a pose.
};
/// "touches", "touches itself", "under the ground", "slides", "beyond its limits".
[[nodiscard]] const char* toString(FaultKind kind);

/// A fault of one interval, from pose `step` to the next.
struct StepFault {
  FaultKind kind = FaultKind::Scene;
  std::int32_t step = 0;  ///< For Limit a pose; for Under, too, but for the last one.
  LinkId link = -1;       ///< A link of the body; for Limit the knob's place.
  LinkId other = -1;      ///< For Own.
  ObjectId object = -1;   ///< For Scene.
  std::size_t part = 0;   ///< For Under and Slide: a part of FeetInputs::body.
  bool isStart = false;   ///< For contacts: it touches at the pose already.
  bool isUndecided = false;
  double at = 0.0;  ///< For contacts, in [0,1]: it is free until there.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();       ///< On what is touched.
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();  ///< Unit, towards the link; zero: not known.
  TriangleId triangle = -1;
  /// By how much (m, or for Limit the knob's unit): depth, the stance's slide, excess; for contacts
  /// the penetration of an axis' radius, where it is known.
  double by = 0.0;
};

/// The looks of a stance that bear: those at which the part is about the lowest of its foot. A heel
/// that lifts over a ball that stands does not slide.
struct BearingStance {
  std::size_t part = 0;
  std::vector<RestLook> looks;
  double slide = 0.0, moved = 0.0;  ///< As in FootStance, for these looks.
  std::int64_t fromFrame = 0, toFrame = 0;

  [[nodiscard]] bool isFault(double mostSlide) const {
    return slide >= kSlides && moved <= mostSlide;
  }
  [[nodiscard]] bool isMeant(double mostSlide) const {
    return slide >= kSlides && moved > mostSlide;
  }
};
/// A part is about the lowest within this (m).
inline constexpr double kBears = 0.002;

struct Faults {
  std::vector<StepFault> all;  ///< By step.
  FeetAnswer feet;
  std::vector<BearingStance> bearing;  ///< Stances of feet.
  std::vector<std::uint8_t> isFaulty;  ///< Per interval.
  std::int64_t faulty = 0;             ///< Number of faulty intervals.

  [[nodiscard]] std::int64_t countOf(FaultKind kind) const;  ///< In intervals.
};

/// Asks the kernel about every interval, and finds how feet rest. Errors: those of stancesOf().
[[nodiscard]] Result<Faults> faultsOf(const RepairStage& stage);

/// Depths below this are rounding (m).
inline constexpr double kNoFault = 1e-6;
/// The most that printing six digits may add to a limit (rad or m).
inline constexpr double kLimitRounding = 1e-5;

}  // namespace foretouch::tools
