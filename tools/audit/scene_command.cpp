#include "tools/audit/scene_command.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assets/import/scene_import.h"
#include "middleware/scene/scene.h"
#include "tools/arguments.h"
#include "tools/audit/audits.h"

namespace foretouch::tools {
namespace {

struct SceneTexts {
  std::string scene, up = "y", scale = "1";
};

std::string describe(const SceneImportReport& report) {
  return fmt::format(
      "  {:<25}{}\n  {:<25}{} of {} different meshes\n  {:<25}{} points and lines, {} broken "
      "faces\n",
      "nodes", report.nodes, "mesh instances", report.meshInstances, report.uniqueMeshes,
      "left out by import", report.skippedPrimitives, report.skippedFaces);
}

ExitCode check(const SceneTexts& texts) {
  SceneImportOptions options;
  const auto up = parseUpAxis("--up", texts.up);
  if (!up.ok()) return failed(up.error());
  options.up = up.value();
  const auto scale = parsePositive("--scene-scale", texts.scale);
  if (!scale.ok()) return failed(scale.error());
  options.scale = scale.value();
  auto imported = importScene(texts.scene, options);
  if (!imported.ok()) return failed(inFile(imported.error(), texts.scene));
  const SceneImportReport report = imported.value().report;
  // Built, not only measured: a scene that passes here is one that a replay takes.
  const auto scene = Scene::build(std::move(imported.value().scene));
  if (!scene.ok()) return failed(inFile(scene.error(), texts.scene));

  const SceneAudit& audit = scene.value().audit();
  printOut(texts.scene + "\n" + tools::describe(audit) + describe(report) + "\n" +
           largestObjects(scene.value()));
  const std::vector<std::string> doubts = doubtsAbout(audit);
  for (const std::string& doubt : doubts) printError(texts.scene + ": " + doubt);
  return doubts.empty() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

}  // namespace

void addSceneCommand(CLI::App& program, ExitCode& exit) {
  CLI::App* const scene = program.add_subcommand("scene", "Check scenes");
  scene->require_subcommand(1);
  const auto texts = std::make_shared<SceneTexts>();
  CLI::App* const command = scene->add_subcommand(
      "check", "Measure a scene; exit code 1 where its size or its triangles are amiss");
  command->add_option("scene", texts->scene, "Scene: any mesh format that assimp reads")
      ->type_name("SCENE")
      ->required();
  command->add_option("--up", texts->up, "Which axis of the scene points up")
      ->type_name("y|z")
      ->capture_default_str();
  command->add_option("--scene-scale", texts->scale, "Metres per unit of the scene")
      ->type_name("S")
      ->capture_default_str();
  command->footer("Example:\n  foretouch scene check kitchen.ply --up z");
  command->callback([texts, &exit] { exit = check(*texts); });
}

}  // namespace foretouch::tools
