#include "middleware/ask/hit_list.h"

#include <algorithm>
#include <tuple>

namespace foretouch::internal {

bool comesBefore(const WorldHit& x, const WorldHit& y) {
  const auto key = [](const WorldHit& hit) {
    return std::make_tuple(hit.distance, hit.what.body, hit.what.link, hit.what.lss,
                           hit.what.triangle);
  };
  return key(x) < key(y);
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
  std::sort(answer_.hits.begin(), answer_.hits.end(), comesBefore);
}

}  // namespace foretouch::internal
