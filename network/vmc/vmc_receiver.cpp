#include "network/vmc/vmc_receiver.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <optional>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "network/vmc/vmc_stream.h"
#include "network/wire/datagram_reader.h"
#include "network/wire/udpm_socket.h"

namespace foretouch {
namespace {

Error portError(std::uint16_t port, const char* what) {
  return Error::in("UDP port " + std::to_string(port), ErrorCode::FileUnreadable,
                   std::string(what) + ": " + std::generic_category().message(errno));
}

/// Non-blocking.
Result<internal::FileDescriptor> openPort(std::uint16_t port, bool isOpen,
                                          std::size_t bufferBytes) {
  internal::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.get() < 0) return portError(port, "no socket");
  prepareToListen(socket.get(), bufferBytes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(isOpen ? INADDR_ANY : INADDR_LOOPBACK);
  if (bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return portError(port, "cannot listen");
  }
  return socket;
}

/// The senders of one port.
class Port {
 public:
  Port(VmcBody body, internal::FileDescriptor socket, SenderFilter filter)
      : body_(std::make_unique<VmcBody>(std::move(body))),
        reader_(std::make_unique<DatagramReader>(std::move(socket), std::move(filter))) {}

  [[nodiscard]] int fd() const { return reader_->fd(); }

  /// `take` gets each sender's words.
  template <typename Take>
  Result<Done> read(const Take& take) {
    const int count = reader_->read([&](const UdpmSender& sender, ByteView bytes, std::int64_t us) {
      ++datagrams_;
      VmcStream* const stream = streamOf(sender, us);
      if (stream == nullptr) return;
      said_.clear();
      if (!stream->take(bytes, us, said_)) ++faulty_;
      for (const VmcStream::Said& said : said_) take(sender, said);
    });
    if (count < 0 && !isPassing(errno)) return portError(0, "cannot receive");
    return Done{};
  }

  void addTo(WireCounts& counts) const {
    counts.datagrams += datagrams_ + reader_->foreign();
    counts.foreign += reader_->foreign() + crowdedOut_;
    counts.kernelDrops += reader_->kernelDrops();
    counts.faults[slotOf(DatagramFault::Osc)] += faulty_;
  }

 private:
  struct Known {
    UdpmSender sender;
    std::int64_t heardUs = 0;
    VmcStream stream;
  };

  VmcStream* streamOf(const UdpmSender& sender, std::int64_t utimeUs) {
    const auto isSilent = [&](const Known& known) {
      return utimeUs - known.heardUs > kVmcSilentUs;
    };
    const auto found = std::find_if(known_.begin(), known_.end(),
                                    [&](const Known& known) { return known.sender == sender; });
    if (found != known_.end()) {
      found->heardUs = utimeUs;
      return &found->stream;
    }
    if (known_.size() == kMaxVmcSenders) {
      const auto gone = std::find_if(known_.begin(), known_.end(), isSilent);
      if (gone == known_.end()) {
        ++crowdedOut_;
        return nullptr;
      }
      known_.erase(gone);
    }
    known_.push_back({sender, utimeUs, VmcStream(*body_)});
    return &known_.back().stream;
  }

  std::unique_ptr<VmcBody> body_;  // at its place, whatever moves
  std::unique_ptr<DatagramReader> reader_;
  std::vector<Known> known_;
  std::vector<VmcStream::Said> said_;
  std::uint64_t datagrams_ = 0, faulty_ = 0, crowdedOut_ = 0;
};

class VmcReceiver : public Receiver {
 public:
  VmcReceiver(std::unique_ptr<Receiver> other, std::vector<Port> ports, std::string suffix)
      : other_(std::move(other)), ports_(std::move(ports)), suffix_(std::move(suffix)) {}

  Result<Done> receive(std::vector<WireMessage>& messages, int timeoutMs) override {
    const std::size_t before = messages.size();
    FORETOUCH_CHECK(receiveNow(messages));
    if (messages.size() > before) return Done{};
    wait(timeoutMs);
    return receiveNow(messages);
  }

  [[nodiscard]] WireCounts counts() const override {
    WireCounts counts = other_ ? other_->counts() : WireCounts();
    counts.messages += messages_;
    for (const Port& port : ports_) port.addTo(counts);
    return counts;
  }

  [[nodiscard]] std::size_t receiveBufferBytes() const override {
    return other_ ? other_->receiveBufferBytes() : receiveBufferOf(ports_.front().fd());
  }

 private:
  Result<Done> receiveNow(std::vector<WireMessage>& messages) {
    if (other_) FORETOUCH_CHECK(other_->receive(messages, 0));
    for (Port& port : ports_) {
      FORETOUCH_CHECK(port.read([&](const UdpmSender& sender, const VmcStream::Said& said) {
        if (said.skeleton) add(kSkeletonChannel, *said.skeleton, said, sender, messages);
        add(kPoseChannel, said.pose, said, sender, messages);
      }));
    }
    return Done{};
  }

  template <typename Message>
  void add(const char* channel, const Message& message, const VmcStream::Said& said,
           const UdpmSender& sender, std::vector<WireMessage>& messages) {
    WireMessage& wire = messages.emplace_back();
    wire.channel = channel + suffix_;
    encode(message, wire.payload);
    wire.receiveUtimeUs = said.receiveUtimeUs;
    wire.sender = sender;
    ++messages_;
  }

  void wait(int timeoutMs) {
    std::vector<pollfd> watched;
    if (other_ && other_->readableFd() >= 0) watched.push_back({other_->readableFd(), POLLIN, 0});
    for (const Port& port : ports_) watched.push_back({port.fd(), POLLIN, 0});
    poll(watched.data(), watched.size(), std::max(timeoutMs, 0));
  }

  std::unique_ptr<Receiver> other_;
  std::vector<Port> ports_;
  const std::string suffix_;
  std::uint64_t messages_ = 0;
};

}  // namespace

Result<std::unique_ptr<Receiver>> openVmcReceiver(std::unique_ptr<Receiver> other,
                                                  std::vector<VmcPort> ports,
                                                  const VmcOptions& options) {
  const bool isOpen = options.url.ttl > 0 || !options.senders.empty();
  std::vector<Port> opened;
  for (VmcPort& port : ports) {
    FORETOUCH_TRY(auto socket, openPort(port.port, isOpen, options.url.receiveBufferBytes));
    opened.emplace_back(std::move(port.body), std::move(socket),
                        SenderFilter::ofUnicast(options.url, options.senders));
  }
  return std::unique_ptr<Receiver>(
      new VmcReceiver(std::move(other), std::move(opened), options.suffix));
}

}  // namespace foretouch
