#include "middleware/triggers/presence.h"

#include <algorithm>

namespace foretouch::internal {
namespace {

bool isNotAfter(const WorldTime& x, const WorldTime& y) {
  return !(y < x);
}

/// The union of spans of one kind, in place.
void uniteAlike(std::vector<PresenceSpan>& spans) {
  std::sort(spans.begin(), spans.end(), [](const PresenceSpan& x, const PresenceSpan& y) {
    return x.from == y.from ? x.link < y.link : x.from < y.from;
  });
  std::size_t kept = 0;
  for (const PresenceSpan& span : spans) {
    if (kept > 0 && isNotAfter(span.from, spans[kept - 1].to)) {
      PresenceSpan& last = spans[kept - 1];
      if (last.to < span.to) last.to = span.to;
      last.isAssumed = last.isAssumed || span.isAssumed;
      continue;
    }
    spans[kept++] = span;
  }
  spans.resize(kept);
}

/// Appends what no span of `inside` covers of `unresolved`; both are united.
void appendUncovered(const std::vector<PresenceSpan>& unresolved,
                     const std::vector<PresenceSpan>& inside, std::vector<PresenceSpan>& all) {
  for (const PresenceSpan& span : unresolved) {
    PresenceSpan rest = span;
    bool isLeft = true;
    for (const PresenceSpan& covering : inside) {
      if (covering.to < rest.from || rest.to < covering.from) continue;
      if (rest.from < covering.from) {
        PresenceSpan before = rest;
        before.to = covering.from;
        all.push_back(before);
      }
      isLeft = covering.to < rest.to;
      if (!isLeft) break;
      rest.from = covering.to;
      rest.isFirstKnown = false;
    }
    if (isLeft) all.push_back(rest);
  }
}

}  // namespace

void unite(std::vector<PresenceSpan>& spans, std::vector<PresenceSpan>& memory) {
  std::vector<PresenceSpan> unresolved;
  memory.clear();
  for (const PresenceSpan& span : spans) {
    (span.presence == Presence::Inside ? memory : unresolved).push_back(span);
  }
  uniteAlike(memory);
  uniteAlike(unresolved);
  spans = memory;
  appendUncovered(unresolved, memory, spans);
  std::sort(spans.begin(), spans.end(), [](const PresenceSpan& x, const PresenceSpan& y) {
    return x.from == y.from ? x.to < y.to : x.from < y.from;
  });
}

}  // namespace foretouch::internal
