// network/service/world_desk.h: a service's moving world: one thread at a time tells it what was
// accepted, records that in the order in which it was told, and sends what happened. Not installed.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "network/service/clock.h"
#include "network/service/mail_room.h"
#include "network/service/solid_counts.h"
#include "network/service/world_report.h"
#include "network/stream/bound_stream.h"
#include "network/world_stream/bound_world.h"

namespace foretouch::internal {

class WorldDesk final : WorldRecord {
 public:
  WorldDesk(WorldSolver solver, const SpeakerPolicy& policy, const std::string& suffix,
            const Clock& clock, Outlet& outlet, SolidCounter& solids);

  /// A message about bodies; or what an avatar's stream said, which is recorded, and the step that
  /// its pose ended.
  void take(Mail& mail);
  /// Counts what was refused before it came here: not decodable, or pushed out.
  void refused(MailKind kind, std::size_t poses, Reject reason);
  /// The report; the last one if the world is busy for longer than a tenth of a second.
  [[nodiscard]] WorldReport report() const;
  [[nodiscard]] const std::string& bodyChannel() const { return bodyChannel_; }
  [[nodiscard]] const std::string& rigidChannel() const { return rigidChannel_; }

 private:
  void speaker(const SpeakerMessage& message) override;
  void body(ByteView payload, std::int64_t receiveUtimeUs) override;
  void rigidPose(ByteView payload, std::int64_t receiveUtimeUs) override;
  [[nodiscard]] Reject tell(Mail& mail);
  void advance(std::int64_t receiveUtimeUs);

  void show(std::int64_t receiveUtimeUs);
  template <typename Message>
  void send(Message& message, const std::string& channel, std::int64_t receiveUtimeUs);

  const std::string bodyChannel_, rigidChannel_, eventsChannel_, speakerChannel_, solidChannel_,
      pushesChannel_;
  const Clock& clock_;
  Outlet& outlet_;
  SolidCounter& solids_;
  mutable std::mutex mutex_;  // for the next members, but the last two
  BoundWorld world_;
  std::vector<EventsMessage> answers_;
  Bytes payload_;
  WorldTimes times_;
  mutable std::mutex reportMutex_;  // for the next member
  mutable WorldReport lastReport_;
};

}  // namespace foretouch::internal
