#include "bench/machine.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sched.h>
#include <thread>
#include <utility>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <fmt/format.h>

#include "lss/simd.h"

namespace foretouch::tools {
namespace {

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    if (line.rfind("model name", 0) == 0) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string simdNames() {
  std::string names;
  for (const Simd simd : supportedSimd()) {
    names += (names.empty() ? "" : ", ") + std::string(toString(simd));
  }
  return names;
}

std::string loadNow() {
  double load[1] = {0.0};
  return ::getloadavg(load, 1) == 1 ? fmt::format("{:.1f}", load[0]) : "unknown";
}

bool isPlain(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string("-_./,:=+@%").find(static_cast<char>(c)) != std::string::npos;
  });
}

/// Processor, cores, vector widths, compiler, build type, version and load.
std::vector<BenchFact> machineFacts() {
#ifdef __clang__
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "gcc " __VERSION__;
#endif
  return {{"processor", processorName()},
          {"cores", fmt::format("{}", std::thread::hardware_concurrency())},
          {"vectors", simdNames()},
          {"compiler", compiler},
          {"build", FORETOUCH_BUILD_TYPE},
          {"version", FORETOUCH_VERSION},
          {"load", loadNow()}};
}

/// UTC, "2026-01-31 12:00".
std::string dateNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &utc)};
}

std::string ownCommandLine() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> words;
  for (std::size_t start = 0; start < all.size();) {
    const std::size_t end = std::min(all.find('\0', start), all.size());
    words.push_back(all.substr(start, end - start));
    start = end + 1;
  }
  if (!words.empty()) words.erase(words.begin());
  return commandLine(words);
}

double threadTimeUs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Found once.
double clockOverheadOfThreadUs() {
  static const double overheadUs = overheadOf(threadTimeUs);
  return overheadUs;
}

}  // namespace

BenchReport startedReport(std::string kind, std::string title) {
  BenchReport report;
  report.kind = std::move(kind);
  report.title = std::move(title);
  report.command = ownCommandLine();
  report.date = dateNow();
  report.machine = machineFacts();
  return report;
}

std::string commandLine(const std::vector<std::string>& arguments) {
  std::string line = "foretouch-bench";
  for (const std::string& argument : arguments) {
    const std::size_t slash = argument.find_last_of('/');
    const std::string word = slash == std::string::npos ? argument : argument.substr(slash + 1);
    line += ' ';
    if (isPlain(word)) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

bool pinToProcessor(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (processor < 0 || processor >= CPU_SETSIZE) return false;
  CPU_SET(static_cast<std::size_t>(processor), &set);
  return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

double heapMiB() {
#if defined(__GLIBC__)
  constexpr double kBytesAMiB = 1024.0 * 1024.0;
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / kBytesAMiB;
#else
  return 0.0;
#endif
}

ThreadStopwatch::ThreadStopwatch()
    : overheadUs_(clockOverheadOfThreadUs()), beginUs_(threadTimeUs()) {}

double ThreadStopwatch::us() const {
  return std::max(0.0, threadTimeUs() - beginUs_ - overheadUs_);
}

}  // namespace foretouch::tools
