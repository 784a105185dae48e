#include "tests/network/faulty_network.h"

#include <algorithm>
#include <utility>

namespace foretouch::test {
namespace {

constexpr double kLeastDelayUs = 50.0, kUsualDelayUs = 1000.0;
constexpr std::size_t kFingerprintBytes = 8;

class Network {
 public:
  Network(Random& random, const NetworkFaults& faults) : random_(random), faults_(faults) {}

  void send(const SentMessage& message) {
    if (random_.chance(faults_.foreign)) sendForeign(message);
    if (lost_ == 0 && random_.chance(faults_.burst)) lost_ = 3 + random_.below(28);
    if (lost_ > 0) {
      --lost_;
      return;
    }
    if (!random_.chance(faults_.loss)) deliver(message);
    while (random_.chance(faults_.duplicate)) deliver(message);
  }

  std::vector<Delivery> arrived() {
    std::stable_sort(arrived_.begin(), arrived_.end(),
                     [](const Delivery& x, const Delivery& y) { return x.timeUs < y.timeUs; });
    return std::move(arrived_);
  }

 private:
  [[nodiscard]] std::int64_t delayUs() {
    const double most =
        random_.chance(faults_.delay) ? static_cast<double>(faults_.longestDelayUs) : kUsualDelayUs;
    return static_cast<std::int64_t>(random_.magnitude(kLeastDelayUs, most));
  }

  void deliver(const SentMessage& message) {
    Delivery d{message.timeUs + delayUs(), message.isSkeleton, message.payload, message.id, false};
    if (random_.chance(faults_.corrupt)) corrupt(d);
    if (random_.chance(faults_.truncate)) {
      const std::size_t size = d.payload.size();
      d.payload.resize(static_cast<std::size_t>(random_.below(static_cast<int>(size) + 9)));
      d.isAltered = d.isAltered || d.payload.size() != size;
    }
    arrived_.push_back(std::move(d));
  }

  void corrupt(Delivery& d) {
    const Bytes sent = d.payload;
    const int bytes = 1 + random_.below(4);
    for (int i = 0; i < bytes; ++i) {
      const auto at = static_cast<std::size_t>(random_.below(static_cast<int>(d.payload.size())));
      d.payload[at] ^= static_cast<std::uint8_t>(1 + random_.below(255));
    }
    d.isAltered = d.payload != sent;  // the same bits may have been flipped twice
  }

  /// Noise, another type's fingerprint, or a message on the wrong channel.
  void sendForeign(const SentMessage& message) {
    Delivery d{message.timeUs + delayUs(), random_.chance(0.2), message.payload, {}, true};
    switch (random_.below(3)) {
      case 0:
        d.payload.resize(static_cast<std::size_t>(random_.below(200)));
        for (auto& byte : d.payload) byte = static_cast<std::uint8_t>(random_.below(256));
        break;
      case 1:
        for (std::size_t i = 0; i < kFingerprintBytes; ++i) d.payload[i] ^= 0x5a;
        break;
      default: d.isSkeleton = !message.isSkeleton; break;
    }
    arrived_.push_back(std::move(d));
  }

  Random& random_;
  const NetworkFaults& faults_;
  int lost_ = 0;  // still to be lost of the burst at hand
  std::vector<Delivery> arrived_;
};

}  // namespace

std::vector<Delivery> deliveries(Random& random, const std::vector<SimulatedSender>& senders,
                                 const NetworkFaults& faults) {
  std::vector<const SentMessage*> sent;
  for (const SimulatedSender& sender : senders) {
    for (const SentMessage& message : sender.sent) sent.push_back(&message);
  }
  std::stable_sort(sent.begin(), sent.end(), [](const SentMessage* x, const SentMessage* y) {
    return x->timeUs < y->timeUs;
  });
  Network network(random, faults);
  for (const SentMessage* message : sent) network.send(*message);
  return network.arrived();
}

}  // namespace foretouch::test
