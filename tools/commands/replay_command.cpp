#include "tools/commands/replay_command.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/commands/play_clip.h"
#include "tools/commands/replay_log_command.h"
#include "tools/commands/solid_replay.h"
#include "tools/inputs/file_roles.h"
#include "tools/inputs/policy_rules.h"
#include "tools/replay/summary_json.h"
#include "tools/results_output.h"
#include "tools/settings/solid_settings.h"
#include "tools/settings/stream_settings.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct AskedReplay {
  ReplayJob job;
  std::vector<std::string> files;
  std::vector<std::string> avatars;  ///< For a log, numbered as parseNumberedAvatars() reads them.
  StreamPolicy stream;
  std::string suffix;
  StreamSolidRequest solid;
  std::string bvhPath;  ///< For what a solid avatar shows; empty: none.
  int threads = 0;      ///< 0: one per processor.
  bool asJson = false;  ///< The summary.
};

void addInputSettings(Settings& settings, AskedReplay& asked) {
  ReplayRequest& request = asked.job.request;
  addSceneSettings(settings, request);
  settings.of("--scene").required();
  settings
      .list("--avatar", "[ID=]FILE", asked.avatars,
            "Avatar file (see foretouch avatar); of a log, its number before it, and repeated")
      .files("json")
      .in(kInputGroup)
      .inConfig("avatar", "file")
      .required();
  addMotionSetting(settings, request, "--motion", "CLIP|LOG",
                   "BVH clip, animated model (glb, gltf, fbx, dae, x), joint positions (csv, "
                   "npz), or event log (lcmlog)")
      .files("bvh glb gltf fbx dae x csv npz lcmlog")
      .required();
}

void addOutputSettings(Settings& settings, AskedReplay& asked) {
  settings.output("-o,--output", "FILE", asked.job.outputPath, "Results, as lines of JSON")
      .required();
  settings.output("--report", "FILE", asked.job.report.path,
                  "The report: a page for a browser, all in one file");
  settings
      .whole("--report-triangles", "N", asked.job.report.maxTriangles, 1, kMostReportTriangles,
             "Of a heavier scene the report shows what is near the action, or a simplified form")
      .in(kOutputGroup);
  settings
      .output("--glb", "FILE", asked.job.glb.path,
              "Also the replay as an animated GLB, for any viewer of glTF (docs/formats.md)")
      .ofClips();
  settings
      .whole("--glb-triangles", "N", asked.job.glb.mostTriangles, 1, kMaxTriangles,
             "Triangles of that file at most")
      .in(kOutputGroup)
      .ofClips();
  settings.output("--bvh", "FILE", asked.bvhPath, "Also what the solid avatar shows, as a BVH clip")
      .needing("--solid")
      .ofClips();
  settings.asJson(asked.asJson).ofClips();
  settings.of("--json").help = "Print the summary as one line of JSON (docs/formats.md)";
}

/// What only compares belongs to the benchmarks.
void addGoneSettings(Settings& settings) {
  for (const char* const option : {"--compare-rigid", "--compare-link"}) {
    settings.gone(option, "is gone: foretouch-bench compare counts that");
  }
  settings.gone("--rays", "is gone: foretouch-bench latency times rays beside steps");
}

/// Settings of clips only.
void addClipOnlySettings(Settings& settings, AskedReplay& asked) {
  addRateSetting(settings, asked.job.request).ofClips();
  addClipSettings(settings, asked.job.request);
  addCutSettings(settings, asked.job.request);
  for (const char* const option :
       {"--clip-scale", "--clip-up", "--place", "--map", "--animation", "--robot", "--package",
        "--columns", "--row-rate", "--quaternion", "--angles", "--table-scale", "--from", "--to",
        "--skip-t-pose"}) {
    settings.of(option).ofClips();
  }
}

void tellOfLogs(Setting& setting) {
  setting.help.front() = static_cast<char>(std::tolower(setting.help.front()));
  setting.help = "Of a log: " + setting.help;
}

/// Own links and budgets have options of their own in a clip.
void addSolidReplaySettings(Settings& settings, StreamSolidRequest& solid) {
  addStreamSolidSettings(settings, solid);
  for (const char* const option : {"--solid-self", "--solid-budget-us"}) {
    tellOfLogs(settings.of(option).ofLogs());
  }
}

/// Settings of logs only.
void addLogSettings(Settings& settings, AskedReplay& asked) {
  addSuffixSetting(settings, asked.suffix);
  addStreamSettings(settings, asked.stream);
  for (const char* const option :
       {"--suffix", "--max-step", "--confirmations", "--unmatched-at-rest"}) {
    Setting& setting = settings.of(option).ofLogs().in("Event logs");
    tellOfLogs(setting);
  }
}

