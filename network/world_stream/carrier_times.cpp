#include "network/world_stream/carrier_times.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace foretouch::internal {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// Of the bodies above or below one, at all times, no more than so many spans are looked at. Eight
/// that hang on one another and are handed over ten times a second stay far below.
constexpr std::size_t kMostLooked = 1024;

/// Calls `visit(carrier, fromUs, toUs)` for each time from `fromUs` on in which another body
/// carries it.
template <typename Visit>
void forEachCarrier(const LiveBody& body, std::int64_t fromUs, const Visit& visit) {
  const std::size_t told = body.carriers.size(), all = told + body.changes.size();
  const auto sinceUs = [&](std::size_t i) {
    return i < told ? body.carriers[i].sinceUs : body.changes[i - told].sinceUs;
  };
  for (std::size_t i = 0; i < all; ++i) {
    const LiveChange* const change = i < told ? nullptr : &body.changes[i - told];
    if (change != nullptr && !change->hasCarrier()) continue;
    const BodyNumber carrier = change != nullptr ? change->carrier : body.carriers[i].carrier;
    const std::int64_t toUs = i + 1 < all ? sinceUs(i + 1) : kNever;
    if (carrier != kNoBody && toUs > fromUs) visit(carrier, std::max(fromUs, sinceUs(i)), toUs);
  }
}

/// One that hangs above or below another in a time.
struct Hanging {
  BodyNumber body = 0;
  std::int64_t fromUs = 0, toUs = 0;
  int depth = 0;
};

/// How many hang on one another below the body at most, at any time from `sinceUs` on.
int depthBelow(const LiveBodies& bodies, BodyNumber body, std::int64_t sinceUs) {
  struct Span {
    BodyNumber rider, carrier;
    std::int64_t fromUs, toUs;
  };
  std::vector<Span> spans;
  for (const auto& [number, other] : bodies) {
    forEachCarrier(other, sinceUs, [&, rider = number](BodyNumber carrier, auto fromUs, auto toUs) {
      spans.push_back({rider, carrier, fromUs, toUs});
    });
  }
  std::vector<Hanging> below{{body, sinceUs, kNever, 0}};
  int deepest = 0;
  for (std::size_t i = 0; i < below.size() && deepest < kMostCarriers; ++i) {
    const Hanging next = below[i];
    if (i == kMostLooked) return kMostCarriers;
    deepest = std::max(deepest, next.depth);
    for (const Span& span : spans) {
      const std::int64_t fromUs = std::max(span.fromUs, next.fromUs);
      const std::int64_t toUs = std::min(span.toUs, next.toUs);
      if (span.carrier != next.body || fromUs >= toUs) continue;
      below.push_back({span.rider, fromUs, toUs, next.depth + 1});
    }
  }
  return deepest;
}

}  // namespace

Reject carrierFault(const LiveBodies& bodies, BodyNumber body, BodyNumber carrier,
                    std::int64_t sinceUs) {
  if (carrier == kNoBody) return Reject::None;
  const int below = depthBelow(bodies, body, sinceUs);
  std::vector<Hanging> above{{carrier, sinceUs, kNever, 1}};
  // Each is at its times above exactly one: so this ends, circle or not.
  for (std::size_t i = 0; i < above.size(); ++i) {
    const Hanging next = above[i];
    if (next.body == body) return Reject::CarrierLoop;
    if (i == kMostLooked || next.depth + below > kMostCarriers) return Reject::Limit;
    const auto found = bodies.find(next.body);
    if (found == bodies.end()) return Reject::UnknownBody;
    forEachCarrier(found->second, next.fromUs,
                   [&](BodyNumber higher, std::int64_t fromUs, std::int64_t toUs) {
                     if (fromUs >= next.toUs) return;
                     above.push_back({higher, fromUs, std::min(toUs, next.toUs), next.depth + 1});
                   });
  }
  return Reject::None;
}

bool isUnknown(const LiveBodies& bodies, BodyNumber body, LinkId link, std::int64_t fromUs,
               std::int64_t toUs) {
  if (body < 0) return false;  // the scene, every body
  struct Part {
    BodyNumber body;
    LinkId link;
    bool operator==(const Part& o) const { return body == o.body && link == o.link; }
  };
  std::vector<Part> parts{{body, link}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part part = parts[i];
    const auto found = bodies.find(part.body);
    if (found == bodies.end()) return true;
    const LiveBody& known = found->second;
    if (known.isUnknown(part.link, fromUs, toUs)) return true;
    if (!known.isHeldFast && known.saidUntilUs() < toUs) return true;
    // At the instant of a change, also by the body that carried it until then.
    for (std::size_t c = 0; c < known.carriers.size(); ++c) {
      const LiveCarrier& by = known.carriers[c];
      const bool isOver = c + 1 < known.carriers.size() && known.carriers[c + 1].sinceUs < fromUs;
      if (isOver || by.sinceUs > toUs || by.carrier == kNoBody) continue;
      const Part higher{by.carrier, by.link};
      if (std::find(parts.begin(), parts.end(), higher) == parts.end()) parts.push_back(higher);
    }
  }
  return false;
}

}  // namespace foretouch::internal
