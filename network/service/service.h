// network/service/service.h: the service: poses in, one answer for each that is accepted, for any
// number of avatars on any number of threads.
//
// One thread receives: it decodes, and puts what is sound into its avatar's mailbox, where a pose
// too many makes the oldest one go. Workers take the mail, each avatar's in order, answer it and
// publish. Another thread publishes the status. A journal, where there is one, is written by a
// thread of its own. Nothing waits for a disk or for the network: an answer that the system does
// not take is counted, not sent again. An observer, where there is one, is shown each step after
// its answer went out, in the thread that answered it.
//
// Whenever they are taken, counts satisfy: received = answered + rejected + waiting.
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
#include "network/service/journal.h"
#include "network/service/service_counts.h"
#include "network/stream/step_observer.h"
#include "network/stream/stream_solver.h"
#include "network/wire/messages.h"
#include "network/wire/wire.h"

namespace foretouch {

inline constexpr int kMaxServiceWorkers = 256;
inline constexpr std::size_t kMaxServiceQueue = 65536;

struct ServiceOptions {
  int workers = 1;           ///< 1 to kMaxServiceWorkers.
  std::size_t queue = 256;   ///< Poses that an avatar may have waiting; 1 to kMaxServiceQueue.
  std::string suffix;        ///< Of all four channels.
  std::string build, scene;  ///< For the status.
  std::chrono::milliseconds statusEvery{1000};   ///< At least 1.
  std::chrono::milliseconds stuckAfter{10'000};  ///< A thread that has not got on for this long.
  JournalOptions journal;
};

/// What surrounds a service.
struct ServiceParts {
  std::unique_ptr<Receiver> receiver;  ///< Of the channels of receivedChannels().
  std::unique_ptr<Publisher> publisher;
  std::unique_ptr<JournalSink> journal;  ///< None: nothing is recorded.
  const Clock* clock = &systemClock();   ///< Outlives the service.
  StepObserver* observer = nullptr;      ///< Outlives the service; none: nobody looks.
};

/// The channels that a service reads.
[[nodiscard]] std::vector<std::string> receivedChannels(const std::string& suffix);

struct ServiceHealth {
  bool isWell = true;
  std::string text;  ///< "ok" and when the last pose came, or what is wrong; lines.
};

class Service {
 public:
  /// Runs from here on. Errors: no avatar, two of one id, options out of range, a suffix that makes
  /// a channel's name too long, threads that the system does not give.
  static Result<Service> start(std::vector<StreamSolver> avatars, ServiceParts parts,
                               const ServiceOptions& options);
  Service(Service&&) noexcept;
  Service& operator=(Service&&) noexcept;
  ~Service();  ///< As stop().

  /// Receives no more, answers and publishes all that waits, sends a last status and closes the
  /// journal.
  void stop();

  /// As it is published; latencies are those of the last whole second.
  [[nodiscard]] StatusMessage status() const;
  [[nodiscard]] ServiceCounts counts() const;
  /// Of all answers since the start.
  [[nodiscard]] AnswerTimes times() const;
  [[nodiscard]] const ServiceFacts& facts() const;
  [[nodiscard]] ServiceHealth health() const;
  /// What keeps the service from going on: its receiver is gone, or memory has run out.
  [[nodiscard]] std::optional<Error> failure() const;
  /// The last thing that the journal could not do; empty where there is none.
  [[nodiscard]] std::string journalFailure() const;

 private:
  struct Impl;
  explicit Service(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
