// tests/network/private_network.h: tests that really send. They run in their own network namespace
// (in_namespace.sh), and are skipped elsewhere.
#pragma once

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "network/wire/udpm_socket.h"
#include "network/wire/wire.h"
#include "tests/network/wire/udpm_bytes.h"

namespace foretouch::test {

class PrivateNetwork : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("FORETOUCH_PRIVATE_NETWORK") == nullptr) {
      GTEST_SKIP() << "sends multicast: run it by tests/network/in_namespace.sh";
    }
  }
};

using Clock = std::chrono::steady_clock;
/// How long tests wait for a required message; no test takes that long unless it fails.
inline constexpr std::chrono::seconds kPatience{10};

/// Receives until `isEnough`; false if that does not happen.
inline bool receiveUntil(Receiver& receiver, std::vector<WireMessage>& messages,
                         const std::function<bool()>& isEnough) {
  const auto deadline = Clock::now() + kPatience;
  while (!isEnough()) {
    if (Clock::now() > deadline) return false;
    const auto received = receiver.receive(messages, 20);
    EXPECT_TRUE(received.ok()) << describe(received.error());
    if (!received.ok()) return false;
  }
  return true;
}

inline bool receiveCount(Receiver& receiver, std::vector<WireMessage>& messages,
                         std::size_t count) {
  return receiveUntil(receiver, messages, [&] { return messages.size() >= count; });
}

template <typename T>
T valueOf(Result<T> result) {
  if (!result.ok()) {
    ADD_FAILURE() << describe(result.error());
    std::abort();
  }
  return std::move(result.value());
}

inline std::unique_ptr<Receiver> receiverOf(const std::vector<std::string>& channels,
                                            const UdpmUrl& url = {}) {
  return valueOf(openUdpmReceiver(url, channels));
}
inline std::unique_ptr<Publisher> publisherTo(const UdpmUrl& url = {}) {
  return valueOf(openUdpmPublisher(url));
}

/// Sends raw bytes to the group, from its own port.
class RawSender {
 public:
  explicit RawSender(const UdpmUrl& url = {})
      : address_(addressOf(url)), socket_(valueOf(openSendingSocket(url))) {}
  bool send(const RawBytes& bytes) const {
    return sendto(socket_.get(), bytes.data(), bytes.size(), 0,
                  reinterpret_cast<const sockaddr*>(&address_),
                  sizeof address_) == static_cast<ssize_t>(bytes.size());
  }

 private:
  sockaddr_in address_;
  internal::FileDescriptor socket_;
};

inline Bytes patterned(std::size_t size, std::uint32_t seed) {
  Bytes bytes(size);
  for (auto& byte : bytes) {
    seed = seed * 1664525 + 1013904223;
    byte = static_cast<std::uint8_t>(seed >> 24);
  }
  return bytes;
}

/// Resident memory of this process.
inline std::size_t residentBytes() {
  std::size_t total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace foretouch::test
