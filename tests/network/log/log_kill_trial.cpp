#include "tests/network/log/log_kill_trial.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <new>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "network/log/event_log_format.h"
#include "tests/network/log/log_samples.h"

namespace foretouch::test {
namespace {

/// What the writer had done, seen by both processes.
struct Progress {
  std::atomic<std::int64_t> taken{0};    ///< Events whose write() had returned.
  std::atomic<std::int64_t> flushed{0};  ///< Of those, before a flush() that had returned.
  std::atomic<bool> failed{false};
};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

class SharedProgress {
 public:
  SharedProgress()
      : memory_(::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ != MAP_FAILED) progress_ = new (memory_) Progress;
  }
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;
  ~SharedProgress() {
    if (progress_ != nullptr) ::munmap(memory_, sizeof(Progress));
  }
  [[nodiscard]] Progress* get() const { return progress_; }

 private:
  void* memory_;
  Progress* progress_ = nullptr;
};

/// Event `number` of trial `seed`; any of them can be made without those before.
LogEvent eventOf(std::uint64_t seed, std::int64_t number) {
  std::mt19937_64 random(seed * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(number));
  const std::size_t largest = random() % 50 == 0 ? 100'000 : 2'000;
  LogEvent event = numberedEvent(number, 0);
  event.payload.resize(random() % largest);
  std::uint64_t word = random() | 1;
  for (std::uint8_t& byte : event.payload) {  // xorshift: fast enough not to slow the writer down
    word ^= word << 13;
    word ^= word >> 7;
    word ^= word << 17;
    byte = static_cast<std::uint8_t>(word);
  }
  return event;
}

LogWriteOptions optionsOf(std::uint64_t seed) {
  LogWriteOptions options;
  const std::size_t sizes[] = {1, 4u << 10, 64u << 10, 64u << 10, 256u << 10, kMaxLogBlockBytes};
  options.blockBytes = sizes[seed % std::size(sizes)];
  options.blockUs = 1'000'000;
  return options;
}

[[noreturn]] void writeUntilKilled(const std::string& path, std::uint64_t seed,
                                   Progress& progress) {
  std::mt19937_64 random(~seed);
  auto writer = EventLogWriter::create(path, optionsOf(seed));
  for (std::int64_t number = 0; writer.ok(); ++number) {
    const LogEvent event = eventOf(seed, number);
    if (!writer.value().write(event.utimeUs, event.channel, event.payload).ok()) break;
    progress.taken.store(number + 1);
    if (random() % 400 != 0) continue;
    if (!writer.value().flush().ok()) break;
    progress.flushed.store(number + 1);
  }
  progress.failed.store(true);
  ::_exit(1);
}

/// Starts the writer and kills it within `longestUs`.
bool writeAndKill(const std::string& path, std::uint64_t seed, Progress& progress) {
  constexpr long kLongestNs = 25'000'000;
  std::mt19937_64 random(seed);
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) writeUntilKilled(path, seed, progress);
  const timespec wait{0, static_cast<long>(random() % kLongestNs)};
  ::nanosleep(&wait, nullptr);
  ::kill(child, SIGKILL);
  return ::waitpid(child, nullptr, 0) == child && !progress.failed.load();
}

/// Reads it all and compares: events from 0 on, none left out.
std::string compare(const std::string& path, std::uint64_t seed, bool keepTail, std::int64_t& given,
                    LogCounts& counts) {
  LogReadOptions options;
  options.keepTail = keepTail;
  auto reader = EventLogReader::open(path, options);
  if (!reader.ok()) return describe(reader.error());
  given = 0;
  for (LogEvent event;; ++given) {
    const auto more = reader.value().next(event);
    if (!more.ok()) return describe(more.error());
    if (!more.value()) break;
    if (!(event == eventOf(seed, given))) return "event " + std::to_string(given) + " is another";
  }
  counts = reader.value().counts();
  return counts.badBlocks + counts.missingBlocks > 0 ? "a block is bad" : "";
}

/// Whether the events that are gone fit into one block.
bool isOneBlock(std::uint64_t seed, std::int64_t given, std::int64_t taken) {
  std::size_t bytes = 0;
  for (std::int64_t number = given; number < taken; ++number) {
    const LogEvent event = eventOf(seed, number);
    bytes += kEventHeaderBytes + event.channel.size() + event.payload.size();
  }
  return bytes <= optionsOf(seed).blockBytes;
}

}  // namespace

std::string runKillTrial(const std::string& folder, std::uint64_t seed, KillTally& tally) {
  const std::string path = folder + "/killed.lcmlog";
  std::remove(path.c_str());
  const SharedProgress progress;
  if (progress.get() == nullptr || !writeAndKill(path, seed, *progress.get())) {
    return "the writer did not write until it was killed";
  }
  const std::int64_t taken = progress.get()->taken.load();
  ++tally.trials;
  if (taken == 0 && !EventLogReader::open(path).ok()) {
    ++tally.unopened;
    return "";
  }
  std::int64_t given = 0, withTail = 0;
  LogCounts counts, tailCounts;
  std::string broken = compare(path, seed, false, given, counts);
  if (broken.empty()) broken = compare(path, seed, true, withTail, tailCounts);
  if (!broken.empty()) return broken;
  if (given < progress.get()->flushed.load()) return "a flushed event is lost";
  if (!isOneBlock(seed, given, taken)) return "more than the last block is lost";
  if (withTail < given) return "a tail takes events away";
  tally.torn += counts.isTruncated ? 1 : 0;
  tally.tails += counts.tailEvents > 0 ? 1 : 0;
  tally.incomplete += given < taken ? 1 : 0;
  tally.events += static_cast<std::uint64_t>(given);
  tally.lostEvents += static_cast<std::uint64_t>(std::max<std::int64_t>(taken - given, 0));
  tally.tailEvents += static_cast<std::uint64_t>(withTail - given);
  return "";
}

}  // namespace foretouch::test
