// bench/world/timed_world.h: windows of a world, asked one after the other, and their times.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/timing.h"
#include "bench/world/people.h"
#include "middleware/world/world.h"

namespace foretouch::tools {

/// Microseconds of the thread's processor time, one per window.
struct WindowFigures {
  std::vector<double> pushUs, answerUs;  ///< For all poses; for the answer.
  WorldCounters sum;                     ///< For all windows, like the next four.
  std::uint64_t contacts = 0, starts = 0, undecided = 0;

  [[nodiscard]] std::uint64_t windows() const { return answerUs.size(); }
  /// Per window; 0 without any.
  [[nodiscard]] double perWindow(std::uint64_t count) const;
};

/// One thread.
class TimedWorld {
 public:
  /// With the benchmark's tolerance, kBenchWorldTolerance.
  explicit TimedWorld(std::optional<Scene> still = std::nullopt);

  [[nodiscard]] World& world() { return world_; }
  [[nodiscard]] const WorldContacts& answer() const { return answer_; }

  /// Adds a person; `asksSelf`: own links, too, if he has pairs of them.
  [[nodiscard]] BodyId add(const Person& person, bool asksSelf, BodyGroup group = 0);
  /// Adds a person as the options say.
  [[nodiscard]] BodyId add(const Person& person, const BodyOptions& options);
  /// A pose whose time counts for the window that is asked next.
  void push(BodyId body, std::int64_t utimeUs, const Pose& pose);
  /// Asks and forgets; counts it if `isCounted`.
  void ask(std::int64_t fromUs, std::int64_t toUs, bool isCounted);

  WindowFigures figures;

 private:
  World world_;
  Scratch scratch_;
  WorldContacts answer_;
  double pushedUs_ = 0.0;
};

inline constexpr double kBenchWorldTolerance = 1e-3;

/// How long a crowd is looked at.
struct CrowdWindows {
  std::int64_t windowUs = 33'333;
  int warm = 10;  ///< Windows before those that count.
  int counted = 60;
};
/// Runs all of them from their first poses on, window after window; bodies 0, 1, ... of the world.
void runCrowd(const std::vector<Person>& people, const CrowdWindows& windows, TimedWorld& world);

}  // namespace foretouch::tools
