#include "middleware/worker_pool.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace foretouch {
namespace {

/// A run may follow the last one within microseconds, and waking a sleeping thread takes longer
/// than many runs.
template <typename Condition>
void waitBriefly(const Condition& isMet) {
  constexpr std::chrono::microseconds kBriefly{50};
  const auto end = std::chrono::steady_clock::now() + kBriefly;
  while (!isMet() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

}  // namespace

struct WorkerPool::Impl {
  std::vector<std::thread> threads;  // beside the calling one
  std::vector<Scratch> scratches;    // per thread, the calling one's first
  const std::function<void(std::size_t)>* part = nullptr;
  std::mutex mutex;
  std::condition_variable begins, ends;
  std::atomic<std::uint64_t> runs{0};   // number of runs begun
  std::atomic<std::size_t> working{0};  // threads not done with the current run
  bool isStopping = false;

  ~Impl() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      isStopping = true;
    }
    begins.notify_all();
    for (std::thread& thread : threads) thread.join();
  }

  void work(std::size_t number) {
    std::uint64_t seen = 0;
    for (;;) {
      waitBriefly([&] { return runs.load(std::memory_order_acquire) != seen; });
      std::unique_lock<std::mutex> lock(mutex);
      begins.wait(lock, [&] { return isStopping || runs != seen; });
      if (isStopping) return;
      seen = runs;
      lock.unlock();
      (*part)(number);
      lock.lock();
      if (--working == 0) ends.notify_one();
    }
  }

  void runAll() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      working = threads.size();
      ++runs;
    }
    begins.notify_all();
    (*part)(0);
    waitBriefly([&] { return working.load(std::memory_order_acquire) == 0; });
    std::unique_lock<std::mutex> lock(mutex);
    ends.wait(lock, [&] { return working == 0; });
  }
};

WorkerPool::WorkerPool(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WorkerPool::~WorkerPool() = default;
WorkerPool::WorkerPool(WorkerPool&&) noexcept = default;
WorkerPool& WorkerPool::operator=(WorkerPool&&) noexcept = default;

Result<WorkerPool> WorkerPool::start(int threads) {
  if (threads < 1 || threads > kMaxPoolThreads) {
    return Error::in("threads", ErrorCode::OutOfRange,
                     "expected a number from 1 to " + std::to_string(kMaxPoolThreads));
  }
  auto impl = std::make_unique<Impl>();
  const auto count = static_cast<std::size_t>(threads);
  impl->threads.reserve(count - 1);
  impl->scratches.resize(count);
  try {
    for (std::size_t i = 1; i < count; ++i) {
      impl->threads.emplace_back([all = impl.get(), i] { all->work(i); });
    }
  } catch (const std::system_error& failure) {
    return Error::in("threads", ErrorCode::DeviceFailed,
                     std::string("the system gives no more threads: ") + failure.what());
  }
  return WorkerPool(std::move(impl));
}

int WorkerPool::threads() const {
  return static_cast<int>(impl_->scratches.size());
}

Scratch& WorkerPool::scratch(std::size_t thread) {
  return impl_->scratches[thread];
}

void WorkerPool::run(const std::function<void(std::size_t)>& part) {
  impl_->part = &part;
  impl_->runAll();
}

}  // namespace foretouch
