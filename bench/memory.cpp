// bench/memory.cpp: `foretouch-bench memory`: the time and memory of a scene and an avatar before
// the first answer, stage by stage.
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/report.h"
#include "tools/console.h"
#include "tools/inputs/policy_rules.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/settings/words.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// A scene to load, and an avatar in it.
struct MemoryRequest : WorldRequest {
  std::string avatarPath;
};

/// A value in /proc/self/status, in MiB; nothing if there is no such line.
std::optional<double> statusMiB(const std::string& key) {
  constexpr double kKiBAMiB = 1024.0;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) != 0) continue;
    return std::strtod(line.c_str() + key.size() + 1, nullptr) / kKiBAMiB;
  }
  return std::nullopt;
}

/// Processor time of this process and its ended children, so far (ms).
double processorMs() {
  double sum = 0.0;
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    static_cast<void>(::getrusage(whose, &usage));
    for (const timeval& part : {usage.ru_utime, usage.ru_stime}) {
      sum += 1e3 * static_cast<double>(part.tv_sec) + 1e-3 * static_cast<double>(part.tv_usec);
    }
  }
  return sum;
}

/// A row per stage: how long it took, how much processor time, including that of the import
/// child, and this process's memory after it, as the system counts it (without that child).
/// Peak: since the process began. Now: with freed memory that is kept for later. Heap: the part
/// of it that is allocated and not freed.
class Stages {
 public:
  Result<Done> end(const std::string& name) {
    const auto now = Clock::now();
    const auto peak = statusMiB("VmHWM"), resident = statusMiB("VmRSS");
    if (!peak || !resident) {
      return Error::in("/proc/self/status", ErrorCode::FileUnreadable,
                       "expected lines VmHWM and VmRSS");
    }
    const std::chrono::duration<double, std::milli> elapsed = now - begin_;
    const double processor = processorMs();
    table_.rows.push_back(
        {name, elapsed.count(), processor - processor_, *peak, *resident, heapMiB()});
    begin_ = Clock::now();
    processor_ = processor;
    return Done{};
  }
  [[nodiscard]] BenchTable table(std::string title) const {
    BenchTable table = table_;
    table.title = std::move(title);
    return table;
  }

 private:
  using Clock = std::chrono::steady_clock;
  BenchTable table_{"stages",
                    "",
                    {{"stage", "stage"},
                     {"ms", "ms", 2},
                     {"processor_ms", "of processors", 2},
                     {"peak_mib", "peak MiB", 1},
                     {"now_mib", "now MiB", 1},
                     {"heap_mib", "heap MiB", 1}},
                    {}};
  Clock::time_point begin_ = Clock::now();
  double processor_ = 0.0;
};

std::string describe(const Scene& scene, const Avatar& avatar, const QueryOptions& query) {
  std::size_t exactLinks = 0, triangles = 0;
  if (query.surface) {
    triangles = query.surface->numTriangles();
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      exactLinks += query.surface->triangles(link).empty() ? 0 : 1;
    }
  }
  return fmt::format(
      "{} triangles in the scene; {} links, {} of them with {} triangles of their own",
      scene.numTriangles(), avatar.numLinks(), exactLinks, triangles);
}

/// Loads the request's files, as a replay does, and queries the rest pose twice. Errors name the
/// file or option, or say that the system does not report a process's memory.
Result<BenchTable> measureMemory(const MemoryRequest& request) {
  Stages stages;
  FORETOUCH_CHECK(stages.end("program"));
  FORETOUCH_TRY(const auto scene, loadScene(request));
  FORETOUCH_CHECK(stages.end("scene"));
  FORETOUCH_TRY(const auto avatar, readAvatarFile(request.avatarPath));
  FORETOUCH_TRY(const auto options, queryOptionsFor(request, request.avatarPath, avatar, scene));
  FORETOUCH_TRY(const auto query, Query::build(avatar, scene, options));
  FORETOUCH_CHECK(stages.end("avatar"));
  const Pose rest = restPose(avatar.skeleton());
  const ChainMotion still(avatar.skeleton(), rest, rest);
  Scratch scratch;
  for (const char* const name : {"first query", "second query"}) {
    static_cast<void>(query.answer(still, scratch));
    FORETOUCH_CHECK(stages.end(name));
  }
  return stages.table(describe(scene, avatar, options));
}

ExitCode run(MemoryRequest request) {
  FORETOUCH_CHECK_OR(failed, readPolicies(request));
  FORETOUCH_TRY_OR(failed, const auto table, measureMemory(request));
  printOut(tableText(table));
  return ExitCode::Done;
}

}  // namespace

Command memoryCommand() {
  const auto request = std::make_shared<MemoryRequest>();
  Settings settings;
  addSceneSettings(settings, *request);
  settings.of("--scene").required();
  settings.path("--avatar", "FILE", request->avatarPath, "Avatar file (see foretouch avatar)")
      .required();
  settings
      .word("--fidelity", "link|exact", request->query.fidelity, fidelityWords(),
            "What touches, where no policy says more")
      .only({"link", "exact"});
  settings.path("--policy", "FILE", request->policyPath, "As of replay: [[policy]] tables");
  Command command{"memory",
                  "What a scene and an avatar cost in time and memory before the first answer",
                  "Example:\n  foretouch-bench memory --scene kitchen.ply --scene-up z --avatar "
                  "man.avatar.json "
                  "--fidelity exact",
                  std::move(settings)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
