#include "network/service/service.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <unordered_map>
#include <utility>

#include "network/service/mail_room.h"
#include "network/service/message_seal.h"
#include "network/service/service_channels.h"
#include "network/service/service_health.h"
#include "network/service/service_status.h"
#include "network/service/stream_desk.h"
#include "network/service/thread_beat.h"
#include "network/service/world_desk.h"

namespace foretouch {
namespace {

using std::chrono::milliseconds;

/// Notices a stop after this long.
constexpr int kReceiveWaitMs = 100;
/// Idle threads and the status thread signal this often that they run.
constexpr milliseconds kBeatEvery{500};

/// `world`: null if there is none.
std::optional<Error> problemOf(const std::vector<StreamSolver>& avatars, const WorldSolver* world,
                               const ServiceOptions& options) {
  const auto refused = [](ErrorCode code, const std::string& message) {
    return Error::of(code, message);
  };
  if (avatars.empty()) return refused(ErrorCode::Empty, "expected at least one avatar");
  for (const StreamSolver& avatar : avatars) {
    if (avatar.solid() == nullptr || world == nullptr || !world->isSolid(avatar.id())) continue;
    return refused(ErrorCode::Mismatch, "expected avatar " + std::to_string(avatar.id()) +
                                            " to be solid by itself, or in the world");
  }
  if (options.workers < 1 || options.workers > kMaxServiceWorkers) {
    return refused(ErrorCode::OutOfRange, "expected 1 to " + std::to_string(kMaxServiceWorkers) +
                                              " workers, found " + std::to_string(options.workers));
  }
  if (options.queue < 1 || options.queue > kMaxServiceQueue) {
    return refused(ErrorCode::OutOfRange, "expected a queue of 1 to " +
                                              std::to_string(kMaxServiceQueue) + " poses, found " +
                                              std::to_string(options.queue));
  }
  if (options.statusEvery < milliseconds(1)) {
    return refused(ErrorCode::OutOfRange, "expected a status at most every millisecond");
  }
  // FORETOUCH_SKELETON and FORETOUCH_CONTACTS are the longest names.
  if (internal::ServiceChannels(options.suffix).skeleton.size() > kMaxChannelBytes) {
    return refused(ErrorCode::LimitExceeded, "expected a suffix that leaves channel names within " +
                                                 std::to_string(kMaxChannelBytes) +
                                                 " bytes, found " +
                                                 std::to_string(options.suffix.size()) + " bytes");
  }
  return std::nullopt;
}

std::string shortened(std::string text) {
  if (text.size() > kMaxTextBytes) text.resize(kMaxTextBytes);
  return text;
}

}  // namespace

std::vector<std::string> receivedChannels(const std::string& suffix, bool hasWorld) {
  const internal::ServiceChannels channels(suffix);
  std::vector<std::string> received{channels.skeleton, channels.pose};
  if (hasWorld)
    received.insert(received.end(), {kBodyChannel + suffix, kRigidPoseChannel + suffix});
  return received;
}

struct Service::Impl final : internal::Outlet {
  Impl(std::vector<StreamSolver> solvers, ServiceParts surroundings, const ServiceOptions& chosen)
      : options(chosen),
        parts(std::move(surroundings)),
        channels(chosen.suffix),
        room(solvers.size(), chosen.queue, static_cast<std::size_t>(chosen.workers),
             parts.world.has_value()),
        seal(chosen.key, *parts.clock),
        threadBeats(static_cast<std::size_t>(chosen.workers) + (parts.world ? 2 : 1)) {
    facts = {shortened(chosen.build), shortened(chosen.scene), solvers.size(), chosen.workers,
             parts.clock->utimeUs()};
    const internal::StreamSurroundings shared{
        channels, *parts.clock,   *this,
        room,     parts.observer, parts.world ? std::optional(solvers.size()) : std::nullopt,
        counter,  solidCounter,   personCounter};
    streams.reserve(solvers.size());
    for (StreamSolver& solver : solvers) {
      indexOf.emplace(solver.id(), streams.size());
      streams.emplace_back(std::move(solver), chosen.speaker, streams.size(), shared);
    }
    for (PersonStream& person : parts.persons) streams[indexOf.at(person.id())].sayOf(person);
    if (!parts.world) return;
    world.emplace(std::move(*parts.world), chosen.speaker, chosen.suffix, *parts.clock, *this,
                  solidCounter);
    parts.world.reset();
  }

