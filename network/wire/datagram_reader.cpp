#include "network/wire/datagram_reader.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <netinet/in.h>
#include <sys/socket.h>
#include <utility>

#include "lss/index.h"

namespace foretouch {
namespace {

constexpr std::size_t kBatch = 64;
// A datagram and a cache line: equal parts of the slots do not share their places in the cache.
constexpr std::size_t kSlotBytes = 65536 + 64;
constexpr std::size_t kControlBytes =
    CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
std::int64_t utimeOf(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000;
}

std::int64_t utimeNow() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return utimeOf(now);
}

}  // namespace

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

/// Room for the datagrams of one call.
class DatagramReader::Batch {
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

DatagramReader::DatagramReader(internal::FileDescriptor socket, SenderFilter filter)
    : socket_(std::move(socket)), filter_(std::move(filter)), batch_(std::make_unique<Batch>()) {}

DatagramReader::~DatagramReader() = default;

int DatagramReader::read(const Take& take) {
  const int count = batch_->receive(socket_.get());
  std::int64_t now = 0;
  const auto readAt = std::chrono::steady_clock::now();
  for (int k = 0; k < count; ++k) {
    const std::size_t i = countOf(k);
    std::int64_t utimeUs = 0;
    std::uint32_t drops = lastDrops_;
    batch_->readNotes(i, utimeUs, drops);
    kernelDrops_ += drops - lastDrops_;  // of 32 bits, which wrap
    lastDrops_ = drops;
    const UdpmSender sender = batch_->sender(i);
    if (!filter_.takes(ntohl(sender.address), readAt)) {
      ++foreign_;
      continue;
    }
    if (utimeUs == 0) utimeUs = now = now != 0 ? now : utimeNow();
    take(sender, batch_->datagram(i), utimeUs);
  }
  return count;
}

}  // namespace foretouch
