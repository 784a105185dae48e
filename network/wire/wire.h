// network/wire/wire.h: the source and destination of messages: LCM's UDP multicast, by our own
// bounded reader or by liblcm, or a test's own. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "network/wire/codec.h"
#include "network/wire/udpm_datagram.h"

namespace foretouch {

/// Where a datagram came from, in network byte order.
struct UdpmSender {
  std::uint32_t address = 0;
  std::uint16_t port = 0;

  friend bool operator==(const UdpmSender& x, const UdpmSender& y) {
    return x.address == y.address && x.port == y.port;
  }
  friend bool operator!=(const UdpmSender& x, const UdpmSender& y) { return !(x == y); }
};

/// One whole message as it arrived.
struct WireMessage {
  std::string channel;
  Bytes payload;
  std::int64_t receiveUtimeUs = 0;  ///< The kernel's stamp if there is one.
  UdpmSender sender{};              ///< All 0: not known (liblcm does not say).
};

/// "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152", as LCM writes it.
struct UdpmUrl {
  std::string group = "239.255.76.67";
  std::uint16_t port = 7667;
  int ttl = 0;                                ///< 0: never leaves this machine.
  std::size_t receiveBufferBytes = 4u << 20;  ///< Requested from the system, which may give less.
};
inline constexpr char kDefaultUrl[] = "udpm://239.255.76.67:7667?ttl=0";
/// Errors name the part: another scheme, no multicast group, a port or ttl out of range, an option
/// that does not exist.
[[nodiscard]] Result<UdpmUrl> parseUdpmUrl(const std::string& url);

/// An IPv4 network: its first address in host byte order, and how many leading bits name it.
struct Network {
  static constexpr int kAddressBits = 32;
  std::uint32_t address = 0;
  int bits = 0;

  [[nodiscard]] std::uint32_t mask() const {
    return bits == 0 ? 0 : ~std::uint32_t{0} << (kAddressBits - bits);
  }
};
/// "10.0.0.0/24", or one address. Errors: anything else, or bits set after the leading ones.
[[nodiscard]] Result<Network> parseNetwork(const std::string& text);

struct WireCounts {
  std::uint64_t datagrams = 0;
  std::uint64_t foreign = 0;        ///< From senders that are not to be heard: refused unread.
  std::uint64_t messages = 0;       ///< Whole ones on a wanted channel.
  std::uint64_t otherChannels = 0;  ///< Whole ones, or first fragments, on others.
  std::uint64_t kernelDrops = 0;    ///< Datagrams that the system dropped unread (SO_RXQ_OVFL).
  std::array<std::uint64_t, kNumDatagramFaults> faults{};
};

/// One thread at a time.
class Receiver {
 public:
  virtual ~Receiver() = default;
  /// Appends arrived messages to `messages`, at most a bounded number; if there are none, waits up
  /// to `timeoutMs`. An error is final (the socket is gone); a link that is down is not an error.
  virtual Result<Done> receive(std::vector<WireMessage>& messages, int timeoutMs) = 0;
  [[nodiscard]] virtual WireCounts counts() const = 0;
  /// What the system gave of UdpmUrl::receiveBufferBytes; 0: not known.
  [[nodiscard]] virtual std::size_t receiveBufferBytes() const { return 0; }
  /// Becomes readable when something came, for waiting for more than one receiver; -1: none.
  [[nodiscard]] virtual int readableFd() const { return -1; }
};

/// Limits on unfinished messages and on their bytes together, bookkeeping included.
inline constexpr std::size_t kMaxPartialMessages = 16;
inline constexpr std::size_t kMaxPartialBytes = 16u << 20;

/// Messages on exactly these channels, by our own reader. Memory is bounded whatever arrives: one
/// receive buffer, at most kMaxPartialMessages unfinished messages in kMaxPartialBytes.
/// With a ttl of 0 it takes datagrams of this machine only; `senders`, if there are any, says whose
/// others it takes, at any ttl.
/// Errors: a channel that is not legal, no socket, no multicast route.
[[nodiscard]] Result<std::unique_ptr<Receiver>> openUdpmReceiver(
    const UdpmUrl& url, const std::vector<std::string>& channels,
    const std::vector<Network>& senders = {});
/// The same by liblcm, from all senders. Two crafted datagrams can crash its receiving thread: for
/// trusted networks only.
[[nodiscard]] Result<std::unique_ptr<Receiver>> openLcmReceiver(
    const std::string& url, const std::vector<std::string>& channels);

class Publisher {
 public:
  virtual ~Publisher() = default;
  /// Never waits. False if the system did not take all of it (no route, no buffer); the caller
  /// counts it. Safe from several threads.
  virtual bool publish(std::string_view channel, ByteView payload) = 0;
};

[[nodiscard]] Result<std::unique_ptr<Publisher>> openUdpmPublisher(const UdpmUrl& url);

/// Sends one datagram to the group on a port of its own choice and waits for it, a second at most.
/// An error names what is missing (a multicast route, usually) and the command to type.
[[nodiscard]] Result<Done> testMulticast(const UdpmUrl& url);

}  // namespace foretouch
