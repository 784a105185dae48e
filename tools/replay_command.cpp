#include "tools/replay_command.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "articulated/text_file.h"
#include "tools/arguments.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

/// Values as typed in.
struct ReplayTexts {
  std::string scene, avatar, motion, animation, robot, map, output, rate = "all";
  std::string scale = "1", sceneScale = "1", motionUp = "y", up = "y", place = "0,0,0,0";
  std::string fidelity = "link", leaves = "advancement", scope = "links", skin, skinScale = "1",
              skinUp = "y", tolerance = "0.001", culler = "flat", threads = "cores";
  std::vector<std::string> ignore, packages;
  bool compareRigid = false, compareLink = false, rays = false;
};

Result<ReplayJob> settled(const ReplayTexts& texts) {
  ReplayJob job;
  ReplayRequest& request = job.request;
  request.scenePath = texts.scene;
  request.avatarPath = texts.avatar;
  request.motionPath = texts.motion;
  request.animation = texts.animation;
  request.robotPath = texts.robot;
  request.packagePaths = texts.packages;
  request.mapPath = texts.map;
  request.ignore = texts.ignore;
  job.outputPath = texts.output;
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
  settle.into(request.placement, parsePlacement("--place", texts.place));
  UpAxis motionUp = UpAxis::Y;
  settle.into(motionUp, parseUpAxis("--motion-up", texts.motionUp));
  request.placement.motionUpZ = motionUp == UpAxis::Z;
  settle.into(request.sceneUp, parseUpAxis("--up", texts.up));
  settle.into(request.motionScale, parsePositive("--scale", texts.scale));
  settle.into(request.sceneScale, parsePositive("--scene-scale", texts.sceneScale));
  settle.into(request.tolerance, parseTolerance("--tolerance", texts.tolerance));
  settle.into(request.culler, parseCuller("--culler", texts.culler));
  if (texts.rate != "all") {
    double rateHz = 0.0;
    settle.into(rateHz, parsePositive("--rate", texts.rate));
    request.rateHz = rateHz;
  }
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  job.options.threads = static_cast<int>(std::min<unsigned>(cores, kMaxThreads));
  if (texts.threads != "cores") {
    settle.into(job.options.threads, parseThreads("--threads", texts.threads));
  }
  if (settle.error()) return *settle.error();
  return job;
}

/// Refuses an output that is one of the inputs, and one that cannot be written, before any work.
Result<Done> checkOutput(const ReplayJob& job) {
  const ReplayRequest& request = job.request;
  const auto separate =
      checkIsNoInput(job.outputPath, {request.scenePath, request.avatarPath, request.motionPath,
                                      request.robotPath, request.mapPath});
  if (!separate.ok()) return separate.error();
  // Opening a pipe and closing it again would tell its reader that there is nothing more to come.
  std::error_code absent;
  const std::filesystem::file_status status = std::filesystem::status(job.outputPath, absent);
  if (std::filesystem::is_other(status)) return Done{};
  const InterruptGuard guard;  // the trial file must not stay behind
  const auto trial = PendingFile::create(job.outputPath);
  if (!trial.ok()) return trial.error();
  return Done{};
}

/// Results that go to standard output leave it to them: the summary then goes to stderr.
bool isStandardOutput(const std::string& path) {
  struct stat file {
  }, out{};
  return ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &out) == 0 &&
         file.st_dev == out.st_dev && file.st_ino == out.st_ino;
}

ExitCode runTexts(const ReplayTexts& texts) {
  const auto job = settled(texts);
  if (!job.ok()) return failed(job.error());
  const bool outIsTaken = isStandardOutput(job.value().outputPath);
  const auto done = runReplay(job.value(), [&](const ReplaySummary& summary) {
    const std::string text = summary.text(job.value().options.threads);
    outIsTaken ? printAside(text) : printOut(text + "\nresults: " + job.value().outputPath + "\n");
  });
  return done.ok() ? ExitCode::Done : failed(done.error());
}

constexpr char kExamples[] = R"(Examples:
  foretouch replay --scene room.obj --avatar dancer.avatar.json --motion dancer.bvh \
      --rate 10 --output contacts.jsonl
  foretouch replay --scene kitchen.ply --up z --avatar a.avatar.json --motion walk.bvh \
      --scale 0.01 --place 1.5,0,-2,90 --ignore '*:floor,LeftFoot' --output contacts.jsonl
  foretouch replay --scene room.obj --avatar man.json --motion man.glb --animation Walk \
      --output contacts.jsonl
  foretouch replay --scene cell.dae --avatar arm.json --motion log.csv --robot arm.urdf \
      --output contacts.jsonl

