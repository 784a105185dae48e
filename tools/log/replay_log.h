// tools/log/replay_log.h: answers the poses of an event log as a service does, and compares the
// answers with those in the log.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "network/log/event_log.h"
#include "network/stream/avatar_stream.h"
#include "network/stream/person_stream.h"
#include "network/stream/stream_solver.h"
#include "network/wire/messages.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/log/journal_check.h"
#include "tools/log/replayed_world.h"
#include "tools/settings/channel_names.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/person_settings.h"
#include "tools/settings/stream_settings.h"

namespace foretouch::tools {

struct LogReplayRequest {
  std::string logPath;
  WorldRequest world;
  std::vector<NumberedAvatar> avatars;
  StreamPolicy policy;
  std::string suffix;
  StreamSolidRequest solid;
  PersonRequest person{};
};

struct LogReplayInputs {
  LogReplayRequest request;
  ChannelNames channels;
  Scene scene;
  std::vector<Avatar> avatars;  ///< In the order of the request.
};

/// Reads, checks and matches the inputs, except the log's content. Errors name the file or option.
[[nodiscard]] Result<LogReplayInputs> loadLogReplayInputs(const LogReplayRequest& request);

struct LogReplayReport {
  std::vector<std::string> remarks;  ///< What differs from the request: one sentence each.
  LogCounts log;
  std::int64_t poses = 0, skeletons = 0;  ///< For the replayed avatars, or unreadable.
  std::int64_t answers = 0;
  std::int64_t lost = 0, gaps = 0, timelines = 0;  ///< As in StreamCounts, for all avatars.
  RejectCounts rejects{};  ///< Poses and skeletons, unreadable ones included.
  /// Avatars whose poses in the log are not replayed, with the number of these poses.
  std::map<std::int32_t, std::int64_t> others;
  std::int64_t unreadableAnswers = 0;  ///< In the log: nothing can be equal to them.
  std::int64_t shown = 0;              ///< Poses shown by avatars that are solid by themselves.
  JournalCheck journal;
  JournalCheck solids{AnswerKind::Solid};    ///< The shown poses, if solid avatars are asked for.
  std::int64_t solidsNotAsked = 0;           ///< Shown poses in the log, if they are not.
  std::int64_t said = 0;                     ///< Messages about persons.
  std::vector<PersonMessage> ended;          ///< Of these, last steps whose next pose did not come.
  JournalCheck persons{AnswerKind::Person};  ///< These messages, if they are asked for.
  std::int64_t personsNotAsked = 0;          ///< Such messages in the log, if they are not.
  std::int64_t eventsNotAsked = 0;           ///< A moving world's, in the log; without one.

  /// Nothing at all was answered: that says nothing about what the avatars touch.
  [[nodiscard]] bool isEmpty() const { return answers == 0; }
  /// The replay contradicts nothing in the log.
  [[nodiscard]] bool agrees() const {
    return unreadableAnswers == 0 && (!journal.hasRecord() || journal.isEqual()) &&
           (!solids.hasRecord() || solids.isEqual()) && (!persons.hasRecord() || persons.isEqual());
  }
};

/// A pose of the log and its answer; valid only during the sink's call.
struct AnsweredPose {
  const ContactsMessage& answer;
  const SolidMessage* solid;              ///< What is shown; null: the avatar is not solid.
  const PersonStream* person;             ///< What is known of the person now; null: not asked.
  std::size_t avatar;                     ///< Its index in the request.
  const StreamStep& step;                 ///< The step that the pose ended.
  const QueryOptions& query;              ///< The options of the query.
  std::uint64_t positionBytes, logBytes;  ///< Bytes of the log: read so far, and all.
};

/// Takes the answers in the order of the log; false ends the replay early.
using AnswerSink = std::function<bool(const AnsweredPose& answered)>;

/// Answers every pose that a service with the same options would answer, as fast as possible and in
/// this thread. The answers' stamps of receiving and sending are 0.
/// `world`: the moving world of the service, if it had one.
[[nodiscard]] Result<LogReplayReport> replayLog(const LogReplayInputs& inputs,
                                                const AnswerSink& sink,
                                                ReplayedWorld* world = nullptr);

/// The first line of the results of a log (docs/formats.md, "Results of a log").
[[nodiscard]] std::string logHeaderLine(const LogReplayInputs& inputs);

}  // namespace foretouch::tools
