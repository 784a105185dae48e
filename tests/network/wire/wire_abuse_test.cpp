// What a network may throw at the own receiver while it must not miss a message.
#include <atomic>
#include <cstring>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "network/wire/messages.h"
#include "network/wire/udpm_reassembly.h"
#include "tests/network/private_network.h"

namespace foretouch {
namespace {

using namespace std::chrono_literals;
using test::fragmentOf;
using test::RawBytes;
using test::shortOf;
using test::withNul;

class WireAbuse : public test::PrivateNetwork {};

/// Threads that run until the object goes.
class Background {
 public:
  template <typename Work>
  void start(Work work) {
    threads_.emplace_back([this, work]() mutable {
      for (std::uint32_t i = 0; !isOver_; ++i) work(i);
    });
  }
  void end() {
    isOver_ = true;
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }
  ~Background() { end(); }

 private:
  std::atomic<bool> isOver_{false};
  std::vector<std::thread> threads_;
};

/// 1 kHz of short messages on POSE, and every fiftieth a fragmented one on SKELETON.
class ValidStream {
 public:
  void sendNext() {
    ASSERT_TRUE(publisher_->publish("POSE", payloadOf(842)));
    ++shortOnes_;
    if (shortOnes_ % 50 != 0) return;
    ASSERT_TRUE(publisher_->publish("SKELETON", payloadOf(300'000)));
    ++longOnes_;
  }
  [[nodiscard]] std::uint64_t sent() const { return shortOnes_ + longOnes_; }

  /// How many of what was sent did not come; every one that came is checked.
  [[nodiscard]] std::uint64_t lost(const std::vector<WireMessage>& messages) const {
    std::set<std::uint64_t> poses, skeletons;
    for (const WireMessage& message : messages) {
      std::uint64_t number = 0;
      if (message.payload.size() != 842 && message.payload.size() != 300'000) continue;
      std::memcpy(&number, message.payload.data(), sizeof number);
      const Bytes expected = test::patterned(message.payload.size(), 5);
      EXPECT_TRUE(std::equal(expected.begin() + 8, expected.end(), message.payload.begin() + 8));
      (message.channel == "POSE" ? poses : skeletons).insert(number);
    }
    return sent() - poses.size() - skeletons.size();
  }

 private:
  [[nodiscard]] Bytes payloadOf(std::size_t size) const {
    Bytes payload = test::patterned(size, 5);
    std::memcpy(payload.data(), &shortOnes_, sizeof shortOnes_);
    return payload;
  }
  std::unique_ptr<Publisher> publisher_ = test::publisherTo();
  std::uint64_t shortOnes_ = 0, longOnes_ = 0;
};

/// Sends `valid` at 1 kHz for a while and receives it meanwhile. What the system drops unread is
/// not the receiver's fault: it is counted, and nothing else may be missing.
void expectNothingLost(ValidStream& valid, std::chrono::milliseconds time, Background& abuse) {
  UdpmUrl url;
  url.receiveBufferBytes = 64u << 20;
  const auto receiver = test::receiverOf({"POSE", "SKELETON"}, url);
  std::atomic<bool> isOver{false};
  std::thread sender([&] {
    const auto start = test::Clock::now();
    for (auto next = start; next < start + time; next += 1ms) {
      std::this_thread::sleep_until(next);
      valid.sendNext();
    }
    abuse.end();
    isOver = true;
  });
  std::vector<WireMessage> messages, batch;
  while (!isOver) {
    batch.clear();
    EXPECT_TRUE(receiver->receive(batch, 10).ok());
    for (WireMessage& message : batch) {
      // What garbage made up on our channels is not kept.
      if (message.payload.size() >= 842) messages.push_back(std::move(message));
    }
  }
  sender.join();
  const auto before = [&] { return receiver->counts().datagrams; };
  const auto takeAll = [&] {
    for (std::uint64_t seen = ~0ull; seen != before();) {
      seen = before();
      EXPECT_TRUE(receiver->receive(messages, 100).ok());
    }
  };
  takeAll();
  // The system tells what it dropped with the next datagram that it takes.
  valid.sendNext();
  takeAll();
  const WireCounts counts = receiver->counts();
  const std::uint64_t lost = valid.lost(messages);
  EXPECT_LE(lost, counts.kernelDrops);
  std::cout << "  " << valid.sent() << " valid messages, " << lost << " lost; " << counts.datagrams
            << " datagrams, " << counts.kernelDrops << " dropped unread;";
  for (std::size_t fault = 1; fault < kNumDatagramFaults; ++fault) {
    std::cout << ' ' << toString(static_cast<DatagramFault>(fault)) << ' ' << counts.faults[fault];
  }
  std::cout << '\n';
}

TEST_F(WireAbuse, PacketsThatCrashLiblcmDoNotTouchAStream) {
  const std::vector<RawBytes> packets = {
      fragmentOf({7, 1000, 0, 0, 2}, withNul("POSE") + "x"),
      fragmentOf({7, 1000, 0xfffffff0, 1, 2}, std::string(64, 'x')),  // offset near 2^32
      fragmentOf({8, 1000, 0, 0, 2}, withNul("POSE") + "x"),
      [] {
        RawBytes bytes = fragmentOf({8, 1000, 0, 1, 2}, "");
        bytes.resize(16);  // less than its header
        return bytes;
      }(),
      shortOf(9, "POSE"),  // no NUL
      shortOf(9, std::string(60'000, 'A')),
      fragmentOf({10, 16u << 20, 0, 0, 1}, withNul("POSE") + "x"),
      fragmentOf({11, 256u << 20, 0, 0, 1}, withNul("POSE") + "x"),
      fragmentOf({12, 4, 0, 0, 2}, withNul("POSE") + "ab"),  // twice the same
      fragmentOf({12, 4, 0, 0, 2}, withNul("POSE") + "ab"),
      RawBytes{},
      RawBytes(3, 'L')};
  Background abuse;
  abuse.start([&packets, sender = std::make_shared<test::RawSender>()](std::uint32_t) {
    for (const RawBytes& bytes : packets) sender->send(bytes);
    std::this_thread::sleep_for(1ms);
  });
  ValidStream valid;
  expectNothingLost(valid, 1500ms, abuse);
}

TEST_F(WireAbuse, GarbageAtLineRateDoesNotTouchAStream) {
  Background abuse;
  abuse.start([sender = std::make_shared<test::RawSender>(),
               random = std::mt19937(1)](std::uint32_t i) mutable {
    RawBytes bytes(random() % 64);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    switch (i % 4) {
      case 0: sender->send(bytes); break;
      case 1: sender->send(shortOf(i, withNul("NOBODY_" + std::to_string(i)), "x")); break;
      case 2: sender->send(fragmentOf({i, 90'000, 0, 0, 2}, withNul("POSE") + "x")); break;
      case 3: sender->send(fragmentOf({i, 90'000, 1000, 1, 3}, "x")); break;
    }
  });
  ValidStream valid;
  expectNothingLost(valid, 4000ms, abuse);
}

TEST_F(WireAbuse, ManySendersOfUnfinishedMessagesDoNotTouchAStream) {
  auto senders = std::make_shared<std::vector<test::RawSender>>(64);
  Background abuse;
  abuse.start([senders](std::uint32_t i) {
    (*senders)[i % senders->size()].send(fragmentOf({i, 90'000, 0, 0, 2}, withNul("POSE") + "x"));
    if (i % 10 == 0) std::this_thread::sleep_for(1ms);
  });
  ValidStream valid;
  expectNothingLost(valid, 3000ms, abuse);
}

TEST_F(WireAbuse, NamesOfChannelsCostNothing) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep freed memory";
#endif
  const auto receiver = test::receiverOf({"POSE"});
  const test::RawSender sender;
  std::vector<WireMessage> messages;
  std::size_t before = 0;
  for (std::uint32_t i = 0; i < 200'000; ++i) {
    ASSERT_TRUE(sender.send(shortOf(i, withNul("CHANNEL_" + std::to_string(i)), "x")));
    if (i % 32 == 0) {
      ASSERT_TRUE(receiver->receive(messages, 0).ok());
    }
    if (i == 20'000) before = test::residentBytes();
  }
  ASSERT_TRUE(test::receiveUntil(*receiver, messages, [&] {
    const WireCounts counts = receiver->counts();
    return counts.otherChannels + counts.kernelDrops >= 200'000;
  }));
  EXPECT_TRUE(messages.empty());
  EXPECT_LT(test::residentBytes(), before + (1u << 20));
}

TEST_F(WireAbuse, DropsOfTheSystemAreCountedToTheLast) {
  UdpmUrl url;
  url.receiveBufferBytes = 64u << 10;
  const auto receiver = test::receiverOf({"POSE"}, url);
  const auto publisher = test::publisherTo();
  constexpr std::uint64_t kSent = 5000;
  for (std::uint64_t i = 0; i < kSent; ++i) ASSERT_TRUE(publisher->publish("POSE", Bytes(842)));
  std::vector<WireMessage> messages;
  std::size_t seen = 1;
  while (seen != messages.size()) {
    seen = messages.size();
    ASSERT_TRUE(receiver->receive(messages, 200).ok());
  }
  EXPECT_LT(messages.size(), kSent);
  // Known from the next datagram that is kept.
  ASSERT_TRUE(publisher->publish("POSE", Bytes(842)));
  ASSERT_TRUE(test::receiveCount(*receiver, messages, seen + 1));
  EXPECT_EQ(messages.size() + receiver->counts().kernelDrops, kSent + 1);
}

TEST_F(WireAbuse, ThreadsShareAPublisher) {
  UdpmUrl url;
  url.receiveBufferBytes = 64u << 20;
  const auto receiver = test::receiverOf({"POSE"}, url);
  const auto publisher = test::publisherTo();
  std::vector<std::thread> threads;
  constexpr std::size_t kThreads = 4, kEach = 50;
  for (std::size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < kEach; ++i) {
        const std::size_t size = i % 10 == 0 ? 200'000 : 800;
        EXPECT_TRUE(
            publisher->publish("POSE", test::patterned(size + t, static_cast<std::uint32_t>(i))));
      }
    });
  }
  std::vector<WireMessage> messages;
  const bool isAll = test::receiveCount(*receiver, messages, kThreads * kEach);
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(isAll) << messages.size();
  std::multiset<Bytes> got, sent;
  for (const WireMessage& message : messages) got.insert(message.payload);
  for (std::size_t t = 0; t < kThreads; ++t) {
    for (std::size_t i = 0; i < kEach; ++i) {
      const std::size_t size = i % 10 == 0 ? 200'000 : 800;
      sent.insert(test::patterned(size + t, static_cast<std::uint32_t>(i)));
    }
  }
  EXPECT_TRUE(got == sent);
}

TEST_F(WireAbuse, APublisherRefusesWhatIsNoMessage) {
  const auto publisher = test::publisherTo();
  EXPECT_FALSE(publisher->publish("", Bytes{1}));
  EXPECT_FALSE(publisher->publish(std::string(64, 'A'), Bytes{1}));
  EXPECT_FALSE(publisher->publish("A\nB", Bytes{1}));
  EXPECT_FALSE(publisher->publish("POSE", Bytes(kMaxMessageBytes + 1)));
  EXPECT_TRUE(publisher->publish("POSE", Bytes{}));
}

TEST_F(WireAbuse, AReceiverRefusesWhatIsNoChannel) {
  for (const std::string& channel : {std::string(), std::string(64, 'A'), std::string("A\tB")}) {
    EXPECT_FALSE(openUdpmReceiver({}, {"POSE", channel}).ok());
    EXPECT_FALSE(openLcmReceiver(kDefaultUrl, {"POSE", channel}).ok());
  }
}

}  // namespace
}  // namespace foretouch
