// bench/person.h: `foretouch-bench body`: what brackets say of persons whose poses are held back,
// by rate and model, judged; and what they cost beside a plain step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

struct PersonBenchRequest {
  std::string dataFolder;  ///< With mocap/ and scenes/; empty: the bundled room and dancer alone.
  std::vector<std::string> scenes, clips;                    ///< As loadCast() takes them.
  std::vector<double> ratesHz{60.0, 30.0, 15.0, 10.0, 5.0};  ///< Of given poses.
  std::vector<MotionModel> models{MotionModel::ConstantRate, MotionModel::Cubic,
                                  MotionModel::CubicLate};
  int places = 1;           ///< Per clip and scene.
  double seconds = 4.0;     ///< At each.
  int instants = 3;         ///< That the judge looks at per frame.
  double boundShare = 1.0;  ///< Of the bounds that hold: below 1 to see them found out.
  std::uint64_t seed = 1;   ///< Of the places.
  /// Above 0: bounds are learned at this quantile, on all clips of other makers than the judged
  /// one's; touches that are missed or invented are then counted, and no violation.
  double learned = 0.0;
  double aheadS = 0.0;  ///< Above 0: instead, what is said of this long after each pose.
  std::string command;
};

struct PersonBench {
  BenchReport report;
  std::uint64_t violations = 0;  ///< Missed touches and lies.
};

/// One thread.
[[nodiscard]] Result<PersonBench> measurePerson(const PersonBenchRequest& request);

}  // namespace foretouch::tools
