// tools/replay/summary.h: the summary at the end of a replay, for people.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lss/index.h"
#include "middleware/query/query.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/replay/replay_touches.h"
#include "tools/replay/step_solver.h"
#include "tools/replay/touch_words.h"

namespace foretouch::tools {

/// Collects steps and summarises them. Keeps one float per step and a few numbers per link.
class ReplaySummary {
 public:
  /// `inputs` must outlive it.
  explicit ReplaySummary(const ReplayInputs& inputs);

  void add(const ReplayedStep& step);
  /// The touches of all steps, after the last one.
  void add(const ReplayTouches& touches);

  /// `threads` shared the machine during the measurements.
  [[nodiscard]] std::string text(int threads) const;

  /// Contacts that a check of the poses misses: the earliest of each of the first kKeptMissed steps
  /// that have one.
  [[nodiscard]] const std::vector<ReportedContact>& firstMissed() const { return firstMissed_; }
  static constexpr std::size_t kKeptMissed = 5;

  [[nodiscard]] const ReplayInputs& inputs() const { return inputs_; }
  struct Counts {
    std::int64_t contacts = 0, missedByPoses = 0, startsInContact = 0, undecided = 0;
  };
  [[nodiscard]] const TouchCounts& touches() const { return touches_; }
  /// The touchHeadline() of the touches.
  [[nodiscard]] std::string headline() const { return touchHeadline(inputs_, touches_); }
  /// Contacts as the steps have them, one per link and step.
  [[nodiscard]] const Counts& total() const { return total_; }
  [[nodiscard]] const Counts& ofLink(LinkId link) const { return ofLink_[slotOf(link)]; }
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  /// Counts of own links, where they were asked; does not count what the poses miss.
  [[nodiscard]] const Counts& totalOfPairs() const { return pairs_; }
  /// The same for every link with every object, where they were asked one by one.
  [[nodiscard]] const Counts& totalOfObjects() const { return objects_; }
  /// Of the own links, the pairs that start in contact in nearly every step.
  [[nodiscard]] std::vector<StartingPair> startingPairs() const;
  [[nodiscard]] std::int64_t stepsWithPairs() const { return stepsWithPairs_; }
  [[nodiscard]] std::int64_t stepsWithContact() const { return stepsWithContact_; }
  /// The latency within which this share of the steps was answered.
  [[nodiscard]] double latencyUs(double share) const;

 private:
  /// Bounds on the depth of the deepest start in contact (m), as far as they are known.
  struct Deepest {
    double atLeast = 0.0, atMost = 0.0;
  };

  void count(const LinkContact& contact);
  void countObjects(const StepAnswer& answer);
  void countPairs(const StepAnswer& answer);
  [[nodiscard]] std::string head(int threads) const;
  [[nodiscard]] std::string verdicts() const;
  [[nodiscard]] std::string byLink() const;
  [[nodiscard]] std::string byObject() const;
  [[nodiscard]] std::string ownPairs() const;
  [[nodiscard]] std::string deepestOf(const std::pair<LinkId, LinkId>& pair) const;
  [[nodiscard]] std::string cost() const;

  const ReplayInputs& inputs_;
  std::int64_t steps_ = 0, stepsWithContact_ = 0, stepsWithPairs_ = 0;
  Counts total_, objects_, pairs_;
  std::map<std::pair<LinkId, ObjectId>, Counts> ofObject_;
  std::map<std::pair<LinkId, LinkId>, Counts> ofPair_;
  std::map<std::pair<LinkId, LinkId>, Deepest> deepest_;  // of those that start in contact
  std::vector<Counts> ofLink_;
  TouchCounts touches_;
  std::vector<LinkTouches> touchesOfLink_;
  std::vector<ReportedContact> firstMissed_;
  QueryCounters work_;
  std::vector<float> latenciesUs_;
};

}  // namespace foretouch::tools
