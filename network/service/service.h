// network/service/service.h: the service: poses in, one answer per accepted pose, for any number of
// avatars on any number of threads.
//
// One thread at a time receives: it decodes messages and puts valid ones into their avatar's
// mailbox; when the mailbox is full, the oldest pose is dropped. The other threads take the mail,
// each avatar's in order, answer it and publish; the threads take turns at receiving
// (network/service/mail_room.h). Another thread publishes the status. A separate thread writes the
// journal, if there is one. Nothing waits for a disk or for the network: the service counts an
// answer that the system does not take, and does not send it again. An observer, if there is one,
// sees each step after its answer went out, in the thread that answered it.
// Where an avatar is solid (StreamSolver::makeSolid), its thread shows it after it has sent the
// answer: one solid_t per accepted pose.
// Where something is claimed of an avatar's person (ServiceParts::persons), the thread then says
// what follows: at least one person_t per accepted pose. Where there is a moving world, the thread
// then tells it of the pose, and sends what its solid bodies show, and what happened between
// bodies, as far as that is known; one thread at a time does that.
//
// At every moment: received = answered + rejected + waiting. Not installed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "network/service/clock.h"
#include "network/service/health.h"
#include "network/service/journal.h"
#include "network/service/person_counts.h"
#include "network/service/service_counts.h"
#include "network/service/solid_counts.h"
#include "network/service/world_report.h"
#include "network/stream/person_stream.h"
#include "network/stream/speaker_gate.h"
#include "network/stream/step_observer.h"
#include "network/stream/stream_solver.h"
#include "network/wire/message_key.h"
#include "network/wire/messages.h"
#include "network/wire/wire.h"
#include "network/world_stream/world_solver.h"

namespace foretouch {

inline constexpr int kMaxServiceWorkers = 256;
inline constexpr std::size_t kMaxServiceQueue = 65536;

struct ServiceOptions {
  int workers = 1;           ///< 1 to kMaxServiceWorkers.
  std::size_t queue = 256;   ///< Poses that may wait per avatar; 1 to kMaxServiceQueue.
  std::string suffix;        ///< Ends the names of all channels.
  std::string build, scene;  ///< For the status.
  std::chrono::milliseconds statusEvery{1000};   ///< At least 1.
  std::chrono::milliseconds stuckAfter{10'000};  ///< A thread without progress for this long is
                                                 ///< stuck.
  std::chrono::milliseconds unacceptedAfter{10'000};  ///< Poses that come for so long, and none of
                                                      ///< them accepted, are ill health.
  SpeakerPolicy speaker;
  /// Messages without its signature are refused, and what the service says is signed. None: signed
  /// messages are taken as if they were not.
  std::optional<MessageKey> key;
  JournalOptions journal;
};

/// The environment of a service.
struct ServiceParts {
  std::unique_ptr<Receiver> receiver;  ///< On the channels of receivedChannels().
  std::unique_ptr<Publisher> publisher;
  std::unique_ptr<JournalSink> journal;  ///< None: records nothing.
  const Clock* clock = &systemClock();   ///< Outlives the service.
  StepObserver* observer = nullptr;      ///< Outlives the service; may be none.
  std::optional<WorldSolver> world;      ///< None: no query about what bodies do to each other.
  std::vector<PersonStream> persons;     ///< For some of the avatars, each at most once.
};

/// The channels that a service reads.
[[nodiscard]] std::vector<std::string> receivedChannels(const std::string& suffix,
                                                        bool hasWorld = false);

class Service {
 public:
  /// Starts the service. Errors: no avatar, two with one id, one that is solid by itself and in the
  /// world, a person of no avatar, options out of range, a suffix that makes a channel's name too
  /// long, or the system refuses the threads.
  static Result<Service> start(std::vector<StreamSolver> avatars, ServiceParts parts,
                               const ServiceOptions& options);
  Service(Service&&) noexcept;
  Service& operator=(Service&&) noexcept;
  ~Service();  ///< As stop().

  /// Stops receiving, answers and publishes everything that waits, sends a last status and closes
  /// the journal.
  void stop();

  /// As published; latencies are those of the last whole second.
  [[nodiscard]] StatusMessage status() const;
  [[nodiscard]] ServiceCounts counts() const;
  /// The times of all answers since the start.
  [[nodiscard]] AnswerTimes times() const;
  /// The counts of solid avatars, since the start.
  [[nodiscard]] SolidCounts solidCounts() const;
  /// The counts of persons, since the start.
  [[nodiscard]] PersonCounts personCounts() const;
  /// The report of the moving world; nothing if there is none.
  [[nodiscard]] std::optional<WorldReport> world() const;
  [[nodiscard]] const ServiceFacts& facts() const;
  [[nodiscard]] ServiceHealth health() const;
  /// Why the service cannot continue: its receiver is gone, or memory has run out.
  [[nodiscard]] std::optional<Error> failure() const;
  /// The journal's last failure; empty if there was none.
  [[nodiscard]] std::string journalFailure() const;

 private:
  struct Impl;
  explicit Service(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
