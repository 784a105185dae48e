#include "network/world_stream/live_body.h"

#include <algorithm>

namespace foretouch::internal {

bool isSamePose(const RigidPose& x, const RigidPose& y) {
  return x.translation == y.translation && x.rotation.coeffs() == y.rotation.coeffs();
}

LiveChange LiveBody::carriedSince(std::int64_t utimeUs) const {
  return {utimeUs,
          true,
          carriers.back().carrier,
          carriers.back().link,
          !isHeldFast,
          {told.rotations[0], told.translations[0]},
          toldUntilUs};
}

/// A pose at the very instant of a change is in the frame before it: at the first change that is
/// heard, it must be the same pose.
bool LiveBody::hasFrameOf(std::int64_t utimeUs, const RigidPose& pose) const {
  return utimeUs > firstUs || (utimeUs == firstUs && isSamePose(pose, firstPose));
}

void LiveBody::ripen(std::int64_t nowUs) {
  while (!announced.empty()) {
    const LiveChange& next = announced.front();
    const bool isClosed = !isAwaited || saidUntilUs() < 0 || knownUntilUs >= next.sinceUs;
    if (next.sinceUs + (isClosed ? 0 : kClosingUs) > nowUs) return;
    isAwaited = next.awaitsPoses();
    if (next.isPresent) stateUs = std::max(stateUs, next.sinceUs);
    announced.pop_front();
  }
}

void LiveBody::addUnknown(LinkId link, UndecidedReason reason, std::int64_t fromUs,
                          std::int64_t toUs) {
  for (UnknownSpan& span : unknown) {
    if (span.link != link || span.reason != reason || span.toUs < fromUs) continue;
    span.fromUs = std::min(span.fromUs, fromUs);
    span.toUs = std::max(span.toUs, toUs);
    return;
  }
  unknown.push_back({link, reason, fromUs, toUs});
}

void LiveBody::forgetBefore(std::int64_t utimeUs) {
  const auto isOver = [&](const UnknownSpan& span) { return span.toUs < utimeUs; };
  unknown.erase(std::remove_if(unknown.begin(), unknown.end(), isOver), unknown.end());
  while (carriers.size() > 1 && carriers[1].sinceUs < utimeUs) carriers.erase(carriers.begin());
}

bool LiveBody::isUnknown(LinkId link, std::int64_t fromUs, std::int64_t toUs) const {
  return std::any_of(unknown.begin(), unknown.end(), [&](const UnknownSpan& span) {
    const bool isOf = span.link == kEveryLink || link == kEveryLink || span.link == link;
    return isOf && span.fromUs <= toUs && fromUs <= span.toUs;
  });
}

Reject rigidPlaceFault(const LiveBody& body, const RigidPlace& place, std::int64_t receiveUtimeUs,
                       std::int64_t restartUs, bool& isGap) {
  // It is not known whether the first pose that is heard is the first one.
  isGap = !body.hasStream;
  if (isGap) return Reject::None;
  if (place.utimeUs <= body.knownUntilUs) {
    const bool isCopy = place.session == body.session && place.sequence == body.sequence &&
                        place.utimeUs == body.knownUntilUs;
    if (isCopy) return Reject::Duplicate;
    if (place.session < body.session) return Reject::OldSession;
    return place.session == body.session && place.sequence < body.sequence ? Reject::OutOfOrder
                                                                           : Reject::StaleStamp;
  }
  isGap = body.isOtherSpeaker || place.session != body.session ||
          place.sequence != body.sequence + 1 || body.skips;
  if (body.isOtherSpeaker || receiveUtimeUs - body.heardUs > restartUs) {
    isGap = true;
    return Reject::None;
  }
  if (place.session < body.session) return Reject::OldSession;
  if (place.session > body.session) return Reject::None;
  if (place.sequence == body.sequence) return Reject::Duplicate;
  return place.sequence < body.sequence ? Reject::OutOfOrder : Reject::None;
}

}  // namespace foretouch::internal
