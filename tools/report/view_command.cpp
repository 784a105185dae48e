#include "tools/report/view_command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "assets/text_file.h"
#include "tools/arguments.h"
#include "tools/inputs/clip_options.h"
#include "tools/interrupt.h"
#include "tools/log/replay_log.h"
#include "tools/report/inspection.h"
#include "tools/report/report_file.h"
#include "tools/results_output.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

/// Values as typed in.
struct ViewTexts {
  std::vector<std::string> files;
  ClipTexts clip;
  std::string scene, avatar, motion, output = "foretouch-view.html", sceneScale = "1", up = "y",
                                     triangles = std::to_string(kDefaultViewTriangles);
};

struct ViewJob {
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

Error fileError(const std::string& path, std::string message) {
  return Error{ErrorCode::Mismatch, path, -1, -1, std::move(message)};
}

/// Gives files without an option the one that their names speak of.
Result<Done> assignFiles(const std::vector<std::string>& files, ReplayRequest& request) {
  for (const std::string& file : files) {
    std::string* place = nullptr;
    switch (roleOf(file)) {
      case FileRole::Scene: place = &request.scenePath; break;
      case FileRole::Avatar: place = &request.avatarPath; break;
      case FileRole::Motion: place = &request.motionPath; break;
      case FileRole::Several:
        return fileError(file,
                         "may be a scene or a motion; expected --scene or --motion before it");
      case FileRole::Unknown:
        return fileError(file,
                         "its name does not say what it is; expected --scene, --avatar or --motion "
                         "before it");
    }
    if (!place->empty()) {
      return fileError(file, "is one too many; expected at most one of its kind, found " +
                                 inQuotes(*place) + " as well");
    }
    *place = file;
  }
  return Done{};
}

Result<ViewJob> settled(const ViewTexts& texts) {
  ViewJob job;
  ReplayRequest& request = job.request;
  request.scenePath = texts.scene;
  request.avatarPath = texts.avatar;
  request.motionPath = texts.motion;
  job.report.path = texts.output;
  Settling settle;
  settle.require(assignFiles(texts.files, request));
  settleClip(texts.clip, settle, request);
  settle.into(request.sceneUp, parseUpAxis("--up", texts.up));
  settle.into(request.sceneScale, parsePositive("--scene-scale", texts.sceneScale));
  settle.into(job.report.maxTriangles, parseReportTriangles("--report-triangles", texts.triangles));
  if (settle.error()) return *settle.error();
  if (request.scenePath.empty() && request.avatarPath.empty() && request.motionPath.empty()) {
    return Error{ErrorCode::Empty, "view", -1, -1, "expected a scene, an avatar or a motion"};
  }
  if (isEventLog(request.motionPath)) {
    return fileError(request.motionPath,
                     "is an event log; expected a clip. `foretouch replay --report` shows logs");
  }
  return job;
}

Result<Done> view(const ViewJob& job, std::vector<std::string>& notes) {
  const ReplayRequest& request = job.request;
  const auto checked =
      checkOutput(job.report.path, {request.scenePath, request.avatarPath, request.motionPath,
                                    request.robotPath, request.mapPath});
  if (!checked.ok()) return checked;
  const auto inspected = inspect(request);
  if (!inspected.ok()) return inspected.error();
  const InterruptGuard guard;
  return writeReport(job.report.path, guard,
                     [&](const ReportProgress& progress) -> Result<ViewDocument> {
                       auto document = documentOf(*inspected.value(), job.report, progress);
                       if (document.ok()) notes = document.value().notes;
                       return document;
                     });
}

ExitCode runTexts(const ViewTexts& texts) {
  const auto job = settled(texts);
  if (!job.ok()) return failed(job.error());
  std::vector<std::string> notes;
  const auto done = view(job.value(), notes);
  if (!done.ok()) return failed(done.error());
  for (const std::string& note : notes) printNote(note);
  const std::string& path = job.value().report.path;
  if (!isStandardOutput(path)) printOut("report: " + path + "\n");
  return ExitCode::Done;
}

constexpr char kViewExamples[] = R"(Examples:
  foretouch view room.obj dancer.bvh
  foretouch view --scene kitchen.ply --up z --avatar a.avatar.json --motion walk.bvh --scale 0.01 \
      --place 1.5,0,-2,90 --output kitchen.html

Nothing is asked of the motion: `foretouch replay --report` shows contacts.)";

}  // namespace

void addViewCommand(CLI::App& program, ExitCode& exit) {
  const auto texts = std::make_shared<ViewTexts>();
  CLI::App* const command = program.add_subcommand(
      "view", "Look at a scene, an avatar or a clip before a run: units, axes, placement");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    return command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  command
      ->add_option(
          "files", texts->files,
          "Scene (obj, ply, stl, off, 3ds), avatar (json) and clip (bvh, csv), any of them")
      ->type_name("FILE");
  option("--scene", texts->scene, "FILE", "Scene: any mesh format that assimp reads");
  option("--avatar", texts->avatar, "FILE", "Avatar file (see foretouch avatar)");
  option("--motion", texts->motion, "CLIP",
         "BVH clip, animated model (glb, gltf, fbx, dae, x) or joint positions (csv)");
  option("--output", texts->output, "FILE", "The report: a page for a browser, all in one file");
  option("--report-triangles", texts->triangles, "N",
         "Of a heavier scene the report shows what is near the avatar, or a simplified form");
  option("--rate", texts->clip.rate, "HZ",
         "Poses a second to show of the clip; animations: 30 if all");
  addClipOptions(*command, texts->clip);
  option("--scene-scale", texts->sceneScale, "S", "Metres per unit of the scene");
  option("--up", texts->up, "y|z", "Which axis of the scene points up");
  command->footer(kViewExamples);
  command->callback([texts, &exit] { exit = runTexts(*texts); });
}

}  // namespace foretouch::tools
