#include "bench/cage.h"

#include <chrono>
#include <filesystem>
#include <sys/resource.h>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/import/process.h"
#include "assets/import/protocol.h"
#include "assets/import/run.h"
#include "assets/import/scene_import.h"
#include "bench/bench_folder.h"
#include "bench/machine.h"
#include "bench/timing.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerMB = 1e6;

/// A strip of triangles in a row, as OBJ.
std::string stripOf(int triangles) {
  std::string text = "o strip\n";
  for (int i = 0; i < triangles + 2; ++i) {
    text += fmt::format("v {} {} {}\n", 0.01 * (i / 2), i % 2, 0.001 * (i % 7));
  }
  for (int i = 1; i <= triangles; ++i) text += fmt::format("f {} {} {}\n", i, i + 1, i + 2);
  return text;
}

/// Thirty-one nodes that each place the next one twice.
std::string instancesOfInstances() {
  std::string nodes;
  for (int i = 1; i <= 30; ++i) {
    nodes += fmt::format(R"({{"mesh":0,"children":[{},{}]}},)", i, i);
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"({"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         std::string(48, 'A') + R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})";
}

double secondsFrom(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Of this process and of its ended children, in milliseconds.
double processorMs() {
  double ms = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    getrusage(who, &used);
    for (const timeval& time : {used.ru_utime, used.ru_stime}) {
      ms += 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
    }
  }
  return ms;
}

struct ImportCost {
  double ms = 0.0, processorMs = 0.0;
};

/// One import; the answer is read and checked as importScene() does.
Result<ImportCost> costOfImport(const std::string& importer, const std::string& path,
                                bool isCaged) {
  const SceneImportOptions usual;
  const double before = processorMs();
  const auto begin = std::chrono::steady_clock::now();
  internal::ProcessLimits limits{usual.memoryLimitBytes, usual.timeLimitS, {}};
  const std::string folder = fs::path(path).parent_path().string();
  if (isCaged) limits.cage = internal::Cage(importer, {folder, path}, "");
  internal::ImportReader reader;
  const auto end =
      internal::runLimited(importer, {path}, std::move(limits), [&](std::string_view bytes) {
        return reader.feed(bytes) == internal::FrameReader::State::Reading;
      });
  const ImportCost cost{1e3 * secondsFrom(begin), processorMs() - before};
  if (reader.state() == internal::FrameReader::State::Complete) return cost;
  return Error::in(path, ErrorCode::ImportFailed,
                   "expected a complete answer of the importer: " + end.errorOutput);
}

double medianOf(const std::vector<ImportCost>& costs, double ImportCost::*part) {
  std::vector<double> values;
  for (const ImportCost& cost : costs) values.push_back(cost.*part);
  return percentilesOf(std::move(values)).p50;
}

BenchTable costTable(const std::vector<ImportCost>& free, const std::vector<ImportCost>& caged,
                     int triangles) {
  std::vector<ImportCost> added;
  for (std::size_t i = 0; i < free.size(); ++i) {
    added.push_back({caged[i].ms - free[i].ms, caged[i].processorMs - free[i].processorMs});
  }
  return {
      "cost",
      "An import with and without the cage, in turns",
      {{"triangles", "triangles", 0},
       {"free_ms", "without (ms)", 2},
       {"caged_ms", "in the cage (ms)", 2},
       {"added_ms", "added, median of the pairs (ms)", 2},
       {"added_processor_ms", "of processor time (ms)", 2}},
      {{BenchCell(triangles), BenchCell(medianOf(free, &ImportCost::ms)),
        BenchCell(medianOf(caged, &ImportCost::ms)), BenchCell(medianOf(added, &ImportCost::ms)),
        BenchCell(medianOf(added, &ImportCost::processorMs))}}};
}

/// Of the largest child so far: the last, if it is a hostile one.
BenchTable hostileTable(const std::string& path) {
  const auto begin = std::chrono::steady_clock::now();
  const auto result = importScene(path);
  const double seconds = secondsFrom(begin);
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  std::error_code unknown;
  return {"hostile",
          "A small file that places instances of instances",
          {{"bytes", "bytes of the file", 0},
           {"peak_mb", "the importer's memory (MB)", 0},
           {"seconds", "until it ended (s)", 1},
           {"refused", "refused", 0}},
          {{BenchCell(static_cast<std::int64_t>(fs::file_size(path, unknown))),
            BenchCell(static_cast<double>(children.ru_maxrss) * 1024 / kBytesPerMB),
            BenchCell(seconds), BenchCell(std::string(result.ok() ? "no" : "yes"))}}};
}

}  // namespace

Result<BenchReport> measureCage(const CageRequest& request) {
  if (internal::kUnderSanitizer) {
    return Error::in("foretouch-bench cage", ErrorCode::OutOfRange,
                     "expected a build without sanitizers, under which there is no cage");
  }
  const BenchFolder folder;
  FORETOUCH_TRY(const auto strip, folder.write("strip.obj", stripOf(request.triangles)));
  FORETOUCH_TRY(const auto importer, internal::findImporter(strip, {}));
  std::vector<ImportCost> free, caged;
  for (int i = 0; i <= request.repeats; ++i) {
    FORETOUCH_TRY(const ImportCost without, costOfImport(importer, strip, false));
    FORETOUCH_TRY(const ImportCost with, costOfImport(importer, strip, true));
    if (i == 0) continue;  // fills the caches of files
    free.push_back(without);
    caged.push_back(with);
  }
  FORETOUCH_TRY(const auto bomb, folder.write("instances.gltf", instancesOfInstances()));
  BenchReport report;
  report.kind = "cage";
  report.title = "What the importer's cage costs, and what it bounds";
  report.command = request.command;
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = {{"pairs", std::to_string(request.repeats)}};
  report.tables = {costTable(free, caged, request.triangles), hostileTable(bomb)};
  if (const std::string lacking = internal::weaknessOf(internal::partsOfThisKernel());
      !lacking.empty()) {
    report.notes.push_back(lacking + ".");
  }
  return report;
}

}  // namespace foretouch::tools
