#include "tools/commands/log_replay_command.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/console.h"
#include "tools/interrupt.h"
#include "tools/log/replay_log_summary.h"
#include "tools/progress.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"
#include "tools/stream/serving.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct AskedLogReplay {
  std::string logPath, worldPath, suffix;
  WorldRequest query;  ///< Scene and avatars are the world file's.
  StreamPolicy stream;
  WorldPolicy world;
  StreamSolidRequest solid;
  PersonRequest person;
  bool asJson = false;
};

std::string line(const char* what, std::int64_t number) {
  return fmt::format("{:<28}{:>10}\n", what, number);
}

std::int64_t eventsOf(const WorldCounts& counts) {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : counts.events) sum += count;
  return static_cast<std::int64_t>(sum);
}

std::string outcomeOf(const JournalCheck& check, const char* what, std::int64_t answers) {
  std::string text = LogReplaySummary::compared(check, what, answers);
  const auto first = check.hasRecord() ? check.firstDifference() : std::optional<std::string>();
  if (first) text += "first: " + *first + "\n";
  return text;
}

std::string summaryOf(const LogReplayReport& report, const ReplayedWorld& world) {
  const WorldCounts counts = world.counts();
  std::string text = line("poses of avatars", report.poses);
  text += line("answered", report.answers);
  text += line("poses of bodies", static_cast<std::int64_t>(counts.rigidPoses));
  text += line("states of bodies", static_cast<std::int64_t>(counts.states));
  text += line("advances", static_cast<std::int64_t>(counts.advances));
  text += line("events", eventsOf(counts));
  text += line("marked", static_cast<std::int64_t>(counts.marked));
  text += line("silences", static_cast<std::int64_t>(counts.silences));
  for (std::size_t i = 1; i < kNumRejects; ++i) {
    if (counts.rejects[i] == 0) continue;
    const std::string what = fmt::format("refused, {}", toString(static_cast<Reject>(i)));
    text += line(what.c_str(), static_cast<std::int64_t>(counts.rejects[i]));
  }
  text += LogReplaySummary::comparison(report);
  const JournalCheck& journal = world.journal();
  if (world.unreadable() > 0) {
    text += fmt::format("{} messages about bodies cannot be read\n", world.unreadable());
  }
  if (!journal.hasRecord()) {
    return text + "the log has no events of a moving world: there is nothing to compare\n";
  }
  return text + outcomeOf(journal, "messages of events", world.answers()) +
         outcomeOf(world.solids(), "poses of solid bodies", world.shown()) +
         outcomeOf(world.pushes(), "messages of pushes", world.shown());
}

std::string jsonOf(const LogReplayReport& report, const ReplayedWorld& world) {
  const WorldCounts counts = world.counts();
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("poses", report.poses);
  out.field("answers", report.answers);
  out.field("answers_recorded", report.journal.recorded());
  out.field("answers_equal", report.journal.equal());
  out.field("advances", counts.advances);
  out.field("events", eventsOf(counts));
  out.field("messages", world.answers());
  out.field("messages_recorded", world.journal().recorded());
  out.field("messages_equal", world.journal().equal());
  if (report.said > 0) {
    out.field("persons", report.said);
    out.field("persons_equal", report.persons.equal());
  }
  if (world.shown() > 0) {
    out.field("shown", world.shown());
    out.field("shown_equal", world.solids().equal());
    out.field("pushes_equal", world.pushes().equal());
  }
  const bool agrees = report.agrees() && world.agrees();
  if (agrees && !world.journal().hasRecord()) {
    out.rawField("agrees", "null");  // no contradiction, but also nothing that could be one
  } else {
    out.field("agrees", agrees);
  }
  out.endObject();
  return text + "\n";
}

ExitCode run(AskedLogReplay& asked) {
  FORETOUCH_TRY_OR(failed, auto loaded,
                   loadWorldToServe(asked.worldPath, asked.world, asked.solid, asked.query));
  const LogReplayRequest request{asked.logPath, asked.query,  std::move(loaded.avatars),
                                 asked.stream,  asked.suffix, asked.solid,
                                 asked.person};
  FORETOUCH_TRY_OR(failed, const auto inputs, loadLogReplayInputs(request));
  ReplayedWorld world(std::move(loaded.solver));
  const InterruptGuard guard;
  ProgressBar progress("replay", 100);
  FORETOUCH_TRY_OR(failed, const auto report,
                   replayLog(
                       inputs,
                       [&](const AnsweredPose& answered) {
                         if (answered.logBytes > 0) {
                           progress.advanceTo(static_cast<std::int64_t>(
                               100 * answered.positionBytes / answered.logBytes));
                         }
                         return !guard.requested();
                       },
                       &world));
  if (guard.requested()) return ExitCode::Done;
  printOut(asked.asJson ? jsonOf(report, world) : summaryOf(report, world));
  const bool hasCompared = world.journal().hasRecord();
  return hasCompared && report.agrees() && world.agrees() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

}  // namespace

Command logReplayCommand() {
  const auto asked = std::make_shared<AskedLogReplay>();
  Settings settings;
  settings.path("log", "LOG", asked->logPath, "LCM event log of a service with a moving world")
      .files("lcmlog")
      .required("an event log");
  settings
      .path("--world", "FILE", asked->worldPath,
            "The world file that the service had: scene, avatars and shapes are its")
      .files("toml")
      .required();
  addSuffixSetting(settings, asked->suffix);
  addQuerySettings(settings, asked->query);
  addStreamSettings(settings, asked->stream);
  addWorldStreamSettings(settings, asked->world);
  addStreamSolidSettings(settings, asked->solid);
  addWorldSolidSetting(settings, asked->solid);
  addPersonSettings(settings, asked->person);
  settings.of("--between").needing("--bounds");
  settings.asJson(asked->asJson);
  Command command{
      "replay", "Answer what a service with a moving world recorded, and compare byte for byte",
      "Example:\n  foretouch log replay today.lcmlog --world stage.toml\n\n"
      "Options are those of the service. Exit code 1 says that contacts or events found\n"
      "now are others than those in the log, or that it has no events to compare.",
      std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