Settings replaySettings(AskedReplay& asked) {
  Settings settings;
  addInputSettings(settings, asked);
  addClipOnlySettings(settings, asked);
  addQuerySettings(settings, asked.job.request);
  addReplayQuerySettings(settings, asked.job.request);
  addTouchSettings(settings, asked.job.request);
  addPersonSettings(settings, asked.job.person);
  settings.of("--between").help =
      "The motion between two poses that the bounds are about, or, of a clip without bounds, that "
      "is asked; cubic-late needs the pose after them";
  tellOfLogs(settings.of("--ahead").ofLogs());
  addSolidReplaySettings(settings, asked.solid);
  addOutputSettings(settings, asked);
  addGoneSettings(settings);
  settings.wholeOr("cores", "--threads", "N", asked.threads, kMaxThreads, "Threads")
      .in(kEffortGroup)
      .ofClips();
  addLogSettings(settings, asked);
  addFilesSetting(settings, asked.files);
  return settings;
}

/// What only link and exact fidelity can answer.
Result<Done> checkFidelity(const char* option, const WorldRequest& request) {
  const Fidelity fidelity = request.query.fidelity;
  if (fidelity == Fidelity::Link || fidelity == Fidelity::Exact) return Done{};
  return Error::in(option, ErrorCode::Mismatch,
                   std::string("expected --fidelity link or exact, found ") + toString(fidelity) +
                       ": at other ones links have no surface of their own");
}

/// What own links are not asked with.
Result<Done> checkSelf(const WorldRequest& request) {
  if (!request.asksSelf) return Done{};
  FORETOUCH_CHECK(checkFidelity("--self", request));
  if (request.query.scope != Scope::FirstOfAvatar) return Done{};
  return Error::in("--self", ErrorCode::Mismatch,
                   std::string("expected --scope links or objects, found ") +
                       toString(request.query.scope) + ": own pairs are answered one by one");
}

/// What is not asked beyond the first contact.
Result<Done> checkBeyondFirst(const WorldRequest& request) {
  if (request.query.scope == Scope::EveryObject) {
    FORETOUCH_CHECK(checkFidelity("--scope objects", request));
    if (request.budgetUs > 0) {
      return Error::in("--scope objects", ErrorCode::Mismatch,
                       "expected no --budget-us, found " + std::to_string(request.budgetUs) +
                           ": it may end before the last object");
    }
  }
  if (!request.query.passSeparating) return Done{};
  return checkFidelity("--pass-separating", request);
}

/// Options that are legal by themselves, but not together.
Result<Done> checkTogether(const WorldRequest& request) {
  FORETOUCH_CHECK(checkSelf(request));
  return checkBeyondFirst(request);
}

/// Refuses a given option that makes no sense with this kind of motion.
Result<Done> checkOptions(const Settings& settings, const AskedReplay& asked, bool isLog) {
  const std::string& motion = asked.job.request.motionPath;
  for (const Setting& setting : settings) {
    if (!setting.isGiven || !(isLog ? setting.isOfClips : setting.isOfLogs)) continue;
    return Error::in(setting.name(), ErrorCode::Mismatch,
                     std::string("applies to ") + (isLog ? "clips" : "event logs") +
                         " only, but --motion is the " + (isLog ? "event log " : "clip ") +
                         inQuotes(motion));
  }
  if (!isLog && asked.avatars.size() > 1) {
    return Error::in("--avatar", ErrorCode::Mismatch,
                     "expected one avatar for a clip, found " +
                         std::to_string(asked.avatars.size()) + "; an event log may have several");
  }
  return Done{};
}

/// A cubic without bounds is only for clips, and for their plain answers.
Result<Done> checkBetween(const AskedReplay& asked, bool isLog) {
  const PersonRequest& person = asked.job.person;
  const bool isPlain = !isLog && !asked.solid.solid.isAsked;
  if (person.model == MotionModel::ConstantRate || person.isAsked() || isPlain) return Done{};
  return Error::in("--between", ErrorCode::Mismatch,
                   std::string("expected --bounds beside it: without, it is of the plain answers "
                               "of a clip, found ") +
                       (isLog ? "an event log" : "--solid"));
}

/// The places of a run's files, for its summary.
std::string placesOf(const std::string& output, const std::string& report) {
  return "\nresults: " + output + "\n" + (report.empty() ? "" : "report:  " + report + "\n");
}

ExitCode runClip(const AskedReplay& asked) {
  ReplayJob job = asked.job;
  job.request.avatarPath = asked.avatars.front();
  if (!job.person.isAsked()) job.request.between = job.person.model;
  const int cores = static_cast<int>(
      std::clamp(std::thread::hardware_concurrency(), 1u, static_cast<unsigned>(kMaxThreads)));
  job.threads = asked.threads == 0 ? cores : asked.threads;
  const std::string& report = job.report.path;
  const bool outIsTaken = isStandardOutput(job.outputPath) || isStandardOutput(report) ||
                          isStandardOutput(job.glb.path);
  const auto done = runReplay(job, [&](const ReplaySummary& summary, const std::string& person) {
    const int threads = job.threads;
    std::string text = asked.asJson ? summaryLine(summary, threads, job.outputPath, report)
                                    : summary.text(threads) + person;
    if (!asked.asJson && !outIsTaken) text += placesOf(job.outputPath, report);
    outIsTaken ? printAside(text) : printOut(text);
  });
  return done.ok() ? ExitCode::Done : failed(done.error());
}

