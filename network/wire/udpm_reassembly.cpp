#include "network/wire/udpm_reassembly.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "lss/assert.h"

namespace foretouch {
namespace {

// The largest message with its bookkeeping fits several times: makeWay() always finds another one.
static_assert(2 * (kMaxMessageBytes + kMaxFragments * 64) < kMaxPartialBytes);

bool isRecent(std::int64_t thenUs, std::int64_t nowUs) {
  // The clock may also have been set back.
  return nowUs - thenUs <= kMaxFragmentPauseUs && thenUs - nowUs <= kMaxFragmentPauseUs;
}

/// Doubles, but never beyond the message's full size.
template <typename T>
void growFor(std::vector<T>& values, std::size_t needed, std::size_t most) {
  if (needed <= values.capacity()) return;
  values.reserve(std::min(most, std::max(needed, 2 * values.capacity())));
}

}  // namespace

UdpmReassembler::Partial::Partial() = default;

std::size_t UdpmReassembler::Partial::bytesHeld() const {
  return sizeof(Partial) + channel.capacity() + bytes.capacity() +
         pieces.capacity() * sizeof(Piece);
}

UdpmReassembler::UdpmReassembler(const std::vector<std::string>& channels)
    : channels_(channels.begin(), channels.end()) {}

bool UdpmReassembler::isSame(const Key& a, const Key& b) {
  return a.sequence == b.sequence && a.sender == b.sender;
}

bool UdpmReassembler::isWanted(std::string_view channel) const {
  return channels_.find(channel) != channels_.end();
}

std::size_t UdpmReassembler::numPartials() const {
  return static_cast<std::size_t>(std::count_if(slots_.begin(), slots_.end(),
                                                [](const Slot& slot) { return slot.has_value(); }));
}

std::size_t UdpmReassembler::bytesHeld() const {
  std::size_t held = 0;
  for (const Slot& slot : slots_) held += slot ? slot->bytesHeld() : 0;
  return held;
}

void UdpmReassembler::take(const UdpmSender& sender, ByteView bytes, std::int64_t receiveUtimeUs,
                           std::vector<WireMessage>& messages) {
  ++takes_;
  ++counts_.datagrams;
  UdpmDatagram datagram;
  const DatagramFault fault = parseDatagram(bytes, datagram);
  if (fault != DatagramFault::None) return count(fault);
  if (datagram.isFragment) {
    return takeFragment({sender, datagram.sequence}, datagram, receiveUtimeUs, messages);
  }
  if (!isWanted(datagram.channel)) {
    ++counts_.otherChannels;
    return;
  }
  const std::uint8_t* payload = datagram.payload.data;
  deliver(sender,
          {std::string(datagram.channel), Bytes(payload, payload + datagram.payload.size),
           receiveUtimeUs},
          messages);
}

void UdpmReassembler::takeFragment(const Key& key, const UdpmDatagram& datagram,
                                   std::int64_t utimeUs, std::vector<WireMessage>& messages) {
  if (const Finished* finished = findFinished(key, utimeUs)) {
    if (finished->fault != DatagramFault::None) count(finished->fault);
    return;
  }
  Slot* slot = findPartial(key);
  if (slot != nullptr && !isRecent((*slot)->lastUtimeUs, utimeUs)) {
    count(DatagramFault::Incomplete);
    slot->reset();
    slot = nullptr;
  }
  if (datagram.fragment == 0 && !isWanted(datagram.channel)) {
    ++counts_.otherChannels;
    if (slot != nullptr) slot->reset();
    return remember(key, DatagramFault::None, utimeUs);
  }
  if (slot == nullptr) slot = &startPartial(key, datagram);
  Partial& partial = **slot;
  partial.lastTake = takes_;
  partial.lastUtimeUs = utimeUs;

  const DatagramFault fault = check(partial, datagram);
  if (fault != DatagramFault::None) {
    count(fault);
    if (fault == DatagramFault::Conflict) finish(*slot, DatagramFault::Conflict, utimeUs);
    return;
  }
  addPiece(partial, datagram);
  if (partial.pieces.size() < partial.fragments) return;
  if (auto payload = assembled(partial)) {
    deliver(key.sender, {std::move(partial.channel), std::move(*payload), utimeUs}, messages);
    finish(*slot, DatagramFault::Repeated, utimeUs);
  } else {
    count(DatagramFault::Conflict);
    finish(*slot, DatagramFault::Conflict, utimeUs);
  }
}

const UdpmReassembler::Finished* UdpmReassembler::findFinished(const Key& key,
                                                               std::int64_t utimeUs) const {
  const auto end = finished_.begin() + static_cast<std::ptrdiff_t>(numFinished_);
  const auto found = std::find_if(finished_.begin(), end, [&](const Finished& finished) {
    return isSame(finished.key, key) && isRecent(finished.utimeUs, utimeUs);
  });
  return found == end ? nullptr : &*found;
}

UdpmReassembler::Slot* UdpmReassembler::findPartial(const Key& key) {
  const auto found = std::find_if(slots_.begin(), slots_.end(),
                                  [&](const Slot& slot) { return slot && isSame(slot->key, key); });
  return found == slots_.end() ? nullptr : &*found;
}

UdpmReassembler::Slot& UdpmReassembler::startPartial(const Key& key, const UdpmDatagram& datagram) {
  if (numPartials() == slots_.size()) makeWay(key.sender, nullptr);
  Slot& slot = *std::find_if(slots_.begin(), slots_.end(),
                             [](const Slot& candidate) { return !candidate.has_value(); });
  slot.emplace();
  slot->key = key;
  slot->messageBytes = datagram.messageBytes;
  slot->fragments = datagram.fragments;
  return slot;
}

DatagramFault UdpmReassembler::check(const Partial& partial, const UdpmDatagram& datagram) {
  if (partial.messageBytes != datagram.messageBytes || partial.fragments != datagram.fragments) {
    return DatagramFault::Conflict;
  }
  const ByteView& payload = datagram.payload;
  if (partial.isThere[datagram.fragment]) {
    const auto piece =
        std::find_if(partial.pieces.begin(), partial.pieces.end(),
                     [&](const Piece& p) { return p.fragment == datagram.fragment; });
    const bool isRepeated = piece->offset == datagram.offset && piece->size == payload.size &&
                            std::memcmp(&partial.bytes[piece->at], payload.data, payload.size) == 0;
    return isRepeated ? DatagramFault::Repeated : DatagramFault::Conflict;
  }
  return partial.bytes.size() + payload.size > partial.messageBytes ? DatagramFault::Conflict
                                                                    : DatagramFault::None;
}

void UdpmReassembler::addPiece(Partial& partial, const UdpmDatagram& datagram) {
  const ByteView& payload = datagram.payload;
  growFor(partial.bytes, partial.bytes.size() + payload.size, partial.messageBytes);
  growFor(partial.pieces, partial.pieces.size() + 1, partial.fragments);
  partial.pieces.push_back({datagram.offset, static_cast<std::uint32_t>(payload.size),
                            static_cast<std::uint32_t>(partial.bytes.size()), datagram.fragment});
  partial.bytes.insert(partial.bytes.end(), payload.data, payload.data + payload.size);
  partial.isThere.set(datagram.fragment);
  if (datagram.fragment == 0) partial.channel = datagram.channel;
  // One message at its largest fits several times, so this ends with `partial` still there.
  while (bytesHeld() > kMaxPartialBytes) makeWay(partial.key.sender, &partial);
}

std::optional<Bytes> UdpmReassembler::assembled(Partial& partial) {
  std::vector<const Piece*> inOrder(partial.fragments);
  for (const Piece& piece : partial.pieces) inOrder[piece.fragment] = &piece;
  // Every fragment is there once; if each begins where the one before ends, so is every byte.
  std::size_t end = 0;
  bool arrivedInOrder = true;
  for (const Piece* piece : inOrder) {
    if (piece->offset != end) return std::nullopt;
    arrivedInOrder = arrivedInOrder && piece->at == end;
    end += piece->size;
  }
  FORETOUCH_ASSERT(end == partial.messageBytes);  // the last one ends there: parseDatagram()
  if (arrivedInOrder) return std::move(partial.bytes);
  Bytes payload;
  payload.reserve(end);
  for (const Piece* piece : inOrder) {
    const std::uint8_t* from = &partial.bytes[piece->at];
    payload.insert(payload.end(), from, from + piece->size);
  }
  return payload;
}

void UdpmReassembler::finish(Slot& slot, DatagramFault fault, std::int64_t utimeUs) {
  remember(slot->key, fault, utimeUs);
  slot.reset();
}

void UdpmReassembler::remember(const Key& key, DatagramFault fault, std::int64_t utimeUs) {
  finished_[nextFinished_] = {key, utimeUs, fault};
  nextFinished_ = (nextFinished_ + 1) % finished_.size();
  numFinished_ = std::min(numFinished_ + 1, finished_.size());
}

void UdpmReassembler::deliver(const UdpmSender& sender, WireMessage message,
                              std::vector<WireMessage>& messages) {
  ++counts_.messages;
  message.sender = sender;
  messages.push_back(std::move(message));
  if (known_[lastKnown_].lastTake == 0 || known_[lastKnown_].sender != sender) {
    auto entry = std::find_if(known_.begin(), known_.end(), [&](const KnownSender& known) {
      return known.lastTake != 0 && known.sender == sender;
    });
    if (entry == known_.end()) {
      entry = std::min_element(
          known_.begin(), known_.end(),
          [](const KnownSender& a, const KnownSender& b) { return a.lastTake < b.lastTake; });
    }
    lastKnown_ = static_cast<std::size_t>(entry - known_.begin());
  }
  known_[lastKnown_] = {sender, takes_};
}

bool UdpmReassembler::isKnown(const UdpmSender& sender) const {
  for (const KnownSender& known : known_) {
    if (known.lastTake == 0) return false;  // filled from the front
    if (known.sender == sender) return true;
  }
  return false;
}

void UdpmReassembler::makeWay(const UdpmSender& newcomer, const Partial* kept) {
  Slot* victim = nullptr;
  std::tuple<int, bool, int, std::uint64_t> worst;
  for (Slot& slot : slots_) {
    if (!slot || &*slot == kept) continue;
    const UdpmSender& sender = slot->key.sender;
    // The newcomer's message counts, too.
    int ofSender = sender == newcomer ? 1 : 0;
    int ofAddress = sender.address == newcomer.address ? 1 : 0;
    for (const Slot& other : slots_) {
      if (!other) continue;
      ofSender += other->key.sender == sender ? 1 : 0;
      ofAddress += other->key.sender.address == sender.address ? 1 : 0;
    }
    const std::tuple rank{ofSender, !isKnown(sender), ofAddress, takes_ - slot->lastTake};
    if (victim == nullptr || rank > worst) {
      victim = &slot;
      worst = rank;
    }
  }
  if (victim == nullptr) return;
  count(DatagramFault::Incomplete);
  victim->reset();
}

}  // namespace foretouch
