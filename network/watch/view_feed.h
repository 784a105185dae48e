// network/watch/view_feed.h: from the threads that answer to the one that shows it. Each avatar has
// a box with one batch of steps in it, which passes from hand to hand: who answers takes it out,
// adds a step and puts it back; who watches takes it away. Neither waits for the other, and no
// contact is lost between them (but beyond kMaxBatchContacts, counted).
//
// While nobody watches a step costs one atomic load, and sample() asks for one step now and then,
// so that there is something to show at once when somebody comes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "network/stream/step_batch.h"
#include "network/stream/step_observer.h"

namespace foretouch {

/// An avatar's batches are given out at most so often on average.
inline constexpr int kMaxShownStepsPerS = 30;

/// Lets through kMaxShownStepsPerS a second on average, and two at once after a pause.
class ShowPace {
 public:
  /// Whether one may pass at `nowUs`, which never goes back; it then has.
  [[nodiscard]] bool passes(std::int64_t nowUs);

 private:
  std::int64_t dueUs_ = 0;
};

class ViewFeed final : public StepObserver {
 public:
  explicit ViewFeed(std::size_t numAvatars);
  ViewFeed(const ViewFeed&) = delete;
  ViewFeed& operator=(const ViewFeed&) = delete;
  ~ViewFeed() override;

  // By those who answer.
  [[nodiscard]] bool wants(std::size_t avatar) const noexcept override;
  void observe(std::size_t avatar, const StreamStep& step,
               const ContactsMessage& answer) noexcept override;

  // By the one who watches.
  [[nodiscard]] std::size_t numAvatars() const { return numAvatars_; }
  /// From now on every step is wanted, or none.
  void watch(bool isWatched);
  /// Of each avatar the next step is wanted. Only while nobody watches.
  void sample();
  /// What has been answered since the last take, in `batch`; false where nothing has, or where it
  /// is not yet time (it is kept). `nowUs` is any clock that never goes back.
  [[nodiscard]] bool take(std::size_t avatar, std::int64_t nowUs, StepBatch& batch);
  /// Steps that found no memory.
  [[nodiscard]] std::uint64_t numFailed() const;

 private:
  struct Box;
  std::size_t numAvatars_ = 0;
  std::unique_ptr<Box[]> boxes_;
};

}  // namespace foretouch
