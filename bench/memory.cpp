#include "bench/memory.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <utility>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "tools/console.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {
namespace {

/// Of /proc/self/status, in MiB; nothing if there is no such line.
std::optional<double> statusMiB(const std::string& key) {
  constexpr double kKiBAMiB = 1024.0;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) != 0) continue;
    return std::strtod(line.c_str() + key.size() + 1, nullptr) / kKiBAMiB;
  }
  return std::nullopt;
}

class Stages {
 public:
  explicit Stages(MemoryBench& bench) : bench_(bench) {}

  Result<Done> end(const std::string& name) {
    const auto now = Clock::now();
    const auto peak = statusMiB("VmHWM"), resident = statusMiB("VmRSS");
    if (!peak || !resident) {
      return Error::in("/proc/self/status", ErrorCode::FileUnreadable,
                       "expected lines VmHWM and VmRSS");
    }
    const std::chrono::duration<double, std::milli> elapsed = now - begin_;
    bench_.stages.push_back({name, elapsed.count(), *peak, *resident, heapMiB()});
    begin_ = Clock::now();
    return Done{};
  }

 private:
  using Clock = std::chrono::steady_clock;
  MemoryBench& bench_;
  Clock::time_point begin_ = Clock::now();
};

void count(const QueryOptions& query, MemoryBench& bench) {
  if (!query.surface) return;
  bench.surfaceTriangles = query.surface->numTriangles();
  for (LinkId link = 0; link < bench.links; ++link) {
    bench.exactLinks += query.surface->triangles(link).empty() ? 0 : 1;
  }
}

}  // namespace

double heapMiB() {
#if defined(__GLIBC__)
  constexpr double kBytesAMiB = 1024.0 * 1024.0;
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / kBytesAMiB;
#else
  return 0.0;
#endif
}

Result<MemoryBench> measureMemory(const MemoryRequest& request) {
  MemoryBench bench;
  Stages stages(bench);
  auto done = stages.end("program");
  if (!done.ok()) return done.error();
  const auto scene = loadScene(request);
  if (!scene.ok()) return scene.error();
  bench.sceneTriangles = scene.value().numTriangles();
  done = stages.end("scene");
  if (!done.ok()) return done.error();
  const auto avatar = readAvatarFile(request.avatarPath);
  if (!avatar.ok()) return avatar.error();
  bench.links = avatar.value().numLinks();
  FORETOUCH_TRY(const auto options,
                queryOptionsFor(request, request.avatarPath, avatar.value(), scene.value()));
  count(options, bench);
  FORETOUCH_TRY(const auto query, Query::build(avatar.value(), scene.value(), options));
  done = stages.end("avatar");
  if (!done.ok()) return done.error();
  const Pose rest = restPose(avatar.value().skeleton());
  const ChainMotion still(avatar.value().skeleton(), rest, rest);
  Scratch scratch;
  for (const char* const name : {"first query", "second query"}) {
    static_cast<void>(query.answer(still, scratch));
    done = stages.end(name);
    if (!done.ok()) return done.error();
  }
  return bench;
}

std::string memoryTable(const MemoryBench& bench) {
  std::string text = fmt::format(
      "{} triangles in the scene; {} links, {} of them with {} triangles of their own\n"
      "{:<14}{:>10}{:>12}{:>12}{:>12}\n",
      bench.sceneTriangles, bench.links, bench.exactLinks, bench.surfaceTriangles, "stage", "ms",
      "peak MiB", "now MiB", "heap MiB");
  for (const MemoryStage& stage : bench.stages) {
    text += fmt::format("{:<14}{:>10.2f}{:>12.1f}{:>12.1f}{:>12.1f}\n", stage.name, stage.ms,
                        stage.peakMiB, stage.residentMiB, stage.heapMiB);
  }
  return text;
}

}  // namespace foretouch::tools
