#include "tools/commands/world_command.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/commands/open_page.h"
#include "tools/console.h"
#include "tools/glb/world_glb.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/report/document_parts.h"
#include "tools/report/report_file.h"
#include "tools/report/view_person.h"
#include "tools/report/world_report.h"
#include "tools/results_output.h"
#include "tools/world/followed_world.h"
#include "tools/world/load_world.h"
#include "tools/world/world_audit.h"
#include "tools/world/world_event_lines.h"
#include "tools/world/world_intervals.h"
#include "tools/world/world_person.h"
#include "tools/world/world_results.h"
#include "tools/world/world_summary.h"

namespace foretouch::tools {
namespace {

/// Windows per second: from one per hour to one per microsecond.
constexpr NumberRange kWindowRate{1.0 / 3600.0, 1e6};

/// The values of all options.
struct AskedWorld {
  std::string path;
  double tolerance = kDefaultTolerance;
  WindowRequest windows;
  std::string outputPath;
  std::string eventsPath;
  ReportOptions report;
  GlbRequest glb;
  bool asJson = false;
};

Result<LoadedWorld> load(const AskedWorld& asked, const Settings& settings) {
  FORETOUCH_TRY(auto file, readWorldFile(asked.path));
  if (settings.isGiven("--tolerance")) file.tolerance = asked.tolerance;
  FORETOUCH_TRY(auto world, loadWorld(std::move(file)));
  if (!asked.asJson) {
    for (const std::string& remark : world.remarks) printNote(remark);
  }
  return world;
}

/// Every file that the world is read from: none may be overwritten.
std::vector<std::string> inputsOf(const WorldFile& file) {
  std::vector<std::string> inputs{file.path, file.scene.scenePath};
  for (const FileBody& body : file.bodies) {
    inputs.insert(inputs.end(),
                  {body.shape.avatarPath, body.shape.meshPath, body.pairsPath, body.posesPath,
                   body.clip.motionPath, body.clip.mapPath, body.clip.robotPath, body.boundsPath});
  }
  return inputs;
}

ExitCode check(const AskedWorld& asked, const Settings& settings) {
  FORETOUCH_TRY_OR(failed, const auto world, load(asked, settings));
  FORETOUCH_TRY_OR(failed, const auto overlaps, overlapsAtStart(world));
  printOut(asked.asJson ? auditLine(world, overlaps) : describe(world, overlaps));
  return ExitCode::Done;
}

/// Nothing is written over an input, nor over what else is written.
Result<Done> checkPlaces(const AskedWorld& asked, const LoadedWorld& world) {
  std::vector<std::string> inputs = inputsOf(world.file);
  FORETOUCH_CHECK(checkOutputs(asked.outputPath, asked.report.path, inputs));
  inputs.push_back(asked.report.path);
  FORETOUCH_CHECK(checkOutputs(asked.outputPath, asked.glb.path, inputs));
  inputs.push_back(asked.glb.path);
  return checkOutputs(asked.outputPath, asked.eventsPath, inputs);
}

void tellFound(const AskedWorld& asked, const WorldSummary& summary, const std::string& persons) {
  const std::string& report = asked.report.path;
  const bool outIsTaken = isStandardOutput(asked.outputPath) || isStandardOutput(report) ||
                          isStandardOutput(asked.glb.path) || isStandardOutput(asked.eventsPath);
  std::string text =
      asked.asJson ? summary.jsonLine(asked.outputPath, report) : summary.text() + persons;
  if (!asked.asJson && !outIsTaken) {
    text += "\nresults: " + asked.outputPath + "\n";
    if (!asked.eventsPath.empty()) text += "events:  " + asked.eventsPath + "\n";
    if (!report.empty()) text += "report:  " + report + "\n";
  }
  outIsTaken ? printAside(text) : printOut(text);
}

/// What a replay finds, and where it goes.
class WorldReplay {
 public:
  WorldReplay(const AskedWorld& asked, LoadedWorld& world, std::vector<std::int64_t> cuts)
      : asked_(asked), world_(world), cuts_(std::move(cuts)), intervals_(world), summary_(world) {}

