// network/service/stream_desk.h: one avatar's stream in a service: answers its poses, shows them
// where it is solid, and says what follows for its person; the journal and the world hear of all
// of it. Not installed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "network/service/clock.h"
#include "network/service/held_records.h"
#include "network/service/mail_room.h"
#include "network/service/person_counts.h"
#include "network/service/service_channels.h"
#include "network/service/service_counts.h"
#include "network/service/solid_counts.h"
#include "network/stream/bound_stream.h"
#include "network/stream/person_stream.h"
#include "network/stream/step_observer.h"
#include "network/wire/message_key.h"

namespace foretouch::internal {

/// What a service's streams share. Outlives them.
struct StreamSurroundings {
  const ServiceChannels& channels;
  const Clock& clock;
  Outlet& outlet;
  MailRoom& room;
  StepObserver* observer;               ///< May be none.
  std::optional<std::size_t> worldBox;  ///< In the room; none: nothing else moves.
  ServiceCounter& counter;
  SolidCounter& solids;
  PersonCounter& persons;
};

/// One thread's reusable memory.
struct StreamMemory {
  ContactsMessage answer;
  SolidMessage shown;
  Bytes payload;
  HeldRecords held;
  std::unique_ptr<Mail> step = std::make_unique<Mail>();  ///< For the world.
};

class StreamDesk {
 public:
  /// `index`: the number of its box in the room.
  StreamDesk(StreamSolver solver, const SpeakerPolicy& policy, std::size_t index,
             const StreamSurroundings& surroundings);
  /// `person` is the same avatar's, and outlives this.
  void sayOf(PersonStream& person) { person_ = &person; }

  // For the receiving thread.
  /// Why mail that just came is not for the box; None: it is.
  [[nodiscard]] Reject refusal(const Mail& mail, bool isSigned);
  /// Whether its person waits for a pose that has not come for long, or, if nothing comes any more,
  /// never will. Says so once: a MailKind::Silence then ends the wait.
  [[nodiscard]] bool waitsInVain(std::chrono::steady_clock::time_point now, bool isOver);
  /// Answers the mail. After an exception, see abandon().
  void take(const Mail& mail, StreamMemory& memory);
  /// An exception has left the stream's state unknown: it answers nothing more. Refuses the mail,
  /// unless it is answered already.
  void abandon(MailKind kind);

 private:
  void answer(const Mail& mail, StreamMemory& memory, StreamRecord& record);
  void show(SolidStream& solid, const Mail& mail, StreamMemory& memory);
  void endWait(const Mail& mail, StreamMemory& memory);
  void sayPerson(const Mail& mail, StreamMemory& memory);
  void settle(const Mail& mail, const StreamStep* step, StreamMemory& memory);
  void observe(const StreamMemory& memory);
  void addUp();
  void tellKnown();
  void reject(MailKind kind, Reject reason);
  template <typename Message>
  void send(const Message& message, const std::string& channel, StreamMemory& memory);

  StreamSurroundings service_;
  BoundStream stream_;
  std::size_t index_;
  PersonStream* person_ = nullptr;
  StreamCounts added_;                          // of the solver's counts, what is added up already
  std::vector<std::int64_t> known_, nowKnown_;  // hashes that the room knows of; scratch
  ReplayGuard skeletons_, poses_;               // of the receiving thread, as the next member
  std::optional<std::chrono::steady_clock::time_point> posedAt_;  // the last pose that waits
  bool isCounted_ = false;                      // the mail at hand
  bool isBroken_ = false;
};

}  // namespace foretouch::internal
