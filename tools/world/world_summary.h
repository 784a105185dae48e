// tools/world/world_summary.h: what a world holds, and what its replay found, for people and for
// programs.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/world/world_touches.h"
#include "tools/world/world_windows.h"

namespace foretouch::tools {

/// Counts the contacts of all windows. Keeps one float per window.
class WorldSummary {
 public:
  /// `world` outlives it.
  explicit WorldSummary(const LoadedWorld& world) : world_(world) {}

  void add(const WorldStep& step);
  /// The touches of all windows, after the last one.
  void add(const WorldTouches& touches);

  struct Counts {
    std::int64_t contacts = 0, startsInContact = 0, undecided = 0, touches = 0;
  };
  [[nodiscard]] const Counts& total() const { return total_; }
  [[nodiscard]] const WorldTouchCounts& touches() const { return touches_; }
  [[nodiscard]] std::int64_t windows() const { return windows_; }
  [[nodiscard]] std::int64_t windowsWithContact() const { return windowsWithContact_; }
  [[nodiscard]] std::int64_t assumed() const { return assumed_; }
  /// The latency within which this share of the windows was answered.
  [[nodiscard]] double latencyUs(double share) const;

  [[nodiscard]] std::string text() const;
  /// One line. `output` and `report`: the files written; an empty report: none.
  [[nodiscard]] std::string jsonLine(const std::string& output, const std::string& report) const;

 private:
  using Pair = std::pair<BodyId, BodyId>;  // of the scene: kStillScene second
  [[nodiscard]] std::string nameOf(const Pair& pair) const;

  const LoadedWorld& world_;
  std::int64_t windows_ = 0, windowsWithContact_ = 0, assumed_ = 0;
  Counts total_;
  std::map<Pair, Counts> ofPair_;
  WorldTouchCounts touches_;
  std::uint64_t pairs_ = 0, nearPairs_ = 0;
  std::vector<float> latenciesUs_;
};

}  // namespace foretouch::tools
