// network/log/event_log_format.h: the bytes of an LCM event log, and of the events that verify its
// blocks (docs/formats.md, "Event logs"). Pure: reads any bytes; allocates only what it appends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "network/log/event_log.h"

namespace foretouch {

inline constexpr std::uint8_t kEventMagic[] = {0xED, 0xA1, 0xDA, 0x01};
inline constexpr std::size_t kEventHeaderBytes = 28;
inline constexpr std::size_t kMaxEventBytes =
    kEventHeaderBytes + kMaxLogChannelBytes + kMaxLogPayloadBytes;

struct EventHeader {
  std::int64_t number = 0;
  std::int64_t utimeUs = 0;
  std::size_t channelBytes = 0, payloadBytes = 0;

  [[nodiscard]] std::size_t eventBytes() const {
    return kEventHeaderBytes + channelBytes + payloadBytes;
  }
};

/// Whether kEventHeaderBytes of `bytes` are a header whose lengths are possible.
[[nodiscard]] bool parseEventHeader(const std::uint8_t* bytes, EventHeader& header);

/// 1 to kMaxLogChannelBytes bytes, none of them a control character.
[[nodiscard]] bool isLogChannel(std::string_view channel);

/// Precondition: a channel and a payload within the limits.
void appendEvent(Bytes& log, const LogEvent& event);
void appendEvent(Bytes& log, std::int64_t number, std::int64_t utimeUs, std::string_view channel,
                 ByteView payload);

/// The content of an event on kLogBlockChannel. Offsets are from the log's first byte.
struct BlockEvent {
  bool isLast = false;           ///< Its log was closed here.
  std::uint64_t logId = 0;       ///< Drawn at random when the log is created; the seed of its
                                 ///< hashes.
  std::uint64_t number = 0;      ///< 0 opens the log and covers nothing; then one per block.
  std::uint64_t offset = 0;      ///< Offset of this event.
  std::uint64_t previous = 0;    ///< Offset of the last block event; 0 in the opening one.
  std::uint64_t blockBytes = 0;  ///< Right before this event.
  std::uint64_t blockEvents = 0;
  std::int64_t firstNumber = 0;  ///< The block's first event's, or the next one's if it has none.
  std::int64_t utimeUs = 0;      ///< This event's own stamp: the last one of its block.
  std::int64_t earliestUs = 0, latestUs = 0;  ///< Stamps in the block.
  std::uint64_t blockHash = 0;                ///< XXH64 of the block's bytes.

  /// This event's own number: the block's last one.
  [[nodiscard]] std::int64_t eventNumber() const;
};
inline constexpr std::size_t kBlockPayloadBytes = 104;
inline constexpr std::size_t kBlockEventBytes =
    kEventHeaderBytes + sizeof kLogBlockChannel - 1 + kBlockPayloadBytes;

/// Largest block that a reader accepts: one event of the largest size, or kMaxLogBlockBytes of
/// small ones.
inline constexpr std::size_t kMaxBlockSpan = kMaxEventBytes + kMaxLogBlockBytes;

enum class BlockEventState : std::uint8_t {
  None,     ///< No block event of this version.
  Intact,   ///< As its writer wrote it.
  Copied,   ///< Its payload in an event of another number or stamp: a recording of a replay.
  Damaged,  ///< Its own hash is wrong.
};
/// Reads kBlockEventBytes of `bytes`.
[[nodiscard]] BlockEventState parseBlockEvent(const std::uint8_t* bytes, BlockEvent& event);
void appendBlockEvent(Bytes& log, const BlockEvent& event);

[[nodiscard]] std::uint64_t blockHashOf(ByteView block, std::uint64_t logId);

}  // namespace foretouch
