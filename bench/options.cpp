#include "bench/options.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/mesh/link_mesh.h"
#include "assets/text_file.h"
#include "bench/machine.h"
#include "bench/scene.h"
#include "bench/surface.h"
#include "lss/index.h"
#include "tools/arguments.h"
#include "tools/console.h"
#include "tools/inputs/skin_file.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

template <typename Value, typename Parse>
Result<std::vector<Value>> parseEach(const std::string& text, const Parse& parse) {
  std::vector<Value> values;
  for (const std::string& part : splitAtCommas(text)) {
    FORETOUCH_TRY(const auto value, parse(part));
    values.push_back(value);
  }
  return values;
}

/// One of two words, as toString() has them.
template <typename Value>
Result<Value> parseWord(const std::string& option, const std::string& text,
                        const std::array<Value, 2>& values) {
  for (const Value value : values) {
    if (text == toString(value)) return value;
  }
  return Error::in(option, ErrorCode::UnknownName,
                   std::string("expected ") + toString(values[0]) + " or " + toString(values[1]) +
                       ", found " + inQuotes(text));
}

/// Of volumes that only the reference room asks.
std::optional<Rung> rungNamed(const std::string& word) {
  for (const Rung rung : {Rung::Limb, Rung::Avatar, Rung::Ellipsoid}) {
    if (word == toString(rung)) return rung;
  }
  return std::nullopt;
}

std::string nameOf(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

bool hasMeshes(const Avatar& avatar) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (!avatar.mesh(link).file.empty()) return true;
  }
  return false;
}

void settleFiles(const BenchTexts& texts, Settling& settle, BenchFiles& files) {
  files.scenePath = texts.scene;
  files.motionPath = texts.motion;
  files.avatarPath = texts.avatar;
  files.mapPath = texts.map;
  settle.into(files.sceneScale, parsePositive("--scene-scale", texts.sceneScale));
  settle.into(files.motionScale, parsePositive("--clip-scale", texts.scale));
  settle.into(files.sceneUp, parseUpAxis("--scene-up", texts.up));
  settle.into(files.motionUp, parseUpAxis("--clip-up", texts.motionUp));
}

void settleWorkload(const BenchTexts& texts, Settling& settle, WorkloadRequest& workload) {
  constexpr int kMaxSeed = 1'000'000'000;
  int steps = 0, seed = 1;
  settle.into(steps, parseCount("--steps", texts.steps, kMaxBenchSteps));
  settle.into(seed, parseCount("--seed", texts.seed, kMaxSeed));
  if (texts.choice == "mix") {
    workload.choice = StepChoice::Mix;
  } else if (texts.choice != "busy") {
    settle.require(
        Result<Done>(Error::in("--choice", ErrorCode::OutOfRange,
                               "expected busy or mix, found " + inQuotes(texts.choice))));
  }
  settle.into(workload.mostPlacements, parseCount("--places", texts.places, kMaxBenchSteps));
  settle.into(workload.floorY, parseNumber("--floor", texts.floor));
  settle.into(workload.liftM, parseNumber("--lift", texts.lift));
  workload.steps = countOf(steps);
  workload.seed = static_cast<std::uint64_t>(seed);
  if (texts.place.empty()) return;
  Placement place;
  settle.into(place, parsePlacement("--place", texts.place));
  workload.place = place;
}

}  // namespace

Result<std::vector<double>> parsePositives(const std::string& option, const std::string& text) {
  return parseEach<double>(text, [&](const auto& part) { return parsePositive(option, part); });
}

Result<std::vector<double>> parseTolerances(const std::string& option, const std::string& text) {
  return parseEach<double>(text, [&](const auto& part) { return parseTolerance(option, part); });
}

Result<std::vector<int>> parseCounts(const std::string& option, const std::string& text, int most) {
  return parseEach<int>(text, [&](const auto& part) { return parseCount(option, part, most); });
}

Result<int> parseOwnOrCount(const std::string& option, const std::string& text, int most) {
  return text == "own" ? Result<int>(0) : parseCount(option, text, most);
}

