#include <optional>
#include <utility>

#include "articulated/try.h"
#include "network/log/event_log_blocks.h"
#include "network/log/event_log_reader_access.h"

namespace foretouch {

const char* toString(LogDamage damage) {
  switch (damage) {
    case LogDamage::Skipped: return "skipped bytes";
    case LogDamage::BadBlock: return "bad block";
    case LogDamage::MissingBlocks: return "missing blocks";
    case LogDamage::RepeatedBlock: return "repeated block";
    case LogDamage::UncheckedTail: return "unchecked tail";
    case LogDamage::Truncated: return "truncated";
    case LogDamage::OtherLog: return "another log";
  }
  return "skipped bytes";
}

struct EventLogReader::Impl {
  Impl(std::unique_ptr<LogBytes> bytes, LogReadOptions readOptions)
      : options(std::move(readOptions)),
        window(std::move(bytes)),
        blocks(window, counts, options) {}

  /// Reads from the start.
  void begin() {
    isChecked = counts.hasCheckSums = kind.hasCheckSums && !options.ignoreCheckSums;
    if (isChecked) blocks.start(0, kind.logId);
  }

  bool nextUnchecked(LogEvent& event) {
    for (;;) {
      const FoundFrame found = findFrame(window, position, window.size());
      const std::uint64_t begin = found.isFound ? found.frame.offset : window.size();
      counts.badEvents += found.impossible;
      if (begin > position) passOver(begin, found.isTorn);
      position = begin;
      if (!found.isFound) return false;
      if (!window.isOnBlockChannel(found.frame, begin)) {
        position = found.frame.end();
        return window.eventOf(found.frame, event);
      }
      BlockEvent check;
      if (!options.ignoreCheckSums &&
          window.blockEventAt(begin, check) == BlockEventState::Intact) {
        isChecked = counts.hasCheckSums = true;
        blocks.start(begin, check.logId);
        return false;
      }
      position = found.frame.end();
    }
  }

  void passOver(std::uint64_t to, bool isTorn) {
    counts.skippedBytes += to - position;
    counts.isTruncated = counts.isTruncated || isTorn;
    if (options.onFinding) {
      options.onFinding(
          {isTorn ? LogDamage::Truncated : LogDamage::Skipped, position, to - position, 0});
    }
  }

  /// Does not count it as returned.
  bool read(LogEvent& event, bool& isUnchecked) {
    isUnchecked = !isChecked && nextUnchecked(event);
    return isUnchecked || (isChecked && blocks.next(event));
  }

  LogReadOptions options;
  LogWindow window;
  LogCounts counts;
  LogKind kind;
  CheckedBlocks blocks;
  bool isChecked = false;
  std::uint64_t position = 0;  ///< In the events without check sums.
};

EventLogReader::EventLogReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EventLogReader::EventLogReader(EventLogReader&&) noexcept = default;
EventLogReader& EventLogReader::operator=(EventLogReader&&) noexcept = default;
EventLogReader::~EventLogReader() = default;

Result<EventLogReader> EventLogReaderAccess::open(std::unique_ptr<LogBytes> bytes,
                                                  const std::string& name,
                                                  const LogReadOptions& options) {
  auto impl = std::make_unique<EventLogReader::Impl>(std::move(bytes), options);
  impl->kind = findKind(impl->window);
  if (impl->window.failure()) return *impl->window.failure();
  if (impl->kind.isEmpty) {
    return Error::in(name, ErrorCode::Empty,
                     "no event of an LCM log in it (expected ED A1 DA 01 and a whole event)");
  }
  impl->begin();
  return EventLogReader(std::move(impl));
}

Result<EventLogReader> EventLogReader::open(const std::string& path,
                                            const LogReadOptions& options) {
  FORETOUCH_TRY(auto bytes, openLogFile(path));
  return EventLogReaderAccess::open(std::move(bytes), path, options);
}

Result<bool> EventLogReader::next(LogEvent& event) {
  bool isUnchecked = false;
  const bool isFound = impl_->read(event, isUnchecked);
  if (impl_->window.failure()) return *impl_->window.failure();
  if (!isFound) return false;
  ++impl_->counts.events;
  if (isUnchecked) ++impl_->counts.uncheckedEvents;
  return true;
}

const LogCounts& EventLogReader::counts() const {
  return impl_->counts;
}

std::uint64_t EventLogReader::position() const {
  return impl_->isChecked ? impl_->blocks.position() : impl_->position;
}

std::uint64_t EventLogReader::size() const {
  return impl_->window.size();
}

}  // namespace foretouch
