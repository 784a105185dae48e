#include "tools/person/bounds_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/bounds/bounds_file.h"
#include "assets/bvh/bvh_reader.h"
#include "tools/console.h"
#include "tools/inputs/file_roles.h"
#include "tools/inputs/motion_file.h"
#include "tools/inputs/played_clip.h"
#include "tools/person/learn_bounds.h"
#include "tools/program.h"
#include "tools/results_output.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// The height (m) of a person whose clip does not say how long its units are.
constexpr double kUsualStature = 1.7;

struct BoundsJob {
  LearnRequest learn;
  std::vector<std::string> clips, models{"cubic-late"};
  double quantile = 0.999, scale = 0.0;
  std::string name, output;
  std::string avatar;  ///< Empty: a body is made for each clip.
};

/// The clip at a person's size, unless the user says its units.
Result<Clip> readAtSize(const std::string& path, double scale) {
  MotionRequest request;
  request.path = path;
  if (scale > 0.0) request.scale = scale;
  FORETOUCH_TRY(auto motion, readMotion(request));
  const auto stature = statureOf(motion.clip.skeleton);
  if (scale > 0.0 || !stature) return std::move(motion.clip);
  request.scale = (request.scale.value_or(1.0)) * kUsualStature / *stature;
  FORETOUCH_TRY(auto sized, readMotion(request));
  return std::move(sized.clip);
}

void learnFrom(const Clip& clip, const Avatar& avatar, const std::string& path,
               BoundsLearner& learner) {
  if (learner.learn(clip, avatar) > 0) return;
  printNote(fmt::format("{}: {:.4g} poses per second are too few for these rates; left out", path,
                        1.0 / clip.frameTimeS));
}

/// Learns from a body that is made for the clip.
Result<Done> learnFrom(const std::string& path, double scale, BoundsLearner& learner) {
  FORETOUCH_TRY(const Clip clip, readAtSize(path, scale));
  FORETOUCH_TRY(const Avatar avatar, inFile(avatarFromClip(clip), path));
  learnFrom(clip, avatar, path, learner);
  return Done{};
}

/// Learns from the axes that `replay` asks about, moved as it moves them.
Result<Done> learnFrom(const std::string& path, const BoundsJob& job, BoundsLearner& learner) {
  ClipRequest request;
  request.avatarPath = job.avatar;
  request.motionPath = path;
  if (job.scale > 0.0) request.motionScale = job.scale;
  FORETOUCH_TRY(auto played, loadPlayedClip(request));
  const Skeleton& skeleton = played.avatar.skeleton();
  Clip onAvatar = played.clip;
  onAvatar.skeleton = skeleton;
  onAvatar.frames.clear();
  for (std::size_t frame = 0; frame < played.clip.frames.size(); ++frame) {
    FORETOUCH_TRY(
        auto pose,
        inFile(validatedPose(skeleton, poseOfAvatar(skeleton, played.clip, played.match, frame)),
               path));
    onAvatar.frames.push_back(std::move(pose));
  }
  learnFrom(onAvatar, played.avatar, path, learner);
  return Done{};
}

std::string tableOf(const BoundsFile& file) {
  std::string text =
      fmt::format("{:<12}{:<15}{:>8}{:>12}{:>12}{:>12}{:>10}{:>12}\n", "part", "between", "Hz",
                  "m/s2", "share", "gap m/s", "steps", "of them mm");
  for (const BoundEntry& entry : file.entries) {
    const double seconds = 1.0 / entry.rateHz;
    text += fmt::format("{:<12}{:<15}{:>8.3g}{:>12.4g}{:>12.3g}{:>12.3g}{:>10}{:>12.3g}\n",
                        entry.link.empty() ? entry.part : entry.link,
                        entry.model ? toString(*entry.model) : "any", entry.rateHz,
                        entry.bound.acceleration, entry.bound.followShare, entry.bound.speed,
                        entry.count, 1e3 * entry.bound.acceleration * seconds * seconds / 8.0);
  }
  return text;
}

Result<Done> runLearn(BoundsJob& job) {
  FORETOUCH_CHECK(checkOutput(job.output, job.clips));
  job.learn.models.clear();
  for (const std::string& word : job.models) job.learn.models.push_back(*motionModelNamed(word));
  job.learn.quantile = job.quantile;
  BoundsLearner learner(job.learn);
  for (const std::string& path : job.clips) {
    FORETOUCH_CHECK(job.avatar.empty() ? learnFrom(path, job.scale, learner)
                                       : learnFrom(path, job, learner));
  }
  BoundsFile file = learner.bounds();
  if (file.entries.empty()) {
    return Error::in("--rates", ErrorCode::Empty,
                     "no clip has two frames or more per given pose: nothing could be learned");
  }
  file.name = job.name;
  file.source =
      fmt::format("learned from {} {}", job.clips.size(), job.clips.size() == 1 ? "clip" : "clips");
  FORETOUCH_CHECK(writeBoundsFile(file, job.output));
  const std::string text = tableOf(file);
  isStandardOutput(job.output) ? printAside(text)
                               : printOut(text + "\nbounds: " + job.output + "\n");
  return Done{};
}

Command learnCommand() {
  const auto job = std::make_shared<BoundsJob>();
  Settings settings;
  settings
      .list("clips", "CLIP...", job->clips, "Clips at their full rate (bvh, or animated models)")
      .files(kClipEndings)
      .required();
  settings.output("-o,--output", "FILE", job->output, "The bounds (json)").required();
  addNumbers(settings, "--rates", "HZ,...", job->learn.ratesHz, kAboveZero,
             "Poses per second that will be given");
  addWords(settings, "--between", "WORD,...", job->models, {"constant-rate", "cubic", "cubic-late"},
           "Models of the motion between two poses");
  settings.number("--quantile", "Q", job->quantile, NumberRange{0.0, 1.0},
                  "Share of steps that the bounds hold at; 1: all");
  settings.number("--error", "M", job->learn.errorM, kZeroOrAbove, "What a pose is off by (m)");
  settings
      .text("--avatar", "FILE", job->avatar,
            "The body whose links the bounds are about, as replay takes it; one is made for each "
            "clip if not given")
      .files("json");
  settings.number("--clip-scale", "S", job->scale, kZeroOrAbove,
                  "Metres per unit; 0: as the clip says with --avatar, else such that a person is "
                  "1.7 m tall");
  settings.flag("--by-link", job->learn.isByLink, "One bound per link, not per part of the body");
  settings.text("--name", "TEXT", job->name, "Written into the file, for people");
  Command command{
      "learn", "Learn from clips how far persons are from a model of their motion",
      "Example:\n  foretouch bounds learn anna*.bvh --rates 10,30 --between cubic-late \\\n"
      "      --quantile 0.999 -o anna.bounds.json\n\n"
      "Every n-th pose is given, the others say where the person was. What a bound promises, and\n"
      "which to take: docs/person.md.",
      std::move(settings)};
  command.run = [job](const Settings&) {
    const auto done = runLearn(*job);
    return done.ok() ? ExitCode::Done : failed(done.error());
  };
  return command;
}

}  // namespace

Command boundsCommand() {
  Command bounds{"bounds", "How far persons may be from a model of their motion"};
  bounds.commands.push_back(learnCommand());
  return bounds;
}

}  // namespace foretouch::tools
