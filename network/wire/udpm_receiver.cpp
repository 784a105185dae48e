#include <cerrno>
#include <chrono>
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "network/wire/datagram_reader.h"
#include "network/wire/udpm_reassembly.h"
#include "network/wire/udpm_senders.h"
#include "network/wire/udpm_socket.h"
#include "network/wire/wire.h"

namespace foretouch {
namespace {

using SteadyClock = std::chrono::steady_clock;

// After this long without a datagram, joins the group again, in case its interface went away.
constexpr std::chrono::seconds kSilence{1};

class UdpmReceiver : public Receiver {
 public:
  UdpmReceiver(const UdpmUrl& url, internal::FileDescriptor socket,
               const std::vector<std::string>& channels, const std::vector<Network>& senders)
      : url_(url),
        reader_(std::move(socket), SenderFilter(url, senders)),
        reassembler_(channels),
        lastSign_(SteadyClock::now()) {}

  Result<Done> receive(std::vector<WireMessage>& messages, int timeoutMs) override {
    auto received = receiveBatch(messages);
    if (!received.ok()) return received.error();
    if (received.value()) return Done{};
    if (!waitReadable(reader_.fd(), timeoutMs)) {
      rejoinIfSilent();
      return Done{};
    }
    received = receiveBatch(messages);
    if (!received.ok()) return received.error();
    return Done{};
  }

  [[nodiscard]] WireCounts counts() const override {
    WireCounts counts = reassembler_.counts();
    counts.datagrams += reader_.foreign();
    counts.foreign = reader_.foreign();
    counts.kernelDrops = reader_.kernelDrops();
    return counts;
  }

  [[nodiscard]] std::size_t receiveBufferBytes() const override {
    return receiveBufferOf(reader_.fd());
  }
  [[nodiscard]] int readableFd() const override { return reader_.fd(); }

 private:
  /// Whether anything came.
  Result<bool> receiveBatch(std::vector<WireMessage>& messages) {
    const int count = reader_.read([&](const UdpmSender& sender, ByteView bytes, std::int64_t us) {
      reassembler_.take(sender, bytes, us, messages);
    });
    if (count >= 0) {
      lastSign_ = SteadyClock::now();
      return true;
    }
    if (isPassing(errno)) return false;
    return socketError(url_, "cannot receive", errno);
  }

  void rejoinIfSilent() {
    const SteadyClock::time_point now = SteadyClock::now();
    if (now - lastSign_ < kSilence) return;
    lastSign_ = now;
    joinGroup(reader_.fd(), url_);  // fails while there is no route; tried again
  }

  const UdpmUrl url_;
  DatagramReader reader_;
  UdpmReassembler reassembler_;
  SteadyClock::time_point lastSign_;  ///< Last datagram, or last attempt to join without one.
};

}  // namespace

Result<std::unique_ptr<Receiver>> openUdpmReceiver(const UdpmUrl& url,
                                                   const std::vector<std::string>& channels,
                                                   const std::vector<Network>& senders) {
  for (const std::string& channel : channels) {
    if (isLegalChannel(channel)) continue;
    return Error::of(ErrorCode::OutOfRange,
                     "channel: expected 1 to 63 bytes of printable ASCII, found '" + channel + "'");
  }
  FORETOUCH_TRY(auto socket, openListeningSocket(url));
  return std::unique_ptr<Receiver>(new UdpmReceiver(url, std::move(socket), channels, senders));
}

}  // namespace foretouch
