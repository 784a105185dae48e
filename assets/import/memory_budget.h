// assets/import/memory_budget.h: how much memory an import may take for the bytes that it reads, so
// that no small file costs gigabytes: instances of instances, counts that lie. For the importer's
// own process. Not installed.
#pragma once

#include <cstdint>

namespace foretouch::internal {

/// What the importer may take before it has read a byte, its libraries included (some 100 MB).
/// Together with a small file's share it stays below 1 GB.
constexpr std::uint64_t kMemoryForNothing = 990'000'000;
/// For each byte read. Faces as text cost assimp most, some 50 bytes of memory per byte; compressed
/// FBX arrays unpack to several times their size first.
constexpr std::uint64_t kMemoryPerByte = 256;

/// Counts `bytes` as read and sets the limit of the address space accordingly, never above what the
/// parent allows. Does nothing under sanitizers. Called from one thread.
void grantMemoryFor(std::uint64_t bytes);

/// The limit in force, in bytes.
[[nodiscard]] std::uint64_t grantedMemory();

}  // namespace foretouch::internal
