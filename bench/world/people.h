// bench/world/people.h: the people who move in the worlds that are measured: they go through a clip
// there and back, for as long as the measurement takes. Metres, microseconds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/solid/cast.h"

namespace foretouch::tools {

/// "walk (22 links), jump (22 links)".
[[nodiscard]] std::string namesOf(const Cast& cast);

/// A clip's poses at a rate, about the origin; shared by all people who go through it.
struct ClipPoses {
  const SolidActor* actor = nullptr;
  std::int64_t periodUs = 0;
  std::vector<Pose> poses;
};
/// One per actor whose clip is long enough.
[[nodiscard]] std::vector<ClipPoses> clipPosesOf(const Cast& cast, double rateHz);

struct Person {
  const ClipPoses* clip = nullptr;
  Placement place;
  std::size_t phase = 0;      ///< Which pose is the first.
  std::int64_t offsetUs = 0;  ///< When it is taken.

  /// The k-th pose, from 0 on, and its instant.
  [[nodiscard]] Pose pose(std::int64_t k) const;
  [[nodiscard]] std::int64_t instant(std::int64_t k) const { return offsetUs + clip->periodUs * k; }
};

/// People on a square grid of this spacing, each with a clip, a phase and a direction: the same
/// for the same arguments.
[[nodiscard]] std::vector<Person> crowdOf(const std::vector<ClipPoses>& clips, int count,
                                          double spacing);

}  // namespace foretouch::tools
