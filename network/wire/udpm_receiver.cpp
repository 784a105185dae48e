#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <memory>
#include <netinet/in.h>
#include <sys/socket.h>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "network/wire/messages.h"
#include "network/wire/udpm_reassembly.h"
#include "network/wire/udpm_senders.h"
#include "network/wire/udpm_socket.h"
#include "network/wire/wire.h"

namespace foretouch {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t kBatch = 64;
// A datagram and a cache line: equal parts of the slots do not share their places in the cache.
constexpr std::size_t kSlotBytes = 65536 + 64;
constexpr std::size_t kControlBytes =
    CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
// After this long without a datagram, joins the group again, in case its interface went away.
constexpr std::chrono::seconds kSilence{1};

std::int64_t utimeOf(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000;
}

std::int64_t utimeNow() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return utimeOf(now);
}

/// Room for the datagrams of one call.
class Batch {
 public:
  Batch() : bytes_(kBatch * kSlotBytes) {}

  /// The number received; negative: an error in errno.
  int receive(int fd) {
    for (std::size_t i = 0; i < kBatch; ++i) {
      parts_[i] = {&bytes_[i * kSlotBytes], kSlotBytes};
      msghdr& header = headers_[i].msg_hdr;
      header = {};
      header.msg_name = &senders_[i];
      header.msg_namelen = sizeof senders_[i];
      header.msg_iov = &parts_[i];
      header.msg_iovlen = 1;
      header.msg_control = controls_[i].bytes;
      header.msg_controllen = kControlBytes;
    }
    return recvmmsg(fd, headers_.data(), kBatch, MSG_DONTWAIT, nullptr);
  }
  [[nodiscard]] ByteView datagram(std::size_t i) const {
    return {&bytes_[i * kSlotBytes], headers_[i].msg_len};
  }
  [[nodiscard]] UdpmSender sender(std::size_t i) const {
    return {senders_[i].sin_addr.s_addr, senders_[i].sin_port};
  }
  /// The kernel's stamp, and its count of drops up to this datagram, if present.
  void readNotes(std::size_t i, std::int64_t& utimeUs, std::uint32_t& drops) {
    msghdr& header = headers_[i].msg_hdr;
    for (cmsghdr* note = CMSG_FIRSTHDR(&header); note != nullptr;
         note = CMSG_NXTHDR(&header, note)) {
      if (note->cmsg_level != SOL_SOCKET) continue;
      if (note->cmsg_type == SCM_TIMESTAMPNS) {
        timespec stamp{};
        std::memcpy(&stamp, CMSG_DATA(note), sizeof stamp);
        utimeUs = utimeOf(stamp);
      } else if (note->cmsg_type == SO_RXQ_OVFL) {
        std::memcpy(&drops, CMSG_DATA(note), sizeof drops);
      }
    }
  }

 private:
  struct alignas(cmsghdr) Control {
    char bytes[kControlBytes];
  };
  Bytes bytes_;
  std::array<iovec, kBatch> parts_{};
  std::array<sockaddr_in, kBatch> senders_{};
  std::array<Control, kBatch> controls_{};
  std::array<mmsghdr, kBatch> headers_{};
};

/// Temporary errors of a socket: of a link, of memory, of a route.
bool isPassing(int errorNumber) {
  switch (errorNumber) {
    case EAGAIN:
    case EINTR:
    case ENOMEM:
    case ENOBUFS:
    case ENETDOWN:
    case ENETUNREACH:
    case EHOSTDOWN:
    case EHOSTUNREACH:
    case ECONNREFUSED: return true;
    default: return false;
  }
}

class UdpmReceiver : public Receiver {
 public:
  UdpmReceiver(const UdpmUrl& url, Descriptor socket, const std::vector<std::string>& channels,
               const std::vector<Network>& senders)
      : url_(url),
        socket_(std::move(socket)),
        filter_(url, senders),
        reassembler_(channels),
        lastSign_(SteadyClock::now()) {}

  Result<Done> receive(std::vector<WireMessage>& messages, int timeoutMs) override {
    auto received = receiveBatch(messages);
    if (!received.ok()) return received.error();
    if (received.value()) return Done{};
    if (!waitReadable(socket_.get(), timeoutMs)) {
      rejoinIfSilent();
      return Done{};
    }
    received = receiveBatch(messages);
    if (!received.ok()) return received.error();
    return Done{};
  }

  [[nodiscard]] WireCounts counts() const override {
    WireCounts counts = reassembler_.counts();
    counts.datagrams += foreign_;
    counts.foreign = foreign_;
    counts.kernelDrops = kernelDrops_;
    return counts;
  }

  [[nodiscard]] std::size_t receiveBufferBytes() const override {
    return receiveBufferOf(socket_.get());
  }

 private:
  /// Whether anything came.
  Result<bool> receiveBatch(std::vector<WireMessage>& messages) {
    const int count = batch_.receive(socket_.get());
    if (count < 0) {
      if (isPassing(errno)) return false;
      return socketError(url_, "cannot receive", errno);
    }
    std::int64_t now = 0;
    lastSign_ = SteadyClock::now();
    for (std::size_t i = 0; i < countOf(count); ++i) {
      std::int64_t utimeUs = 0;
      std::uint32_t drops = lastDrops_;
      batch_.readNotes(i, utimeUs, drops);
      kernelDrops_ += drops - lastDrops_;  // of 32 bits, which wrap
      lastDrops_ = drops;
      const UdpmSender sender = batch_.sender(i);
      if (!filter_.takes(ntohl(sender.address), lastSign_)) {
        ++foreign_;
        continue;
      }
      if (utimeUs == 0) utimeUs = now = now != 0 ? now : utimeNow();
      reassembler_.take(sender, batch_.datagram(i), utimeUs, messages);
    }
    return true;
  }

  void rejoinIfSilent() {
    const SteadyClock::time_point now = SteadyClock::now();
    if (now - lastSign_ < kSilence) return;
    lastSign_ = now;
    joinGroup(socket_.get(), url_);  // fails while there is no route; tried again
  }

  const UdpmUrl url_;
  const Descriptor socket_;
  SenderFilter filter_;
  UdpmReassembler reassembler_;
  Batch batch_;
  SteadyClock::time_point lastSign_;  ///< Last datagram, or last attempt to join without one.
  std::uint64_t kernelDrops_ = 0, foreign_ = 0;
  std::uint32_t lastDrops_ = 0;
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
