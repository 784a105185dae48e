#include "network/world_stream/refused_bodies.h"

#include <algorithm>
#include <cmath>

namespace foretouch {
namespace {

/// More are not kept: the body that was refused longest ago makes place.
constexpr std::size_t kMostKept = 256;
/// A body of which no pose came for so long is not listed any more.
constexpr std::int64_t kOverUs = 2'000'000;

}  // namespace

std::string describe(const RefusedBody& body) {
  constexpr double kTenthsPerUs = 1e-5;
  const auto tenths = std::llround(static_cast<double>(body.lastUs - body.sinceUs) * kTenthsPerUs);
  return "body " + std::to_string(body.body) + ": none of its " + std::to_string(body.poses) +
         " poses was accepted for " + std::to_string(tenths / 10) + "." +
         std::to_string(tenths % 10) + " s: " + toString(body.reason);
}

void RefusedBodies::refused(BodyNumber body, Reject reason, std::int64_t receiveUtimeUs) {
  // The network repeats; the pose was accepted.
  if (reason == Reject::Duplicate) return;
  nowUs_ = receiveUtimeUs;
  const auto known = bodies_.find(body);
  if (known == bodies_.end() && bodies_.size() >= kMostKept) {
    bodies_.erase(std::min_element(
        bodies_.begin(), bodies_.end(),
        [](const auto& x, const auto& y) { return x.second.lastUs < y.second.lastUs; }));
  }
  RefusedBody& kept = bodies_[body];
  const bool isNew = kept.poses == 0 || receiveUtimeUs - kept.lastUs > kOverUs;
  if (isNew) kept = {body, reason, receiveUtimeUs, receiveUtimeUs, 0};
  kept.reason = reason;
  kept.lastUs = receiveUtimeUs;
  ++kept.poses;
}

void RefusedBodies::accepted(BodyNumber body) {
  if (!bodies_.empty()) bodies_.erase(body);
}

std::vector<RefusedBody> RefusedBodies::list(std::size_t& all) const {
  std::vector<RefusedBody> listed;
  for (const auto& [number, body] : bodies_) {
    const bool isOver = nowUs_ - body.lastUs > kOverUs;
    if (!isOver && body.lastUs - body.sinceUs >= kRefusedAfterUs) listed.push_back(body);
  }
  all = listed.size();
  std::sort(listed.begin(), listed.end(), [](const RefusedBody& x, const RefusedBody& y) {
    return x.sinceUs != y.sinceUs ? x.sinceUs < y.sinceUs : x.body < y.body;
  });
  if (listed.size() > kMostRefusedListed) listed.resize(kMostRefusedListed);
  return listed;
}

}  // namespace foretouch
