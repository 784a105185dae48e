#include "middleware/world/world_pool.h"

#include <utility>

#include "articulated/try.h"
#include "middleware/query/query_pool.h"
#include "middleware/query/worker_threads.h"
#include "middleware/world/window_query.h"

namespace foretouch {

struct WorldPool::Impl {
  internal::WorkerThreads threads;
  internal::WorldScratchParts scratch;

  explicit Impl(internal::WorkerThreads&& started) : threads(std::move(started)) {}
};

WorldPool::WorldPool(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WorldPool::~WorldPool() = default;
WorldPool::WorldPool(WorldPool&&) noexcept = default;
WorldPool& WorldPool::operator=(WorldPool&&) noexcept = default;

Result<WorldPool> WorldPool::start(int threads) {
  FORETOUCH_TRY(auto started, internal::WorkerThreads::start(threads, kMaxPoolThreads));
  return WorldPool(std::make_unique<Impl>(std::move(started)));
}

int WorldPool::threads() const {
  return static_cast<int>(impl_->threads.count());
}

Result<Done> WorldPool::contacts(const World& world, std::int64_t fromUs, std::int64_t toUs,
                                 WorldContacts& answer) {
  return internal::askWindow(world, fromUs, toUs, &impl_->threads, impl_->scratch, answer);
}

}  // namespace foretouch
