// tests/oracle/obstacles.h: what stands where a clip's limbs go, made by construction: thin plates,
// a cage of bars around the first pose, thin spikes that point at the body. Metres.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/solid/stage.h"

namespace foretouch::test {

enum class Obstacles : std::uint8_t { None, Plates, Cage, Spikes };
inline constexpr std::uint8_t kNumObstacles = 4;
/// "none", "plates", "cage", "spikes".
[[nodiscard]] const char* toString(Obstacles obstacles);

/// The stage and the obstacles: the same for the same arguments. None of them is within a
/// centimetre of the first pose; plates and spikes are where an end of an LSS is later.
[[nodiscard]] tools::SolidStage withObstacles(const tools::SolidStage& stage, Obstacles obstacles,
                                              const Avatar& avatar, const std::vector<Pose>& poses,
                                              std::uint64_t seed);

}  // namespace foretouch::test
