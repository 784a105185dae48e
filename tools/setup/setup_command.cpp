#include "tools/setup/setup_command.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/clip/clip_file.h"
#include "assets/import/model_import.h"
#include "assets/text_file.h"
#include "tools/audit/avatar_files.h"
#include "tools/inputs/file_roles.h"
#include "tools/results_output.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/frame_settings.h"
#include "tools/settings/world_settings.h"
#include "tools/setup/setup.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

/// The values of all options.
struct AskedSetup {
  WorldRequest world;
  ClipRequest clip;
  std::string output = kProjectName;
  std::string on;
  bool yes = false, json = false;
  bool givesPlace = false;
  std::string clipLines;  ///< Project::clipLines.
};

SetupRequest requestOf(const AskedSetup& asked) {
  SetupRequest request;
  request.scene = asked.world.scenePath;
  request.sceneScale = asked.world.sceneImport.scale;
  request.sceneUp = asked.world.sceneImport.up;
  request.body = asked.clip;
  request.on = asked.on;
  if (asked.givesPlace) {
    request.place = asked.clip.placement;
    request.place->motionUpZ = false;
  }
  return request;
}

/// A clip, an avatar or a model with bones: what stands in scenes and is not one.
Result<bool> isBody(const std::string& path) {
  if (clipFormatOf(path) != ClipFormat::Model) {
    FORETOUCH_TRY(const FileRole role, roleOfFile(path));
    return role == FileRole::Clip || role == FileRole::Avatar;
  }
  FORETOUCH_TRY(const auto model, importModel(path));
  return holdsBody(model);
}

/// The scene and the body may come in any order if only one of them can be the body. What cannot
/// be read stays in its place, whose reader says why.
void sortFiles(AskedSetup& asked) {
  std::string &scene = asked.world.scenePath, &body = asked.clip.motionPath;
  const auto second = isBody(body);  // first, as scenes are large
  if (!second.ok() || second.value()) return;
  const auto first = isBody(scene);
  if (first.ok() && first.value()) std::swap(scene, body);
}

/// The avatar's file: as given, or a new one beside the project.
std::string avatarPathOf(const AskedSetup& asked, const SetupRequest& request) {
  if (!makesAvatar(request.body)) return request.body.avatarPath;
  const std::string body = fs::path(bodyFileOf(request.body)).stem().string();
  return (fs::path(asked.output).parent_path() / (body + ".avatar.json")).string();
}

/// The path as the project's folder sees it. An absolute path stays one.
std::string besideProject(const std::string& path, const std::string& project) {
  if (path.empty() || fs::path(path).is_absolute()) return path;
  const fs::path folder = fs::path(project).parent_path();
  std::error_code failed;
  const fs::path seen = fs::proximate(path, folder.empty() ? fs::path(".") : folder, failed);
  return failed ? fs::absolute(path).string() : seen.string();
}

/// A file that is there already stays, under another name.
Result<Done> keepOld(const std::string& path, std::vector<std::string>& written) {
  std::error_code failed;
  if (!fs::exists(path, failed)) return Done{};
  std::string old = path + "~";
  for (int k = 2; fs::exists(old, failed); ++k) old = path + "~" + std::to_string(k);
  fs::rename(path, old, failed);
  if (failed) {
    return Error::in(path, ErrorCode::FileUnwritable,
                     "exists, and cannot be renamed to " + inQuotes(old));
  }
  written.push_back(old + " (what " + path + " was)");
  return Done{};
}

Result<Done> writeText(const std::string& path, const std::string& text) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  return file.commit();
}

