// network/wire/udpm_reassembly.h: whole messages from datagrams that arrive in any order, from any
// number of senders, some of them hostile. Pure: no clock, no socket. Not installed.
//
// Bounds, whatever arrives:
//   - kMaxPartialMessages unfinished messages. Fragments are stored as they came, so a message
//     costs at most twice the bytes of its fragments (vectors double), never the size it announces;
//     all of them together at most kMaxPartialBytes between two calls of take().
//   - The last kMaxFinished messages that came to an end (delivered, refused, or on an unwanted
//     channel), so that their late and repeated fragments do not count as new messages.
//   - Channel names are only compared, never stored.
//   - The last kMaxKnownSenders senders of which a message was delivered.
//
// Without room, this drops an unfinished message of the sender (address and port) that has most of
// them; among equals, one of an unknown sender, then of the address that has most, then the one
// that has waited longest for a fragment. So a flooding sender only pushes out its own messages,
// and any number of senders that never complete a message cannot push out those of one that did.
// Only other senders at the same address can push out a sender's very first message, if it is
// fragmented and kMaxPartialMessages of them start a message between two consecutive fragments of
// it; the next message then gets through. Short messages need no room.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lss/index.h"
#include "network/wire/udpm_datagram.h"
#include "network/wire/wire.h"

namespace foretouch {

/// Longest pause between two fragments of one message, by their receive stamps. Later ones belong
/// to another message that happens to have the same sender and sequence (a sender that was
/// restarted).
inline constexpr std::int64_t kMaxFragmentPauseUs = 1'000'000;
inline constexpr std::size_t kMaxFinished = 64;
inline constexpr std::size_t kMaxKnownSenders = 64;

class UdpmReassembler {
 public:
  /// Delivers messages on these channels only.
  explicit UdpmReassembler(const std::vector<std::string>& channels);

  /// Takes any bytes; appends at most one message, stamped as the datagram that completed it.
  void take(const UdpmSender& sender, ByteView bytes, std::int64_t receiveUtimeUs,
            std::vector<WireMessage>& messages);

  /// All but kernelDrops. Faults count datagrams, Incomplete messages. A fragment that belongs to
  /// an unwanted message counts as a datagram only.
  [[nodiscard]] const WireCounts& counts() const { return counts_; }
  [[nodiscard]] std::size_t numPartials() const;
  /// Memory of unfinished messages, capacities included: at most kMaxPartialBytes.
  [[nodiscard]] std::size_t bytesHeld() const;

 private:
  struct Key {
    UdpmSender sender;
    std::uint32_t sequence = 0;
  };
  /// One fragment; its payload is at `at` in Partial::bytes, in order of arrival.
  struct Piece {
    std::uint32_t offset = 0, size = 0, at = 0;
    std::uint16_t fragment = 0;
  };
  struct Partial {
    Key key;
    std::uint32_t messageBytes = 0;
    std::uint16_t fragments = 0;
    std::string channel;
    Bytes bytes;
    std::vector<Piece> pieces;
    std::bitset<kMaxFragments> isThere;
    std::int64_t lastUtimeUs = 0;
    std::uint64_t lastTake = 0;

    Partial();
    [[nodiscard]] std::size_t bytesHeld() const;
  };
  struct Finished {
    Key key;
    std::int64_t utimeUs = 0;
    DatagramFault fault = DatagramFault::None;  ///< The fault of its further fragments.
  };
  struct KnownSender {
    UdpmSender sender;
    std::uint64_t lastTake = 0;  ///< 0: none.
  };
  using Slot = std::optional<Partial>;

  static bool isSame(const Key& a, const Key& b);
  [[nodiscard]] bool isWanted(std::string_view channel) const;
  void count(DatagramFault fault) { ++counts_.faults[slotOf(fault)]; }
  void takeFragment(const Key& key, const UdpmDatagram& datagram, std::int64_t utimeUs,
                    std::vector<WireMessage>& messages);
  [[nodiscard]] const Finished* findFinished(const Key& key, std::int64_t utimeUs) const;
  [[nodiscard]] Slot* findPartial(const Key& key);
  Slot& startPartial(const Key& key, const UdpmDatagram& datagram);
  [[nodiscard]] static DatagramFault check(const Partial& partial, const UdpmDatagram& datagram);
  void addPiece(Partial& partial, const UdpmDatagram& datagram);
  [[nodiscard]] static std::optional<Bytes> assembled(Partial& partial);
  void finish(Slot& slot, DatagramFault fault, std::int64_t utimeUs);
  void remember(const Key& key, DatagramFault fault, std::int64_t utimeUs);
  void deliver(const UdpmSender& sender, WireMessage message, std::vector<WireMessage>& messages);
  [[nodiscard]] bool isKnown(const UdpmSender& sender) const;
  /// Drops one message, not `kept`, to make room for one of the newcomer's.
  void makeWay(const UdpmSender& newcomer, const Partial* kept);

  std::set<std::string, std::less<>> channels_;
  std::array<Slot, kMaxPartialMessages> slots_;
  std::array<Finished, kMaxFinished> finished_;
  std::size_t numFinished_ = 0, nextFinished_ = 0;
  std::array<KnownSender, kMaxKnownSenders> known_;
  std::size_t lastKnown_ = 0;  ///< Of the last message delivered.
  std::uint64_t takes_ = 0;
  WireCounts counts_;
};

}  // namespace foretouch
