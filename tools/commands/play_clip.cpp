#include "tools/commands/play_clip.h"

#include <optional>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/replay/place_doubts.h"
#include "tools/report/replay_report.h"
#include "tools/report/report_file.h"
#include "tools/report/view_person.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

/// Writes nothing if there is no path.
Result<Done> writeGlb(const ReplayGlb& glb, const ReplayTouches& touches, const std::string& path) {
  if (path.empty()) return Done{};
  FORETOUCH_TRY(const auto notes, glb.write(touches.listed()));
  for (const std::string& note : notes) printNote(path + ": " + note);
  return Done{};
}

void printRemarks(const PlaceDoubts& doubts, const std::optional<std::string>& hint) {
  for (const std::string& remark : doubts.remarks()) printNote(remark);
  if (hint) printNote(*hint);
}

Result<Done> checkPages(const ReplayJob& job) {
  const ReplayRequest& request = job.request;
  for (const std::string& page : {job.report.path, job.glb.path}) {
    FORETOUCH_CHECK(
        checkOutputs(job.outputPath, page,
                     {request.scenePath, request.avatarPath, request.motionPath, request.robotPath,
                      request.mapPath, request.policyPath, request.skinPath, request.pairsPath,
                      job.person.boundsPath, page == job.glb.path ? job.report.path : ""}));
  }
  return Done{};
}

}  // namespace

Result<Done> runReplay(
    const ReplayJob& job,
    const std::function<void(const ReplaySummary&, const std::string& person)>& tell) {
  const ReplayRequest& request = job.request;
  FORETOUCH_CHECK(checkPages(job));
  FORETOUCH_TRY(const auto inputs, loadReplayInputs(request));
  for (const std::string& remark : remarksOn(inputs)) printNote(remark);
  const auto rate = remarkOnRate(inputs.steps, inputs.clip, request.rateHz);
  if (rate && !inputs.curve) printNote(*rate);

  FORETOUCH_TRY(const auto bounds, personBounds(inputs, job.person));
  ReplaySummary summary(inputs);
  PersonTold person;
  PlaceDoubts doubts(inputs.avatar.skeleton(), inputs.query.self.has_value());
  FORETOUCH_TRY(auto touches, ReplayTouches::start(inputs));
  std::optional<ReplayReport> report;
  if (!job.report.path.empty()) report.emplace(inputs, job.report);
  ReplayGlb glb(inputs, job.glb);
  {
    const InterruptGuard guard;  // built first, destroyed last: removes the file before the signal
    FORETOUCH_TRY(auto file, PendingFile::create(job.outputPath));
    file.write(headerLine(inputs));
    ProgressBar progress("replay", inputs.steps.count);
    Result<Done> followed = Done{};
    const auto done = replay(inputs, job.threads, [&](const ReplayedStep& step) {
      file.write(step.line);
      summary.add(step);
      doubts.add(step.answer);
      if (report) report->add(step);
      followed = touches.add(step.answer);
      glb.add(step.answer);
      glb.add(touches.begun());
      progress.advanceTo(step.answer.step + 1);
      return followed.ok() && !guard.requested();
    });
    if (!done.ok()) return done.error();
    if (!followed.ok()) return followed.error();
    if (!guard.requested()) {
      FORETOUCH_CHECK(touches.finish());
      glb.add(touches.begun());
      summary.add(touches);
      FORETOUCH_TRY(person, tellPerson(inputs, job.person, bounds));
      file.write(person.lines + touches.lines());
      FORETOUCH_CHECK(file.commit());
      FORETOUCH_CHECK(writeGlb(glb, touches, job.glb.path));
    }
    if (report && !guard.requested()) {
      FORETOUCH_CHECK(writeReport(job.report.path, guard, [&](const ReportProgress& watch) {
        auto document = report->document(summary, touches.listed(), watch);
        if (document.ok()) addPerson(inputs, job.person, person.answer, document.value());
        return document;
      }));
    }
  }
  tell(summary, person.text);
  printRemarks(doubts, hintOnOwnPairs(inputs, summary.startingPairs(), summary.steps()));
  return Done{};
}

}  // namespace foretouch::tools
