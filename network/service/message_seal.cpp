#include "network/service/message_seal.h"

#include <algorithm>

namespace foretouch::internal {

Reject MessageSeal::open(WireMessage& message, std::int64_t& sentUtimeUs) const {
  SignedPayload opened{withoutSignature(message.payload), 0};
  if (key_) {
    const Reject reject = key_->open(message.channel, message.payload, opened);
    if (reject != Reject::None) return reject;
  }
  sentUtimeUs = opened.sentUtimeUs;
  message.payload.resize(opened.content.size);
  return Reject::None;
}

void MessageSeal::sign(const std::string& channel, Bytes& payload) {
  if (!key_) return;
  std::int64_t last = last_.load();
  std::int64_t next = 0;
  do {
    next = std::max(clock_.utimeUs(), last + 1);
  } while (!last_.compare_exchange_weak(last, next));
  key_->sign(channel, next, payload);
}

}  // namespace foretouch::internal
