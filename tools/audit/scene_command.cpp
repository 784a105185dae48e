#include "tools/audit/scene_command.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/import/scene_import.h"
#include "assets/json_writer.h"
#include "middleware/scene/scene.h"
#include "tools/audit/audit_json.h"
#include "tools/audit/audits.h"
#include "tools/inputs/first_pose.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

std::string describe(const SceneImportReport& report) {
  return fmt::format(
      "  {:<25}{}\n  {:<25}{} of {} different meshes\n  {:<25}{} points and lines, {} broken "
      "faces\n",
      "nodes", report.nodes, "mesh instances", report.meshInstances, report.uniqueMeshes,
      "left out by import", report.skippedPrimitives, report.skippedFaces);
}

/// The values of all options.
struct AskedScene : WorldRequest {
  bool asJson = false;
  std::string bakedPath;
};

/// `scene check` and `scene bake` name their scene without an option.
Settings settingsFor(AskedScene& asked) {
  Settings settings;
  addSceneSettings(settings, asked);
  Setting& scene = settings.of("--scene").required("a scene file");
  scene.option = "scene";
  scene.value = "SCENE";
  return settings;
}

std::string sceneJson(const AskedScene& asked, const Scene& scene, const SceneImportReport& report,
                      const std::vector<std::string>& doubts) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("scene", asked.scenePath);
  writeFields(scene.audit(), out);
  writeFields(report, out);
  writeObjects(scene, out);
  out.field("doubts", doubts);
  out.endObject();
  return text + "\n";
}

void remarkOn(const AskedScene& asked, const LoadedScene& loaded) {
  if (const std::string weak = importerWeakness(); !weak.empty()) printNote(weak);
  printNotes(asked.scenePath, loaded.report.notes);
  if (const auto remark =
          remarkOnFrame(loaded.frame, {"--scene-scale", "--scene-up"}, asked.scenePath)) {
    printNote(*remark);
  }
}

ExitCode bake(const AskedScene& asked) {
  FORETOUCH_TRY_OR(failed, const auto loaded,
                   bakeScene(asked.scenePath, asked.sceneImport, asked.bakedPath));
  remarkOn(asked, loaded);
  return ExitCode::Done;
}

ExitCode check(const AskedScene& asked) {
  // Builds the scene, not only measures it: a replay accepts every scene that passes here.
  FORETOUCH_TRY_OR(failed, const auto loaded, readScene(asked.scenePath, asked.sceneImport));
  const auto& [scene, report, frame] = loaded;
  remarkOn(asked, loaded);
  FORETOUCH_CHECK_OR(failed, inFile(checkScene(scene), asked.scenePath));
  const SceneAudit& audit = scene.audit();
  const std::vector<std::string> doubts = doubtsAbout(audit);
  printOut(asked.asJson ? sceneJson(asked, scene, report, doubts)
                        : asked.scenePath + "\n" + tools::describe(audit) + describe(report) +
                              rowOf(frame) + "\n" + largestObjects(scene));
  for (const std::string& doubt : doubts) printError(asked.scenePath + ": " + doubt);
  return doubts.empty() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

}  // namespace

Command sceneCommand() {
  const auto asked = std::make_shared<AskedScene>();
  Settings settings = settingsFor(*asked);
  settings.asJson(asked->asJson);
  Command check{"check", "Measure a scene; exit code 1 where its size or its triangles are amiss",
                "Example:\n  foretouch scene check kitchen.ply --scene-up z", std::move(settings)};
  check.takesProject = true;
  check.run = [asked](const Settings&) { return tools::check(*asked); };
  Settings baking = settingsFor(*asked);
  baking.output("-o,--output", "FILE", asked->bakedPath, "The baked scene").required();
  Command bake{"bake", "Write a scene as a file that every command reads in milliseconds",
               "Example:\n  foretouch scene bake kitchen.ply --scene-up z -o kitchen.ftscene",
               std::move(baking)};
  bake.run = [asked](const Settings&) { return tools::bake(*asked); };
  Command command{"scene", "Check and bake scenes"};
  command.commands.push_back(std::move(check));
  command.commands.push_back(std::move(bake));
  return command;
}

}  // namespace foretouch::tools