  const ServiceOptions options;
  ServiceParts parts;
  const internal::ServiceChannels channels;
  ServiceFacts facts;
  std::vector<internal::StreamDesk> streams;
  std::unordered_map<std::int32_t, std::size_t> indexOf;  // by an avatar's id: its stream
  MailRoom room;
  internal::MessageSeal seal;
  ServiceCounter counter;
  SolidCounter solidCounter;
  PersonCounter personCounter;
  std::optional<Journal> journal;
  std::optional<internal::WorldDesk> world;  // its mail comes after that of the streams

  mutable std::mutex mutex;  // of the next members
  std::condition_variable stopsNow;
  bool isStatusOver = false;
  std::optional<Error> failure;
  AnswerTimes lastSecond;

  std::atomic<bool> isStopping{false};
  ThreadBeat receiverBeat, statusBeat;  // the receiving thread's; the status thread's
  std::vector<ThreadBeat> threadBeats;
  std::thread statusThread;
  std::vector<std::thread> threads;  // receive and answer, in turns
  std::vector<WireMessage> arrived;  // of the receiving thread

  void fail(Error error) {
    const std::lock_guard lock(mutex);
    if (!failure) failure = std::move(error);
  }

  /// Runs `work`; an exception becomes the service's failure.
  template <typename Work>
  bool guarded(const char* what, const Work& work) {
    try {
      work();
      return true;
    } catch (const std::exception& e) {
      fail({ErrorCode::LimitExceeded, "", -1, -1, std::string(what) + " failed: " + e.what()});
    }
    return false;
  }

  // Receiving and answering, in turns.

  void serve(ThreadBeat& beat) {
    internal::StreamMemory memory;
    auto mail = std::make_unique<Mail>();
    std::size_t index = 0;
    for (;;) {
      const MailRoom::Taken taken = room.takeOrLead(index, mail, kBeatEvery);
      beat.beat();
      if (taken == MailRoom::Taken::Closed) return;
      if (taken == MailRoom::Taken::Lead) lead(mail, beat);
      if (taken != MailRoom::Taken::Mail) continue;
      if (index == streams.size()) {
        guarded("the world", [&] { world->take(*mail); });
      } else if (internal::StreamDesk& stream = streams[index];
                 !guarded("answering", [&] { stream.take(*mail, memory); })) {
        stream.abandon(mail->kind);
      }
      room.finish(index);
    }
  }

  /// Receives until a message has come, or none will come any more.
  void lead(std::unique_ptr<Mail>& mail, ThreadBeat& beat) {
    bool isOver = false;
    const bool done = guarded("receiving", [&] {
      do {
        isOver = receive(mail);
        receiverBeat.beat();
        beat.beat();
      } while (!isOver && arrived.empty());
    });
    room.endLead(isOver || !done);
  }

  /// True if nothing more will come.
  bool receive(std::unique_ptr<Mail>& mail) {
    const bool isLast = isStopping.load();  // still takes what the system holds already
    arrived.clear();
    const auto received = parts.receiver->receive(arrived, isLast ? 0 : kReceiveWaitMs);
    counter.wire(parts.receiver->counts());
    for (WireMessage& message : arrived) sort(message, mail);
    if (!received.ok()) fail(received.error());
    const bool isOver = isLast || !received.ok();
    tellSilence(isOver, mail);
    return isOver;
  }

  /// Posts a silence to those whose persons wait for a pose.
  void tellSilence(bool isOver, std::unique_ptr<Mail>& mail) {
    if (parts.persons.empty()) return;
    const auto now = std::chrono::steady_clock::now();
    for (std::size_t index = 0; index < streams.size(); ++index) {
      if (!streams[index].waitsInVain(now, isOver)) continue;
      mail->kind = MailKind::Silence;
      mail->receiveUtimeUs = parts.clock->utimeUs();
      static_cast<void>(room.post(index, mail));
    }
  }

  void sort(WireMessage& message, std::unique_ptr<Mail>& mail) {
    mail->receiveUtimeUs = message.receiveUtimeUs;
    mail->sender = message.sender;
    mail->sentUtimeUs = 0;
    if (message.channel == channels.pose) {
      counter.receivedPose(message.receiveUtimeUs);
      mail->kind = MailKind::Pose;
      Reject reject = seal.open(message, mail->sentUtimeUs);
      if (reject == Reject::None) reject = decode(message.payload, mail->pose);
      if (reject != Reject::None) return counter.rejectedPose(reject);
      post(mail->pose.avatar, mail->pose.session, message, mail);
    } else if (message.channel == channels.skeleton) {
      counter.receivedSkeleton();
      mail->kind = MailKind::Skeleton;
      Reject reject = seal.open(message, mail->sentUtimeUs);
      if (reject == Reject::None) reject = decode(message.payload, mail->skeleton);
      if (reject != Reject::None) return counter.rejectedSkeleton(reject);
      post(mail->skeleton.avatar, mail->skeleton.session, message, mail);
    } else if (world && message.channel == world->bodyChannel()) {
      mail->kind = MailKind::Body;
      sortWorld(message, mail->body, mail);
    } else if (world && message.channel == world->rigidChannel()) {
      mail->kind = MailKind::RigidPose;
      sortWorld(message, mail->rigid, mail);
    }
  }

