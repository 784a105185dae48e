#include "tools/log/journal_check.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "tools/log/answer_difference.h"

namespace foretouch::tools {
namespace {

bool sameBytes(ByteView a, ByteView b) {
  return a.size == b.size && std::equal(a.data, a.data + a.size, b.data);
}

std::string nameOf(std::int32_t avatar, std::int64_t session, std::int64_t sequence) {
  return fmt::format("avatar {}, session {}, pose {}", avatar, session, sequence);
}

}  // namespace

void JournalCheck::addRecorded(const ContactsMessage& message, ByteView payload) {
  ++recorded_;
  const Key key{message.avatar, message.session, message.sequenceTo};
  const auto replayed = pair(key, payload, recordedOnly_, replayedOnly_);
  lastRecorded_[message.avatar] = order_;
  if (replayed) compare(message, payload, *replayed);
}

void JournalCheck::addReplayed(const ContactsMessage& message, ByteView payload) {
  const Key key{message.avatar, message.session, message.sequenceTo};
  const auto recorded = pair(key, payload, replayedOnly_, recordedOnly_);
  if (recorded) compare(message, *recorded, payload);
}

void JournalCheck::endIsOpen() {
  for (auto queue = replayedOnly_.begin(); queue != replayedOnly_.end();) {
    const std::int64_t last = lastRecorded_[std::get<0>(queue->first)];
    std::deque<Waiting>& waiting = queue->second;
    while (!waiting.empty() && waiting.back().order > last) {
      waiting.pop_back();
      ++beyondEnd_;
    }
    queue = waiting.empty() ? replayedOnly_.erase(queue) : std::next(queue);
  }
}

std::optional<Bytes> JournalCheck::pair(const Key& key, ByteView payload, Queues& own,
                                        Queues& others) {
  ++order_;
  const auto found = others.find(key);
  if (found == others.end()) {
    own[key].push_back({order_, Bytes(payload.data, payload.data + payload.size)});
    return std::nullopt;
  }
  Bytes other = std::move(found->second.front().payload);
  found->second.pop_front();
  if (found->second.empty()) others.erase(found);
  return other;
}

void JournalCheck::compare(const ContactsMessage& message, ByteView recorded, ByteView replayed) {
  if (sameBytes(verdictBytes(recorded), verdictBytes(replayed))) {
    ++equal_;
    return;
  }
  if (first_) return;
  ContactsMessage before, now;
  const bool isReadable =
      decode(recorded, before) == Reject::None && decode(replayed, now) == Reject::None;
  const std::string text =
      isReadable ? tools::firstDifference(before, now) : std::string("the two cannot be read");
  first_ = Difference{order_, nameOf(message.avatar, message.session, message.sequenceTo) +
                                  " is answered differently: " + text};
}

std::optional<JournalCheck::Difference> JournalCheck::firstOf(const Queues& queues,
                                                              const char* what) {
  std::optional<Difference> first;
  for (const auto& [key, waiting] : queues) {
    const std::int64_t order = waiting.front().order;
    if (first && first->order <= order) continue;
    first = Difference{order,
                       nameOf(std::get<0>(key), std::get<1>(key), std::get<2>(key)) + " " + what};
  }
  return first;
}

std::optional<std::string> JournalCheck::firstDifference() const {
  std::optional<Difference> first = first_;
  for (const auto& other : {firstOf(recordedOnly_, "is answered in the log, and not here"),
                            firstOf(replayedOnly_, "is answered here, and not in the log")}) {
    if (other && (!first || other->order < first->order)) first = other;
  }
  if (!first) return std::nullopt;
  return first->text;
}

}  // namespace foretouch::tools