ExitCode runLog(const AskedReplay& asked) {
  FORETOUCH_TRY_OR(failed, auto avatars, parseNumberedAvatars("--avatar", asked.avatars));
  const ReplayRequest& given = asked.job.request;
  const LogReplayJob job{{given.motionPath, given, std::move(avatars), asked.stream, asked.suffix,
                          asked.solid, asked.job.person},
                         asked.job.outputPath,
                         asked.job.report};
  const bool outIsTaken = isStandardOutput(job.outputPath) || isStandardOutput(job.report.path);
  const auto replayed = runLogReplay(job, [&](const std::string& text) {
    outIsTaken ? printAside(text) : printOut(text + placesOf(job.outputPath, job.report.path));
  });
  if (!replayed.ok()) return failed(replayed.error());
  const bool isFine = replayed.value().agrees() && !replayed.value().isEmpty();
  return isFine ? ExitCode::Done : ExitCode::CheckSaysNo;
}

ExitCode runSolid(const Settings& settings, const AskedReplay& asked) {
  SolidReplayJob job{asked.job.request,    asked.solid.solid, settings.isGiven("--tolerance"),
                     asked.job.outputPath, asked.bvhPath,     asked.job.report,
                     asked.job.glb};
  job.request.avatarPath = asked.avatars.front();
  job.hasTolerance = job.hasTolerance || job.request.query.tolerance != kDefaultTolerance;
  const std::string& report = job.report.path;
  const bool outIsTaken = isStandardOutput(job.outputPath) || isStandardOutput(report) ||
                          isStandardOutput(job.glb.path) || isStandardOutput(job.bvhPath);
  const auto done = runSolidReplay(job, [&](const SolidSummary& summary) {
    std::string text = asked.asJson ? summary.jsonLine(job.outputPath, report) : summary.text();
    if (!asked.asJson && !outIsTaken) text += placesOf(job.outputPath, report);
    outIsTaken ? printAside(text) : printOut(text);
  });
  return done.ok() ? ExitCode::Done : failed(done.error());
}

ExitCode run(const Settings& settings, AskedReplay& asked) {
  const bool isLog = isEventLog(asked.job.request.motionPath);
  FORETOUCH_CHECK_OR(failed, checkOptions(settings, asked, isLog));
  FORETOUCH_CHECK_OR(failed, checkBetween(asked, isLog));
  FORETOUCH_CHECK_OR(failed, readPolicies(asked.job.request));
  if (asked.solid.solid.isAsked && !isLog) {
    FORETOUCH_CHECK_OR(failed, checkSolidTogether(settings, asked.job.request));
    return runSolid(settings, asked);
  }
  FORETOUCH_CHECK_OR(failed, checkTogether(asked.job.request));
  return isLog ? runLog(asked) : runClip(asked);
}

constexpr char kReplayExamples[] = R"(Examples:
  foretouch replay room.obj dancer.avatar.json dancer.bvh --rate 10 -o contacts.jsonl
  foretouch replay --scene room.obj --avatar dancer.avatar.json --motion dancer.bvh \
      --rate 10 --output contacts.jsonl
  foretouch replay --scene kitchen.ply --scene-up z --avatar a.avatar.json --motion walk.bvh \
      --clip-scale 0.01 --place 1.5,0,-2,90 --ignore '*:floor,LeftFoot' --output contacts.jsonl
  foretouch replay --scene room.obj --avatar man.json --motion man.glb --animation Walk \
      --output contacts.jsonl
  foretouch replay --scene room.obj --avatar 1=anna.json --avatar 2=ben.json \
      --motion journal.lcmlog --output contacts.jsonl
  foretouch replay --scene room.obj --avatar man.json --motion dance.bvh --self \
      --pairs man.pairs.json --output contacts.jsonl
  foretouch replay --scene room.obj --avatar man.json --motion dance.bvh --scope objects \
      --pass-separating --output contacts.jsonl
  foretouch replay --scene room.obj --avatar man.json --motion dance.bvh --solid \
      --output shown.jsonl --report shown.html
  foretouch replay --scene cell.dae --avatar arm.json --motion log.csv --robot arm.urdf \
      --output contacts.jsonl

--ignore takes pairs `link` or `link:object`, separated by commas; a trailing * stands for any
ending. The results file is described in docs/formats.md. Of an event log that holds a service's
verdicts as well, exit code 1 says that those found now are others.)";

}  // namespace

Command replayCommand() {
  const auto asked = std::make_shared<AskedReplay>();
  Command command{"replay", "Find what an avatar touches between the poses of a recorded clip",
                  kReplayExamples, replaySettings(*asked)};
  command.takesProject = true;
  command.run = [asked](const Settings& settings) { return run(settings, *asked); };
  return command;
}

}  // namespace foretouch::tools
