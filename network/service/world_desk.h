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
#include "network/service/world_report.h"
#include "network/stream/bound_stream.h"
#include "network/world_stream/bound_world.h"

namespace foretouch::internal {

/// Where messages of a service go.
class Outlet {
 public:
  virtual ~Outlet() = default;
  /// Leaves the payload as it was.
  virtual void publish(const std::string& channel, Bytes& payload) = 0;
  virtual void record(std::int64_t utimeUs, const std::string& channel, ByteView payload) = 0;
};

/// What is to be recorded as soon as the world is told of it. Keeps its memory.
class HeldRecords {
 public:
  void add(std::int64_t utimeUs, const std::string& channel, ByteView payload);
  void flush(Outlet& outlet);

 private:
  struct Held {
    std::int64_t utimeUs = 0;
    const std::string* channel = nullptr;
    Bytes payload;
  };
  std::vector<Held> held_;
  std::size_t count_ = 0;
};

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