  /// Several senders speak of one world: their signatures' times have no order among each other, so
  /// it is their sequences that show what is old.
  template <typename Message>
  void sortWorld(WireMessage& message, Message& into, std::unique_ptr<Mail>& mail) {
    const MailKind kind = mail->kind;
    Reject reason = seal.open(message, mail->sentUtimeUs);
    if (reason == Reject::None) reason = decode(message.payload, into);
    if (reason == Reject::None && seal.isAsked()) {
      reason = ReplayGuard().take(mail->sentUtimeUs, message.receiveUtimeUs);
    }
    if (reason != Reject::None) return world->refused(kind, 1, reason);
    mail->payload.swap(message.payload);
    if (room.post(streams.size(), mail) == MailRoom::Posted::Kept) return;
    world->refused(kind, 1, Reject::Overrun);
  }

  /// What has no chance to be accepted takes no place from what has.
  void post(std::int32_t id, std::int64_t session, WireMessage& message,
            std::unique_ptr<Mail>& mail) {
    const MailKind kind = mail->kind;
    const auto known = indexOf.find(id);
    if (known == indexOf.end()) return reject(kind, Reject::UnknownAvatar);
    const Reject future = sessionFault(session, message.receiveUtimeUs);
    if (future != Reject::None) return reject(kind, future);
    const Reject refusal = streams[known->second].refusal(*mail, seal.isAsked());
    if (refusal != Reject::None) return reject(kind, refusal);
    mail->payload.swap(message.payload);
    switch (room.post(known->second, mail)) {
      case MailRoom::Posted::Kept: return;
      case MailRoom::Posted::Unwanted: return reject(kind, Reject::SkeletonMismatch);
      case MailRoom::Posted::TooEarly: return reject(kind, Reject::UnknownSkeleton);
      default: return reject(kind, Reject::Overrun);
    }
  }

  void reject(MailKind kind, Reject reason) {
    kind == MailKind::Pose ? counter.rejectedPose(reason) : counter.rejectedSkeleton(reason);
  }

  // What goes out.

  void publish(const std::string& channel, Bytes& payload) override {
    const std::size_t size = payload.size();
    seal.sign(channel, payload);
    const bool isSent =
        payload.size() <= kMaxMessageBytes && parts.publisher->publish(channel, payload);
    if (!isSent) counter.failedPublish();
    payload.resize(size);
  }

  void record(std::int64_t utimeUs, const std::string& channel, ByteView payload) override {
    if (journal) journal->add(utimeUs, channel, payload);
  }

  // Status.

  void tell() {
    auto next = std::chrono::steady_clock::now() + options.statusEvery;
    for (;;) {
      bool isLast = false;
      {
        std::unique_lock lock(mutex);
        const auto wakeAt = std::min(next, std::chrono::steady_clock::now() + kBeatEvery);
        isLast = stopsNow.wait_until(lock, wakeAt, [&] { return isStatusOver; });
      }
      statusBeat.beat();
      if (!isLast && std::chrono::steady_clock::now() < next) continue;
      next = std::chrono::steady_clock::now() + options.statusEvery;
      tellOnce();
      if (isLast) return;
    }
  }

  void tellOnce() {
    const AnswerTimes recent = counter.takeRecentTimes();
    {
      const std::lock_guard lock(mutex);
      lastSecond = recent;
    }
    const StatusMessage message = status();
    Bytes payload;
    encode(message, payload);
    publish(channels.status, payload);
    record(message.utimeUs, channels.status, payload);
  }

  [[nodiscard]] StatusMessage status() const {
    const ServiceCounts counts = counter.counts();
    const auto report = worldReport();
    const std::lock_guard lock(mutex);
    return statusOf(facts, counts, lastSecond, parts.clock->utimeUs(),
                    report ? &report->counts : nullptr);
  }

  [[nodiscard]] std::optional<WorldReport> worldReport() const {
    return world ? std::optional(world->report()) : std::nullopt;
  }

