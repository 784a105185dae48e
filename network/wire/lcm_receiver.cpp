// liblcm behind Receiver. Its known faults (1.3.1): its select() aborts beyond 1024 descriptors, so
// we poll; when its queue is full it silently drops the newest message, so the queue is long; it
// delivers payloads whose size underflowed.
#include <algorithm>
#include <cctype>
#include <lcm/lcm.h>
#include <memory>
#include <string>
#include <sys/select.h>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "network/wire/messages.h"
#include "network/wire/udpm_socket.h"
#include "network/wire/wire.h"

namespace foretouch {
namespace {

constexpr int kQueueCapacity = 10000;
constexpr int kMostAtOnce = 64;
// liblcm's thread and its self-test select() on some ten descriptors that they open.
constexpr int kMaxDescriptor = FD_SETSIZE - 32;

/// A regular expression for only this text.
std::string escaped(const std::string& channel) {
  std::string expression;
  for (const char c : channel) {
    const bool isPlain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    if (!isPlain) expression += '\\';
    expression += c;
  }
  return expression;
}

class LcmReceiver : public Receiver {
 public:
  LcmReceiver(std::string url, lcm_t* lcm) : url_(std::move(url)), lcm_(lcm, lcm_destroy) {}

  bool subscribe(const std::vector<std::string>& channels) {
    for (const std::string& channel : channels) {
      lcm_subscription_t* subscription =
          lcm_subscribe(lcm_.get(), escaped(channel).c_str(), handle, this);
      if (subscription == nullptr) return false;
      lcm_subscription_set_queue_capacity(subscription, kQueueCapacity);
    }
    return true;
  }

  Result<Done> receive(std::vector<WireMessage>& messages, int timeoutMs) override {
    messages_ = &messages;
    const int fd = lcm_get_fileno(lcm_.get());
    for (int i = 0; i < kMostAtOnce && waitReadable(fd, i == 0 ? timeoutMs : 0); ++i) {
      if (lcm_handle(lcm_.get()) != 0) {
        return Error::in(url_, ErrorCode::FileUnreadable, "liblcm gave up receiving");
      }
    }
    return Done{};
  }

  [[nodiscard]] WireCounts counts() const override { return counts_; }
  [[nodiscard]] int readableFd() const override { return lcm_get_fileno(lcm_.get()); }

 private:
  static void handle(const lcm_recv_buf_t* buffer, const char* channel, void* receiver) {
    static_cast<LcmReceiver*>(receiver)->take(*buffer, channel);
  }

  /// Called from C: must not throw.
  void take(const lcm_recv_buf_t& buffer, const char* channel) noexcept {
    if (buffer.data_size > kMaxMessageBytes) {
      ++counts_.faults[slotOf(DatagramFault::TooLarge)];
      return;
    }
    const auto* payload = static_cast<const std::uint8_t*>(buffer.data);
    messages_->push_back({channel, Bytes(payload, payload + buffer.data_size), buffer.recv_utime});
    ++counts_.messages;
  }

  const std::string url_;
  std::unique_ptr<lcm_t, void (*)(lcm_t*)> lcm_;
  std::vector<WireMessage>* messages_ = nullptr;  ///< Those of the running call of receive().
  WireCounts counts_;
};

}  // namespace

Result<std::unique_ptr<Receiver>> openLcmReceiver(const std::string& url,
                                                  const std::vector<std::string>& channels) {
  for (const std::string& channel : channels) {
    if (isLegalChannel(channel)) continue;
    return Error::of(ErrorCode::OutOfRange,
                     "channel: expected 1 to 63 bytes of printable ASCII, found '" + channel + "'");
  }
  // Without a route, liblcm reads freed memory for its message: check first.
  const auto udpm = parseUdpmUrl(url);
  if (udpm.ok()) {
    FORETOUCH_TRY(const auto listener, openListeningSocket(udpm.value()));
    if (listener.get() > kMaxDescriptor) {
      return Error::in(
          url, ErrorCode::LimitExceeded,
          "liblcm works below descriptor 1024 only, and so many files are open; expected "
          "fewer, or our own reader");
    }
  }
  lcm_t* lcm = lcm_create(url.c_str());
  if (lcm == nullptr) {
    return Error::in(url, ErrorCode::FileUnreadable, "liblcm does not take this URL");
  }
  auto receiver = std::make_unique<LcmReceiver>(url, lcm);
  if (!receiver->subscribe(channels)) {
    return Error::in(url, ErrorCode::FileUnreadable, "liblcm cannot listen here");
  }
  return std::unique_ptr<Receiver>(std::move(receiver));
}

}  // namespace foretouch
