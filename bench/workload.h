// bench/workload.h: the steps of a benchmark: a clip at many places of a scene, and there either
// all steps of busy places, or a fixed mix, from all places, of steps with a contact, steps near
// things and steps far from all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/body.h"
#include "bench/inputs.h"

namespace foretouch::tools {

enum class StepChoice : std::uint8_t {
  BusyPlaces,  ///< All steps of places where about one step in five has a contact.
  Mix,         ///< Selected so that hardly a step is easy.
};
/// "busy", "mix".
[[nodiscard]] const char* toString(StepChoice choice);

struct WorkloadRequest {
  StepChoice choice = StepChoice::BusyPlaces;
  double rateHz = 5.0;
  std::size_t steps = 500;  ///< Requested; there may be fewer.
  std::uint64_t seed = 1;
  int mostPlacements = 1000;
  double floorY = 0.0;             ///< Height (m) of the scene's floor.
  double liftM = 0.05;             ///< How far the clip's lowest point stays above it.
  std::optional<Placement> place;  ///< Given: every step of the clip at this one place, no choice.
};

/// A place is busy if this share of the steps that do not start in contact has one, and at most
/// kMostStarts of all start in contact (a body that stands in furniture).
inline constexpr double kLeastBusy = 0.12, kMostBusy = 0.28, kMostStarts = 0.2;
/// If busy places have fewer steps than this, the places nearest to busy supply the rest.
inline constexpr std::size_t kLeastSteps = 100;

/// Shares of the mix: a step is easy (far), nearly a contact, or a contact. Excludes steps that
/// start in contact.
inline constexpr double kBusyContact = 0.20, kBusyNear = 0.65;
/// A step is near if a link with its radii grown by this (m) touches at one of kNearInstants
/// instants. A fixed rule, so that the steps do not depend on the query's bounds.
inline constexpr double kNearM = 0.03;
inline constexpr int kNearInstants = 5;
/// Limit on the steps of a long clip per place, spread over it: otherwise one place would fill the
/// mix.
inline constexpr std::int64_t kMostStepsAPlace = 40;
/// Places tried even if fewer complete the mix.
inline constexpr int kLeastPlaces = 20;
/// Contacts count at this tolerance (m).
inline constexpr double kWorkloadTolerance = 1e-3;

enum class StepClass : std::uint8_t { Start, Contact, Near, Far };
inline constexpr std::size_t kStepClasses = 4;

struct StepPick {
  Placement placement;
  std::int64_t frame = 0;  ///< From here to frame + stride.
  StepClass kind = StepClass::Far;
};

struct Workload {
  WorkloadRequest request;
  std::int64_t stride = 1;
  std::vector<StepPick> picks;
  int placements = 0;                      ///< Tried.
  int taken = 0;                           ///< Busy ones selected.
  std::int64_t found[kStepClasses] = {};   ///< Steps at those places, by class.
  std::int64_t chosen[kStepClasses] = {};  ///< Steps of the workload, by class.
};

/// Steps of `body`, which is made from the inputs' avatar. Deterministic: the same request gives
/// the same steps, and the same places whatever the rate. Errors: a rate that the clip does not
/// have.
[[nodiscard]] Result<Workload> chooseSteps(const BenchInputs& inputs, const BenchBody& body,
                                           const WorkloadRequest& request);

/// "500 steps: 20 % with a contact, ...": for the report.
[[nodiscard]] std::string describe(const Workload& workload);

struct StepPoses {
  Pose from, to;
};

/// The chosen steps' validated poses for a body made from the inputs' avatar.
[[nodiscard]] Result<std::vector<StepPoses>> posesOf(const BenchInputs& inputs,
                                                     const BenchBody& body,
                                                     const Workload& workload);

/// The picks' places in the list, placement by placement, and there in the order of the
/// clip: as a live program asks them.
[[nodiscard]] std::vector<std::size_t> inClipOrder(const Workload& workload);

}  // namespace foretouch::tools
