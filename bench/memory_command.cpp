#include "bench/memory_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "bench/memory.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct MemoryTexts {
  std::string scene, avatar, policy, sceneScale = "1", up = "y", fidelity = "link";
};

Result<ReplayRequest> settled(const MemoryTexts& texts) {
  ReplayRequest request;
  request.scenePath = texts.scene;
  request.avatarPath = texts.avatar;
  Settling settle;
  settle.into(request.sceneScale, parsePositive("--scene-scale", texts.sceneScale));
  settle.into(request.sceneUp, parseUpAxis("--up", texts.up));
  settle.into(request.fidelity, parseFidelity("--fidelity", texts.fidelity));
  if (!texts.policy.empty()) settle.into(request.policies, readPolicyFile(texts.policy));
  if (settle.error()) return *settle.error();
  if (request.fidelity != Fidelity::Link && request.fidelity != Fidelity::Exact) {
    return Error{ErrorCode::OutOfRange, "--fidelity", -1, -1, "expected link or exact"};
  }
  return request;
}

ExitCode run(const MemoryTexts& texts) {
  const auto request = settled(texts);
  if (!request.ok()) return failed(request.error());
  const auto bench = measureMemory(request.value());
  if (!bench.ok()) return failed(bench.error());
  printOut(memoryTable(bench.value()));
  return ExitCode::Done;
}

}  // namespace

void addBenchMemoryCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<MemoryTexts>();
  CLI::App* const command = bench.add_subcommand(
      "memory", "What a scene and an avatar cost in time and memory before the first answer");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    return command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--scene", texts->scene, "FILE", "Scene: any mesh format that assimp reads")->required();
  option("--avatar", texts->avatar, "FILE", "Avatar file (see foretouch avatar)")->required();
  option("--scene-scale", texts->sceneScale, "S", "Metres per unit of the scene");
  option("--up", texts->up, "y|z", "Which axis of the scene points up");
  option("--fidelity", texts->fidelity, "link|exact", "What touches, where no policy says more");
  option("--policy", texts->policy, "FILE", "As of replay: [[policy]] tables");
  command->footer(
      "Example:\n  foretouch-bench memory --scene kitchen.ply --up z --avatar man.avatar.json "
      "--fidelity exact");
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
