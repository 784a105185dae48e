// network/stream/step_batch.h: answered steps of one avatar, collected for viewers: the newest in
// full, and from every step all links that were not clear. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/skeleton.h"
#include "middleware/bracket/bracket.h"
#include "network/stream/avatar_stream.h"
#include "network/stream/step_observer.h"
#include "network/wire/messages.h"

namespace foretouch {

/// Contacts in a batch; counts those beyond.
inline constexpr std::size_t kMaxBatchContacts = 4096;

/// A step of a batch, and where its contacts end in StepBatch::contacts().
struct BatchedStep {
  std::int64_t sequence = 0;  ///< That of the pose that ends the step.
  std::int64_t utimeFromUs = 0, utimeToUs = 0;
  std::size_t endOfContacts = 0;
};

/// What a solid avatar showed in a step.
struct WatchedSolid {
  Pose from, to;
  SolidState state = SolidState::Placing;
  SolidLimit limit = SolidLimit::None;
  bool isCertified = false;
  double deviation = 0.0, lift = 0.0, clearance = 0.0;
  std::int64_t snapInUs = -1;
};

/// What a person surely touched, or may have touched, in a step.
struct WatchedBracket {
  LinkBracket bracket;
  std::int64_t utimeFromUs = 0, utimeToUs = 0;
};

struct WatchedStep {
  Pose from, to;  ///< Parent-relative, of the avatar's joints.
  StepKind kind = StepKind::First;
  std::int64_t sequence = 0, lost = 0;
  std::int64_t utimeFromUs = 0, utimeToUs = 0;
  double queryUs = 0.0;
  double addedUs = 0.0;  ///< From receiving the pose to publishing its answer, less the query.
  bool isSolid = false;  ///< `solid` counts.
  WatchedSolid solid;
};

class StepBatch {
 public:
  /// Adds a step after the others, as StepObserver::observe() has it.
  void add(const StreamStep& step, const ContactsMessage& answer, const ShownStep* shown,
           const PersonStream* person);
  /// Keeps its memory.
  void clear();

  [[nodiscard]] std::uint64_t numSteps() const { return numSteps_; }
  /// Precondition: numSteps() > 0.
  [[nodiscard]] const WatchedStep& newest() const { return newest_; }
  /// Links that are not clear, step by step, a step's earliest first.
  [[nodiscard]] const std::vector<LinkContact>& contacts() const { return contacts_; }
  /// The steps that have any of these, in order.
  [[nodiscard]] const std::vector<BatchedStep>& touchingSteps() const { return touchingSteps_; }
  /// What the person touched, step by step; none beyond kMaxBatchContacts.
  [[nodiscard]] const std::vector<WatchedBracket>& brackets() const { return brackets_; }
  /// Contacts beyond kMaxBatchContacts.
  [[nodiscard]] std::uint64_t numLeftOut() const { return numLeftOut_; }

 private:
  WatchedStep newest_;
  std::vector<LinkContact> contacts_;
  std::vector<BatchedStep> touchingSteps_;
  std::vector<WatchedBracket> brackets_;
  std::uint64_t numSteps_ = 0, numLeftOut_ = 0;
};

}  // namespace foretouch
