#include "tools/commands/replay_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "assets/text_file.h"
#include "tools/arguments.h"
#include "tools/commands/replay_log_command.h"
#include "tools/inputs/clip_options.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/report/replay_report.h"
#include "tools/report/report_file.h"
#include "tools/results_output.h"
#include "tools/settling.h"
#include "tools/stream/serve_config.h"
#include "tools/stream/stream_arguments.h"

namespace foretouch::tools {
namespace {

/// Values as typed in.
struct ReplayTexts {
  std::string scene, motion, output;
  ClipTexts clip;
  std::string sceneScale = "1", up = "y";
  std::string fidelity = "link", leaves = "advancement", scope = "links", skin, skinScale = "1",
              skinUp = "y", tolerance = "0.001", culler = "flat", threads = "cores";
  std::string suffix, maxStep = "10", confirmations = "3", budgetUs;
  std::string policy, report, reportTriangles = std::to_string(kDefaultViewTriangles);
  std::string glb, glbTriangles = "1000000";
  std::vector<std::string> avatars, ignore;
  bool compareRigid = false, compareLink = false, rays = false, unmatchedAtRest = false;
};

/// Options that are legal by themselves, but not together.
Result<Done> checkTogether(const ReplayTexts& texts, const ReplayRequest& request) {
  const bool isAboveLinks = request.fidelity == Fidelity::Limb ||
                            request.fidelity == Fidelity::Avatar ||
                            request.fidelity == Fidelity::Ellipsoid;
  if (isAboveLinks && (texts.compareRigid || texts.compareLink)) {
    return Error{ErrorCode::OutOfRange, "--fidelity", -1, -1,
                 "expected link, exact or skinned with --compare-rigid or --compare-link: above "
                 "them links have no surface of their own to compare"};
  }
  if (request.budgetUs == 0) return Done{};
  if (texts.compareRigid || texts.compareLink) {
    return Error{ErrorCode::Mismatch, "--budget-us", -1, -1,
                 "expected none with --compare-rigid or --compare-link: what is undecided has "
                 "nothing to compare"};
  }
  if (request.culler != Culler::FlatBvh) {
    return Error{ErrorCode::Mismatch, "--budget-us", -1, -1,
                 "expected none with --culler point-query: cullers do different work, and would "
                 "leave different links undecided"};
  }
  return Done{};
}

Result<ReplayJob> settled(const ReplayTexts& texts) {
  ReplayJob job;
  ReplayRequest& request = job.request;
  request.scenePath = texts.scene;
  if (texts.avatars.size() == 1) request.avatarPath = texts.avatars.front();
  request.motionPath = texts.motion;
  request.ignore = texts.ignore;
  request.policyPath = texts.policy;
  job.outputPath = texts.output;
  job.report.path = texts.report;
  job.glb.path = texts.glb;
  job.options.compareRigid = texts.compareRigid;
  job.options.compareLink = texts.compareLink;
  job.options.rays = texts.rays;

  Settling settle;
  settle.into(request.fidelity, parseFidelity("--fidelity", texts.fidelity));
  settle.into(request.scope, parseScope("--scope", texts.scope));
  settle.into(request.leafMethod, parseLeafMethod("--leaves", texts.leaves));
  request.skinPath = texts.skin;
  settle.into(request.skinScale, parsePositive("--skin-scale", texts.skinScale));
  settle.into(request.skinUp, parseUpAxis("--skin-up", texts.skinUp));
  settleClip(texts.clip, settle, request);
  settle.into(request.sceneUp, parseUpAxis("--up", texts.up));
  settle.into(request.sceneScale, parsePositive("--scene-scale", texts.sceneScale));
  settle.into(request.tolerance, parseTolerance("--tolerance", texts.tolerance));
  settle.into(request.culler, parseCuller("--culler", texts.culler));
  if (!texts.budgetUs.empty()) {
    settle.into(request.budgetUs, parseBudgetUs("--budget-us", texts.budgetUs));
  }
  settle.into(job.report.maxTriangles,
              parseReportTriangles("--report-triangles", texts.reportTriangles));
  int glbTriangles = 0;
  settle.into(glbTriangles,
              parseCount("--glb-triangles", texts.glbTriangles, static_cast<int>(kMaxTriangles)));
  job.glb.mostTriangles = static_cast<std::size_t>(glbTriangles);
  if (!texts.policy.empty()) settle.into(request.policies, readPolicyFile(texts.policy));
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  job.options.threads = static_cast<int>(std::min<unsigned>(cores, kMaxThreads));
  if (texts.threads != "cores") {
    settle.into(job.options.threads, parseThreads("--threads", texts.threads));
  }
  if (settle.error()) return *settle.error();
  const auto checked = checkTogether(texts, request);
  if (!checked.ok()) return checked.error();
  return job;
}

/// Of the options that make no sense with this kind of motion, one that was given all the same.
Result<Done> checkOptions(const CLI::App& command, const ReplayTexts& texts, bool isLog) {
  constexpr std::array kOfClips = {"--rate",    "--place",     "--scale",         "--motion-up",
                                   "--map",     "--animation", "--robot",         "--package",
                                   "--threads", "--scope",     "--compare-rigid", "--compare-link",
                                   "--rays",    "--glb",       "--glb-triangles"};
  constexpr std::array kOfLogs = {"--suffix", "--max-step", "--confirmations",
                                  "--unmatched-at-rest"};
  const auto firstGiven = [&command](const auto& options) {
    const auto given = std::find_if(options.begin(), options.end(),
                                    [&](const char* option) { return command.count(option) > 0; });
    return given == options.end() ? "" : *given;
  };
  const std::string misplaced = isLog ? firstGiven(kOfClips) : firstGiven(kOfLogs);
  if (!misplaced.empty()) {
    return Error{ErrorCode::Mismatch, misplaced, -1, -1,
                 std::string("makes no sense with ") + (isLog ? "an event log" : "a clip") +
                     " as --motion; expected none, found one with " + inQuotes(texts.motion)};
  }
  if (!isLog && texts.avatars.size() > 1) {
    return Error{ErrorCode::Mismatch, "--avatar", -1, -1,
                 "expected one avatar for a clip, found " + std::to_string(texts.avatars.size()) +
                     "; an event log may have several"};
  }
  return Done{};
}

/// Where a run's files are, for its summary.
std::string placesOf(const std::string& output, const std::string& report) {
  return "\nresults: " + output + "\n" + (report.empty() ? "" : "report:  " + report + "\n");
}

ExitCode runClip(const ReplayTexts& texts) {
  const auto job = settled(texts);
  if (!job.ok()) return failed(job.error());
  const bool outIsTaken =
      isStandardOutput(job.value().outputPath) || isStandardOutput(job.value().report.path);
  const auto done = runReplay(job.value(), [&](const ReplaySummary& summary) {
    const std::string text = summary.text(job.value().options.threads);
    const std::string places = placesOf(job.value().outputPath, job.value().report.path);
    outIsTaken ? printAside(text) : printOut(text + places);
  });
  return done.ok() ? ExitCode::Done : failed(done.error());
}

Result<LogReplayJob> settledLog(const ReplayTexts& texts) {
  auto clip = settled(texts);
  if (!clip.ok()) return clip.error();
  LogReplayJob job;
  job.outputPath = clip.value().outputPath;
  job.report = clip.value().report;
  LogReplayRequest& request = job.request;
  request.query = std::move(clip.value().request);
  request.suffix = texts.suffix;
  Settling settle;
  settle.into(request.avatars, parseNumberedAvatars("--avatar", texts.avatars));
  settle.into(request.policy.maxStepUs, parseMaxStepUs("--max-step", texts.maxStep));
  settle.into(request.policy.confirmations,
              parseCount("--confirmations", texts.confirmations, kMaxServeConfirmations));
  request.policy.unmatchedAtRest = texts.unmatchedAtRest;
  if (settle.error()) return *settle.error();
  return job;
}

ExitCode runLog(const ReplayTexts& texts) {
  const auto job = settledLog(texts);
  if (!job.ok()) return failed(job.error());
  const std::string& output = job.value().outputPath;
  const std::string& page = job.value().report.path;
  const bool outIsTaken = isStandardOutput(output) || isStandardOutput(page);
  const auto replayed = runLogReplay(job.value(), [&](const std::string& text) {
    outIsTaken ? printAside(text) : printOut(text + placesOf(output, page));
  });
  if (!replayed.ok()) return failed(replayed.error());
  return replayed.value().agrees() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

ExitCode runTexts(const CLI::App& command, const ReplayTexts& texts) {
  const bool isLog = isEventLog(texts.motion);
  const auto checked = checkOptions(command, texts, isLog);
  if (!checked.ok()) return failed(checked.error());
  return isLog ? runLog(texts) : runClip(texts);
}

constexpr char kReplayExamples[] = R"(Examples:
  foretouch replay --scene room.obj --avatar dancer.avatar.json --motion dancer.bvh \
      --rate 10 --output contacts.jsonl
  foretouch replay --scene kitchen.ply --up z --avatar a.avatar.json --motion walk.bvh \
      --scale 0.01 --place 1.5,0,-2,90 --ignore '*:floor,LeftFoot' --output contacts.jsonl
  foretouch replay --scene room.obj --avatar man.json --motion man.glb --animation Walk \
      --output contacts.jsonl
  foretouch replay --scene room.obj --avatar 1=anna.json --avatar 2=ben.json \
      --motion journal.lcmlog --output contacts.jsonl
  foretouch replay --scene cell.dae --avatar arm.json --motion log.csv --robot arm.urdf \
      --output contacts.jsonl

--ignore takes pairs `link` or `link:object`, separated by commas; a trailing * stands for any
ending. The results file is described in docs/formats.md. Of an event log that holds a service's
verdicts as well, exit code 1 says that those found now are others.)";

/// Nothing where none is asked for.
Result<Done> writeGlb(const ReplayGlb& glb, const std::string& path) {
  if (path.empty()) return Done{};
  const auto notes = glb.write();
  if (!notes.ok()) return notes.error();
  for (const std::string& note : notes.value()) printNote(path + ": " + note);
  return Done{};
}

}  // namespace

Result<Done> runReplay(const ReplayJob& job,
                       const std::function<void(const ReplaySummary&)>& tell) {
  const ReplayRequest& request = job.request;
  for (const std::string& page : {job.report.path, job.glb.path}) {
    const auto checked =
        checkOutputs(job.outputPath, page,
                     {request.scenePath, request.avatarPath, request.motionPath, request.robotPath,
                      request.mapPath, request.policyPath, request.skinPath,
                      page == job.glb.path ? job.report.path : ""});
    if (!checked.ok()) return checked.error();
  }
  const auto inputs = loadReplayInputs(request);
  if (!inputs.ok()) return inputs.error();
  for (const std::string& remark : remarksOn(inputs.value())) printNote(remark);

  ReplaySummary summary(inputs.value());
  std::optional<ReplayReport> report;
  if (!job.report.path.empty()) report.emplace(inputs.value(), job.report);
  ReplayGlb glb(inputs.value(), job.glb);
  {
    const InterruptGuard guard;  // first built, last gone: the file goes before the signal comes
    auto file = PendingFile::create(job.outputPath);
    if (!file.ok()) return file.error();
    file.value().write(headerLine(inputs.value()));
    ProgressBar progress("replay", inputs.value().steps.count);
    const auto done = replay(inputs.value(), job.options, [&](const ReplayedStep& step) {
      file.value().write(step.line);
      summary.add(step);
      if (report) report->add(step);
      glb.add(step.answer);
      progress.advanceTo(step.answer.step + 1);
      return !guard.requested();
    });
    if (!done.ok()) return done.error();
    if (!guard.requested()) {
      const auto written = file.value().commit();
      if (!written.ok()) return written.error();
      const auto shown = writeGlb(glb, job.glb.path);
      if (!shown.ok()) return shown.error();
    }
    if (report && !guard.requested()) {
      const auto reported = writeReport(job.report.path, guard, [&](const ReportProgress& watch) {
        return report->document(summary, watch);
      });
      if (!reported.ok()) return reported.error();
    }
  }
  tell(summary);
  return Done{};
}

void addReplayCommand(CLI::App& program, ExitCode& exit) {
  const auto texts = std::make_shared<ReplayTexts>();
  CLI::App* const command = program.add_subcommand(
      "replay", "Find what an avatar touches between the poses of a recorded clip");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    return command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--scene", texts->scene, "FILE", "Scene: any mesh format that assimp reads")->required();
  command
      ->add_option(
          "--avatar", texts->avatars,
          "Avatar file (see foretouch avatar); of a log, its number before it, and repeated")
      ->type_name("[ID=]FILE")
      ->allow_extra_args(false)
      ->required();
  option("--motion", texts->motion, "CLIP|LOG",
         "BVH clip, animated model (glb, gltf, fbx, dae, x), joint positions (csv), or event log "
         "(lcmlog)")
      ->required();
  option("--output", texts->output, "FILE", "Results, as lines of JSON")->required();
  option("--report", texts->report, "FILE", "The report: a page for a browser, all in one file");
  option("--report-triangles", texts->reportTriangles, "N",
         "Of a heavier scene the report shows what is near the action, or a simplified form");
  option("--glb", texts->glb, "FILE",
         "Also the replay as an animated GLB, for any viewer of glTF (docs/formats.md)");
  option("--glb-triangles", texts->glbTriangles, "N", "Triangles of that file at most");
  option("--rate", texts->clip.rate, "HZ",
         "Poses a second to use of the clip; animations: 30 if all");
  addClipOptions(*command, texts->clip);
  option("--scene-scale", texts->sceneScale, "S", "Metres per unit of the scene");
  option("--up", texts->up, "y|z", "Which axis of the scene points up");
  option("--fidelity", texts->fidelity, "RUNG",
         "What touches: one ellipsoid, one LSS (avatar), one a limb, the links' LSS (link), "
         "their meshes (exact), or a skin (skinned)");
  option("--skin", texts->skin, "BODY", "Skinned fidelity: the model that the avatar was made of");
  option("--skin-scale", texts->skinScale, "S", "Metres per unit of that model");
  option("--skin-up", texts->skinUp, "y|z", "Which axis of that model points up");
  option("--leaves", texts->leaves, "advancement|cubics",
         "Exact fidelity's way with pairs of triangles; both keep the promise");
  option("--scope", texts->scope, "links|avatar",
         "Every link's first contact, or only the first of all");
  option("--tolerance", texts->tolerance, "M", "Largest separation (m) of a reported contact");
  option("--threads", texts->threads, "N", "Threads");
  option("--culler", texts->culler, "flat|point-query", "Way to cull; both find the same");
  command->add_option("--ignore", texts->ignore, "Contacts not asked for; may be repeated")
      ->type_name("PAIRS")
      ->allow_extra_args(false);
  option(
      "--policy", texts->policy, "FILE",
      "Tolerance, fidelity and what to ignore, link by link: [[policy]] tables (docs/formats.md)");
  option("--suffix", texts->suffix, "TEXT", "Of a log: ending of the channels' names");
  option("--max-step", texts->maxStep, "S", "Of a log: a pose this much after the last is refused");
  option("--confirmations", texts->confirmations, "N",
         "Of a log: poses in a row that make a timeline that was not expected");
  option("--budget-us", texts->budgetUs, "US",
         "What a step may cost, as an amount of work; links beyond it are undecided");
  command->add_flag("--unmatched-at-rest", texts->unmatchedAtRest,
                    "Of a log: joints that the sender does not have keep their rest values");
  command->add_flag("--compare-rigid", texts->compareRigid,
                    "Also count what a model that knows only each link's own two poses misses");
  command->add_flag("--compare-link", texts->compareLink,
                    "With --fidelity exact: also count the LSS contacts that the meshes refute");
  command->add_flag("--rays", texts->rays, "Also time 16 occlusion rays a step, as a yardstick");
  command->footer(kReplayExamples);
  command->callback([texts, command, &exit] { exit = runTexts(*command, *texts); });
}

}  // namespace foretouch::tools
