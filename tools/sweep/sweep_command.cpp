#include "tools/sweep/sweep_command.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "tools/inputs/file_roles.h"
#include "tools/inputs/played_clip.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/results_output.h"
#include "tools/settings/world_settings.h"
#include "tools/sweep/surface_writer.h"
#include "tools/sweep/sweep.h"

namespace foretouch::tools {
namespace {

constexpr int kMostTriangles = 1'000'000'000;
/// A file of these is a gigabyte; an option allows more.
constexpr std::size_t kUsualTriangles = 20'000'000;

/// Names, given separately or with commas.
std::vector<std::string> namesIn(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const std::string& text : texts) {
    for (std::string& name : splitAtCommas(text)) {
      if (!name.empty()) names.push_back(std::move(name));
    }
  }
  return names;
}

/// The values of all options.
struct SweepJob {
  SweepRequest request;
  std::vector<std::string> files;
  std::vector<std::string> links;  ///< As given; none: all.
  std::string output;
  MeshFormat format = MeshFormat::Obj;  ///< The format of the output.
  bool inner = false;
  bool asJson = false;  ///< Whether the report on it is JSON.
};

/// Derives the rest of the job from the options.
Result<Done> settle(SweepJob& job) {
  SweepRequest& request = job.request;
  request.links = job.links.empty() ? std::vector<std::string>{"all"} : namesIn(job.links);
  request.surface.side = job.inner ? SurfaceSide::Inner : SurfaceSide::Outer;
  // The name of a stream does not say the format: take the one that every tool reads.
  if (job.output != kStandardOutput) {
    FORETOUCH_TRY(job.format, meshFormatOf(job.output));
  }
  const bool isGlb = job.format == MeshFormat::Glb;
  request.surface.bits = isGlb ? CoordinateBits::Single : CoordinateBits::Double;
  return checkIsNoInput(
      job.output, {request.avatarPath, request.motionPath, request.robotPath, request.mapPath});
}

void remarkOn(const SweepInputs& inputs) {
  for (const std::string& note : inputs.clip.notes) {
    printNote(inputs.request.motionPath + ": " + note);
  }
  const auto rate = remarkOnRate(inputs.steps, inputs.clip, inputs.request.rateHz);
  if (rate) printNote(*rate);
  if (!inputs.match.unmatchedAvatar.empty()) {
    printNote(
        fmt::format("{}: {} of {} joints have no counterpart in the clip and keep their rest "
                    "values: {}",
                    inputs.request.avatarPath, inputs.match.unmatchedAvatar.size(),
                    inputs.avatar.numLinks(), firstOf(inputs.match.unmatchedAvatar)));
  }
}

std::string report(const SweepInputs& inputs, const Sweep& sweep, std::size_t bytes, double tookS) {
  const bool isOuter = inputs.request.surface.side == SurfaceSide::Outer;
  std::string text = fmt::format("{} in {}, {:g} s to {:g} s, {} links, {} surface\n\n",
                                 inputs.request.avatarPath, inputs.request.motionPath, inputs.fromS,
                                 inputs.toS, sweep.links.size(), isOuter ? "outer" : "inner");
  const auto line = [&](const char* name, const std::string& value, const std::string& more = "") {
    text += fmt::format("{:<22}{:>12}{}{}\n", name, value, more.empty() ? "" : "   ", more);
  };
  line("triangles", fmt::format("{}", sweep.triangles));
  line("vertices", fmt::format("{}", sweep.vertices));
  line("pieces", fmt::format("{}", sweep.pieces));
  line("bytes", fmt::format("{}", bytes));
  line("certified error, mm", fmt::format("{:.6g}", 1e3 * sweep.certifiedError),
       isOuter ? "no enclosed point is farther from the swept volume"
               : "no point of the swept volume is farther from an enclosed one");
  if (isOuter) {
    line("sampled error, mm", fmt::format("{:.6g}", 1e3 * sweep.sampledError),
         fmt::format("largest of {} points of the surface", sweep.samples));
  }
  if (sweep.vanished > 0) {
    line("left out", fmt::format("{}", sweep.vanished), "LSS too thin for this error");
  }
  line("time, s", fmt::format("{:.3f}", tookS), "1 thread");
  return text;
}

std::string sweepJson(const SweepJob& job, const SweepInputs& inputs, const Sweep& sweep,
                      std::size_t bytes, double tookS) {
  const bool isOuter = inputs.request.surface.side == SurfaceSide::Outer;
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("avatar", inputs.request.avatarPath);
  out.field("motion", inputs.request.motionPath);
  out.field("from", inputs.fromS);
  out.field("to", inputs.toS);
  out.field("links", sweep.links.size());
  out.field("side", isOuter ? "outer" : "inner");
  out.field("triangles", sweep.triangles);
  out.field("vertices", sweep.vertices);
  out.field("pieces", sweep.pieces);
  out.field("bytes", bytes);
  out.field("certified_error", sweep.certifiedError);
  if (isOuter) out.field("sampled_error", sweep.sampledError);
  out.field("too_thin", sweep.vanished);
  out.field("seconds", tookS);
  out.field("output", job.output);
  out.endObject();
  return text + "\n";
}

Result<Done> runSweep(const SweepJob& job) {
  FORETOUCH_TRY(const auto inputs, loadSweepInputs(job.request));
  remarkOn(inputs);
  const auto begin = std::chrono::steady_clock::now();
  std::string text;
  {
    const InterruptGuard guard;  // built first, destroyed last: removes the file before the signal
    FORETOUCH_TRY(auto file, PendingFile::create(job.output));
    std::optional<ProgressBar> progress;  // the total is known after the first step
    auto sweep = sweepOf(inputs, [&](std::int64_t done, std::int64_t total) {
      if (!progress) progress.emplace("sweep", total);
      progress->advanceTo(done);
      return !guard.requested();
    });
    if (!sweep.ok()) return sweep.error();
    const double tookS =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!guard.requested()) {
      const auto bytes = writeSurfaces(sweep.value(), job.request.surface.side, job.format, file);
      if (!bytes.ok()) return bytes.error();
      FORETOUCH_CHECK(file.commit());
      text = job.asJson ? sweepJson(job, inputs, sweep.value(), bytes.value(), tookS)
                        : report(inputs, sweep.value(), bytes.value(), tookS) +
                              "\nmesh: " + job.output + "\n";
    }
  }
  isStandardOutput(job.output) ? printAside(text) : printOut(text);
  return Done{};
}