  /// Writes all into its files; none of them if it is interrupted. `guard`: older than this.
  Result<Done> run(const InterruptGuard& guard) {
    FORETOUCH_TRY(auto results, PendingFile::create(asked_.outputPath));
    std::optional<PendingFile> events;
    if (!asked_.eventsPath.empty()) {
      FORETOUCH_TRY(auto created, PendingFile::create(asked_.eventsPath));
      events.emplace(std::move(created));
    }
    const bool isFollowed = checkFollowed(world_).ok();
    if (isFollowed) {
      FORETOUCH_CHECK(follow(guard, events ? &*events : nullptr));
    }
    const WorldIntervals* const followed = isFollowed ? &intervals_ : nullptr;
    WorldTouches touches(world_, followed);
    FORETOUCH_TRY(auto report, WorldReport::make(world_, asked_.report, followed));
    FORETOUCH_CHECK(askWindows(guard, results, touches, report));
    if (guard.requested()) return Done{};
    touches.finish();
    summary_.add(touches);
    FORETOUCH_TRY(persons_, personsOf(world_, cuts_.front(), cuts_.back()));
    if (persons_) results.write(personLines(world_, *persons_));
    results.write(touchLines(world_, touches, summary_.windows()));
    FORETOUCH_CHECK(results.commit());
    if (events) {
      events->write(intervalLines(world_, intervals_));
      FORETOUCH_CHECK(events->commit());
    }
    if (!asked_.glb.path.empty()) {
      FORETOUCH_TRY(const auto notes, writeWorldGlb(world_, touches, header(), asked_.glb));
      for (const std::string& note : notes) printNote(asked_.glb.path + ": " + note);
    }
    if (asked_.report.path.empty() || guard.requested()) return Done{};
    return writeReport(asked_.report.path, guard,
                       [&](const ReportProgress& watch) -> Result<ViewDocument> {
                         ViewDocument document = report.document(&summary_, &touches, watch);
                         if (persons_ && document.avatars.size() == world_.bodies.size()) {
                           addPersons(world_, *persons_, document);
                         }
                         return document;
                       });
  }

  [[nodiscard]] const WorldSummary& summary() const { return summary_; }
  /// The text about the persons; empty if there are none.
  [[nodiscard]] std::string text() const { return persons_ ? personText(world_, *persons_) : ""; }

 private:
  [[nodiscard]] std::string header() const { return worldHeader(world_, asked_.windows, cuts_); }

  /// Follows from enter to leave, into the file of events if there is one.
  Result<Done> follow(const InterruptGuard& guard, PendingFile* events) {
    if (events != nullptr) events->write(eventsHeader(world_, cuts_.front(), cuts_.back()));
    ProgressBar progress("follow", cuts_.back() - cuts_.front());
    FORETOUCH_CHECK(
        followWorld(world_, cuts_.front(), cuts_.back(), [&](const FollowedStretch& of) {
          if (events != nullptr) events->write(eventLines(world_, of));
          intervals_.add(of);
          progress.advanceTo(of.contacts.toUs - cuts_.front());
          return !guard.requested();
        }));
    intervals_.finish(cuts_.back());
    return Done{};
  }

  Result<Done> askWindows(const InterruptGuard& guard, PendingFile& results, WorldTouches& touches,
                          WorldReport& report) {
    if (guard.requested()) return Done{};
    results.write(header());
    ProgressBar progress("replay", static_cast<std::int64_t>(cuts_.size()) - 1);
    return replayWorld(world_, cuts_, [&](const WorldStep& step) {
      results.write(windowLine(world_, step));
      summary_.add(step);
      touches.add(step);
      if (!asked_.report.path.empty()) report.add(step);
      progress.advanceTo(step.window + 1);
      return !guard.requested();
    });
  }

