#include "bench/options.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/mesh/link_mesh.h"
#include "assets/text_file.h"
#include "bench/machine.h"
#include "bench/scene.h"
#include "bench/surface.h"
#include "lss/index.h"
#include "tools/inputs/skin_file.h"
#include "tools/report/document_parts.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/frame_settings.h"
#include "tools/settings/words.h"

namespace foretouch::tools {
namespace {

constexpr NumberRange kMetres{-kMaxCoordinate, kMaxCoordinate, "metres", "m"};

/// The words of a few values, as toString() has them.
template <typename Value>
Words<Value> wordsOf(std::initializer_list<Value> values) {
  Words<Value> words;
  for (const Value value : values) words.emplace_back(toString(value), value);
  return words;
}

bool hasMeshes(const Avatar& avatar) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (!avatar.mesh(link).file.empty()) return true;
  }
  return false;
}

/// The words of volumes that only the reference room asks, and those of fidelities.
Words<std::string> touchingWords() {
  Words<std::string> words;
  for (const Rung rung : {Rung::Ellipsoid, Rung::Avatar, Rung::Limb}) {
    words.emplace_back(toString(rung), toString(rung));
  }
  for (const auto& [word, unused] : fidelityWords()) words.emplace_back(word, word);
  return words;
}

void takeTouching(BenchOptions& options) {
  for (const Rung rung : {Rung::Ellipsoid, Rung::Avatar, Rung::Limb}) {
    if (options.touching == toString(rung)) options.reference.rung = rung;
  }
  for (const auto& [word, fidelity] : fidelityWords()) {
    if (options.touching == word) options.fidelity = fidelity;
  }
}

/// Adds one place, instead of a choice of places.
void addOnePlace(Settings& settings, std::optional<Placement>& place) {
  settings.parsed(
      "--place", "X,Y,Z[,YAW]",
      [&place](const std::string& text) -> Result<Done> {
        FORETOUCH_TRY(place, placementFrom(text));
        return Done{};
      },
      [] { return std::string(); },
      "Every step at this one place, as replay has it, instead of a choice");
}

void addWorkload(Settings& settings, WorkloadRequest& workload) {
  constexpr int kMaxSeed = 1'000'000'000;
  addOnePlace(settings, workload.place);
  settings.word("--choice", "busy|mix", workload.choice,
                wordsOf({StepChoice::BusyPlaces, StepChoice::Mix}),
                "All steps at busy places, or a mix of which hardly a step is easy");
  settings.whole("--places", "N", workload.mostPlacements, 1, kMaxBenchSteps,
                 "Places tried at most");
  addFloor(settings, workload);
  settings.whole("--steps", "N", workload.steps, 1, kMaxBenchSteps, "Steps, if so many are found");
  settings.whole("--seed", "N", workload.seed, 1, kMaxSeed,
                 "Of the places, and of the choice among their steps");
}

void addWays(Settings& settings, ReferenceOptions& reference) {
  settings.word("--descent", "straight|by-need", reference.descent,
                wordsOf({Descent::Straight, Descent::ByNeed}),
                "Whether a query first checks if anything is within the avatar's reach");
  settings.word("--leaves", "advancement|cubics", reference.leafMethod,
                wordsOf({LeafMethod::Advancement, LeafMethod::Cubics}),
                "How exact fidelity tests pairs of triangles; both keep the promise");
  settings.word("--culler", "flat|point-query", reference.culler,
                wordsOf({Culler::FlatBvh, Culler::PointQuery}),
                "How to cull; both give the same answers");
}

}  // namespace

void addBenchFiles(Settings& settings, BenchFiles& files) {
  settings.path("--scene", "FILE", files.scenePath, "Scene; the bundled room if not given");
  settings.path("--motion", "CLIP", files.motionPath, "Clip; the bundled one if not given");
  settings.path("--avatar", "FILE", files.avatarPath,
                "Avatar; one LSS a bone of the clip if not given");
  settings.path("--map", "FILE", files.mapPath, "Joint names that differ, as for replay");
  const Words<UpAxis> axes{{"y", UpAxis::Y}, {"z", UpAxis::Z}};
  settings
      .number("--clip-scale", "S", files.motionScale, kMetresPerUnit, "Metres per unit of the clip")
      .formerly("--scale");
  settings.word("--clip-up", "y|z", files.motionUp, axes, "Which axis of the clip points up")
      .formerly("--motion-up");
  settings.number("--scene-scale", "S", files.sceneScale, kMetresPerUnit,
                  "Metres per unit of the scene");
  settings.word("--scene-up", "y|z", files.sceneUp, axes, "Which axis of the scene points up")
      .formerly("--up");
}

void addFigures(Settings& settings, FigureFiles& files, const char* inCsv) {
  settings.output("--json", "FILE", files.json, "Also write the figures to a file");
  settings.output("--csv", "FILE", files.csv, inCsv);
}

