// network/world_stream/world_roster.h: the bodies of a live world: which messages about them are
// accepted, how far all that is waited for is known, and which are gone. Not installed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "articulated/result.h"
#include "network/stream/avatar_stream.h"
#include "network/wire/world_messages.h"
#include "network/world_stream/live_world.h"
#include "network/world_stream/world_counts.h"
#include "network/world_stream/world_setup.h"

namespace foretouch::internal {

class WorldRoster {
 public:
  WorldRoster(const WorldSetup& setup, const WorldPolicy& policy);

  [[nodiscard]] Reject take(const BodyMessage& message, std::int64_t receiveUtimeUs);
  [[nodiscard]] Reject take(const RigidPoseMessage& message, std::int64_t receiveUtimeUs);
  [[nodiscard]] Reject take(BodyNumber avatar, const StreamStep& step, std::int64_t receiveUtimeUs);
  void changeSpeaker(BodyNumber body);
  /// As WorldSolver's.
  [[nodiscard]] const std::vector<Reject>& reasons() const { return reasons_; }

  /// How far all that is waited for is known; nothing if no body is there.
  [[nodiscard]] std::optional<std::int64_t> watermark();
  /// All before is answered: later messages about it are late. Nothing: the timeline begins anew.
  void answered(std::optional<std::int64_t> utimeUs);
  /// Whether the service's clock was set back so far that the timeline must begin anew.
  [[nodiscard]] bool isSetBack() const { return isSetBack_; }
  /// Forgets what is not there any more in the world: places, and what was told.
  void beginAnew(std::int64_t fromUs, bool keepsBodies);
  void erase(BodyNumber body) { bodies_.erase(body); }

  [[nodiscard]] LiveBodies& bodies() { return bodies_; }
  [[nodiscard]] const LiveBodies& bodies() const { return bodies_; }
  [[nodiscard]] bool isWaitedFor(const LiveBody& body) const;
  [[nodiscard]] WorldCounts& counts() { return counts_; }
  [[nodiscard]] const WorldCounts& counts() const { return counts_; }
  [[nodiscard]] BodyNumber waitsFor() const { return waitsFor_; }
  [[nodiscard]] const RefusedBodies& refusedBodies() const { return refused_; }
  /// Counts it, unless it is None.
  [[nodiscard]] Reject refusePose(BodyNumber body, Reject reason, std::int64_t receiveUtimeUs);
  /// As WorldSolver's.
  [[nodiscard]] bool isNoted() const { return isNoted_; }

 private:
  [[nodiscard]] Reject refuse(Reject reason);
  [[nodiscard]] Reject whyNot(const BodyMessage& message) const;
  [[nodiscard]] Reject carrierFaultOf(const BodyMessage& message) const;
  [[nodiscard]] std::int64_t earliestChangeUs() const;
  [[nodiscard]] Reject timeFault(LiveBody& body, std::int64_t utimeUs, std::int64_t receiveUtimeUs);
  [[nodiscard]] Reject take(LiveBody& body, const BodyPose& told, const RigidPoseMessage& message,
                            std::int64_t receiveUtimeUs);
  void change(LiveBody& body, const BodyMessage& message);
  void keep(LiveBody& body, LiveKnot knot, bool isGap, std::int64_t receiveUtimeUs);
  void received(std::int64_t receiveUtimeUs);
  void forgetSilent();
  [[nodiscard]] bool isBack(const LiveBody& body) const;
  void noteSilence(std::int64_t utimeUs);

  const WorldSetup& setup_;
  const WorldPolicy policy_;
  LiveBodies bodies_;
  std::unordered_map<std::string, std::size_t> shapeOf_;
  std::vector<std::int64_t> hashes_;  // of shapes
  std::optional<std::int64_t> answeredUs_;
  std::int64_t nowUs_ = 0;  // the newest receipt of an accepted message
  bool isSetBack_ = false;
  BodyNumber waitsFor_ = kNoBody;
  WorldCounts counts_;
  std::vector<Reject> reasons_;
  RefusedBodies refused_;
  bool isNoted_ = false;
};

}  // namespace foretouch::internal
