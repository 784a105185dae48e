// tools/replay/followed_touches.h: the touches of a replay that is followed: from enter to leave,
// both proven, each with what the steps' answers say about it.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/replay/results_writer.h"
#include "tools/replay/step_follower.h"
#include "tools/reported_contact.h"
#include "tools/touches/ground.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

class FollowedTouches {
 public:
  /// `inputs` must outlive it.
  FollowedTouches(const ReplayInputs& inputs, StepFollower follower);

  /// Steps in order. Appends the contacts that begin touches, and the touches that ended.
  [[nodiscard]] Result<Done> add(const StepAnswer& answer, std::vector<ReportedContact>& begun,
                                 std::vector<Touch>& ended);
  /// Call after the last step: nothing is known of what follows it.
  [[nodiscard]] Result<Done> finish(std::vector<ReportedContact>& begun, std::vector<Touch>& ended);

 private:
  /// A contact of a step's answer.
  struct Row {
    LinkContact contact;
    LinkId other = -1;
    ObjectId object = -1;
    std::int64_t step = 0;
    bool isGround = false, isMissed = false;

    [[nodiscard]] double at() const { return static_cast<double>(step) + contact.toi; }
  };
  /// A touch that has not ended, or about which not all is counted that the steps say.
  struct Live {
    Touch touch;
    LinkContact first;
    ObjectId object = -1;
    double from = 0.0, to = 0.0;  ///< In steps.
    bool isNew = true, isMissed = false, isEnded = false;
  };

  void addRows(const StepAnswer& answer);
  void takeEvents();
  void begin(const WorldEvent& event);
  [[nodiscard]] LinkContact contactOf(const WorldEvent& event) const;
  [[nodiscard]] bool isGround(const LinkContact& contact, std::int64_t step);
  void end(const WorldEvent& event);
  void end(Live& live, const StepInstant& instant, bool isOpen);
  void countRows();
  [[nodiscard]] Live* liveOf(const Row& row);
  static void count(const Row& row, double timeS, Live& live);
  void takeBegun(std::vector<ReportedContact>& begun);
  void takeEnded(std::vector<Touch>& ended);
  [[nodiscard]] double secondsOf(const StepInstant& instant) const;

  const ReplayInputs& inputs_;
  StepFollower follower_;
  GroundTest ground_;
  std::vector<Row> rows_;  // of steps that are not followed yet
  std::vector<Live> live_;
};

}  // namespace foretouch::tools