/// Writes the avatar first, so that a project never names a missing file.
Result<std::vector<std::string>> writeFiles(const AskedSetup& asked, const Setup& setup,
                                            const std::string& avatarPath) {
  std::vector<std::string> written;
  if (isSameFile(asked.output, avatarPath)) {
    return Error::in(asked.output, ErrorCode::FileUnwritable,
                     "is the avatar's file as well; expected another one for the project");
  }
  if (makesAvatar(setup.request.body)) {
    FORETOUCH_CHECK(keepOld(avatarPath, written));
    FORETOUCH_CHECK(setup.body.ofModel ? writeModelAvatar(*setup.body.ofModel, avatarPath)
                                       : writeAvatarFile(*setup.body.avatar, avatarPath));
    written.push_back(avatarPath);
  }
  Project project = projectOf(setup, avatarPath);
  project.clipLines = asked.clipLines;
  std::vector<std::string*> paths{&project.scene, &project.avatar, &project.clip, &project.jointMap,
                                  &project.robot};
  for (std::string& package : project.packages) paths.push_back(&package);
  for (std::string* const path : paths) *path = besideProject(*path, asked.output);
  FORETOUCH_CHECK(keepOld(asked.output, written));
  FORETOUCH_TRY(const auto text,
                projectText(project, fs::path(asked.output).parent_path().string()));
  FORETOUCH_CHECK(writeText(asked.output, text));
  written.push_back(asked.output);
  return written;
}

/// What to type next. The project in the current folder needs no name.
std::vector<std::string> nextCommands(const AskedSetup& asked, const Setup& setup) {
  const std::string project = asked.output == kProjectName ? "" : " --project " + asked.output;
  std::vector<std::string> next = {"foretouch view" + project};
  if (setup.body.clip && setup.body.clip->frames.size() > 1) {
    next.push_back("foretouch replay" + project +
                   " --rate 10 --output contacts.jsonl --report contacts.html");
  }
  return next;
}

bool isTerminal() {
  return isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1;
}

/// The line that the user types; nothing at the end of input.
std::optional<std::string> ask(const std::string& question) {
  printOut(question);
  std::cout.flush();
  std::string line;
  if (!std::getline(std::cin, line)) return std::nullopt;
  return line;
}

/// Shows what was found; the user may answer an option in place of it, as often as needed. False:
/// the user wants nothing written.
Result<bool> talk(const AskedSetup& asked, SetupRequest request, const std::string& meshFile,
                  Setup& setup) {
  for (;;) {
    printOut(describe(setup));
    for (const std::string& note : setup.notes) printNote(note);
    const auto line = ask("\nWrite " + asked.output +
                          "? [Enter: yes; n: no; or an option to change, such as --clip-scale "
                          "0.01 or --place 1,0,-2,90] ");
    if (!line || *line == "n" || *line == "no") return false;
    if (line->empty() || *line == "y" || *line == "yes") return true;
    const std::size_t space = line->find(' ');
    const std::string option = line->substr(0, space);
    const std::string value = space == line->npos ? "" : line->substr(space + 1);
    WorldRequest world;
    ClipRequest clip;
    Settings settings;
    addSceneSettings(settings, world);
    addClipSettings(settings, clip);
    bool isKnown = false;
    for (Setting& setting : settings) {
      if (setting.name() != option) continue;
      isKnown = true;
      const auto taken = takeTyped(setting, {value});
      if (!taken.ok()) printError(describe(taken.error()));
    }
    if (!isKnown) {
      printError(option +
                 ": expected --scene-scale, --scene-up, --clip-scale, --clip-up or --place");
      continue;
    }
    if (world.sceneImport.scale) request.sceneScale = world.sceneImport.scale;
    if (world.sceneImport.up) request.sceneUp = world.sceneImport.up;
    if (clip.motionScale) request.body.motionScale = clip.motionScale;
    if (clip.motionUp) request.body.motionUp = clip.motionUp;
    if (settings.isGiven("--place")) request.place = clip.placement;
    FORETOUCH_TRY(setup, findSetup(request, meshFile));
  }
}

std::string jsonOf(const Setup& setup, const std::vector<std::string>& written,
                   const std::vector<std::string>& next) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  writeSetup(setup, out);
  out.field("written", written);
  out.field("next", next);
  out.endObject();
  return text + "\n";
}

std::string closingText(const std::vector<std::string>& written,
                        const std::vector<std::string>& next) {
  std::string text = "\n";
  for (const std::string& file : written) text += "wrote " + file + "\n";
  if (written.empty()) text += "nothing was written: --yes writes the project\n";
  text += "next:\n";
  for (const std::string& command : next) text += "  " + command + "\n";
  return text;
}

