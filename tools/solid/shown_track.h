// tools/solid/shown_track.h: the shown curve of a solid avatar over a whole clip, for pages and
// pictures: every piece of every way with its place in time, and what it touches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/skeleton.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/reported_contact.h"
#include "tools/solid/solid_player.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

/// A certified motion: from one pose of the track to the next.
struct ShownStep {
  std::uint32_t from = 0, to = 0;
  std::int64_t tick = 0;
};

/// A contact with its push, at the end of a tick.
struct ShownContact : ReportedContact {
  double push = 0.0, slipSpeed = 0.0;
};

struct ShownTouchOf {
  Touch touch;            ///< Its steps are those of the track.
  std::size_t first = 0;  ///< The contact that begins it.
  double mostPush = 0.0;
};

class ShownTrack {
 public:
  /// `inputs` must outlive it.
  explicit ShownTrack(const ReplayInputs& inputs) : inputs_(inputs) {}

  /// Ticks in order.
  void add(const PlayedTick& tick);
  /// Call after the last one: ends the touches that are still open.
  void finish();

  /// Ascending; a tick's way leads to the tick's own time. Two poses without a step between them:
  /// no motion leads from one to the other.
  [[nodiscard]] const std::vector<double>& timesS() const { return timesS_; }
  [[nodiscard]] const std::vector<Pose>& poses() const { return poses_; }
  [[nodiscard]] const std::vector<ShownStep>& steps() const { return steps_; }
  /// One per tick: what was tracked, when, the state, the largest deviation.
  [[nodiscard]] const std::vector<Pose>& tracked() const { return tracked_; }
  [[nodiscard]] const std::vector<double>& tickTimesS() const { return tickTimesS_; }
  [[nodiscard]] const std::vector<SolidState>& states() const { return states_; }
  [[nodiscard]] const std::vector<double>& deviations() const { return deviations_; }
  /// What is shown at each tick: places among poses().
  [[nodiscard]] const std::vector<std::size_t>& shownAtTick() const { return shownAtTick_; }
  /// The strongest for each link with each object, or other link, in each tick, in order of steps.
  [[nodiscard]] const std::vector<ShownContact>& contacts() const { return contacts_; }
  /// The touches in listed order.
  [[nodiscard]] const std::vector<ShownTouchOf>& touches() const { return touches_; }

 private:
  void addPose(double timeS, const Pose& pose, std::int64_t tick, bool isStep);
  void addContacts(const PlayedTick& tick);
  void takeContact(const SolidContact& contact, double timeS, std::vector<ShownContact>& found);

  const ReplayInputs& inputs_;
  std::vector<double> timesS_, tickTimesS_, deviations_;
  std::vector<Pose> poses_, tracked_;
  std::vector<ShownStep> steps_;
  std::vector<SolidState> states_;
  std::vector<std::size_t> shownAtTick_;
  std::vector<ShownContact> contacts_;
  std::vector<ShownTouchOf> touches_, open_;
};

}  // namespace foretouch::tools
