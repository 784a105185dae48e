#include "middleware/events/open_parts.h"

#include <algorithm>

namespace foretouch::internal {
namespace {

PairKey keyOfOpen(const OpenPart& open) {
  return keyOf(open, open.object);
}

}  // namespace

std::size_t OpenParts::placeOf(const PairKey& key) const {
  const auto place = std::lower_bound(
      open_.begin(), open_.end(), key,
      [](const OpenPart& open, const PairKey& wanted) { return keyOfOpen(open) < wanted; });
  return static_cast<std::size_t>(place - open_.begin());
}

bool OpenParts::has(const PairKey& key) const {
  const std::size_t place = placeOf(key);
  return place < open_.size() && keyOfOpen(open_[place]) == key;
}

void OpenParts::beginTime(std::int64_t fromUs) {
  from_ = {fromUs, 0.0};
}

void OpenParts::take(const WorldEvent& event, std::vector<WorldPart>& parts) {
  const PairKey key = keyOf(event, event.object);
  const std::size_t place = placeOf(key);
  const auto offset = static_cast<std::ptrdiff_t>(place);
  if (has(key)) {
    OpenPart& ended = open_[place];
    if (ended.kind == PartKind::Contact && event.isAssumed) ended.isAssumed = true;
    close(place, event.time, false, parts);
    open_.erase(open_.begin() + offset);
  }
  if (event.kind == EventKind::Leave || event.kind == EventKind::UnresolvedTo) return;
  const bool isUnresolved = event.kind == EventKind::UnresolvedFrom;
  open_.insert(open_.begin() + offset,
               {isUnresolved ? PartKind::Unresolved : PartKind::Contact, event.reason,
                event.isAssumed, event.a, event.b, event.object, event.time});
}

void OpenParts::assume(const PairKey& key) {
  if (has(key)) open_[placeOf(key)].isAssumed = true;
}

void OpenParts::close(std::size_t place, const WorldTime& to, bool goesOn,
                      std::vector<WorldPart>& parts) const {
  const OpenPart& open = open_[place];
  WorldPart part;
  part.kind = open.kind;
  part.reason = open.reason;
  part.isAssumed = open.isAssumed;
  part.beganBefore = open.since < from_;
  part.goesOn = goesOn;
  part.a = open.a;
  part.b = open.b;
  part.object = open.object;
  part.from = std::max(open.since, from_);
  part.to = to;
  part.since = open.since;
  parts.push_back(part);
}

void OpenParts::endTime(std::int64_t toUs, std::vector<WorldPart>& parts) {
  for (std::size_t i = 0; i < open_.size(); ++i) close(i, {toUs, 0.0}, true, parts);
  std::sort(parts.begin(), parts.end(), [](const WorldPart& x, const WorldPart& y) {
    const PairKey ofX = keyOf(x, x.object), ofY = keyOf(y, y.object);
    if (!(ofX == ofY)) return ofX < ofY;
    if (!(x.from == y.from)) return x.from < y.from;
    return x.to < y.to;
  });
}

}  // namespace foretouch::internal