ExitCode run(AskedSetup& asked) {
  if (asked.output == kStandardOutput) {
    return failed(Error::in("--output", ErrorCode::Mismatch,
                            "expected a file, as a project names its files from where it lies; "
                            "--json tells what setup finds on standard output"));
  }
  sortFiles(asked);
  const SetupRequest request = requestOf(asked);
  const std::string avatarPath = avatarPathOf(asked, request);
  const std::string meshFile = meshFileOf(avatarPath);
  for (const std::string& output : {asked.output, avatarPath}) {
    if (output == request.body.avatarPath) continue;
    FORETOUCH_CHECK_OR(
        failed,
        checkIsNoInput(output, {request.scene, request.body.motionPath, request.body.avatarPath,
                                request.body.mapPath, request.body.robotPath}));
  }
  FORETOUCH_TRY_OR(failed, auto setup, findSetup(request, meshFile));
  bool writes = asked.yes;
  const bool talks = !asked.yes && !asked.json && isTerminal();
  if (talks) {
    FORETOUCH_TRY_OR(failed, writes, talk(asked, request, meshFile, setup));
  }
  std::vector<std::string> written;
  if (writes) {
    FORETOUCH_TRY_OR(failed, written, writeFiles(asked, setup, avatarPath));
  }
  const auto next = nextCommands(asked, setup);
  if (asked.json) {
    printOut(jsonOf(setup, written, next));
  } else {
    if (!talks) {
      printOut(describe(setup));
      for (const std::string& note : setup.notes) printNote(note);
    }
    printOut(closingText(written, next));
  }
  return setup.isUsable() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

/// What was said about the clip, as a project keeps it: all but paths, and what setup settles.
std::string clipLinesOf(const Settings& given) {
  std::string lines;
  for (const Setting& setting : given) {
    const bool isKept = setting.isGiven && setting.table == "clip" && !setting.isPath &&
                        setting.key != "scale" && setting.key != "up" && setting.key != "place";
    if (isKept) lines += setting.key + " = " + setting.json() + "\n";
  }
  return lines;
}

constexpr char kSetupExamples[] = R"(Examples:
  foretouch setup kitchen.ply walk.bvh
  foretouch setup level.obj man.glb --yes
  foretouch setup level.obj run.fbx --avatar man.fbx --yes --json
  foretouch setup level.obj walk.bvh --skip-t-pose
  foretouch setup hall.obj walk1_subject1.csv --robot g1.urdf --columns lafan1-g1

What an option says is not asked again. Exit code 1 says that something is wrong, and what.)";

}  // namespace

Command setupCommand() {
  const auto asked = std::make_shared<AskedSetup>();
  Settings settings;
  addSceneSettings(settings, asked->world);
  Setting& scene = settings.of("--scene").required("a scene, and a clip or a model");
  scene.option = "scene";
  scene.value = "SCENE";
  addMotionSetting(settings, asked->clip, "body", "CLIP|MODEL",
                   "BVH clip, model with or without an animation (glb, gltf, vrm, fbx, dae, x), or "
                   "joint positions of a robot (csv, npz)")
      .required("a clip or a model behind the scene");
  settings
      .path("--avatar", "FILE|MODEL", asked->clip.avatarPath,
            "The body, if it is in another file: an avatar or a model; made of the clip if not "
            "given")
      .in(kInputGroup);
  addClipSettings(settings, asked->clip);
  addCutSettings(settings, asked->clip);
  settings
      .text("--on", "OBJECT", asked->on,
            "Stand on this object, a roof or a table; `*` at an end stands for anything. Else on "
            "the floor that most of the scene is reached from")
      .in(kUnitsGroup);
  settings.output("-o,--output", "FILE", asked->output, "Project file to write");
  settings.flag("--yes", asked->yes, "Write what is offered, without asking").in(kOutputGroup);
  settings.asJson(asked->json);
  Command command{"setup",
                  "Find unit, axis and place of a scene and a body, and write a project for them",
                  kSetupExamples, std::move(settings)};
  command.run = [asked](const Settings& given) {
    asked->givesPlace = given.isGiven("--place");
    asked->clipLines = clipLinesOf(given);
    return run(*asked);
  };
  return command;
}

}  // namespace foretouch::tools
