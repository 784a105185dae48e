#include "network/watch/view_feed.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace foretouch {
namespace {

constexpr std::int64_t kPeriodUs = 1'000'000 / kMaxShownStepsPerS;
constexpr std::size_t kCacheLineBytes = 64;

enum class Wish : std::uint8_t { None, One, All };

/// A batch that threads pass to one another: the thread that took it owns it.
class Handover {
 public:
  Handover() = default;
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;
  ~Handover() { delete place_.load(); }
  [[nodiscard]] bool isEmpty() const { return place_.load(std::memory_order_relaxed) == nullptr; }
  [[nodiscard]] std::unique_ptr<StepBatch> take() {
    return std::unique_ptr<StepBatch>(place_.exchange(nullptr, std::memory_order_acq_rel));
  }
  /// Deletes the previous batch.
  void put(std::unique_ptr<StepBatch> batch) {
    delete place_.exchange(batch.release(), std::memory_order_acq_rel);
  }

 private:
  std::atomic<StepBatch*> place_{nullptr};
};

}  // namespace

bool ShowPace::passes(std::int64_t nowUs) {
  if (nowUs < dueUs_) return false;
  // On a grid, so that a stream of exactly this rate passes despite its jitter.
  dueUs_ = std::max(dueUs_ + kPeriodUs, nowUs);
  return true;
}

struct alignas(kCacheLineBytes) ViewFeed::Box {
  std::atomic<Wish> wish{Wish::None};
  Handover full;   // with steps; only answering threads put it
  Handover empty;  // returned by the watching thread
  std::atomic<std::uint64_t> numFailed{0};
  ShowPace pace;  // of the watching thread
};

ViewFeed::ViewFeed(std::size_t numAvatars)
    : numAvatars_(numAvatars), boxes_(std::make_unique<Box[]>(numAvatars)) {}
ViewFeed::~ViewFeed() = default;

bool ViewFeed::wants(std::size_t avatar) const noexcept {
  return boxes_[avatar].wish.load(std::memory_order_relaxed) != Wish::None;
}

void ViewFeed::observe(std::size_t avatar, const StreamStep& step, const ContactsMessage& answer,
                       const ShownStep* shown, const PersonStream* person) noexcept {
  Box& box = boxes_[avatar];
  Wish one = Wish::One;
  const bool isOnlyOne = box.wish.load(std::memory_order_relaxed) == Wish::One &&
                         box.wish.compare_exchange_strong(one, Wish::None);
  try {
    std::unique_ptr<StepBatch> batch = box.full.take();
    if (!batch) batch = box.empty.take();
    if (!batch) batch = std::make_unique<StepBatch>();
    if (isOnlyOne) batch->clear();  // a sample replaces earlier ones
    batch->add(step, answer, shown, person);
    box.full.put(std::move(batch));
  } catch (...) {
    box.numFailed.fetch_add(1, std::memory_order_relaxed);
  }
}

void ViewFeed::watch(bool isWatched) {
  for (std::size_t i = 0; i < numAvatars_; ++i) boxes_[i].wish = isWatched ? Wish::All : Wish::None;
}

void ViewFeed::sample() {
  for (std::size_t i = 0; i < numAvatars_; ++i) boxes_[i].wish = Wish::One;
}

bool ViewFeed::take(std::size_t avatar, std::int64_t nowUs, StepBatch& batch) {
  Box& box = boxes_[avatar];
  if (box.full.isEmpty() || !box.pace.passes(nowUs)) return false;
  std::unique_ptr<StepBatch> taken = box.full.take();
  if (!taken) return false;  // an answering thread has it now
  std::swap(batch, *taken);
  taken->clear();
  box.empty.put(std::move(taken));
  return true;
}

std::uint64_t ViewFeed::numFailed() const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < numAvatars_; ++i) {
    sum += boxes_[i].numFailed.load(std::memory_order_relaxed);
  }
  return sum;
}

}  // namespace foretouch
