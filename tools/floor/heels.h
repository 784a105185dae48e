// tools/floor/heels.h: heels for a body that was made of bones: bones show where the ankle is, and
// no heel below it.
#pragma once

#include <cstddef>
#include <vector>

#include "articulated/result.h"
#include "tools/floor/floor_fit.h"
#include "tools/floor/resting_body.h"

namespace foretouch::tools {

/// Lets the rear end of each heel down to the level of the ball, as the foot stands when it rests;
/// `rests` say when that is. Feet whose rests differ too much, or that never rest, stay as they
/// are. `lowered`, if not null, becomes the number of heels that came down. Errors: as `poses`.
[[nodiscard]] Result<RestingBody> withHeelsDown(RestingBody body,
                                                const std::vector<FootRest>& rests,
                                                const RestingPoses& poses,
                                                std::size_t* lowered = nullptr);

/// The avatar that `body` was made of, with the body's heels and balls in place of its feet.
[[nodiscard]] Result<Avatar> avatarWithHeels(const Avatar& avatar, const RestingBody& body);

}  // namespace foretouch::tools
