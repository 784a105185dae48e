#include "network/log/event_log_blocks.h"

#include <algorithm>

namespace foretouch {
namespace {

constexpr std::uint64_t kMaxWalkCredit = 4 * static_cast<std::uint64_t>(kMaxBlockSpan);

bool isOpening(const BlockEvent& event) {
  return event.number == 0 && event.blockBytes == 0;
}

}  // namespace

void CheckedBlocks::start(std::uint64_t offset, std::optional<std::uint64_t> logId,
                          std::uint64_t number) {
  logId_ = logId;
  expected_ = number;
  next_ = offset;
  walkCredit_ = kMaxWalkCredit;
  isTail_ = false;
  cursor_ = end_ = offset;
}

std::uint64_t CheckedBlocks::position() const {
  return cursor_ < end_ ? cursor_ : next_;
}

bool CheckedBlocks::next(LogEvent& event) {
  if (cursor_ >= end_) {
    if (isTail_ || !(findBlock() || (findTail(), cursor_ < end_))) return false;
  }
  Frame frame;
  if (window_.frameAt(cursor_, frame) != FrameState::Whole || !window_.eventOf(frame, event)) {
    return false;  // a failed read: both were read before
  }
  cursor_ = frame.end();
  return true;
}

bool CheckedBlocks::findBlock() {
  while (logId_ && next_ < window_.size() && !window_.failure()) {
    BlockEvent event;
    std::uint64_t at = 0;
    const bool isFramed = walk(event, at);
    if (isFramed && event.logId != *logId_) {  // another log begins right behind this one
      logId_ = event.logId;
      expected_ = 0;
    }
    const bool isNext = isFramed && event.blockBytes == at - next_ && verifies(event, at);
    if (!isNext && !scan(event, at)) break;
    consider(event, at);
    if (cursor_ < end_) return true;
  }
  return false;
}

/// A block event of this log, or one that opens another right here, reached by framing.
bool CheckedBlocks::walk(BlockEvent& event, std::uint64_t& at) {
  const std::uint64_t limit =
      next_ + std::min<std::uint64_t>(walkCredit_, static_cast<std::uint64_t>(kMaxBlockSpan));
  bool isFound = false;
  at = next_;
  Frame frame;
  while (at <= limit && window_.frameAt(at, frame, next_) == FrameState::Whole) {
    if (window_.isOnBlockChannel(frame, next_)) {
      isFound = window_.blockEventAt(at, event, next_) == BlockEventState::Intact &&
                (event.logId == *logId_ || (at == next_ && isOpening(event)));
      break;
    }
    at = frame.end();
  }
  walkCredit_ -= std::min(walkCredit_, at - next_);
  return isFound;
}

/// The next block event of this log, anywhere.
bool CheckedBlocks::scan(BlockEvent& event, std::uint64_t& at) {
  const std::uint64_t size = window_.size();
  for (at = window_.findMagic(next_, size); at < size; at = window_.findMagic(at + 1, size)) {
    if (window_.blockEventAt(at, event) == BlockEventState::Intact && event.logId == *logId_) {
      return true;
    }
  }
  return false;
}

/// Whether the bytes before `at`, none of them before the last block's end, are the event's block.
bool CheckedBlocks::verifies(const BlockEvent& event, std::uint64_t at) {
  if (event.blockBytes > at - next_ || event.blockBytes > kMaxBlockSpan) return false;
  const std::uint64_t first = at - event.blockBytes;
  const auto count = static_cast<std::size_t>(event.blockBytes);
  const std::uint8_t* const bytes = window_.view(first, count, next_);
  if (bytes == nullptr || blockHashOf({bytes, count}, event.logId) != event.blockHash) return false;
  std::uint64_t events = 0;
  Frame frame;
  for (std::uint64_t offset = first; offset < at; offset = frame.end(), ++events) {
    if (window_.frameAt(offset, frame, first) != FrameState::Whole || frame.end() > at ||
        window_.isOnBlockChannel(frame, first)) {
      return false;
    }
  }
  return events == event.blockEvents;
}

/// Makes the event's block the current one if it is whole and in order; else skips it.
void CheckedBlocks::consider(const BlockEvent& event, std::uint64_t at) {
  const std::uint64_t first = at - std::min(event.blockBytes, at - next_);
  const bool isWhole = verifies(event, at);
  passOver(LogDamage::Skipped, next_, first);
  if (event.number < expected_) {
    ++counts_.badBlocks;
    passOver(LogDamage::RepeatedBlock, first, at + kBlockEventBytes);
  } else {
    judgeNumber(event, at);
    if (isWhole) {
      counts_.blocks += event.blockEvents > 0 ? 1 : 0;
      counts_.isClosed = event.isLast;
      cursor_ = first;
      end_ = at;
    } else {
      ++counts_.badBlocks;
      passOver(LogDamage::BadBlock, first, at);
    }
  }
  advanceTo(at + kBlockEventBytes);
}

void CheckedBlocks::judgeNumber(const BlockEvent& event, std::uint64_t at) {
  const std::uint64_t least = std::max<std::uint64_t>(expected_, 1);  // number 0 covers nothing
  if (event.number > least) {
    counts_.missingBlocks += event.number - least;
    report(LogDamage::MissingBlocks, next_, at, event.number - least);
  }
  expected_ = event.number + 1;
}

void CheckedBlocks::advanceTo(std::uint64_t offset) {
  walkCredit_ = std::min(walkCredit_ + (offset - next_), kMaxWalkCredit);
  next_ = offset;
}

/// After the last block: events up to the first damage, unless a check sum that is also damaged
/// follows them. Does not read another log from here on: behind damage, nothing distinguishes it
/// from a log inside a payload.
void CheckedBlocks::findTail() {
  isTail_ = true;
  std::uint64_t first = next_, offset = next_, last = next_, events = 0;
  Frame frame;
  FrameState state;
  BlockEvent other;
  while ((state = window_.frameAt(offset, frame)) == FrameState::Whole) {
    if (window_.isOnBlockChannel(frame, offset)) {
      if (window_.blockEventAt(offset, other) == BlockEventState::Intact) break;
      ++counts_.badBlocks;
      passOver(LogDamage::BadBlock, first, frame.end());
      first = frame.end();
      events = 0;
    } else {
      ++events;
    }
    last = offset;
    offset = frame.end();
  }
  counts_.tailEvents += events;
  if (events > 0) report(LogDamage::UncheckedTail, first, offset, events);
  counts_.isTruncated = state == FrameState::Torn;
  passOver(counts_.isTruncated ? LogDamage::Truncated : LogDamage::Skipped, offset, window_.size());
  // From the last event's start on: its length may be the damage.
  for (std::uint64_t at = window_.findMagic(last, window_.size());
       offset < window_.size() && at < window_.size();
       at = window_.findMagic(at + 1, window_.size())) {
    if (window_.blockEventAt(at, other) == BlockEventState::Intact && isOpening(other)) {
      report(LogDamage::OtherLog, at, window_.size());
      break;
    }
  }
  next_ = window_.size();
  if (options_.keepTail) {
    cursor_ = first;
    end_ = offset;
  }
}

void CheckedBlocks::passOver(LogDamage damage, std::uint64_t from, std::uint64_t to) {
  if (from >= to) return;
  counts_.skippedBytes += to - from;
  report(damage, from, to);
}

void CheckedBlocks::report(LogDamage damage, std::uint64_t from, std::uint64_t to,
                           std::uint64_t count) {
  if (options_.onFinding) options_.onFinding({damage, from, to - from, count});
}

}  // namespace foretouch
