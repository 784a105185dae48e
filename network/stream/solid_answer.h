// network/stream/solid_answer.h: what a SolidMessage says, from a solid avatar's tick: for one
// alone (stream_solver.h), and for one among what moves (world_stream/). Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_tick.h"
#include "network/wire/messages.h"

namespace foretouch::internal {

/// An avatar of more than kMaxSolidJoints joints, which no message can hold, is an error.
[[nodiscard]] Result<Done> checkedJoints(const Avatar& avatar);

/// One flag per joint: 0 where it is not known (StreamStep::unknownJoints). True if all roots are.
bool findTracked(const Skeleton& skeleton, const std::vector<UndecidedReason>& unknownJoints,
                 std::vector<std::uint8_t>& isTracked);

/// Fills in which avatar a message is about, and the options. `avatarHash`: its skeleton's.
void fillSolidHead(std::int32_t id, std::int64_t avatarHash, const SolidOptions& options,
                   SolidMessage& answer);

/// What it shows at the tick's end. A way of more than kMaxSolidPoses poses does not travel: the
/// message then has only its end, not certified.
void fillSolidTick(const SolidTick& tick, const Skeleton& skeleton, const Scene& scene,
                   SolidMessage& answer);

/// Nothing to follow yet: says where the joints are as far as they are known.
void fillSolidWait(const Pose& tracked, const std::vector<std::uint8_t>& isTracked,
                   SolidMessage& answer);

}  // namespace foretouch::internal
