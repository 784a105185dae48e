// middleware/solid/solid_checks.h: the options of a solid avatar, completed and checked. Not
// installed.
#pragma once

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "middleware/solid/solid_options.h"

namespace foretouch::internal {

/// The options, with what names of links say where nothing is given.
[[nodiscard]] SolidOptions completed(const Avatar& avatar, SolidOptions options);
/// Errors: an option out of range; lists of another length than the avatar's links.
Result<Done> checked(const Avatar& avatar, const SolidOptions& options);

}  // namespace foretouch::internal
