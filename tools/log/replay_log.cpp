#include "tools/log/replay_log.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "lss/index.h"
#include "tools/console.h"
#include "tools/json_line.h"
#include "tools/replay/results_writer.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"
#include "tools/stream/stream_person.h"
#include "tools/stream/stream_solid.h"

namespace foretouch::tools {
namespace {

/// Counts up to this many other avatars one by one.
constexpr std::size_t kMaxOthers = 1024;

Result<std::vector<StreamSolver>> solversFor(const LogReplayInputs& inputs) {
  std::vector<StreamSolver> solvers;
  for (std::size_t i = 0; i < inputs.avatars.size(); ++i) {
    const std::string& path = inputs.request.avatars[i].path;
    FORETOUCH_TRY(auto options,
                  queryOptionsFor(inputs.request.world, path, inputs.avatars[i], inputs.scene));
    FORETOUCH_TRY(auto solver,
                  inFile(StreamSolver::make(inputs.request.avatars[i].id, inputs.avatars[i],
                                            inputs.scene, options, inputs.request.policy),
                         path));
    if (!inputs.request.avatars[i].isSolidInWorld) {
      FORETOUCH_CHECK(makeSolid(inputs.request.solid, path, solver));
    }
    solvers.push_back(std::move(solver));
  }
  return solvers;
}

/// Which answers a log has at all. Only then do those of the replay wait for them.
struct HeldAnswers {
  bool contacts = false, solids = false, persons = false, events = false;
};

/// Reads no further than it must.
Result<HeldAnswers> answersIn(const std::string& path, const ChannelNames& channels,
                              const HeldAnswers& wanted) {
  FORETOUCH_TRY(auto log, EventLogReader::open(path));
  LogEvent event;
  HeldAnswers held;
  while (!held.contacts || (wanted.solids && !held.solids) || (wanted.persons && !held.persons) ||
         (wanted.events && !held.events)) {
    FORETOUCH_TRY(const auto more, log.next(event));
    if (!more) break;
    held.contacts = held.contacts || event.channel == channels.contacts;
    held.solids = held.solids || event.channel == channels.solid;
    held.persons = held.persons || event.channel == channels.person;
    held.events = held.events || event.channel == channels.events;
  }
  return held;
}

/// What decides the shown poses; nothing if there are none.
void writeSolidFields(const StreamSolidRequest& request, JsonWriter& out) {
  if (!request.solid.isAsked) return;
  const SolidOptions& options = request.solid.options;
  writeObject("solid", out, [&] {
    out.field("skin", options.skin);
    out.field("catch_up", options.catchUp);
    out.field("floor", toString(options.floor));
    out.field("snap", options.maySnap);
    out.field("around", options.aroundPerTick);
    out.field("self", request.stopsItself);
    out.field("budget_us", request.budgetUs);
  });
}

/// What decides what is known of persons; nothing if it is not asked.
void writePersonFields(const PersonRequest& request, JsonWriter& out) {
  if (!request.isAsked()) return;
  writeObject("person", out, [&] {
    writeFileName("bounds", request.boundsPath, out);
    out.field("between", toString(request.model));
    out.field("ahead_us", request.aheadUs);
  });
}

/// One replay: the events of a log, one by one.
class LogReplay {
 public:
  LogReplay(const LogReplayInputs& inputs, std::vector<StreamSolver> solvers,
            std::vector<PersonStream> persons, HeldAnswers compares, ReplayedWorld* world)
      : inputs_(inputs),
        solvers_(std::move(solvers)),
        persons_(std::move(persons)),
        compares_(compares),
        world_(world) {
    if (world_ != nullptr) world_->compare(compares.events);
    for (std::size_t i = 0; i < solvers_.size(); ++i) indexOf_[solvers_[i].id()] = i;
  }

  /// The index of the avatar whose pose was answered, the answer then being answer().
  std::optional<std::size_t> take(const LogEvent& event) {
    if (event.channel == inputs_.channels.pose) return takePose(event);
    if (event.channel == inputs_.channels.skeleton) takeSkeleton(event);
    if (event.channel == inputs_.channels.contacts) takeRecorded(event);
    if (event.channel == inputs_.channels.solid &&
        (world_ == nullptr || !world_->takeShown(event))) {
      takeRecordedSolid(event);
    }
    if (event.channel == inputs_.channels.person) takeRecordedPerson(event);
    if (event.channel == inputs_.channels.speaker) takeSpeaker(event);
    if (world_ != nullptr) {
      world_->take(event, inputs_.channels);
    } else if (event.channel == inputs_.channels.events) {
      ++report_.eventsNotAsked;
    }
    return std::nullopt;
  }
  [[nodiscard]] const ContactsMessage& answer() const { return answer_; }
  /// What is shown at the same pose; null: the avatar is not solid.
  [[nodiscard]] const SolidMessage* shown(std::size_t avatar) const {
    return solvers_[avatar].solid() == nullptr ? nullptr : &shown_;
  }
  /// What is known of the person; null: it is not asked.
  [[nodiscard]] const PersonStream* person(std::size_t avatar) const {
    return persons_.empty() ? nullptr : &persons_[avatar];
  }
  [[nodiscard]] const StreamSolver& solver(std::size_t avatar) const { return solvers_[avatar]; }

