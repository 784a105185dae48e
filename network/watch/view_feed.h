// network/watch/view_feed.h: passes steps from the answering threads to the thread that shows them.
// Each avatar has a box with one batch of steps. An answering thread takes the batch out, adds a
// step and puts it back; the watching thread takes it away. Neither waits for the other, and no
// contact is lost between them (except beyond kMaxBatchContacts, counted).
//
// While nobody watches a step costs one atomic load, and sample() asks for one step now and then,
// so that a new viewer sees something at once. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "network/stream/step_batch.h"
#include "network/stream/step_observer.h"

namespace foretouch {

/// An avatar's batches per second, at most, on average.
inline constexpr int kMaxShownStepsPerS = 30;

/// Passes kMaxShownStepsPerS per second on average, and two at once after a pause.
class ShowPace {
 public:
  /// Whether one may pass at `nowUs`, which never goes back; true counts it as passed.
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

  // For the answering threads.
  [[nodiscard]] bool wants(std::size_t avatar) const noexcept override;
  void observe(std::size_t avatar, const StreamStep& step, const ContactsMessage& answer,
               const ShownStep* shown, const PersonStream* person) noexcept override;

  // For the watching thread.
  [[nodiscard]] std::size_t numAvatars() const { return numAvatars_; }
  /// From now on wants every step, or none.
  void watch(bool isWatched);
  /// Wants each avatar's next step. Only while nobody watches.
  void sample();
  /// Moves the steps answered since the last take into `batch`; false if there are none, or if it
  /// is too early (then it keeps them). `nowUs`: any clock that never goes back.
  [[nodiscard]] bool take(std::size_t avatar, std::int64_t nowUs, StepBatch& batch);
  /// Steps lost for lack of memory.
  [[nodiscard]] std::uint64_t numFailed() const;

 private:
  struct Box;
  std::size_t numAvatars_ = 0;
  std::unique_ptr<Box[]> boxes_;
};

}  // namespace foretouch
