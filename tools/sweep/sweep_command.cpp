#include "tools/sweep/sweep_command.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/arguments.h"
#include "tools/inputs/clip_options.h"
#include "tools/inputs/played_clip.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/settling.h"
#include "tools/sweep/surface_writer.h"
#include "tools/sweep/sweep.h"

namespace foretouch::tools {
namespace {

constexpr int kMostTriangles = 1'000'000'000;

/// Values as typed in.
struct SweepTexts {
  std::string avatar, motion, output, from, to, error = "0.001", maxTriangles = "20000000";
  ClipTexts clip;
  std::vector<std::string> links;
  bool inner = false;
};

/// Names, given apart or with commas.
std::vector<std::string> namesIn(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const std::string& text : texts) {
    for (std::string& name : splitAtCommas(text)) {
      if (!name.empty()) names.push_back(std::move(name));
    }
  }
  return names;
}

struct SweepJob {
  SweepRequest request;
  MeshFormat format = MeshFormat::Obj;
};

Result<SweepJob> settled(const SweepTexts& texts) {
  SweepJob job;
  SweepRequest& request = job.request;
  request.avatarPath = texts.avatar;
  request.motionPath = texts.motion;
  request.links = namesIn(texts.links);
  if (texts.links.empty()) request.links = {"all"};
  request.surface.side = texts.inner ? SurfaceSide::Inner : SurfaceSide::Outer;

  Settling settle;
  settle.into(job.format, meshFormatOf(texts.output));
  settle.require(
      checkIsNoInput(texts.output, {texts.avatar, texts.motion, texts.clip.robot, texts.clip.map}));
  const bool isGlb = job.format == MeshFormat::Glb;
  request.surface.bits = isGlb ? CoordinateBits::Single : CoordinateBits::Double;
  settle.into(request.surface.error, parseTolerance("--error", texts.error));
  int most = 0;
  settle.into(most, parseCount("--max-triangles", texts.maxTriangles, kMostTriangles));
  request.surface.maxTriangles = static_cast<std::size_t>(most);
  settleClip(texts.clip, settle, request);
  const auto optional = [&](std::optional<double>& place, const Result<double>& parsed) {
    double number = 0.0;
    settle.into(number, parsed);
    place = number;
  };
  if (texts.clip.rate != "all") optional(request.rateHz, parsePositive("--rate", texts.clip.rate));
  if (!texts.from.empty()) optional(request.fromS, parseNumber("--from", texts.from));
  if (!texts.to.empty()) optional(request.toS, parseNumber("--to", texts.to));
  if (settle.error()) return *settle.error();
  return job;
}

void remarkOn(const SweepInputs& inputs) {
  for (const std::string& note : inputs.clip.notes) {
    printNote(inputs.request.motionPath + ": " + note);
  }
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

Result<Done> runSweep(const SweepJob& job, const std::string& output) {
  const auto inputs = loadSweepInputs(job.request);
  if (!inputs.ok()) return inputs.error();
  remarkOn(inputs.value());
  const auto begin = std::chrono::steady_clock::now();
  std::string text;
  {
    const InterruptGuard guard;  // first built, last gone: the file goes before the signal comes
    auto file = PendingFile::create(output);
    if (!file.ok()) return file.error();
    std::optional<ProgressBar> progress;  // how much there is to do is known after the first step
    auto sweep = sweepOf(inputs.value(), [&](std::int64_t done, std::int64_t total) {
      if (!progress) progress.emplace("sweep", total);
      progress->advanceTo(done);
      return !guard.requested();
    });
    if (!sweep.ok()) return sweep.error();
    const double tookS =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!guard.requested()) {
      const auto bytes =
          writeSurfaces(sweep.value(), job.request.surface.side, job.format, file.value());
      if (!bytes.ok()) return bytes.error();
      const auto written = file.value().commit();
      if (!written.ok()) return written.error();
      text = report(inputs.value(), sweep.value(), bytes.value(), tookS);
    }
  }
  printOut(text);
  return Done{};
}

ExitCode runTexts(const SweepTexts& texts) {
  const auto job = settled(texts);
  if (!job.ok()) return failed(job.error());
  const auto done = runSweep(job.value(), texts.output);
  return done.ok() ? ExitCode::Done : failed(done.error());
}

constexpr char kSweepExamples[] = R"(Examples:
  foretouch sweep --avatar dancer.avatar.json --motion dancer.bvh --links LeftHand,RightHand \
      --from 2 --to 3 --error 0.001 --output hands.ply
  foretouch sweep --avatar a.avatar.json --motion walk.bvh --scale 0.01 --rate 10 --inner \
      --output inner.glb

The surface is closed and oriented, and may pass through itself: enclosed is what it winds around
at least once. Formats: docs/formats.md.)";

}  // namespace

void addSweepCommand(CLI::App& program, ExitCode& exit) {
  const auto texts = std::make_shared<SweepTexts>();
  CLI::App* const command = program.add_subcommand(
      "sweep",
      "Write what links of an avatar cover during a clip as a mesh with a certified error");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    return command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--avatar", texts->avatar, "FILE", "Avatar file (see foretouch avatar)")->required();
  option("--motion", texts->motion, "CLIP",
         "BVH clip, animated model (glb, gltf, fbx, dae, x) or joint positions (csv)")
      ->required();
  command
      ->add_option("--links", texts->links,
                   "Links' names, separated by commas, or all (if not given)")
      ->type_name("NAMES")
      ->allow_extra_args(false);
  option("--from", texts->from, "S", "Seconds in the clip; its begin if not given");
  option("--to", texts->to, "S", "Seconds in the clip; its end if not given");
  option("--rate", texts->clip.rate, "HZ",
         "Poses a second to use of the clip; animations: 30 if all");
  option("--error", texts->error, "M", "Largest distance (m) between surface and swept volume");
  command->add_flag("--inner", texts->inner, "The surface inside the swept volume, not around it");
  option("--output", texts->output, "FILE", "Mesh to write: .obj, .ply or .glb")->required();
  option("--max-triangles", texts->maxTriangles, "N", "Give up beyond this many");
  addClipOptions(*command, texts->clip);
  command->footer(kSweepExamples);
  command->callback([texts, &exit] { exit = runTexts(*texts); });
}

}  // namespace foretouch::tools
