#include "tools/stream/listen_command.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "network/wire/codec.h"
#include "network/wire/message_key.h"
#include "network/wire/wire.h"
#include "tools/settings/channel_names.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"
#include "tools/stream/answer_tracker.h"
#include "tools/stream/contacts_line.h"
#include "tools/stream/person_text.h"
#include "tools/stream/pushes_text.h"
#include "tools/stream/solid_text.h"
#include "tools/stream/stop_signal.h"
#include "tools/stream/stream_touches.h"
#include "tools/stream/told_events.h"
#include "tools/stream/touch_lines.h"
#include "tools/world/load_world.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// Bounds the memory: beyond so many avatars, forgets what the known ones touch.
constexpr std::size_t kMostAvatars = 4096;

/// The values of all options.
struct ListenJob {
  std::string url, suffix, keyPath;
  std::optional<MessageKey> key;
  ChannelNames channels;  ///< With the suffix.
  std::string worldPath;  ///< For a moving world, whose events are heard in place of verdicts.
  bool json = false, status = false, each = false;
  int count = 0;                   ///< Ends after so many verdicts; 0: never.
  std::optional<double> timeoutS;  ///< Ends after so long without a verdict.
};

Result<std::unique_ptr<Receiver>> receiverFor(const ListenJob& job) {
  const auto url = parseUdpmUrl(job.url);
  if (!url.ok()) return inFile(url.error(), "--url");
  FORETOUCH_CHECK(testMulticast(url.value()));
  std::vector<std::string> channels{job.channels.solid, job.channels.person, job.channels.pushes};
  if (job.worldPath.empty()) {
    channels.push_back(job.channels.contacts);
  } else {
    channels.insert(channels.end(), {job.channels.events, job.channels.body});
  }
  if (job.status) channels.push_back(job.channels.status);
  auto receiver = openUdpmReceiver(url.value(), channels);
  if (!receiver.ok()) return inFile(receiver.error(), "--url");
  return receiver;
}

/// What a sender's messages are guarded by, each with its avatar.
enum Topic : std::uint8_t {
  kStatusTopic,
  kContactsTopic,
  kSolidTopic,
  kPersonTopic,
  kPushesTopic,
  kEventsTopic,
  kBodyTopic
};
constexpr std::size_t kMostGuards = 4 * kMostAvatars + 1;

/// Prints messages as they arrive, line by line.
class Listener {
 public:
  Listener(const ListenJob& job, std::optional<LoadedWorld> world) : job_(job) {
    if (world) events_ = std::make_unique<ToldEvents>(*std::move(world));
  }

  void take(const WireMessage& message) {
    if (isDone()) return;
    const Reject reject = hear(message);
    if (reject != Reject::None && rejected_++ == 0) {
      printNote(
          fmt::format("{}: a message that cannot be read ({})", message.channel, toString(reject)));
    }
  }
  /// Call when nothing more is heard.
  void end() {
    if (events_ && job_.json) print(events_->summary());
  }

  [[nodiscard]] bool isDone() const { return job_.count > 0 && verdicts_ >= job_.count; }
  [[nodiscard]] bool isSilent() const {
    const std::chrono::duration<double> silence = Clock::now() - heardAt_;
    return job_.timeoutS && silence.count() >= *job_.timeoutS;
  }
  /// False once the output has no reader.
  [[nodiscard]] bool isHeard() const { return isHeard_; }
  [[nodiscard]] std::int64_t verdicts() const { return verdicts_; }
  [[nodiscard]] std::int64_t rejected() const { return rejected_; }

