// network/service/world_desk.h: a service's moving world: one thread at a time tells it what was
// accepted, records that in the order in which it was told, and sends what happened. Not installed.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "network/service/clock.h"
#include "network/service/held_records.h"
#include "network/service/mail_room.h"
#include "network/service/world_report.h"
#include "network/stream/bound_stream.h"
#include "network/world_stream/bound_world.h"

namespace foretouch::internal {

class WorldDesk final : WorldRecord {
 public:
  WorldDesk(WorldSolver solver, const SpeakerPolicy& policy, const std::string& suffix,
            const Clock& clock, Outlet& outlet);

  /// A message about bodies.
  void take(Mail& mail);
  /// Refused before it came here: not decodable, or pushed out.
  void refused(MailKind kind, std::size_t poses, Reject reason);
  /// Records `held`, which an avatar's stream said, and then tells the world of the step that its
  /// pose ended, if it was accepted.
  void take(HeldRecords& held, BodyNumber avatar, const StreamStep* step,
            std::int64_t receiveUtimeUs);

  [[nodiscard]] WorldReport report() const;
  [[nodiscard]] const std::string& bodyChannel() const { return bodyChannel_; }
  [[nodiscard]] const std::string& rigidChannel() const { return rigidChannel_; }

 private:
  void speaker(const SpeakerMessage& message) override;
  void body(ByteView payload, std::int64_t receiveUtimeUs) override;
  void rigidPose(ByteView payload, std::int64_t receiveUtimeUs) override;
  void advance(std::int64_t receiveUtimeUs);

  const std::string bodyChannel_, rigidChannel_, eventsChannel_, speakerChannel_;
  const Clock& clock_;
  Outlet& outlet_;
  mutable std::mutex mutex_;  // of the next members
  BoundWorld world_;
  std::vector<EventsMessage> answers_;
  Bytes payload_;
  WorldTimes times_;
};

}  // namespace foretouch::internal
