#include "assets/import/usable_memory.h"

#include <charconv>
#include <sstream>
#include <system_error>
#include <unistd.h>

#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

constexpr std::size_t kMostBytes = 1u << 16;  // of the files below

void lower(std::optional<std::size_t>& least, std::optional<std::size_t> limit) {
  if (limit && (!least || *limit < *least)) least = limit;
}

/// Version 2 says "max" where there is no limit, version 1 a number beyond all memory.
std::optional<std::size_t> limitIn(const std::string& file) {
  const auto text = readWholeFile(file, kMostBytes);
  if (!text.ok()) return std::nullopt;
  const char* const begin = text.value().data();
  std::size_t bytes = 0;
  const auto [end, problem] = std::from_chars(begin, begin + text.value().size(), bytes);
  const bool isNumber = problem == std::errc() && end != begin;
  return isNumber ? std::optional(bytes) : std::nullopt;
}

/// The least limit of `group`, a path that begins with '/', and of all groups around it.
std::optional<std::size_t> limitUpwards(const std::string& mount, std::string group,
                                        const char* name) {
  std::optional<std::size_t> least;
  for (;;) {
    if (!group.empty() && group.back() == '/') group.pop_back();
    lower(least, limitIn(mount + group + "/" + name));
    const std::size_t slash = group.rfind('/');
    if (slash == std::string::npos) return least;
    group.resize(slash);
  }
}

/// Whether the comma-separated `controllers` name that of memory.
bool governsMemory(const std::string& controllers) {
  return ("," + controllers + ",").find(",memory,") != std::string::npos;
}

std::optional<std::size_t> physicalMemory() {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::nullopt;
  return static_cast<std::size_t>(pages) * static_cast<std::size_t>(bytes);
}

}  // namespace

std::optional<std::size_t> groupLimit(const std::string& membership, const std::string& mounts) {
  std::optional<std::size_t> least;
  std::istringstream lines(membership);
  // "hierarchy:controllers:group"; version 2 is hierarchy 0 and names no controllers.
  for (std::string hierarchy, controllers, group; std::getline(lines, hierarchy, ':') &&
                                                  std::getline(lines, controllers, ':') &&
                                                  std::getline(lines, group);) {
    if (hierarchy == "0" && controllers.empty()) {
      lower(least, limitUpwards(mounts, group, "memory.max"));
    } else if (governsMemory(controllers)) {
      lower(least, limitUpwards(mounts + "/memory", group, "memory.limit_in_bytes"));
    }
  }
  return least;
}

std::optional<std::size_t> usableMemory() {
  auto least = physicalMemory();
  const auto membership = readWholeFile("/proc/self/cgroup", kMostBytes);
  if (membership.ok()) lower(least, groupLimit(membership.value(), "/sys/fs/cgroup"));
  return least;
}

}  // namespace foretouch::internal