--ignore takes pairs `link` or `link:object`, separated by commas; a trailing * stands for any
ending. The results file is described in docs/formats.md.)";

}  // namespace

Result<Done> runReplay(const ReplayJob& job,
                       const std::function<void(const ReplaySummary&)>& report) {
  const auto checked = checkOutput(job);
  if (!checked.ok()) return checked.error();
  const auto inputs = loadReplayInputs(job.request);
  if (!inputs.ok()) return inputs.error();
  for (const std::string& remark : remarksOn(inputs.value())) printNote(remark);

  ReplaySummary summary(inputs.value());
  {
    const InterruptGuard guard;  // first built, last gone: the file goes before the signal comes
    auto file = PendingFile::create(job.outputPath);
    if (!file.ok()) return file.error();
    file.value().write(headerLine(inputs.value()));
    ProgressBar progress("replay", inputs.value().steps.count);
    const auto done = replay(inputs.value(), job.options, [&](const ReplayedStep& step) {
      file.value().write(step.line);
      summary.add(step);
      progress.advanceTo(step.answer.step + 1);
      return !guard.requested();
    });
    if (!done.ok()) return done.error();
    if (!guard.requested()) {
      const auto written = file.value().commit();
      if (!written.ok()) return written.error();
    }
  }
  report(summary);
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
  option("--avatar", texts->avatar, "FILE", "Avatar file (see foretouch avatar)")->required();
  option("--motion", texts->motion, "CLIP",
         "BVH clip, animated model (glb, gltf, fbx, dae, x) or joint positions (csv)")
      ->required();
  option("--animation", texts->animation, "NAME",
         "Which animation of a model: its name, or its number from 0; the first if not given");
  option("--robot", texts->robot, "URDF", "The robot that joint positions are about");
  command
      ->add_option("--package", texts->packages, "Folder of the robot's packages; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  option("--output", texts->output, "FILE", "Results, as lines of JSON")->required();
  option("--rate", texts->rate, "HZ", "Poses a second to use of the clip; animations: 30 if all");
  option("--scale", texts->scale, "S", "Metres per unit of the clip: 0.01 for centimetres");
  option("--motion-up", texts->motionUp, "y|z", "Which axis of the clip points up");
  option("--scene-scale", texts->sceneScale, "S", "Metres per unit of the scene");
  option("--up", texts->up, "y|z", "Which axis of the scene points up");
  option("--place", texts->place, "X,Y,Z[,YAW]",
         "Where the clip's origin stands in the scene: metres, and degrees about +Y");
  option("--fidelity", texts->fidelity, "RUNG",
         "What touches: the links' LSS (link), their meshes (exact), or a skin (skinned)");
  option("--skin", texts->skin, "BODY", "Skinned fidelity: the model that the avatar was made of");
  option("--skin-scale", texts->skinScale, "S", "Metres per unit of that model");
  option("--skin-up", texts->skinUp, "y|z", "Which axis of that model points up");
  option("--leaves", texts->leaves, "advancement|cubics",
         "Exact fidelity's way with pairs of triangles; both keep the promise");
  option("--scope", texts->scope, "links|avatar",
         "Every link's first contact, or only the first of all");
  option("--tolerance", texts->tolerance, "M", "Largest separation (m) of a reported contact");
  option("--threads", texts->threads, "N", "Threads");
  option("--map", texts->map, "FILE", R"(Joint names that differ: {"avatar joint": "clip joint"})");
  option("--culler", texts->culler, "flat|point-query", "Way to cull; both find the same");
  command->add_option("--ignore", texts->ignore, "Contacts not asked for; may be repeated")
      ->type_name("PAIRS")
      ->allow_extra_args(false);
  command->add_flag("--compare-rigid", texts->compareRigid,
                    "Also count what a model that knows only each link's own two poses misses");
  command->add_flag("--compare-link", texts->compareLink,
                    "With --fidelity exact: also count the LSS contacts that the meshes refute");
  command->add_flag("--rays", texts->rays, "Also time 16 occlusion rays a step, as a yardstick");
  command->footer(kExamples);
  command->callback([texts, &exit] { exit = runTexts(*texts); });
}

}  // namespace foretouch::tools
