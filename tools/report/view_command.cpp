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
#include "assets/import/model_import.h"
#include "assets/json_writer.h"
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
  bool json = false;
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

/// A model is a motion if it holds an animation, else a scene; one that holds neither animation nor
/// triangles is left to the reader of scenes, which says so.
Result<FileRole> roleOfModel(const std::string& file) {
  FORETOUCH_TRY(const auto model, importModel(file));
  const bool hasBones = std::any_of(model.meshes.begin(), model.meshes.end(),
                                    [](const ModelMesh& mesh) { return !mesh.bones.empty(); });
  if (model.animations.empty() && hasBones) {
    return Error::in(file, ErrorCode::Mismatch,
                     "is a body without an animation; expected --scene before it, or foretouch "
                     "avatar mesh to make an avatar of it");
  }
  return model.animations.empty() ? FileRole::Scene : FileRole::Motion;
}

/// Assigns files without an option by their names, models by what is in them.
Result<Done> assignFiles(const std::vector<std::string>& files, ReplayRequest& request) {
  for (const std::string& file : files) {
    FileRole role = roleOf(file);
    if (role == FileRole::Several) {
      FORETOUCH_TRY(role, roleOfModel(file));
    }
    std::string* place = nullptr;
    switch (role) {
      case FileRole::Scene: place = &request.scenePath; break;
      case FileRole::Avatar: place = &request.avatarPath; break;
      case FileRole::Motion: place = &request.motionPath; break;
      case FileRole::Several:
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

/// What the page says, for those who read it elsewhere.
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

ExitCode run(ViewJob job) {
  FORETOUCH_CHECK_OR(failed, check(job));
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
  settings.list(
      "files", "FILE", job->files,
      "Scene, avatar (json) and clip, any of them; their names or contents tell which is which");
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
  Command command{"view",
                  "Look at a scene, an avatar or a clip before a run: units, axes, placement",
                  kViewExamples, std::move(settings)};
  command.takesProject = true;
  command.run = [job](const Settings&) { return run(*job); };
  return command;
}

}  // namespace foretouch::tools
