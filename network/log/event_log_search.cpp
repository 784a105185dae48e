#include <algorithm>
#include <array>

#include "network/log/event_log_blocks.h"

namespace foretouch {
namespace {

/// How far into a file its first event may begin, in bytes.
constexpr std::uint64_t kMaxLeadBytes = 64u << 20;

/// Whether an event begins at `offset`, or the log ends there.
bool endsWell(LogWindow& window, std::uint64_t offset) {
  std::array<std::uint8_t, sizeof kEventMagic> bytes{};
  return offset == window.size() ||
         (window.peek(offset, bytes.data(), bytes.size()) &&
          std::equal(bytes.begin(), bytes.end(), std::begin(kEventMagic)));
}

/// The first event inside another's payload that ends well.
bool findInside(LogWindow& window, const Frame& outer, Frame& inner) {
  const std::uint64_t end = outer.end();
  std::uint64_t offset = window.findMagic(outer.offset + 1, end);
  for (; offset < end; offset = window.findMagic(offset + 1, end)) {
    if (window.frameAt(offset, inner) == FrameState::Whole && endsWell(window, inner.end())) {
      return true;
    }
  }
  return false;
}

}  // namespace

FoundFrame findFrame(LogWindow& window, std::uint64_t offset, std::uint64_t limit) {
  FoundFrame found;
  for (; offset < limit; offset = window.findMagic(offset + 1, limit)) {
    const FrameState state = window.frameAt(offset, found.frame);
    if (state == FrameState::Whole) {
      Frame inner;
      found.isFound = true;
      found.isTorn = false;
      if (!endsWell(window, found.frame.end()) && findInside(window, found.frame, inner)) {
        ++found.impossible;
        found.frame = inner;
      }
      return found;
    }
    if (state == FrameState::Impossible) ++found.impossible;
    if (state == FrameState::Torn) found.isTorn = true;
  }
  return found;
}

LogKind findKind(LogWindow& window) {
  LogKind kind;
  const std::uint64_t size = window.size();
  FoundFrame found = findFrame(window, 0, std::min(size, kMaxLeadBytes));
  kind.isEmpty = !found.isFound;
  const std::uint64_t limit =
      std::min<std::uint64_t>(size, found.frame.offset + static_cast<std::uint64_t>(kMaxBlockSpan));
  std::uint64_t expected = 0;
  bool isSound = true;
  for (; found.isFound; found = findFrame(window, expected, limit)) {
    isSound = isSound && found.frame.offset == expected;
    expected = found.frame.end();
    if (!window.isOnBlockChannel(found.frame, found.frame.offset)) continue;
    BlockEvent event;
    const BlockEventState state = window.blockEventAt(found.frame.offset, event);
    if (state == BlockEventState::Damaged) kind.hasCheckSums = true;
    if (state != BlockEventState::Intact) continue;
    const bool isBehindAnother = isSound && !kind.hasCheckSums && found.frame.offset > 0 &&
                                 event.number == 0 && event.blockBytes == 0;
    if (!isBehindAnother) {
      kind.hasCheckSums = true;
      kind.logId = event.logId;
    }
    return kind;
  }
  return kind;
}

}  // namespace foretouch
