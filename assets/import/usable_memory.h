// assets/import/usable_memory.h: how much memory this process may count on. Not installed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace foretouch::internal {

/// Bytes: the machine's, or less where a control group allows less (a container, a unit of
/// systemd). Nothing if the system does not say.
[[nodiscard]] std::optional<std::size_t> usableMemory();

/// The least limit (bytes) of the control groups in `membership`, the text of /proc/self/cgroup,
/// and of the groups around them; `mounts`: /sys/fs/cgroup. Reads version 1, version 2 and both
/// together (cgroups(7)). Where a container sees only its own part of the tree, that part counts.
/// Nothing if no group has a limit.
[[nodiscard]] std::optional<std::size_t> groupLimit(const std::string& membership,
                                                    const std::string& mounts);

}  // namespace foretouch::internal
