// middleware/world/world_pool.h: the question of world_query.h on several threads.
#pragma once

#include <cstdint>
#include <memory>

#include "articulated/result.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// A fixed set of threads, and the memory that their questions reuse. The answers are the same, to
/// the bit, for any number of threads, and those of worldContacts(). Once the threads' memory has
/// grown, allocates nothing.
class WorldPool {
 public:
  /// `threads` in [1, kMaxPoolThreads] (query_pool.h), the calling one among them. Errors: a number
  /// out of range, or the system refuses the threads.
  static Result<WorldPool> start(int threads);
  ~WorldPool();
  WorldPool(WorldPool&&) noexcept;
  WorldPool& operator=(WorldPool&&) noexcept;

  [[nodiscard]] int threads() const;

  /// As worldContacts(). Errors besides: memory ran out (DeviceFailed); the answer then means
  /// nothing. Not for two threads at once; nobody changes the world meanwhile.
  Result<Done> contacts(const World& world, std::int64_t fromUs, std::int64_t toUs,
                        WorldContacts& answer);

 private:
  struct Impl;
  explicit WorldPool(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