  LogReplayReport finish(const LogCounts& log) {
    report_.log = log;
    for (std::size_t i = 0; i < solvers_.size(); ++i) {
      auto remark = remarkOnMeshes(solvers_[i].options(), inputs_.request.avatars[i].path);
      if (remark) report_.remarks.push_back(std::move(*remark));
    }
    if (!compares_.persons)
      std::for_each(persons_.begin(), persons_.end(), [this](auto& person) { endWait(person); });
    if (log.isTruncated || log.tailEvents > 0) closeAtEnd();
    for (const StreamSolver& solver : solvers_) {
      const StreamCounts& counts = solver.counts();
      report_.lost += static_cast<std::int64_t>(counts.lost);
      report_.gaps += static_cast<std::int64_t>(counts.gaps);
      report_.timelines += static_cast<std::int64_t>(counts.timelines);
      for (std::size_t i = 0; i < kNumRejects; ++i) report_.rejects[i] += counts.rejects[i];
    }
    return std::move(report_);
  }

 private:
  void closeAtEnd() {
    report_.journal.endIsOpen();
    report_.solids.endIsOpen();
    report_.persons.endIsOpen();
    if (world_ != nullptr) world_->endIsOpen();
  }

  void reject(Reject reason) { ++report_.rejects[slotOf(reason)]; }

  StreamSolver* solverOf(std::int32_t avatar) {
    const auto found = indexOf_.find(avatar);
    return found == indexOf_.end() ? nullptr : &solvers_[found->second];
  }

  std::optional<std::size_t> takePose(const LogEvent& event) {
    const Reject unreadable = decode(event.payload, pose_);
    if (unreadable != Reject::None) {
      ++report_.poses;
      reject(unreadable);
      return std::nullopt;
    }
    StreamSolver* const solver = solverOf(pose_.avatar);
    if (solver == nullptr) {
      if (report_.others.size() < kMaxOthers || report_.others.count(pose_.avatar) > 0) {
        ++report_.others[pose_.avatar];
      }
      return std::nullopt;
    }
    ++report_.poses;
    if (solver->take(pose_, answer_) != Reject::None) return std::nullopt;  // counted by the stream
    ++report_.answers;
    if (compares_.contacts) {
      encode(answer_, payload_);
      report_.journal.addReplayed(answer_, payload_);
    }
    if (world_ != nullptr) world_->take(pose_.avatar, solver->lastStep(), event.utimeUs);
    if (solver->solid() != nullptr) show(*solver);
    const std::size_t index = indexOf_.at(pose_.avatar);
    if (!persons_.empty()) sayPerson(persons_[index], solver->lastStep());
    return index;
  }

  void sayPerson(PersonStream& person, const StreamStep& step) {
    person.follow(step);
    addSaid(person);
  }

  void endWait(PersonStream& person) {
    person.endWait();
    for (std::size_t i = 0; i < person.numSaid(); ++i) report_.ended.push_back(person.said(i));
    addSaid(person);
  }

  void addSaid(PersonStream& person) {
    for (std::size_t i = 0; i < person.numSaid(); ++i) {
      ++report_.said;
      if (!compares_.persons) continue;
      encode(person.said(i), payload_);
      report_.persons.addReplayed(person.said(i), payload_);
    }
  }

  void show(StreamSolver& solver) {
    solver.solid()->follow(solver.lastStep(), shown_);
    ++report_.shown;
    if (!compares_.solids) return;
    encode(shown_, payload_);
    report_.solids.addReplayed(shown_, payload_);
  }

  void takeSkeleton(const LogEvent& event) {
    const Reject unreadable = decode(event.payload, skeleton_);
    StreamSolver* const solver = unreadable == Reject::None ? solverOf(skeleton_.avatar) : nullptr;
    if (unreadable == Reject::None && solver == nullptr) return;
    ++report_.skeletons;
    if (solver == nullptr) return reject(unreadable);
    static_cast<void>(solver->take(skeleton_));  // counted by the stream
  }

  /// If one is unreadable, a later answer that differs shows it.
  void takeSpeaker(const LogEvent& event) {
    SpeakerMessage message;
    if (decode(event.payload, message) != Reject::None) return;
    StreamSolver* const solver = solverOf(message.avatar);
    if (solver != nullptr) {
      solver->changeSpeaker();
    } else if (world_ != nullptr) {
      world_->changeSpeaker(message.avatar);
    }
  }

  void takeRecorded(const LogEvent& event) {
    if (decode(event.payload, recorded_) != Reject::None) {
      ++report_.unreadableAnswers;
    } else if (solverOf(recorded_.avatar) != nullptr) {
      report_.journal.addRecorded(recorded_, event.payload);
    }
  }