void addFloor(Settings& settings, WorkloadRequest& workload) {
  settings.number("--floor", "Y", workload.floorY, kMetres, "Height (m) of the scene's floor");
  settings.number("--lift", "M", workload.liftM, kMetres,
                  "The clip's lowest point stays so far (m) above the floor");
}

void addProcessor(Settings& settings, std::optional<int>& processor) {
  constexpr std::int64_t kMostProcessors = 4096;
  settings.parsed(
      "--processor", "N",
      [&processor](const std::string& text) -> Result<Done> {
        std::int64_t number = 0;
        if (text == "any") {
          processor.reset();
        } else if (readNumber(text, number) && number >= 0 && number <= kMostProcessors) {
          processor = static_cast<int>(number);
        } else {
          return Error::of(ErrorCode::OutOfRange,
                           "expected a processor's number or any, found " + inQuotes(text));
        }
        return Done{};
      },
      [&processor] { return processor ? std::to_string(*processor) : "any"; },
      "Keep to this processor");
}

Result<Done> keepTo(const std::optional<int>& processor) {
  if (!processor || pinToProcessor(*processor)) return Done{};
  return Error::in("--processor", ErrorCode::OutOfRange,
                   "expected a processor that this process may use, found " +
                       inQuotes(std::to_string(*processor)));
}

void addLinks(Settings& settings, const char* option, int& links) {
  settings.wholeOr("own", option, "N|own", links, kMaxBenchLinks,
                   "Links: fewer are cut off, more are grown");
}

void addTriangles(Settings& settings, const char* option, std::size_t& triangles) {
  settings.wholeOr("own", option, "N|own", triangles, kMaxBenchTriangles,
                   "Triangles that the scene is divided into");
}

void addBenchOptions(Settings& settings, BenchOptions& options) {
  addBenchFiles(settings, options.files);
  addWorkload(settings, options.workload);
  settings.whole("--repeat", "N", options.timing.repeats, 1, kMaxBenchRepeats,
                 "How often to ask each step");
  addProcessor(settings, options.processor);
  settings.word("--fidelity", "NAME", options.touching, touchingWords(),
                "What touches: link, exact or skinned; or volumes around several links, which only "
                "benchmarks ask: ellipsoid, avatar or limb");
  settings.path("--skin", "FILE", options.skinPath,
                "At skinned fidelity: the model that the avatar was made of");
  addWays(settings, options.reference);
  settings.whole("--surface-triangles", "N", options.surfaceTriangles, 1, kMaxBenchTriangles,
                 "Of an avatar without meshes, at exact fidelity: the skins of its LSS");
  addFigures(settings, options.figures, "Also write one line per step to a file");
}

Result<Done> complete(BenchOptions& options) {
  takeTouching(options);
  if ((options.fidelity == Fidelity::Skinned) == options.skinPath.empty()) {
    return Error::in("--skin", ErrorCode::Mismatch,
                     "expected a model at skinned fidelity, and none at others");
  }
  return keepTo(options.processor);
}

ExitCode finished(const BenchReport& report, const BenchTable& raw, const FigureFiles& files,
                  const std::string& fault) {
  FORETOUCH_CHECK_OR(failed, writeReport(report, raw, files));
  printOut(reportText(report));
  if (fault.empty()) return ExitCode::Done;
  printError(fault);
  return ExitCode::CheckSaysNo;
}

ExitCode finished(const JudgedReport& bench, const std::string& fault, const FigureFiles& files) {
  const bool isSound = bench.violations == 0;
  return finished(bench.report, bench.report.tables.front(), files,
                  isSound ? std::string() : fmt::format("{} {}", bench.violations, fault));
}

bool isAsked(const std::vector<std::string>& named, const std::string& one) {
  return named.empty() || std::find(named.begin(), named.end(), one) != named.end();
}

void addData(Settings& settings, std::string& folder, const char* help) {
  const char* const fromEnvironment = std::getenv("FORETOUCH_DATA");
  folder = fromEnvironment != nullptr ? fromEnvironment : "../shared/data";
  settings.path("--data", "FOLDER", folder, help);
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
      inputs.files.avatarPath.empty() ? "made of the clip" : fileName(inputs.files.avatarPath);
  std::vector<BenchFact> facts = {
      {"scene", fmt::format("{}, {} triangles (the file has {})", fileName(inputs.files.scenePath),
                            scene.numTriangles(), inputs.raw.triangles.size())},
      {"avatar", fmt::format("{}, {} links with {} LSS (of its own {} links)", madeOf,
                             avatar.numLinks(), avatar.numLss(), inputs.avatar.numLinks())},
      {"clip", fmt::format("{}, {} frames at {:.4g} Hz", fileName(inputs.files.motionPath),
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