  const AskedWorld& asked_;
  LoadedWorld& world_;
  std::vector<std::int64_t> cuts_;
  WorldIntervals intervals_;
  WorldSummary summary_;
  std::optional<WorldPersons> persons_;
};

Result<Done> replay(const AskedWorld& asked, const Settings& settings) {
  FORETOUCH_TRY(auto world, load(asked, settings));
  FORETOUCH_CHECK(checkPlaces(asked, world));
  if (!asked.eventsPath.empty()) {
    FORETOUCH_CHECK(checkFollowed(world));
  }
  FORETOUCH_TRY(auto cuts, windowsOf(world, asked.windows));
  WorldReplay replay(asked, world, std::move(cuts));
  {
    const InterruptGuard guard;  // built first, destroyed last: removes the file before the signal
    FORETOUCH_CHECK(replay.run(guard));
  }
  tellFound(asked, replay.summary(), replay.text());
  return Done{};
}

Result<Done> view(const AskedWorld& asked, const Settings& settings) {
  FORETOUCH_TRY(const auto world, load(asked, settings));
  FORETOUCH_CHECK(checkOutput(asked.report.path, inputsOf(world.file)));
  FORETOUCH_TRY(const auto report, WorldReport::make(world, asked.report, nullptr));
  const InterruptGuard guard;
  return writeReport(asked.report.path, guard,
                     [&](const ReportProgress& watch) -> Result<ViewDocument> {
                       return report.document(nullptr, nullptr, watch);
                     });
}

ExitCode runView(const AskedWorld& asked, const Settings& settings) {
  FORETOUCH_CHECK_OR(failed, view(asked, settings));
  if (isStandardOutput(asked.report.path)) return ExitCode::Done;
  printOut("page: " + asked.report.path + "\n");
  offerToOpen(asked.report.path);
  return ExitCode::Done;
}

void addWorldSetting(Settings& settings, AskedWorld& asked) {
  settings
      .path("world", "WORLD", asked.path,
            "World file: a scene, bodies, and how they move (docs/formats.md)")
      .files("toml")
      .required("a world file");
}

void addToleranceSetting(Settings& settings, AskedWorld& asked) {
  addWorldTolerance(settings, asked.tolerance).help =
      "Largest separation (m) of a reported contact, in place of what the world file says";
}

void addWindowSettings(Settings& settings, WindowRequest& windows) {
  settings
      .number("--rate", "HZ", windows.rateHz, kWindowRate, "poses",
              "Windows per second, in each of which every two links' first contact is told; "
              "poses: from each pose of any body to the next")
      .in(kInputGroup);
  settings
      .seconds("--from", windows.fromUs,
               "Instant of the world at which to begin; not given: the first pose")
      .in(kInputGroup);
  settings
      .seconds("--until", windows.untilUs, "Instant at which to end; not given: all that is known")
      .in(kInputGroup);
}

void addReportTriangles(Settings& settings, ReportOptions& report) {
  settings
      .whole("--report-triangles", "N", report.maxTriangles, 1, kMostReportTriangles,
             "Of a heavier scene the page shows what is near the bodies, or a simplified form")
      .in(kOutputGroup);
}

void addGlbSettings(Settings& settings, GlbRequest& glb) {
  settings
      .output("--glb", "FILE", glb.path,
              "Also the world as an animated GLB, for any viewer of glTF (docs/formats.md)")
      .in(kOutputGroup);
  settings
      .whole("--glb-triangles", "N", glb.mostTriangles, 1, kMostReportTriangles,
             "Triangles of that file at most")
      .in(kOutputGroup);
}

Command checkWorldCommand() {
  const auto asked = std::make_shared<AskedWorld>();
  Settings settings;
  addWorldSetting(settings, *asked);
  addToleranceSetting(settings, *asked);
  settings.asJson(asked->asJson);
  Command command{"check", "Read a world; say what is in it, and who overlaps where it appears",
                  "Example:\n  foretouch world check stage.toml", std::move(settings)};
  command.run = [asked](const Settings& given) { return check(*asked, given); };
  return command;
}

Command replayWorldCommand() {
  const auto asked = std::make_shared<AskedWorld>();
  Settings settings;
  addWorldSetting(settings, *asked);
  addWindowSettings(settings, asked->windows);
  addToleranceSetting(settings, *asked);
  settings.output("-o,--output", "FILE", asked->outputPath, "Results, as lines of JSON").required();
  settings.output("--events", "FILE", asked->eventsPath,
                  "Also what begins and ends, with its strength: who enters and leaves whom, and "
                  "triggers; as lines of JSON");
  settings.output("--report", "FILE", asked->report.path,
                  "Also a report: a page for a browser, all in one file");
  addReportTriangles(settings, asked->report);
  addGlbSettings(settings, asked->glb);
  settings.asJson(asked->asJson);
  Command command{"replay", "Find who touches whom in a world, and when",
                  "Examples:\n"
                  "  foretouch world replay stage.toml -o contacts.jsonl --report stage.html\n"
                  "  foretouch world replay stage.toml -o contacts.jsonl --events events.jsonl\n"
                  "  foretouch world replay stage.toml --rate 30 --from 2 --until 4 -o part.jsonl",
                  std::move(settings)};
  command.run = [asked](const Settings& given) {
    FORETOUCH_CHECK_OR(failed, replay(*asked, given));
    return ExitCode::Done;
  };
  return command;
}

Command viewWorldCommand() {
  const auto asked = std::make_shared<AskedWorld>();
  asked->report.path = "foretouch-world.html";
  Settings settings;
  addWorldSetting(settings, *asked);
  settings.output("-o,--output", "FILE", asked->report.path,
                  "The page, for a browser, all in one file");
  addReportTriangles(settings, asked->report);
  Command command{"view", "Look at the bodies of a world, and how they move, before a replay",
                  "Example:\n  foretouch world view stage.toml -o stage.html", std::move(settings)};
  command.run = [asked](const Settings& given) { return runView(*asked, given); };
  return command;
}

}  // namespace

Command worldCommand() {
  Command world{"world", "Ask avatars and props that move among each other"};
  for (const auto command : {checkWorldCommand, replayWorldCommand, viewWorldCommand}) {
    world.commands.push_back(command());
  }
  return world;
}

}  // namespace foretouch::tools
