// tools/world/world_windows.h: the windows of a replayed world, and the answer to each.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "middleware/world/world_contacts.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// At most so many windows.
inline constexpr std::size_t kMostWindows = std::size_t{1} << 24;

/// Which part of a world's time is asked, and how finely.
struct WindowRequest {
  std::optional<double> rateHz;  ///< Windows per second; nothing: from pose to pose of all.
  std::optional<std::int64_t> fromUs, untilUs;  ///< Nothing: all that is known.
};

/// The instants at which windows begin and end: at least two, increasing. Besides the requested
/// ones they are at every instant at which a body appears or changes its carrier, so that no
/// contact begins with that inside a window. Errors name the option.
[[nodiscard]] Result<std::vector<std::int64_t>> windowsOf(const LoadedWorld& world,
                                                          const WindowRequest& request);

struct WorldStep {
  std::int64_t window = 0;
  std::int64_t fromUs = 0, toUs = 0;
  const WorldContacts& answer;
  double latencyUs = 0.0;
};

/// Asks window by window, in order, what touches what, without triggers, until `take` returns
/// false. Errors name the body.
[[nodiscard]] Result<Done> replayWorld(const LoadedWorld& world,
                                       const std::vector<std::int64_t>& cuts,
                                       const std::function<bool(const WorldStep&)>& take);

/// What touches what when bodies appear: the contacts that start, each body at its first pose, with
/// all bodies that are there then, the scene and its own links.
[[nodiscard]] Result<std::vector<WorldContact>> overlapsAtStart(const LoadedWorld& world);

}  // namespace foretouch::tools
