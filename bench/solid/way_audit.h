// bench/solid/way_audit.h: every promise of a solid avatar's ticks, judged from what it recorded
// alone: free, continuous, and no clearance beyond the truth.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bench/solid/plain_body.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch::tools {

struct WayTally {
  std::uint64_t ticks = 0, instants = 0;
  std::uint64_t moved = 0;        ///< Ticks with a way.
  std::uint64_t inside = 0;       ///< Ticks on whose way something penetrates.
  std::uint64_t broken = 0;       ///< Ticks whose way does not begin where the last one ended.
  std::uint64_t overclaimed = 0;  ///< Ticks whose clearance is above the least separation.
  std::uint64_t uncertified = 0, appeared = 0;
  std::uint64_t states[kNumSolidStates] = {}, limits[kNumSolidLimits] = {};
  double least = std::numeric_limits<double>::infinity();  ///< Separation on all ways (m).
  std::vector<std::string> findings;                       ///< The first twenty, to replay them.

  [[nodiscard]] std::uint64_t violations() const { return inside + broken + overclaimed; }
  void add(const WayTally& other);
};

/// Judges tick by tick. The scene must outlive it.
class WayAudit {
 public:
  /// `ownPairs`: links that must not meet.
  WayAudit(const oracle::Scene& scene, const Avatar& avatar,
           const std::vector<std::array<int, 2>>& ownPairs = {});

  /// `name`: the run's, for findings. The next tick is the first.
  void begin(std::string name);
  void look(const SolidTick& tick);
  [[nodiscard]] const WayTally& tally() const { return tally_; }

  /// The judge sees no farther (m).
  static constexpr double kLooksFarM = 0.02;
  /// Instants per tick, at least.
  static constexpr int kInstants = 50;
  /// How far an honest clearance may be above the judge's separation, which rounds (m).
  static constexpr double kRounding = 1e-10;

 private:
  void lookAlong(const SolidTick& tick);
  void find(const std::string& what);

  oracle::WayJudge judge_;
  WayTally tally_;
  std::string name_;
  std::uint64_t tickOfRun_ = 0;
  oracle::PlainPose shown_;
  double leastOfTick_ = 0.0;  // on its way (m); infinite beyond kLooksFarM
};

}  // namespace foretouch::tools
