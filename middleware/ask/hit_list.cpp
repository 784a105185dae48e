#include "middleware/ask/hit_list.h"

#include <algorithm>
#include <tuple>

namespace foretouch::internal {

bool comesBefore(const WorldHit& x, const WorldHit& y) {
  const auto key = [](const WorldHit& hit) {
    return std::make_tuple(hit.distance, hit.what.body, hit.what.link, hit.what.lss,
                           hit.what.triangle, hit.object);
  };
  return key(x) < key(y);
}

/// A link's triangle may hang under several LSS (LinkSurface): the nearest hit of it stays.
void HitList::dropTwins() {
  std::vector<WorldHit>& hits = answer_.hits;
  const auto key = [](const WorldHit& hit) {
    const ContactSide& what = hit.what;
    return std::make_tuple(what.body, what.link, what.triangle, what.triangle < 0 ? what.lss : -1,
                           hit.object);
  };
  std::sort(hits.begin(), hits.end(), [&](const WorldHit& x, const WorldHit& y) {
    return key(x) != key(y) ? key(x) < key(y) : comesBefore(x, y);
  });
  const auto isTwin = [&](const WorldHit& x, const WorldHit& y) { return key(x) == key(y); };
  hits.erase(std::unique(hits.begin(), hits.end(), isTwin), hits.end());
}

void HitList::add(const WorldHit& hit) {
  std::vector<WorldHit>& hits = answer_.hits;
  if (which_ == AskWhich::Closest && !hits.empty()) {
    if (comesBefore(hit, hits.front())) hits.front() = hit;
  } else {
    hits.push_back(hit);
  }
  if (which_ == AskWhich::Closest) limit_ = hits.front().distance;
  if (which_ == AskWhich::Any) limit_ = -1.0;
}

void HitList::finish() {
  if (which_ == AskWhich::All) dropTwins();
  std::sort(answer_.hits.begin(), answer_.hits.end(), comesBefore);
}

}  // namespace foretouch::internal
