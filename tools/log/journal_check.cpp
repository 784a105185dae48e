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

/// The words for answers that differ, or that one of the two lacks.
struct Sayings {
  const char *differs, *isMissingHere, *isMissingThere;
};

Sayings sayingsOf(AnswerKind kind) {
  switch (kind) {
    case AnswerKind::Contacts:
      return {" is answered differently: ", "is answered in the log, and not here",
              "is answered here, and not in the log"};
    case AnswerKind::Solid:
      return {" is shown differently: ", "is shown in the log, and not here",
              "is shown here, and not in the log"};
    case AnswerKind::Person:
      return {" is known differently: ", "is known in the log, and not here",
              "is known here, and not in the log"};
    case AnswerKind::Pushes:
      return {" is pressed differently: ", "is pressed in the log, and not here",
              "is pressed here, and not in the log"};
    case AnswerKind::Events: break;
  }
  return {" tells differently: ", "is told in the log, and not here",
          "is told here, and not in the log"};
}

template <typename Message>
std::string differenceOfAnswers(ByteView recorded, ByteView replayed) {
  Message before, now;
  const bool isReadable =
      decode(recorded, before) == Reject::None && decode(replayed, now) == Reject::None;
  return isReadable ? firstDifference(before, now) : std::string("the two cannot be read");
}

}  // namespace

std::string JournalCheck::nameOf(const Key& key) const {
  const auto& [avatar, session, sequence] = key;
  if (kind_ == AnswerKind::Events) {
    return fmt::format("timeline {}, message {}", session, sequence);
  }
  return fmt::format("avatar {}, session {}, pose {}", avatar, session, sequence);
}

void JournalCheck::addRecorded(const Key& key, ByteView payload) {
  ++recorded_;
  const auto replayed = pair(key, payload, recordedOnly_, replayedOnly_);
  lastRecorded_[std::get<0>(key)] = order_;
  if (replayed) compare(key, payload, *replayed);
}

void JournalCheck::addReplayed(const Key& key, ByteView payload) {
  const auto recorded = pair(key, payload, replayedOnly_, recordedOnly_);
  if (recorded) compare(key, *recorded, payload);
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

void JournalCheck::compare(const Key& key, ByteView recorded, ByteView replayed) {
  if (sameBytes(verdictBytes(recorded), verdictBytes(replayed))) {
    ++equal_;
    return;
  }
  if (first_) return;
  first_ =
      Difference{order_, nameOf(key) + sayingsOf(kind_).differs + differenceOf(recorded, replayed)};
}

std::string JournalCheck::differenceOf(ByteView recorded, ByteView replayed) const {
  switch (kind_) {
    case AnswerKind::Contacts: return differenceOfAnswers<ContactsMessage>(recorded, replayed);
    case AnswerKind::Solid: return differenceOfAnswers<SolidMessage>(recorded, replayed);
    case AnswerKind::Person: return differenceOfAnswers<PersonMessage>(recorded, replayed);
    case AnswerKind::Pushes: return differenceOfAnswers<PushesMessage>(recorded, replayed);
    case AnswerKind::Events: break;
  }
  return differenceOfAnswers<EventsMessage>(recorded, replayed);
}

std::optional<JournalCheck::Difference> JournalCheck::firstOf(const Queues& queues,
                                                              const char* what) const {
  std::optional<Difference> first;
  for (const auto& [key, waiting] : queues) {
    const std::int64_t order = waiting.front().order;
    if (first && first->order <= order) continue;
    first = Difference{order, nameOf(key) + " " + what};
  }
  return first;
}

std::optional<std::string> JournalCheck::firstDifference() const {
  std::optional<Difference> first = first_;
  const Sayings sayings = sayingsOf(kind_);
  for (const auto& other : {firstOf(recordedOnly_, sayings.isMissingHere),
                            firstOf(replayedOnly_, sayings.isMissingThere)}) {
    if (other && (!first || other->order < first->order)) first = other;
  }
  if (!first) return std::nullopt;
  return first->text;
}

}  // namespace foretouch::tools