Result<std::vector<Simd>> parseSimds(const std::string& option, const std::string& text) {
  std::vector<Simd> supported = supportedSimd();
  if (text == "widest") return std::vector<Simd>{supported.back()};
  if (text == "all") {
    std::reverse(supported.begin(), supported.end());
    return supported;
  }
  return parseEach<Simd>(text, [&](const std::string& part) -> Result<Simd> {
    const auto simd = simdFromName(part);
    if (simd && std::find(supported.begin(), supported.end(), *simd) != supported.end()) {
      return *simd;
    }
    std::string names;
    for (const Simd one : supported) names += std::string(toString(one)) + ", ";
    return Error::in(option, ErrorCode::UnknownName,
                     "expected " + names + "all or widest, found " + inQuotes(part));
  });
}

void addBenchOptions(CLI::App& command, BenchTexts& texts) {
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command.add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--scene", texts.scene, "FILE", "Scene; the bundled room if not given");
  option("--motion", texts.motion, "CLIP", "Clip; the bundled one if not given");
  option("--avatar", texts.avatar, "FILE", "Avatar; one LSS a bone of the clip if not given");
  option("--map", texts.map, "FILE", "Joint names that differ, as for replay");
  option("--clip-scale,--scale", texts.scale, "S", "Metres per unit of the clip");
  option("--clip-up,--motion-up", texts.motionUp, "y|z", "Which axis of the clip points up");
  option("--scene-scale", texts.sceneScale, "S", "Metres per unit of the scene");
  option("--scene-up,--up", texts.up, "y|z", "Which axis of the scene points up");
  option("--place", texts.place, "X,Y,Z[,YAW]",
         "Every step at this one place, as replay has it, instead of a choice");
  option("--choice", texts.choice, "busy|mix",
         "All steps at busy places, or a mix of which hardly a step is easy");
  option("--places", texts.places, "N", "Places tried at most");
  option("--floor", texts.floor, "Y", "Height (m) of the scene's floor");
  option("--lift", texts.lift, "M", "The clip's lowest point stays so far (m) above the floor");
  option("--steps", texts.steps, "N", "Steps, if so many are found");
  option("--seed", texts.seed, "N", "Of the places, and of the choice among their steps");
  option("--repeat", texts.repeat, "N", "How often to ask each step");
  option("--processor", texts.processor, "N", "Keep to this processor");
  option("--fidelity", texts.fidelity, "RUNG",
         "What touches: ellipsoid, avatar, limb, link, exact or skinned");
  option("--skin", texts.skin, "FILE",
         "At skinned fidelity: the model that the avatar was made of");
  option("--descent", texts.descent, "straight|by-need",
         "Whether a query first checks if anything is within the avatar's reach");
  option("--leaves", texts.leaves, "advancement|cubics",
         "How exact fidelity tests pairs of triangles; both keep the promise");
  option("--culler", texts.culler, "flat|point-query", "How to cull; both give the same answers");
  option("--surface-triangles", texts.surfaceTriangles, "N",
         "Of an avatar without meshes, at exact fidelity: the skins of its LSS");
  option("--json", texts.json, "FILE", "Also write the figures to a file");
  option("--csv", texts.csv, "FILE", "Also write one line per step to a file");
}

Result<BenchOptions> settled(const BenchTexts& texts) {
  BenchOptions options;
  Settling settle;
  settleFiles(texts, settle, options.files);
  settleWorkload(texts, settle, options.workload);
  settle.into(options.timing.repeats, parseCount("--repeat", texts.repeat, kMaxBenchRepeats));
  options.reference.rung = rungNamed(texts.fidelity);
  if (!options.reference.rung) {
    settle.into(options.fidelity, parseFidelity("--fidelity", texts.fidelity));
  }
  settle.into(options.reference.descent,
              parseWord<Descent>("--descent", texts.descent, {Descent::Straight, Descent::ByNeed}));
  settle.into(options.reference.leafMethod,
              parseWord<LeafMethod>("--leaves", texts.leaves,
                                    {LeafMethod::Advancement, LeafMethod::Cubics}));
  settle.into(options.reference.culler,
              parseWord<Culler>("--culler", texts.culler, {Culler::FlatBvh, Culler::PointQuery}));
  int surfaceTriangles = 0;
  settle.into(surfaceTriangles,
              parseCount("--surface-triangles", texts.surfaceTriangles, kMaxBenchTriangles));
  options.surfaceTriangles = static_cast<std::size_t>(surfaceTriangles);
  if (texts.processor != "any") {
    constexpr double kMostProcessors = 4096.0;
    double processor = 0.0;
    settle.into(processor, parseNumber("--processor", texts.processor));
    options.processor = static_cast<int>(std::clamp(processor, -1.0, kMostProcessors));
  }
  options.jsonPath = texts.json;
  options.csvPath = texts.csv;
  options.command = ownCommandLine();
  if (settle.error()) return *settle.error();
  options.skinPath = texts.skin;
  if ((options.fidelity == Fidelity::Skinned) == texts.skin.empty()) {
    return Error::in("--skin", ErrorCode::Mismatch,
                     "expected a model at skinned fidelity, and none at others");
  }
  if (options.processor && !pinToProcessor(*options.processor)) {
    return Error::in(
        "--processor", ErrorCode::OutOfRange,
        "expected a processor that this process may use, found " + inQuotes(texts.processor));
  }
  return options;
}