  void takeRecordedSolid(const LogEvent& event) {
    if (!inputs_.request.solid.solid.isAsked) {
      ++report_.solidsNotAsked;
    } else if (decode(event.payload, recordedSolid_) != Reject::None) {
      ++report_.unreadableAnswers;
    } else if (solverOf(recordedSolid_.avatar) != nullptr) {
      report_.solids.addRecorded(recordedSolid_, event.payload);
    }
  }

  void takeRecordedPerson(const LogEvent& event) {
    if (!inputs_.request.person.isAsked()) {
      ++report_.personsNotAsked;
    } else if (decode(event.payload, recordedPerson_) != Reject::None) {
      ++report_.unreadableAnswers;
    } else if (solverOf(recordedPerson_.avatar) != nullptr) {
      // The clock decided when a wait ended, and only the log knows that.
      PersonStream& person = persons_[indexOf_.at(recordedPerson_.avatar)];
      if (person.isEndOfWait(recordedPerson_)) endWait(person);
      report_.persons.addRecorded(recordedPerson_, event.payload);
    }
  }

  const LogReplayInputs& inputs_;
  std::vector<StreamSolver> solvers_;
  std::vector<PersonStream> persons_;
  HeldAnswers compares_;
  ReplayedWorld* world_;
  std::map<std::int32_t, std::size_t> indexOf_;
  LogReplayReport report_;
  SkeletonMessage skeleton_;
  PoseMessage pose_;
  ContactsMessage answer_, recorded_;
  SolidMessage shown_, recordedSolid_;
  PersonMessage recordedPerson_;
  Bytes payload_;
};

}  // namespace

Result<LogReplayInputs> loadLogReplayInputs(const LogReplayRequest& request) {
  FORETOUCH_TRY(auto channels, channelNames(request.suffix));
  std::vector<Avatar> avatars;
  for (const NumberedAvatar& numbered : request.avatars) {
    FORETOUCH_TRY(auto avatar, readAvatarFile(numbered.path));
    avatars.push_back(std::move(avatar));
  }
  FileFrame frame;
  FORETOUCH_TRY(auto scene, loadScene(request.world, frame));
  LogReplayRequest asRead = request;  // for the first line of results
  asRead.world.sceneImport.scale = frame.metresPerUnit;
  asRead.world.sceneImport.up = frame.up;
  return LogReplayInputs{std::move(asRead), std::move(channels), std::move(scene),
                         std::move(avatars)};
}

Result<LogReplayReport> replayLog(const LogReplayInputs& inputs, const AnswerSink& sink,
                                  ReplayedWorld* world) {
  const std::string& path = inputs.request.logPath;
  FORETOUCH_TRY(auto solvers, solversFor(inputs));
  FORETOUCH_TRY(auto persons, makePersons(inputs.request.person, solvers, inputs.scene));
  FORETOUCH_TRY(const auto compares,
                answersIn(path, inputs.channels,
                          {true, inputs.request.solid.solid.isAsked,
                           inputs.request.person.isAsked(), world != nullptr}));
  FORETOUCH_TRY(auto log, EventLogReader::open(path));
  LogReplay replay(inputs, std::move(solvers), std::move(persons), compares, world);
  LogEvent event;
  for (;;) {
    FORETOUCH_TRY(const auto more, log.next(event));
    if (!more) break;
    const auto avatar = replay.take(event);
    if (!avatar) continue;
    const StreamSolver& solver = replay.solver(*avatar);
    if (!sink({replay.answer(), replay.shown(*avatar), replay.person(*avatar), *avatar,
               solver.lastStep(), solver.options(), log.position(), log.size()})) {
      break;
    }
  }
  return replay.finish(log.counts());
}

std::string logHeaderLine(const LogReplayInputs& inputs) {
  LogReplayRequest request = inputs.request;
  Settings settings;
  addSceneSettings(settings, request.world);
  addSuffixSetting(settings, request.suffix);
  addQuerySettings(settings, request.world);
  addReplayQuerySettings(settings, request.world);
  addTouchSettings(settings, request.world);
  addStreamSettings(settings, request.policy);
  std::string text;
  JsonWriter out(text);
  beginResults(out);
  writeHeaderField(settings, "scene", out);
  writeFileName("motion", request.logPath, out);
  writeHeaderFields(settings,
                    {"suffix", "tolerance", "fidelity", "policy", "leaves", "skin", "skin_scale",
                     "skin_up", "scene_scale", "up", "ignore"},
                    out);
  writeHeaderField(settings, "budget_us", out);  // also if there is none
  writeHeaderFields(
      settings,
      {"max_step", "confirmations", "unmatched_at_rest", "ground", "ground_angle", "ground_height"},
      out);
  writeSolidFields(request.solid, out);
  writePersonFields(request.person, out);
  out.key("avatars");
  out.beginArray();
  for (std::size_t i = 0; i < inputs.avatars.size(); ++i) {
    out.beginObject();
    out.field("id", request.avatars[i].id);
    writeFileName("avatar", request.avatars[i].path, out);
    writeLinkNames(inputs.avatars[i], out);
    out.endObject();
  }
  out.endArray();
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
