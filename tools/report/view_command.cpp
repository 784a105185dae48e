#include "tools/report/view_command.h"

#include <memory>
#include <string>
#include <vector>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "tools/inputs/file_roles.h"
#include "tools/interrupt.h"
#include "tools/report/document_parts.h"
#include "tools/report/inspection.h"
#include "tools/report/report_file.h"
#include "tools/results_output.h"
#include "tools/setup/placement_check.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct ViewJob {
  std::vector<std::string> files;
  ReplayRequest request;
  ReportOptions report;
  bool json = false;
};

Result<Done> check(const ReplayRequest& request) {
  if (request.scenePath.empty() && request.avatarPath.empty() && request.motionPath.empty()) {
    return Error::in("view", ErrorCode::Empty, "expected a scene, an avatar or a motion");
  }
  if (isEventLog(request.motionPath)) {
    return Error::in(request.motionPath, ErrorCode::Mismatch,
                     "is an event log; expected a clip. `foretouch replay --report` shows logs");
  }
  return Done{};
}

/// What the page says, for users who read it elsewhere.
struct Found {
  std::vector<std::string> notes;
  std::vector<PlacementCheck> checks;
};

Result<Done> view(const ViewJob& job, Found& found) {
  const ReplayRequest& request = job.request;
  const auto checked =
      checkOutput(job.report.path, {request.scenePath, request.avatarPath, request.motionPath,
                                    request.robotPath, request.mapPath});
  if (!checked.ok()) return checked;
  FORETOUCH_TRY(const auto inspected, inspect(request));
  const InterruptGuard guard;
  return writeReport(job.report.path, guard,
                     [&](const ReportProgress& progress) -> Result<ViewDocument> {
                       auto document = documentOf(*inspected, job.report, progress);
                       if (document.ok()) {
                         found = {document.value().notes, document.value().checks};
                       }
                       return document;
                     });
}

std::string jsonOf(const Found& found, const std::string& report) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.key("checks");
  writeChecks(found.checks, out);
  out.field("notes", found.notes);
  out.field("report", report);
  out.endObject();
  return text + "\n";
}

ExitCode run(const ViewJob& job) {
  FORETOUCH_CHECK_OR(failed, check(job.request));
  Found found;
  FORETOUCH_CHECK_OR(failed, view(job, found));
  const bool outIsTaken = isStandardOutput(job.report.path);
  if (job.json) {
    printOut(jsonOf(found, job.report.path));
  } else {
    for (const std::string& note : found.notes) printNote(note);
    const std::string text = describe(found.checks);
    outIsTaken ? printAside(text) : printOut(text + "report: " + job.report.path + "\n");
  }
  return areUsable(found.checks) ? ExitCode::Done : ExitCode::CheckSaysNo;
}

constexpr char kViewExamples[] = R"(Examples:
  foretouch view room.obj dancer.bvh
  foretouch view --scene kitchen.ply --up z --avatar a.avatar.json --motion walk.bvh --scale 0.01 \
      --place 1.5,0,-2,90 --output kitchen.html

Prints whether unit, axis and place are right; exit code 1 says that one is wrong. Nothing is asked
between poses: `foretouch replay --report` shows contacts.)";

}  // namespace

Command viewCommand() {
  const auto job = std::make_shared<ViewJob>();
  job->report.path = "foretouch-view.html";
  Settings settings;
  addSceneSettings(settings, job->request);
  addAvatarSetting(settings, job->request);
  addMotionSetting(settings, job->request, "--motion", "CLIP");
  settings
      .output("-o,--output", "FILE", job->report.path,
              "The report: a page for a browser, all in one file")
      .in(kOutputGroup);
  settings.whole(
      "--report-triangles", "N", job->report.maxTriangles, 1, kMostReportTriangles,
      "Of a heavier scene the report shows what is near the avatar, or a simplified form");
  settings.asJson(job->json);
  addRateSetting(settings, job->request,
                 "Poses per second to show of the clip; animations: 30 if all");
  addClipSettings(settings, job->request);
  addCutSettings(settings, job->request);
  addFilesSetting(
      settings, job->files,
      "Scene, avatar (json) and clip, any of them; their names or contents tell which is which");
  Command command{"view",
                  "Look at a scene, an avatar or a clip before a run: units, axes, placement",
                  kViewExamples, std::move(settings)};
  command.takesProject = true;
  command.run = [job](const Settings&) { return run(*job); };
  return command;
}

}  // namespace foretouch::tools
