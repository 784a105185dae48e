#include "tools/report/view_command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/arguments.h"
#include "tools/interrupt.h"
#include "tools/log/replay_log.h"
#include "tools/report/inspection.h"
#include "tools/report/report_file.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct ViewJob {
  std::vector<std::string> files;  ///< Their names tell their role.
  ReplayRequest request;
  ReportOptions report;
};

/// What a file can be, by its name alone.
enum class FileRole : std::uint8_t { Scene, Avatar, Motion, Several, Unknown };

FileRole roleOf(const std::string& path) {
  using namespace std::string_view_literals;
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto isOneOf = [&](const auto& extensions) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
  };
  if (isOneOf(std::array{".obj"sv, ".ply"sv, ".stl"sv, ".off"sv, ".3ds"sv})) return FileRole::Scene;
  if (extension == ".json") return FileRole::Avatar;
  if (isOneOf(std::array{".bvh"sv, ".csv"sv})) return FileRole::Motion;
  if (isOneOf(std::array{".glb"sv, ".gltf"sv, ".fbx"sv, ".dae"sv, ".x"sv})) {
    return FileRole::Several;
  }
  return FileRole::Unknown;
}

/// Assigns files without an option by their names.
Result<Done> assignFiles(const std::vector<std::string>& files, ReplayRequest& request) {
  for (const std::string& file : files) {
    std::string* place = nullptr;
    switch (roleOf(file)) {
      case FileRole::Scene: place = &request.scenePath; break;
      case FileRole::Avatar: place = &request.avatarPath; break;
      case FileRole::Motion: place = &request.motionPath; break;
      case FileRole::Several:
        return Error::in(file, ErrorCode::Mismatch,
                         "may be a scene or a motion; expected --scene or --motion before it");
      case FileRole::Unknown:
        return Error::in(file, ErrorCode::Mismatch,
                         "its name does not say what it is; expected --scene, --avatar or --motion "
                         "before it");
    }
    if (!place->empty()) {
      return Error::in(file, ErrorCode::Mismatch,
                       "is a second one of its kind; expected at most one, found " +
                           inQuotes(*place) + " as well");
    }
    *place = file;
  }
  return Done{};
}

Result<Done> check(ViewJob& job) {
  ReplayRequest& request = job.request;
  const auto assigned = assignFiles(job.files, request);
  if (!assigned.ok()) return assigned;
  if (request.scenePath.empty() && request.avatarPath.empty() && request.motionPath.empty()) {
    return Error::in("view", ErrorCode::Empty, "expected a scene, an avatar or a motion");
  }
  if (isEventLog(request.motionPath)) {
    return Error::in(request.motionPath, ErrorCode::Mismatch,
                     "is an event log; expected a clip. `foretouch replay --report` shows logs");
  }
  return Done{};
}

Result<Done> view(const ViewJob& job, std::vector<std::string>& notes) {
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
                       if (document.ok()) notes = document.value().notes;
                       return document;
                     });
}

ExitCode run(ViewJob job) {
  FORETOUCH_CHECK_OR(failed, check(job));
  std::vector<std::string> notes;
  FORETOUCH_CHECK_OR(failed, view(job, notes));
  for (const std::string& note : notes) printNote(note);
  if (!isStandardOutput(job.report.path)) printOut("report: " + job.report.path + "\n");
  return ExitCode::Done;
}

constexpr char kViewExamples[] = R"(Examples:
  foretouch view room.obj dancer.bvh
  foretouch view --scene kitchen.ply --up z --avatar a.avatar.json --motion walk.bvh --scale 0.01 \
      --place 1.5,0,-2,90 --output kitchen.html

Nothing is asked of the motion: `foretouch replay --report` shows contacts.)";

}  // namespace

Command viewCommand() {
  const auto job = std::make_shared<ViewJob>();
  job->report.path = "foretouch-view.html";
  Settings settings;
  settings.list("files", "FILE", job->files,
                "Scene (obj, ply, stl, off, 3ds), avatar (json) and clip (bvh, csv), any of them");
  addSceneSettings(settings, job->request);
  addAvatarSetting(settings, job->request);
  addMotionSetting(settings, job->request, "--motion", "CLIP");
  settings.path("--output", "FILE", job->report.path,
                "The report: a page for a browser, all in one file");
  settings.whole(
      "--report-triangles", "N", job->report.maxTriangles, 1, kMostReportTriangles,
      "Of a heavier scene the report shows what is near the avatar, or a simplified form");
  addRateSetting(settings, job->request,
                 "Poses per second to show of the clip; animations: 30 if all");
  addClipSettings(settings, job->request);
  Command command{"view",
                  "Look at a scene, an avatar or a clip before a run: units, axes, placement",
                  kViewExamples, std::move(settings)};
  command.takesProject = true;
  command.run = [job](const Settings&) { return run(*job); };
  return command;
}

}  // namespace foretouch::tools
