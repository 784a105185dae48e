#include "network/world_stream/bound_world.h"

#include <algorithm>
#include <arpa/inet.h>

namespace foretouch {

SpeakerGate& BoundWorld::gateOf(BodyNumber body) {
  const auto known = gates_.find(body);
  if (known != gates_.end()) return *known->second;
  if (gates_.size() >= solver_.policy().maxBodies) {
    for (auto gate = gates_.begin(); gate != gates_.end();) {
      gate = solver_.isThere(gate->first) ? std::next(gate) : gates_.erase(gate);
    }
  }
  return *gates_.emplace(body, std::make_unique<SpeakerGate>(policy_)).first->second;
}

/// Precondition: the body is there.
bool BoundWorld::mayPass(const Heard& heard, BodyNumber body, WorldRecord& record) {
  if (heard.sender == UdpmSender()) return true;  // liblcm does not say who
  SpeakerGate& gate = gateOf(body);
  switch (gate.admit(heard.sender, heard.receiveUtimeUs)) {
    case SpeakerGate::Admission::Refused: return false;
    case SpeakerGate::Admission::Takeover:
      // Which sender speaks for an avatar is its own stream's affair: to say it here, too, would
      // change that in a replay.
      if (solver_.isAvatar(body)) return true;
      record.speaker({body, std::max<std::int64_t>(0, heard.receiveUtimeUs),
                      ntohl(heard.sender.address), ntohs(heard.sender.port)});
      solver_.changeSpeaker(body);
      return true;
    default: return true;
  }
}

bool BoundWorld::hasRoomFor(const UdpmSender& sender) const {
  if (sender == UdpmSender()) return true;  // liblcm does not say who
  const std::size_t there = solver_.numBodies(), most = solver_.policy().maxBodies;
  const auto isOfSender = [&](const auto& known) {
    return known.second->isSpeaker(sender) && solver_.isThere(known.first);
  };
  const auto own = std::count_if(gates_.begin(), gates_.end(), isOfSender);
  return there < most && static_cast<std::size_t>(own) < most - there;
}

Reject BoundWorld::take(const Heard& heard, const BodyMessage& message, WorldRecord& record) {
  Reject reason = sessionFault(message.session, heard.receiveUtimeUs);
  const bool isThere = solver_.isThere(message.body);
  if (reason == Reject::None && !isThere && message.isPresent && !hasRoomFor(heard.sender)) {
    reason = Reject::Limit;
  }
  if (reason == Reject::None && isThere && !mayPass(heard, message.body, record)) {
    reason = Reject::OtherSender;
  }
  if (reason != Reject::None) {
    solver_.refusedState(reason);
    return reason;
  }
  // A sender that speaks first of a body that is gone contends with none.
  if (!isThere) gates_.erase(message.body);
  reason = solver_.take(message, heard.receiveUtimeUs);
  if (reason != Reject::None) return reason;
  record.body(heard.payload, heard.receiveUtimeUs);
  if (heard.sender != UdpmSender()) {
    gateOf(message.body).accepted(heard.sender, heard.receiveUtimeUs);
  }
  return reason;
}

Reject BoundWorld::take(const Heard& heard, RigidPoseMessage& message, WorldRecord& record) {
  const Reject future = sessionFault(message.session, heard.receiveUtimeUs);
  const std::size_t told = message.bodies.size();
  const auto isRefused = [&](const BodyPose& pose) {
    Reject reason = future;
    if (reason == Reject::None && solver_.isThere(pose.body) &&
        !mayPass(heard, pose.body, record)) {
      reason = Reject::OtherSender;
    }
    if (reason != Reject::None) solver_.refusedPose(pose.body, reason, heard.receiveUtimeUs);
    return reason != Reject::None;
  };
  auto& bodies = message.bodies;
  bodies.erase(std::remove_if(bodies.begin(), bodies.end(), isRefused), bodies.end());
  if (bodies.empty() && told > 0) return future != Reject::None ? future : Reject::OtherSender;
  const Reject reason = solver_.take(message, heard.receiveUtimeUs);
  if (reason != Reject::None && !solver_.isNoted()) return reason;
  ByteView payload = heard.payload;
  if (bodies.size() < told) {
    encode(message, payload_);
    payload = payload_;
  }
  record.rigidPose(payload, heard.receiveUtimeUs);
  if (heard.sender == UdpmSender()) return reason;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (solver_.reasons()[i] != Reject::None) continue;
    gateOf(bodies[i].body).accepted(heard.sender, heard.receiveUtimeUs);
  }
  return reason;
}

}  // namespace foretouch