ExitCode run(SweepJob job) {
  FORETOUCH_CHECK_OR(failed, settle(job));
  const auto done = runSweep(job);
  return done.ok() ? ExitCode::Done : failed(done.error());
}

constexpr char kSweepExamples[] = R"(Examples:
  foretouch sweep --avatar dancer.avatar.json --motion dancer.bvh --links LeftHand,RightHand \
      --from 2 --to 3 --error 0.001 --output hands.ply
  foretouch sweep --avatar a.avatar.json --motion walk.bvh --clip-scale 0.01 --rate 10 --inner \
      --output inner.glb

The surface is closed and oriented, and may pass through itself: enclosed is what it winds around
at least once. Formats: docs/formats.md.)";

}  // namespace

Command sweepCommand() {
  const auto job = std::make_shared<SweepJob>();
  SweepRequest& request = job->request;
  request.surface.maxTriangles = kUsualTriangles;
  Settings settings;
  addAvatarSetting(settings, request).required();
  addMotionSetting(settings, request, "--motion", "CLIP").required();
  settings.list("--links", "NAMES", job->links,
                "Links' names, separated by commas, or all (if not given)");
  settings.number("--from", "S", request.fromS, kAnyNumber, "",
                  "Start, in seconds of the clip; its first pose if not given");
  settings.number("--to", "S", request.toS, kAnyNumber, "",
                  "End, in seconds of the clip; its last pose if not given");
  addRateSetting(settings, request);
  settings.number("--error", "M", request.surface.error, kToleranceRange,
                  "Largest distance (m) between surface and swept volume");
  settings.flag("--inner", job->inner, "The surface inside the swept volume, not around it");
  settings
      .output("-o,--output", "FILE", job->output,
              "Mesh to write: .obj, .ply or .glb; -: as .obj on standard output")
      .required();
  settings.whole("--max-triangles", "N", request.surface.maxTriangles, 1, kMostTriangles,
                 "Give up beyond this many");
  settings.asJson(job->asJson);
  addClipSettings(settings, request);
  addSkipTPose(settings, request);
  addFilesSetting(settings, job->files);
  Command command{
      "sweep", "Write what links of an avatar cover during a clip as a mesh with a certified error",
      kSweepExamples, std::move(settings)};
  command.takesProject = true;
  command.run = [job](const Settings&) { return run(*job); };
  return command;
}

}  // namespace foretouch::tools
