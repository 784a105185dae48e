#include "tests/fuzz/datagram_inputs.h"

#include <algorithm>
#include <string>
#include <vector>

#include "network/wire/messages.h"
#include "network/wire/udpm_reassembly.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

struct Sent {
  std::uint16_t port = 0;
  Bytes bytes;  // on the heap at their exact size
};

std::vector<Sent> datagramsIn(const std::uint8_t* data, std::size_t size,
                              std::vector<bool>& pauses) {
  std::vector<Sent> all;
  std::size_t at = 0;
  while (at + 3 <= size) {
    const unsigned control = data[at];
    const std::size_t length = static_cast<std::size_t>(data[at + 1] << 8 | data[at + 2]);
    at += 3;
    const std::size_t end = at + std::min(length, size - at);
    all.push_back({static_cast<std::uint16_t>(control & 3), Bytes(data + at, data + end)});
    pauses.push_back((control & 4) != 0);
    at = end;
  }
  return all;
}

void checkViews(const Bytes& bytes) {
  UdpmDatagram datagram;
  if (parseDatagram(bytes, datagram) != DatagramFault::None) return;
  const std::uint8_t* const end = bytes.data() + bytes.size();
  require(datagram.payload.data > bytes.data() && datagram.payload.data <= end &&
              datagram.payload.data + datagram.payload.size == end,
          "the payload is the datagram's end");
  const bool hasChannel = !datagram.isFragment || datagram.fragment == 0;
  require(hasChannel == isLegalChannel(datagram.channel), "where a channel is, it is legal");
  if (!datagram.isFragment) return;
  require(datagram.messageBytes <= kMaxMessageBytes, "messages are bounded");
  require(datagram.fragment < datagram.fragments && datagram.fragments <= kMaxFragments,
          "fragments are bounded");
  require(datagram.offset + datagram.payload.size <= datagram.messageBytes,
          "a fragment is within its message");
}

/// Offset of a fragment by the protocol's own words, apart from the code under test.
std::size_t numberAt(const Bytes& bytes, std::size_t at) {
  return static_cast<std::size_t>(bytes[at]) << 24 | static_cast<std::size_t>(bytes[at + 1]) << 16 |
         static_cast<std::size_t>(bytes[at + 2]) << 8 | bytes[at + 3];
}

/// Whether `sent` up to `last` holds every byte of the message at its place.
bool wasSent(const WireMessage& message, const std::vector<Sent>& sent, std::size_t last) {
  const Bytes& payload = message.payload;
  const Bytes& completing = sent[last].bytes;
  const std::string ending = message.channel + '\0' + std::string(payload.begin(), payload.end());
  if (completing[3] == '2') return std::string(completing.begin() + 8, completing.end()) == ending;
  std::vector<bool> isThere(payload.size(), false);
  bool isNamed = false;
  for (std::size_t i = 0; i <= last; ++i) {
    const Bytes& bytes = sent[i].bytes;
    if (sent[i].port != sent[last].port || bytes.size() < 20 || bytes[3] != '3') continue;
    if (!std::equal(bytes.begin() + 4, bytes.begin() + 12, completing.begin() + 4)) continue;
    std::size_t begin = 20;
    if (bytes[16] == 0 && bytes[17] == 0) {
      const auto nul = std::find(bytes.begin() + 20, bytes.end(), std::uint8_t{0});
      isNamed = isNamed || std::string(bytes.begin() + 20, nul) == message.channel;
      begin = static_cast<std::size_t>(nul - bytes.begin()) + 1;
    }
    const std::size_t offset = numberAt(bytes, 12);
    for (std::size_t k = begin; k < bytes.size(); ++k) {
      const std::size_t place = offset + k - begin;
      if (place < payload.size() && payload[place] == bytes[k]) isThere[place] = true;
    }
  }
  return isNamed && std::find(isThere.begin(), isThere.end(), false) == isThere.end();
}

}  // namespace

bool feedDatagrams(const std::uint8_t* data, std::size_t size) {
  std::vector<bool> pauses;
  const std::vector<Sent> sent = datagramsIn(data, size, pauses);
  UdpmReassembler reassembler({"P", "POSE"});
  std::vector<WireMessage> messages;
  std::int64_t utimeUs = 0;
  std::size_t delivered = 0;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    checkViews(sent[i].bytes);
    if (pauses[i]) utimeUs += kMaxFragmentPauseUs + 1;
    messages.clear();
    reassembler.take({1, sent[i].port}, sent[i].bytes, utimeUs, messages);
    require(messages.size() <= 1, "a datagram completes one message at most");
    require(reassembler.numPartials() <= kMaxPartialMessages, "unfinished messages are few");
    // Twice what came, and what each message costs by itself.
    require(reassembler.bytesHeld() <= 2 * size + kMaxPartialMessages * 2048,
            "memory is what fragments brought");
    delivered += messages.size();
    for (const WireMessage& message : messages) {
      require(message.channel == "P" || message.channel == "POSE", "the channel was asked for");
      require(message.payload.size() <= kMaxMessageBytes, "messages are bounded");
      require(message.receiveUtimeUs == utimeUs, "the stamp is the completing datagram's");
      require(wasSent(message, sent, i), "only what was sent is delivered");
    }
  }
  require(reassembler.counts().datagrams == sent.size(), "every datagram is counted");
  require(reassembler.counts().messages == delivered, "every message is counted");
  return delivered > 0;
}

}  // namespace foretouch::fuzz
