#include "network/log/event_log_format.h"

#include <algorithm>
#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace foretouch {
namespace {

constexpr std::size_t kChannelBytes = sizeof kLogBlockChannel - 1;
constexpr std::uint32_t kBlockVersion = 1;
constexpr std::uint32_t kIsLast = 1;
constexpr std::size_t kOwnHashOffset = kBlockPayloadBytes - 8;

template <typename Word>
Word readWord(const std::uint8_t* bytes) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i) word = static_cast<Word>(word << 8 | bytes[i]);
  return word;
}

template <typename Word>
void appendWord(Bytes& log, Word word) {
  for (std::size_t i = sizeof(Word); i-- > 0;) {
    log.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
  }
}

/// Reads 64-bit words one by one.
class WordReader {
 public:
  explicit WordReader(const std::uint8_t* bytes) : bytes_(bytes) {}
  std::uint64_t next() {
    const auto word = readWord<std::uint64_t>(bytes_);
    bytes_ += sizeof word;
    return word;
  }
  std::int64_t nextSigned() { return static_cast<std::int64_t>(next()); }

 private:
  const std::uint8_t* bytes_;
};

}  // namespace

bool parseEventHeader(const std::uint8_t* bytes, EventHeader& header) {
  if (std::memcmp(bytes, kEventMagic, sizeof kEventMagic) != 0) return false;
  header.number = static_cast<std::int64_t>(readWord<std::uint64_t>(bytes + 4));
  header.utimeUs = static_cast<std::int64_t>(readWord<std::uint64_t>(bytes + 12));
  // A negative length is a large one here.
  header.channelBytes = readWord<std::uint32_t>(bytes + 20);
  header.payloadBytes = readWord<std::uint32_t>(bytes + 24);
  return header.channelBytes >= 1 && header.channelBytes <= kMaxLogChannelBytes &&
         header.payloadBytes <= kMaxLogPayloadBytes;
}

bool isLogChannel(std::string_view channel) {
  constexpr unsigned char kFirstPrintable = 0x20, kDelete = 0x7F;
  return !channel.empty() && channel.size() <= kMaxLogChannelBytes &&
         std::all_of(channel.begin(), channel.end(), [](char c) {
           const auto byte = static_cast<unsigned char>(c);
           return byte >= kFirstPrintable && byte != kDelete;
         });
}

void appendEvent(Bytes& log, std::int64_t number, std::int64_t utimeUs, std::string_view channel,
                 ByteView payload) {
  log.insert(log.end(), std::begin(kEventMagic), std::end(kEventMagic));
  appendWord(log, static_cast<std::uint64_t>(number));
  appendWord(log, static_cast<std::uint64_t>(utimeUs));
  appendWord(log, static_cast<std::uint32_t>(channel.size()));
  appendWord(log, static_cast<std::uint32_t>(payload.size));
  log.insert(log.end(), channel.begin(), channel.end());
  if (payload.size > 0) log.insert(log.end(), payload.data, payload.data + payload.size);
}

void appendEvent(Bytes& log, const LogEvent& event) {
  appendEvent(log, event.number, event.utimeUs, event.channel, event.payload);
}

std::int64_t BlockEvent::eventNumber() const {
  // Unsigned: a foreign block event may say anything.
  const auto last = static_cast<std::uint64_t>(firstNumber) + blockEvents;
  return static_cast<std::int64_t>(blockEvents == 0 ? last : last - 1);
}

BlockEventState parseBlockEvent(const std::uint8_t* bytes, BlockEvent& event) {
  EventHeader header;
  if (!parseEventHeader(bytes, header) || header.channelBytes != kChannelBytes ||
      header.payloadBytes != kBlockPayloadBytes ||
      std::memcmp(bytes + kEventHeaderBytes, kLogBlockChannel, kChannelBytes) != 0) {
    return BlockEventState::None;
  }
  const std::uint8_t* const payload = bytes + kEventHeaderBytes + kChannelBytes;
  event.logId = readWord<std::uint64_t>(payload + 8);
  if (XXH64(payload, kOwnHashOffset, event.logId) !=
      readWord<std::uint64_t>(payload + kOwnHashOffset)) {
    return BlockEventState::Damaged;
  }
  if (readWord<std::uint32_t>(payload) != kBlockVersion) return BlockEventState::None;
  event.isLast = (readWord<std::uint32_t>(payload + 4) & kIsLast) != 0;
  WordReader words(payload + 16);
  event.number = words.next();
  event.offset = words.next();
  event.previous = words.next();
  event.blockBytes = words.next();
  event.blockEvents = words.next();
  event.firstNumber = words.nextSigned();
  event.utimeUs = words.nextSigned();
  event.earliestUs = words.nextSigned();
  event.latestUs = words.nextSigned();
  event.blockHash = words.next();
  const bool isOwn = header.number == event.eventNumber() && header.utimeUs == event.utimeUs;
  return isOwn ? BlockEventState::Intact : BlockEventState::Copied;
}

void appendBlockEvent(Bytes& log, const BlockEvent& event) {
  Bytes payload;
  payload.reserve(kBlockPayloadBytes);
  appendWord(payload, kBlockVersion);
  appendWord(payload, event.isLast ? kIsLast : std::uint32_t{0});
  for (const std::uint64_t word :
       {event.logId, event.number, event.offset, event.previous, event.blockBytes,
        event.blockEvents, static_cast<std::uint64_t>(event.firstNumber),
        static_cast<std::uint64_t>(event.utimeUs), static_cast<std::uint64_t>(event.earliestUs),
        static_cast<std::uint64_t>(event.latestUs), event.blockHash}) {
    appendWord(payload, word);
  }
  const std::uint64_t ownHash = XXH64(payload.data(), payload.size(), event.logId);
  appendWord(payload, ownHash);
  appendEvent(log, event.eventNumber(), event.utimeUs, kLogBlockChannel, payload);
}

std::uint64_t blockHashOf(ByteView block, std::uint64_t logId) {
  return XXH64(block.data, block.size, logId);
}

}  // namespace foretouch