 private:
  [[nodiscard]] Reject hear(const WireMessage& message) {
    const ChannelNames& channels = job_.channels;
    if (message.channel == channels.status) {
      return read(message, status_, kStatusTopic,
                  [this] { print(job_.json ? statusLine(status_) : statusText(status_)); });
    }
    if (message.channel == channels.solid) {
      return read(message, shown_, kSolidTopic, [this] { printSolid(); });
    }
    if (message.channel == channels.person) {
      return read(message, person_, kPersonTopic, [this] { printPerson(); });
    }
    if (message.channel == channels.pushes) {
      return read(message, pushes_, kPushesTopic, [this] { printPushes(); });
    }
    if (!events_) return read(message, contacts_, kContactsTopic, [this] { printContacts(); });
    if (message.channel == channels.body) {
      return read(message, body_, kBodyTopic, [this] { events_->take(body_); });
    }
    return read(message, told_, kEventsTopic, [this] { printEvents(); });
  }
  [[nodiscard]] static std::int32_t avatarOf(const StatusMessage& /*message*/) { return -1; }
  [[nodiscard]] static std::int32_t avatarOf(const EventsMessage& /*message*/) { return -1; }
  [[nodiscard]] static std::int32_t avatarOf(const BodyMessage& message) { return message.body; }
  template <typename Message>
  [[nodiscard]] static std::int32_t avatarOf(const Message& message) {
    return message.avatar;
  }
  template <typename Message, typename Use>
  [[nodiscard]] Reject read(const WireMessage& arrived, Message& message, Topic topic,
                            const Use& use) {
    const Reject reject = read(arrived, message, topic);
    if (reject == Reject::None) use();
    return reject;
  }
  template <typename Message>
  [[nodiscard]] Reject read(const WireMessage& arrived, Message& message, Topic topic) {
    SignedPayload opened{withoutSignature(arrived.payload), 0};
    if (job_.key) {
      const Reject reject = job_.key->open(arrived.channel, arrived.payload, opened);
      if (reject != Reject::None) return reject;
    }
    const Reject reject = decode(opened.content, message);
    if (reject != Reject::None || !job_.key) return reject;
    // Answers of several avatars may overtake one another.
    const std::pair<Topic, std::int32_t> guarded{topic, avatarOf(message)};
    if (guards_.size() >= kMostGuards && guards_.count(guarded) == 0) return Reject::Limit;
    return guards_[guarded].take(opened.sentUtimeUs, arrived.receiveUtimeUs);
  }
  /// An events file begins with its header.
  void printLine(const std::string& line) {
    if (!events_ || verdicts_ > 0) print(line);
  }
  void printSolid() {
    if (job_.json) return printLine(solidLine(shown_, Stamps::With));
    const bool isNews = news_.isNews(shown_);
    if (job_.each || isNews) print(solidText(shown_));
  }
  void printPerson() {
    if (job_.json) return printLine(personStepLine(person_, Stamps::With));
    const bool isNews = personNews_.isNews(person_);
    if (job_.each || isNews) print(personStepText(person_));
  }
  void printPushes() {
    if (job_.json) return printLine(pushesLine(pushes_));
    const bool isNews = pushesNews_.isNews(pushes_);
    if (job_.each || isNews) print(pushesText(pushes_));
  }
  void printEvents() {
    const ToldEvents::Lines lines = events_->take(told_);
    if (lines.missing) printNote(*lines.missing);
    ++verdicts_;
    heardAt_ = Clock::now();
    print(job_.json ? lines.json : lines.text);
  }
  void printContacts() {
    if (const auto missing = tracker_.take(contacts_)) printNote(*missing);
    ++verdicts_;
    heardAt_ = Clock::now();
    if (job_.each && !job_.json) return print(contactsText(contacts_));
    TouchEvents events;
    touchesOf(contacts_.avatar).take(contacts_, {}, events);
    if (!job_.json) return print(touchesText(contacts_, events));
    std::string lines = contactsLine(contacts_, Stamps::With);
    for (const StreamTouch& ended : events.ended) lines += endedTouchLine(ended);
    for (const StreamTouch& begun : events.begun) lines += begunTouchLine(begun);
    print(lines);
  }
  StreamTouches& touchesOf(std::int32_t avatar) {
    if (touches_.size() >= kMostAvatars && touches_.count(avatar) == 0) touches_.clear();
    return touches_[avatar];
  }
  void print(const std::string& lines) {
    if (lines.empty()) return;
    printOut(lines);
    isHeard_ = isHeard_ && outputArrived();
  }

  const ListenJob& job_;
  AnswerTracker tracker_;
  std::map<std::int32_t, StreamTouches> touches_;  // by avatar; bounded by kMostAvatars
  std::map<std::pair<Topic, std::int32_t>, ReplayGuard> guards_;  // by topic and avatar
  ContactsMessage contacts_;
  SolidMessage shown_;
  SolidNews news_;
  PersonMessage person_;
  PersonNews personNews_;
  PushesMessage pushes_;
  PushesNews pushesNews_;
  StatusMessage status_;
  std::unique_ptr<ToldEvents> events_;  // for a moving world, if it is heard
  EventsMessage told_;
  BodyMessage body_;
  Clock::time_point heardAt_ = Clock::now();
  std::int64_t verdicts_ = 0, rejected_ = 0;
  bool isHeard_ = true;
};

