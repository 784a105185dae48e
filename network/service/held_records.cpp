#include "network/service/held_records.h"

namespace foretouch::internal {

void HeldRecords::add(std::int64_t utimeUs, const std::string& channel, ByteView payload) {
  if (count_ == held_.size()) held_.emplace_back();
  Held& held = held_[count_++];
  held.utimeUs = utimeUs;
  held.channel = &channel;
  held.payload.assign(payload.data, payload.data + payload.size);
}

void HeldRecords::flush(Outlet& outlet) {
  for (std::size_t i = 0; i < count_; ++i) {
    outlet.record(held_[i].utimeUs, *held_[i].channel, held_[i].payload);
  }
  count_ = 0;
}

void HeldStream::speaker(const SpeakerMessage& message) {
  Bytes payload;
  encode(message, payload);
  held_.add(message.utimeUs, channels_.speaker, payload);
}

void HeldStream::skeleton(ByteView payload, std::int64_t receiveUtimeUs) {
  held_.add(receiveUtimeUs, channels_.skeleton, payload);
}

void HeldStream::pose(ByteView payload, std::int64_t receiveUtimeUs) {
  held_.add(receiveUtimeUs, channels_.pose, payload);
}

void HeldStream::leftOut() {
  counter_.leftOut();
}

}  // namespace foretouch::internal
