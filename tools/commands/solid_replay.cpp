#include "tools/commands/solid_replay.h"

#include <optional>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/console.h"
#include "tools/glb/solid_glb.h"
#include "tools/interrupt.h"
#include "tools/log/bvh_text.h"
#include "tools/progress.h"
#include "tools/report/report_file.h"
#include "tools/report/solid_report.h"
#include "tools/results_output.h"
#include "tools/solid/shown_track.h"
#include "tools/solid/solid_lines.h"

namespace foretouch::tools {
namespace {

/// Options of a replay that ask about tracked poses, and what a solid avatar says instead.
struct RefusedOption {
  const char* name;
  const char* why;
};
constexpr RefusedOption kRefused[] = {
    {"--scope", "it is about what tracked poses touch; what holds a shown pose is always told"},
    {"--pass-separating", "a solid avatar always lets go of what it leaves"},
    {"--policy", "all links are solid alike, but for those that --ignore names"},
    {"--skin", "what is solid are the links' LSS; the gap to surfaces is --solid-skin"},
    {"--skin-scale", "what is solid are the links' LSS"},
    {"--skin-up", "what is solid are the links' LSS"},
    {"--threads", "each tick begins where the one before ended"},
    {"--ground", "it is about how touches of tracked poses are listed; feet are told by --floor"},
    {"--ground-angle", "it is about touches of tracked poses"},
    {"--ground-height", "it is about touches of tracked poses"},
};

/// Writes the poses as they are at each tick.
Result<Done> writeBvh(const ReplayInputs& inputs, const ShownTrack& track,
                      const std::string& path) {
  const Skeleton& skeleton = inputs.avatar.skeleton();
  std::vector<Pose> poses;
  for (const std::size_t at : track.shownAtTick()) poses.push_back(track.poses()[at]);
  std::vector<bool> hasTranslation(countOf(skeleton.numJoints()), false);
  for (const Pose& pose : poses) {
    for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
      if (pose.translations[slotOf(joint)] != skeleton.restOffset(joint)) {
        hasTranslation[slotOf(joint)] = true;
      }
    }
  }
  FORETOUCH_TRY(const auto text,
                inFile(bvhText(skeleton, hasTranslation, poses, tickS(inputs)), path));
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  return file.commit();
}

Result<Done> checkFiles(const SolidReplayJob& job) {
  const ReplayRequest& request = job.request;
  std::vector<std::string> taken{request.scenePath, request.avatarPath, request.motionPath,
                                 request.robotPath, request.mapPath,    request.pairsPath};
  for (const std::string& page : {job.report.path, job.glb.path, job.bvhPath}) {
    FORETOUCH_CHECK(checkOutputs(job.outputPath, page, taken));
    if (!page.empty()) taken.push_back(page);
  }
  return Done{};
}

/// What is written besides the results.
class Extras {
 public:
  Extras(const SolidReplayJob& job, const ReplayInputs& inputs) : job_(job), inputs_(inputs) {
    if (!job.report.path.empty() || !job.glb.path.empty() || !job.bvhPath.empty()) {
      track_.emplace(inputs);
    }
  }
  void add(const PlayedTick& tick) {
    if (track_) track_->add(tick);
  }
  Result<Done> write(const SolidSummary& summary, const std::string& header,
                     const InterruptGuard& guard) {
    if (!track_) return Done{};
    track_->finish();
    if (!job_.bvhPath.empty()) FORETOUCH_CHECK(writeBvh(inputs_, *track_, job_.bvhPath));
    if (!job_.glb.path.empty()) {
      FORETOUCH_TRY(const auto notes, writeSolidGlb(inputs_, *track_, header, job_.glb));
      for (const std::string& note : notes) printNote(job_.glb.path + ": " + note);
    }
    if (job_.report.path.empty()) return Done{};
    return writeReport(job_.report.path, guard, [&](const ReportProgress& watch) {
      return solidReport(summary, *track_, job_.solid, job_.report, watch);
    });
  }

 private:
  const SolidReplayJob& job_;
  const ReplayInputs& inputs_;
  std::optional<ShownTrack> track_;
};

}  // namespace

Result<Done> checkSolidTogether(const Settings& settings, const WorldRequest& request) {
  for (const RefusedOption& refused : kRefused) {
    if (settings.isGiven(refused.name)) {
      return Error::in(refused.name, ErrorCode::Mismatch,
                       std::string("does not apply with --solid: ") + refused.why);
    }
  }
  // A project may have asked for these.
  if (request.query.fidelity != Fidelity::Link) {
    return Error::in("--fidelity", ErrorCode::Mismatch,
                     std::string("expected link with --solid, found ") +
                         toString(request.query.fidelity) + ": what is solid are the links' LSS");
  }
  if (request.query.scope != Scope::EveryLink) {
    return Error::in(
        "--scope", ErrorCode::Mismatch,
        std::string("expected links with --solid, found ") + toString(request.query.scope));
  }
  if (!request.policies.empty()) {
    return Error::in("--policy", ErrorCode::Mismatch,
                     "expected no policies with --solid: all links are solid alike");
  }
  return Done{};
}

Result<Done> runSolidReplay(const SolidReplayJob& job,
                            const std::function<void(const SolidSummary&)>& tell) {
  FORETOUCH_CHECK(checkFiles(job));
  FORETOUCH_TRY(const auto inputs, loadReplayInputs(job.request));
  for (const std::string& remark : remarksOn(inputs)) printNote(remark);
  const auto rate = remarkOnRate(inputs.steps, inputs.clip, job.request.rateHz);
  if (rate) printNote(*rate);
  const SolidOptions options = solidOptionsOf(job.solid, inputs, job.hasTolerance);
  SolidSummary summary(inputs);
  {
    const InterruptGuard guard;  // built first, destroyed last: removes the file before the signal
    FORETOUCH_TRY(auto file, PendingFile::create(job.outputPath));
    FORETOUCH_TRY(const auto whole, completedOptions(inputs, options));
    SolidLines lines(inputs, whole);
    FORETOUCH_TRY(const auto header, lines.header());
    file.write(header);
    Extras extras(job, inputs);
    ProgressBar progress("replay", ticksOf(inputs));
    FORETOUCH_CHECK(playSolid(inputs, options, [&](const PlayedTick& tick) {
      file.write(lines.line(tick));
      summary.add(tick);
      extras.add(tick);
      progress.advanceTo(tick.tick + 1);
      return !guard.requested();
    }));
    if (!guard.requested()) {
      file.write(lines.last(summary.fields()));
      FORETOUCH_CHECK(file.commit());
      FORETOUCH_CHECK(extras.write(summary, header, guard));
    }
  }
  tell(summary);
  return Done{};
}

}  // namespace foretouch::tools
