#include <cerrno>
#include <memory>
#include <mutex>
#include <netinet/in.h>
#include <sys/socket.h>
#include <utility>

#include "articulated/try.h"
#include "network/wire/messages.h"
#include "network/wire/udpm_socket.h"
#include "network/wire/wire.h"

namespace foretouch {
namespace {

class UdpmPublisher : public Publisher {
 public:
  UdpmPublisher(const UdpmUrl& url, internal::FileDescriptor socket)
      : address_(addressOf(url)), socket_(std::move(socket)) {}

  bool publish(std::string_view channel, ByteView payload) override {
    if (!isLegalChannel(channel) || payload.size > kMaxMessageBytes) return false;
    // Sends the fragments of a message together: liblcm drops a message when another one of the
    // same sender begins.
    const std::lock_guard lock(mutex_);
    for (const Bytes& datagram : datagramsOf(channel, payload, sequence_++)) {
      if (!send(datagram)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool send(const Bytes& datagram) const {
    ssize_t sent = 0;
    do {
      sent = sendto(socket_.get(), datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                    reinterpret_cast<const sockaddr*>(&address_), sizeof address_);
    } while (sent < 0 && errno == EINTR);
    return sent == static_cast<ssize_t>(datagram.size());
  }

  const sockaddr_in address_;
  const internal::FileDescriptor socket_;
  std::mutex mutex_;
  std::uint32_t sequence_ = 0;
};

}  // namespace

Result<std::unique_ptr<Publisher>> openUdpmPublisher(const UdpmUrl& url) {
  FORETOUCH_TRY(auto socket, openSendingSocket(url));
  return std::unique_ptr<Publisher>(new UdpmPublisher(url, std::move(socket)));
}

}  // namespace foretouch