  [[nodiscard]] ServiceHealth health() const {
    internal::ServiceState state;
    {
      const std::lock_guard lock(mutex);
      state.failure = failure;
    }
    state.threads = {{"receiving", receiverBeat.idleMs()}, {"the status", statusBeat.idleMs()}};
    for (std::size_t i = 0; i < threadBeats.size(); ++i) {
      state.threads.push_back({"thread " + std::to_string(i), threadBeats[i].idleMs()});
    }
    const ServiceCounts counts = counter.counts();
    state.unacceptedMs = counter.unacceptedMs(options.unacceptedAfter.count());
    state.hasJournal = journal.has_value();
    if (journal) state.journalIdleMs = journal->idleMs();
    if (journal) state.journalFailure = journal->lastFailure();
    state.journalFailures = counts.journalFailures;
    state.lastPoseUtimeUs = counts.lastPoseUtimeUs;
    state.nowUtimeUs = parts.clock->utimeUs();
    if (auto report = worldReport()) {
      state.refusedBodies = report->counts.refusedBodies;
      state.refusedLongest = std::move(report->counts.refusedLongest);
    }
    return internal::healthOf(state, {options.stuckAfter, options.unacceptedAfter});
  }

  // Starting and stopping.

  Result<Done> start() {
    if (parts.journal) {
      auto started = Journal::start(std::move(parts.journal), options.journal,
                                    [this] { counter.failedJournal(); });
      if (!started.ok()) return started.error();
      journal.emplace(std::move(started).value());
    }
    try {
      statusThread = std::thread([this] { guarded("the status", [this] { tell(); }); });
      // One more than the workers: one always receives.
      for (ThreadBeat& beat : threadBeats) {
        threads.emplace_back([this, &beat] {
          // Without this thread there might be no leader: the service ends.
          if (!guarded("a thread", [&] { serve(beat); })) room.endLead(true);
        });
      }
    } catch (const std::system_error& e) {
      return Error::of(ErrorCode::LimitExceeded,
                       std::string("expected more threads than the system gives: ") + e.what());
    }
    return Done{};
  }

  void stop() {
    isStopping = true;
    if (!threads.empty()) room.waitForLastLead();
    room.close();
    for (std::thread& thread : threads) {
      if (thread.joinable()) thread.join();
    }
    {
      const std::lock_guard lock(mutex);
      isStatusOver = true;
      stopsNow.notify_all();
    }
    if (statusThread.joinable()) statusThread.join();
    if (journal) journal->close();
  }
};

Service::Service(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Service::Service(Service&&) noexcept = default;
Service& Service::operator=(Service&& other) noexcept {
  if (this != &other) {
    if (impl_) impl_->stop();
    impl_ = std::move(other.impl_);
  }
  return *this;
}
Service::~Service() {
  if (impl_) impl_->stop();
}

Result<Service> Service::start(std::vector<StreamSolver> avatars, ServiceParts parts,
                               const ServiceOptions& options) {
  const WorldSolver* const world = parts.world ? &*parts.world : nullptr;
  if (const auto problem = problemOf(avatars, world, options)) return *problem;
  std::set<std::int32_t> without;  // of whose persons nothing is claimed
  for (const StreamSolver& avatar : avatars) without.insert(avatar.id());
  for (const PersonStream& person : parts.persons) {
    if (without.erase(person.id()) == 1) continue;
    return Error::of(ErrorCode::Mismatch, "expected one person of avatar " +
                                              std::to_string(person.id()) + ", which is served");
  }
  const std::size_t numAvatars = avatars.size();
  auto impl = std::make_unique<Impl>(std::move(avatars), std::move(parts), options);
  if (impl->indexOf.size() != numAvatars) {
    return Error::of(ErrorCode::DuplicateName, "expected avatars of different ids");
  }
  const auto started = impl->start();
  if (!started.ok()) {
    impl->stop();
    return started.error();
  }
  return Service(std::move(impl));
}

void Service::stop() {
  impl_->stop();
}

StatusMessage Service::status() const {
  return impl_->status();
}

ServiceCounts Service::counts() const {
  return impl_->counter.counts();
}

AnswerTimes Service::times() const {
  return impl_->counter.times();
}

SolidCounts Service::solidCounts() const {
  return impl_->solidCounter.counts();
}

PersonCounts Service::personCounts() const {
  return impl_->personCounter.counts();
}

std::optional<WorldReport> Service::world() const {
  return impl_->worldReport();
}

const ServiceFacts& Service::facts() const {
  return impl_->facts;
}

ServiceHealth Service::health() const {
  return impl_->health();
}

std::optional<Error> Service::failure() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->failure;
}

std::string Service::journalFailure() const {
  return impl_->journal ? impl_->journal->lastFailure() : std::string();
}

}  // namespace foretouch