Result<ExitCode> listen(const ListenJob& job) {
  constexpr int kWaitMs = 50;  // longest delay in noticing a signal or a timeout
  StopSignal stop;
  bool isStopped = false;
  std::optional<LoadedWorld> world;
  if (!job.worldPath.empty()) {
    FORETOUCH_TRY(auto file, readWorldFile(job.worldPath));
    FORETOUCH_TRY(auto loaded, loadWorld(std::move(file)));
    world.emplace(std::move(loaded));
  }
  FORETOUCH_TRY(const auto receiver, receiverFor(job));
  Listener listener(job, std::move(world));
  std::vector<WireMessage> messages;
  while (!listener.isDone() && !listener.isSilent() && listener.isHeard() && !isStopped) {
    messages.clear();
    FORETOUCH_CHECK(inFile(receiver->receive(messages, kWaitMs), "--url"));
    for (const WireMessage& message : messages) listener.take(message);
    isStopped = stop.wait(std::chrono::milliseconds(0));
  }
  listener.end();
  const std::uint64_t drops = receiver->counts().kernelDrops;
  if (listener.rejected() > 1) {
    printNote(fmt::format("{} messages could not be read", listener.rejected()));
  }
  if (drops > 0) printNote(fmt::format("the system dropped {} datagrams unread", drops));
  if (job.count == 0 || listener.isDone() || isStopped) return ExitCode::Done;
  printError(fmt::format("{} of {} verdicts arrived before {:g} s of silence", listener.verdicts(),
                         job.count, job.timeoutS.value_or(0.0)));
  return ExitCode::CheckSaysNo;
}

ExitCode run(ListenJob job) {
  if (job.each && !job.worldPath.empty()) {
    return failed(Error::in("--each", ErrorCode::Mismatch,
                            "is of verdicts; --world hears the events of a moving world"));
  }
  FORETOUCH_TRY_OR(failed, job.channels, channelNames(job.suffix));
  job.url = urlOrDefault(job.url);
  if (!job.keyPath.empty()) {
    FORETOUCH_TRY_OR(failed, job.key, inFile(MessageKey::read(job.keyPath), "--key"));
  }
  const auto ended = listen(job);
  return ended.ok() ? ended.value() : failed(ended.error());
}

constexpr char kListenExamples[] = R"(Examples:
  foretouch listen
  foretouch listen --each
  foretouch listen --json --status > verdicts.jsonl
  foretouch listen --count 100 --timeout 5
  foretouch listen --world stage.toml --json > events.jsonl

With --world it prints what happens in the moving world of a service (serve --world) in place of
verdicts, and --count and --timeout are about its messages; --json writes an events file.
Of a solid avatar (serve --solid) it also prints where the state of what is shown changes, and of
one in a moving world what moves and presses against it; of a person (serve --bounds) where what they
touched, surely or perhaps, changes. The lines of --json are described in
docs/formats.md. With --count, exit code 1 says that so many verdicts did not come.)";

}  // namespace

Command listenCommand() {
  const auto job = std::make_shared<ListenJob>();
  Settings settings;
  settings.text("--url", "URL", job->url,
                "Network to listen to; by default LCM_DEFAULT_URL, else this machine only");
  addSuffixSetting(settings, job->suffix);
  addKeySetting(settings, job->keyPath,
                "Key of 32 hexadecimal digits: refuse messages that are not signed with it");
  settings
      .path(
          "--world", "FILE", job->worldPath,
          "World file of the service: hear what happens in its moving world, in place of verdicts")
      .files("toml");
  settings.flag("--json", job->json, "Lines of JSON instead of text");
  settings.flag("--each", job->each,
                "One line per verdict instead of one where a touch begins or ends");
  settings.flag("--status", job->status, "The service's heartbeats as well");
  settings
      .whole("--count", "N", job->count, 1, std::numeric_limits<int>::max(),
             "End after so many verdicts")
      .shown = [] { return std::string(); };
  settings.number("--timeout", "S", job->timeoutS, kAboveZero, "",
                  "End after so many seconds without a verdict");
  Command command{"listen",
                  "Print what touches in the verdicts that a service sends, as they arrive",
                  kListenExamples, std::move(settings)};
  command.run = [job](const Settings&) { return run(*job); };
  return command;
}

}  // namespace foretouch::tools