Result<QueryOptions> queryFor(const BenchInputs& inputs, const BenchBody& body,
                              const BenchOptions& options) {
  QueryOptions query;
  query.fidelity = options.fidelity;
  if (query.fidelity == Fidelity::Skinned) {
    FORETOUCH_TRY(query.skin, loadSkin(options.skinPath, {}, body.avatar));
  }
  if (query.fidelity != Fidelity::Exact) return query;
  std::vector<std::vector<Triangle>> triangles;
  if (body.avatar.numLinks() == inputs.avatar.numLinks() && hasMeshes(inputs.avatar)) {
    FORETOUCH_TRY(triangles, loadLinkMeshes(inputs.avatar, inputs.files.avatarPath));
  } else {
    triangles = lssSkins(body.avatar, options.surfaceTriangles);
  }
  FORETOUCH_TRY(auto surface, AvatarSurface::build(body.avatar, std::move(triangles)));
  surface.prepare();  // the first steps' latencies are the query's
  query.surface = std::move(surface);
  return query;
}

Result<Scene> refinedScene(const BenchInputs& inputs, std::size_t triangles) {
  if (triangles <= inputs.raw.triangles.size()) return inputs.scene;
  auto scene = Scene::build(subdivided(inputs.raw, triangles));
  if (!scene.ok()) return inFile(scene.error(), inputs.files.scenePath);
  return scene;
}

Result<BenchBody> bodyOf(const BenchInputs& inputs, int links) {
  auto body = bodyWithLinks(inputs.avatar, links == 0 ? inputs.avatar.numLinks() : links);
  if (!body.ok()) return inFile(body.error(), "--links");
  return body;
}

const char* fidelityWord(Fidelity fidelity, const ReferenceOptions& reference) {
  return reference.rung ? toString(*reference.rung) : toString(fidelity);
}

std::vector<BenchFact> workloadFacts(const BenchInputs& inputs, const Scene& scene,
                                     const Avatar& avatar, const QueryOptions& query,
                                     const ReferenceOptions& reference) {
  const std::string madeOf =
      inputs.files.avatarPath.empty() ? "made of the clip" : nameOf(inputs.files.avatarPath);
  std::vector<BenchFact> facts = {
      {"scene", fmt::format("{}, {} triangles (the file has {})", nameOf(inputs.files.scenePath),
                            scene.numTriangles(), inputs.raw.triangles.size())},
      {"avatar", fmt::format("{}, {} links with {} LSS (of its own {} links)", madeOf,
                             avatar.numLinks(), avatar.numLss(), inputs.avatar.numLinks())},
      {"clip", fmt::format("{}, {} frames at {:.4g} Hz", nameOf(inputs.files.motionPath),
                           inputs.clip.frames.size(), 1.0 / inputs.clip.frameTimeS)},
      {"fidelity", fidelityWord(query.fidelity, reference)}};
  if (reference.descent == Descent::ByNeed) facts.back().second += ", descent by need";
  if (reference.leafMethod == LeafMethod::Cubics) facts.back().second += ", by cubics";
  if (reference.culler == Culler::PointQuery) facts.back().second += ", culled by point queries";
  if (query.skin) {
    facts.back().second += fmt::format(", {} triangles of a skin", query.skin->numTriangles());
  }
  if (query.surface) {
    facts.back().second +=
        fmt::format(", {} triangles on the links", query.surface->numTriangles());
  }
  return facts;
}

}  // namespace foretouch::tools
