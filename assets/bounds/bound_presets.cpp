#include "assets/bounds/bound_presets.h"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "assets/near_names.h"

namespace foretouch {
namespace {

/// How a person beside a robot moves, as [Thumm25] has it (safety_shield/config/cmu_mocap_no_hand):
/// the speed of every joint (m/s), an error of measured speeds (m/s), and accelerations (m/s^2), of
/// each part the largest of the joints at its ends.
constexpr double kSpeed = 2.0, kSpeedError = 0.1;
constexpr std::array<std::pair<const char*, double>, 7> kAccelerations{{{"trunk", 25.0},
                                                                        {"head", 25.0},
                                                                        {"leg", 30.0},
                                                                        {"foot", 30.0},
                                                                        {"arm", 50.0},
                                                                        {"hand", 50.0},
                                                                        {"all", 50.0}}};
/// Bounds are of person minus model: where both stay below it, they differ by twice that at most.
constexpr double kOfBoth = 2.0;

struct Preset {
  const char* name;
  double errorM;                   // a pose's; if 0, the speed at the last pose is known, too
  std::vector<const char*> parts;  // empty: all
  const char* source;
  double quantile = 1.0;  // at which the error holds, as the source has it
};

const std::array<Preset, 5>& presets() {
  static const std::array<Preset, 5> all{
      {{"sara-shield", 0.0, {}, "motion: Thumm et al. 2025, SaRA-shield's configuration"},
       {"optical",
        0.002,
        {},
        "poses: Merriaux et al. 2017, moving markers; motion: Thumm et al. 2025"},
       {"markerless",
        0.04,
        {},
        "poses: Nakano et al. 2020, nine of ten mean errors of joints; motion: Thumm et al. 2025",
        0.9},
       {"inertial-suit",
        0.07,
        {"arm", "hand"},
        "poses: Filippeschi et al. 2017, twice the mean of an arm; motion: Thumm et al. 2025"},
       {"vr-trackers",
        0.042,
        {"head", "hand"},
        "poses: Sansone et al. 2021, mean and two deviations; motion: Thumm et al. 2025"}}};
  return all;
}

bool has(const std::vector<const char*>& parts, std::string_view part) {
  if (parts.empty()) return true;
  for (const char* const one : parts) {
    if (part == one) return true;
  }
  return false;
}

BoundsFile fileOf(const Preset& preset) {
  BoundsFile file{preset.name, preset.source, {}};
  for (const auto& [part, acceleration] : kAccelerations) {
    if (!has(preset.parts, part)) continue;
    BoundEntry entry;
    entry.part = part;
    entry.model = MotionModel::ConstantRate;
    entry.bound.error = preset.errorM;
    entry.quantile = preset.quantile;
    entry.bound.acceleration = kOfBoth * acceleration;
    entry.bound.speed = kSpeed;
    if (preset.errorM == 0.0) {
      entry.bound.aheadSpeed = kSpeedError;
      entry.bound.aheadAcceleration = kOfBoth * acceleration;
    }
    file.entries.push_back(std::move(entry));
  }
  return file;
}

}  // namespace

Result<BoundsFile> readBounds(const std::string& name) {
  if (name.rfind(kBoundPresetPrefix, 0) != 0) return readBoundsFile(name);
  std::vector<std::string> names;
  for (const Preset& preset : presets()) {
    names.push_back(std::string(kBoundPresetPrefix) + preset.name);
    if (names.back() == name) return fileOf(preset);
  }
  std::string known;
  for (const std::string& one : names) known += (known.empty() ? "" : ", ") + one;
  return Error::of(ErrorCode::UnknownName, fmt::format("expected one of {}, found {}{}", known,
                                                       inQuotes(name), didYouMean(name, names)));
}

}  // namespace foretouch
