#include "network/wire/udpm_reassembly.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "network/wire/messages.h"
#include "tests/network/wire/udpm_bytes.h"

namespace foretouch {
namespace {

using test::cut;
using test::fragmentOf;
using test::RawBytes;
using test::shortOf;
using test::withNul;

constexpr UdpmSender kAlice{0x0100007f, 1000};
constexpr UdpmSender kMallory{0x0100007f, 2000};

RawBytes numbered(std::size_t size, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  RawBytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

class Reassembly : public testing::Test {
 protected:
  void take(const RawBytes& bytes, const UdpmSender& sender = kAlice, std::int64_t utimeUs = 0) {
    const RawBytes exact(bytes);
    reassembler_.take(sender, exact, utimeUs, messages_);
    ASSERT_LE(reassembler_.numPartials(), kMaxPartialMessages);
    ASSERT_LE(reassembler_.bytesHeld(), kMaxPartialBytes);
  }
  void takeAll(const std::vector<RawBytes>& datagrams, const UdpmSender& sender = kAlice) {
    for (const RawBytes& bytes : datagrams) take(bytes, sender);
  }
  [[nodiscard]] std::uint64_t faults(DatagramFault fault) const {
    return reassembler_.counts().faults[static_cast<std::size_t>(fault)];
  }

  UdpmReassembler reassembler_{{"POSE", "SKELETON"}};
  std::vector<WireMessage> messages_;
};

TEST_F(Reassembly, DeliversShortMessagesOnWantedChannelsOnly) {
  take(shortOf(1, withNul("POSE"), "abc"), kAlice, 123);
  take(shortOf(2, withNul("OTHER"), "abc"));
  take(shortOf(3, withNul("POSE2"), "abc"));
  take(shortOf(4, withNul("POS"), "abc"));
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].channel, "POSE");
  EXPECT_EQ(messages_[0].payload, (Bytes{'a', 'b', 'c'}));
  EXPECT_EQ(messages_[0].receiveUtimeUs, 123);
  EXPECT_EQ(reassembler_.counts().datagrams, 4u);
  EXPECT_EQ(reassembler_.counts().messages, 1u);
  EXPECT_EQ(reassembler_.counts().otherChannels, 3u);
}

TEST_F(Reassembly, TakesFragmentsInAnyOrder) {
  const RawBytes payload = numbered(100);
  std::vector<std::size_t> order{0, 1, 2, 3};
  std::uint32_t sequence = 0;
  do {
    const auto fragments = cut("POSE", payload, ++sequence, {10, 1, 40});
    messages_.clear();
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_TRUE(messages_.empty());
      take(fragments[order[i]], kAlice, 10 * static_cast<std::int64_t>(i));
    }
    ASSERT_EQ(messages_.size(), 1u);
    EXPECT_EQ(messages_[0].payload, payload);
    EXPECT_EQ(messages_[0].channel, "POSE");
    EXPECT_EQ(messages_[0].receiveUtimeUs, 30);
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(sequence, 24u);
  EXPECT_EQ(reassembler_.numPartials(), 0u);
}

TEST_F(Reassembly, KeepsSendersAndSequencesApart) {
  const RawBytes a = numbered(50, 1), b = numbered(50, 2), c = numbered(50, 3), d = numbered(50, 4);
  const UdpmSender sameAddress{kAlice.address, 1001}, samePort{0x0200007f, kAlice.port};
  const auto fa = cut("POSE", a, 5, {20}), fb = cut("POSE", b, 5, {20});
  const auto fc = cut("POSE", c, 5, {20}), fd = cut("POSE", d, 6, {20});
  take(fa[0]);
  take(fb[0], sameAddress);
  take(fc[1], samePort);
  take(fd[1]);
  take(fb[1], sameAddress);
  take(fd[0]);
  take(fc[0], samePort);
  take(fa[1]);
  ASSERT_EQ(messages_.size(), 4u);
  EXPECT_EQ(messages_[0].payload, b);
  EXPECT_EQ(messages_[1].payload, d);
  EXPECT_EQ(messages_[2].payload, c);
  EXPECT_EQ(messages_[3].payload, a);
}

TEST_F(Reassembly, PassesOverRepeatedFragmentsEvenLateOnes) {
  const RawBytes payload = numbered(100);
  const auto fragments = cut("POSE", payload, 1, {40});
  take(fragments[0]);
  take(fragments[0]);
  take(fragments[1]);
  takeAll(fragments);
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].payload, payload);
  EXPECT_EQ(faults(DatagramFault::Repeated), 3u);
  EXPECT_EQ(reassembler_.numPartials(), 0u);
}

TEST_F(Reassembly, DropsMessagesWhoseFragmentsDisagree) {
  const RawBytes payload = numbered(100), others = numbered(100, 2);
  const auto fragments = cut("POSE", payload, 1, {40, 30});
  const auto refuses = [&](std::uint32_t sequence, const std::vector<RawBytes>& datagrams) {
    const auto before = faults(DatagramFault::Conflict);
    takeAll(datagrams);
    EXPECT_TRUE(messages_.empty());
    EXPECT_EQ(reassembler_.numPartials(), 0u) << sequence;
    EXPECT_GT(faults(DatagramFault::Conflict), before) << sequence;
  };
  const auto with = [&](std::uint32_t sequence, const std::vector<std::size_t>& sizes) {
    return cut("POSE", payload, sequence, sizes);
  };
  // The same fragment with other bytes, cut elsewhere, of a longer message, of fewer fragments.
  refuses(1, {with(1, {40, 30})[0], cut("POSE", others, 1, {40, 30})[0], fragments[1]});
  refuses(2, {with(2, {40, 30})[0], with(2, {50, 30})[0]});
  refuses(3, {with(3, {40, 30})[0], cut("POSE", numbered(101), 3, {40, 30})[1]});
  refuses(4, {with(4, {40, 30})[0], with(4, {40})[1]});
  // Every fragment there, but with a hole, and with bytes that are there twice.
  refuses(5, {with(5, {40, 30})[0], with(5, {41, 29})[1], with(5, {40, 30})[2]});
  refuses(6, {with(6, {40, 30})[0], with(6, {39, 31})[1], with(6, {40, 30})[2]});
  refuses(7, {with(7, {40, 30})[0], with(7, {40, 29})[1], with(7, {40, 30})[2]});
  // As many bytes as the message has, but one of them twice and one not at all.
  RawBytes shifted = with(9, {40, 30})[1];
  ++shifted[15];  // its offset
  refuses(9, {with(9, {40, 30})[0], shifted, with(9, {40, 30})[2]});
  // More bytes than the message has.
  refuses(8, {with(8, {90, 1})[0], with(8, {10, 89})[1]});
}

TEST_F(Reassembly, ForgetsARefusedMessagesOtherFragments) {
  const auto fragments = cut("POSE", numbered(100), 1, {10, 10, 10});
  take(fragments[0]);
  take(cut("POSE", numbered(100), 1, {10, 10})[1]);
  takeAll(fragments);
  takeAll(fragments);
  EXPECT_TRUE(messages_.empty());
  EXPECT_EQ(reassembler_.numPartials(), 0u);
  EXPECT_EQ(faults(DatagramFault::Conflict), 9u);
}

TEST_F(Reassembly, DoesNotMixMessagesOfARestartedSender) {
  const RawBytes before = numbered(100, 1), after = numbered(100, 2);
  take(cut("POSE", before, 0, {50})[0], kAlice, 0);
  for (const RawBytes& bytes : cut("POSE", after, 0, {50})) {
    take(bytes, kAlice, kMaxFragmentPauseUs + 1);
  }
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].payload, after);
  EXPECT_EQ(faults(DatagramFault::Incomplete), 1u);
  // Restarted once more, with the clock set back.
  for (const RawBytes& bytes : cut("POSE", before, 0, {50})) take(bytes, kAlice, 0);
  ASSERT_EQ(messages_.size(), 2u);
  EXPECT_EQ(messages_[1].payload, before);
}

TEST_F(Reassembly, DoesNotKeepWhatNobodyAskedFor) {
  const auto fragments = cut("VIDEO", numbered(200'000), 1, {65'000, 65'000, 65'000});
  take(fragments[0]);
  EXPECT_EQ(reassembler_.bytesHeld(), 0u);
  takeAll(fragments);
  EXPECT_EQ(reassembler_.bytesHeld(), 0u);
  // The first one last.
  const auto others = cut("VIDEO", numbered(200'000), 2, {65'000, 65'000, 65'000});
  takeAll({others[3], others[2], others[0], others[1]});
  EXPECT_EQ(reassembler_.bytesHeld(), 0u);
  EXPECT_EQ(reassembler_.counts().otherChannels, 2u);
  EXPECT_TRUE(messages_.empty());
}

TEST_F(Reassembly, PaysForWhatCameNotForWhatIsAnnounced) {
  for (std::uint32_t i = 0; i < 1000; ++i) {
    take(fragmentOf({i, kMaxMessageBytes, 0, 0, 2}, withNul("POSE") + "x"));
  }
  EXPECT_EQ(reassembler_.numPartials(), kMaxPartialMessages);
  EXPECT_LT(reassembler_.bytesHeld(), 32u << 10);
  EXPECT_EQ(faults(DatagramFault::Incomplete), 1000 - kMaxPartialMessages);
}

TEST_F(Reassembly, TakesTheLargestMessageInTheSmallestCuts) {
  const RawBytes payload = numbered(kMaxMessageBytes);
  const std::vector<std::size_t> sizes((payload.size() - 1) / 1423, 1423);
  auto fragments = cut("SKELETON", payload, 1, sizes);
  ASSERT_LE(fragments.size(), kMaxFragments);
  std::shuffle(fragments.begin(), fragments.end(), std::mt19937(5));
  takeAll(fragments);
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].payload, payload);
}

TEST_F(Reassembly, AFloodOfOneSenderPushesOutOnlyItsOwn) {
  const RawBytes payload = numbered(300);
  const auto fragments = cut("POSE", payload, 1, {100, 100});
  std::uint32_t flood = 0;
  const auto startMany = [&] {
    for (int i = 0; i < 100; ++i) {
      take(fragmentOf({++flood, 1000, 0, 0, 2}, withNul("POSE") + "x"), kMallory);
    }
  };
  for (const RawBytes& bytes : fragments) {
    startMany();
    take(bytes);
    take(shortOf(9, withNul("POSE"), "short"));
  }
  ASSERT_EQ(messages_.size(), 4u);
  EXPECT_EQ(messages_[2].payload, payload);
}

TEST_F(Reassembly, SendersAndAddressesWithManyMakeWayForNewOnes) {
  const RawBytes payload = numbered(300);
  const auto fragments = cut("POSE", payload, 1, {100, 100});
  const auto start = [&](std::uint32_t sequence, const UdpmSender& sender) {
    take(fragmentOf({sequence, 1000, 0, 0, 2}, withNul("POSE") + "x"), sender);
  };
  // Of the sender that has most, though Alice's has waited longest.
  take(fragments[0]);
  for (std::uint32_t i = 1; i < kMaxPartialMessages; ++i) start(i, kMallory);
  start(1, {kAlice.address, 3000});
  takeAll({fragments[1], fragments[2]});
  ASSERT_EQ(messages_.size(), 1u);
  // Of the address that has most.
  const UdpmSender bob{0x0200000a, 77};
  const std::uint32_t address = 0x0300000a;
  reassembler_ = UdpmReassembler({"POSE"});
  take(fragments[0], bob);
  for (std::uint16_t port = 1; port < kMaxPartialMessages; ++port) start(1, {address, port});
  start(1, {0x0400000a, 1});
  for (const RawBytes& bytes : {fragments[1], fragments[2]}) take(bytes, bob);
  ASSERT_EQ(messages_.size(), 2u);
}

TEST_F(Reassembly, AFloodOfManySendersDoesNotPushOutAKnownOne) {
  const RawBytes payload = numbered(300);
  std::uint16_t port = 5000;
  const auto startFrom = [&](std::size_t senders) {
    for (std::size_t i = 0; i < senders; ++i) {
      take(fragmentOf({1, 1000, 0, 0, 2}, withNul("POSE") + "x"), {kAlice.address, ++port});
    }
  };
  take(shortOf(0, withNul("POSE"), "known from now on"));
  for (const RawBytes& bytes : cut("POSE", payload, 1, {100, 100})) {
    startFrom(1000);
    take(bytes);
  }
  startFrom(1000);
  ASSERT_EQ(messages_.size(), 2u);
  EXPECT_EQ(messages_[1].payload, payload);
}

TEST_F(Reassembly, AKnownSenderThatFloodsPushesOutOnlyItsOwn) {
  const RawBytes payload = numbered(300);
  take(shortOf(0, withNul("POSE"), "known from now on"), kMallory);
  std::uint32_t flood = 0;
  for (const RawBytes& bytes : cut("POSE", payload, 1, {100, 100})) {
    take(bytes);
    for (int i = 0; i < 100; ++i) {
      take(fragmentOf({++flood, 1000, 0, 0, 2}, withNul("POSE") + "x"), kMallory);
    }
  }
  ASSERT_EQ(messages_.size(), 2u);
  EXPECT_EQ(messages_[1].payload, payload);
}

TEST_F(Reassembly, SendersAreKnownInBoundedNumber) {
  const auto known = [](std::size_t i) {
    return UdpmSender{kAlice.address, static_cast<std::uint16_t>(10'000 + i)};
  };
  take(shortOf(0, withNul("POSE"), "first"));
  for (std::size_t i = 0; i + 1 < kMaxKnownSenders; ++i) {
    take(shortOf(0, withNul("POSE"), "others"), known(i));
  }
  const RawBytes payload = numbered(300);
  std::uint16_t port = 20'000;
  const auto survives = [&](std::uint32_t sequence) {
    messages_.clear();
    for (const RawBytes& bytes : cut("POSE", payload, sequence, {100, 100})) {
      take(bytes);
      for (int i = 0; i < 100; ++i) {
        take(fragmentOf({1, 1000, 0, 0, 2}, withNul("POSE") + "x"), {kAlice.address, ++port});
      }
    }
    return messages_.size() == 1;
  };
  EXPECT_TRUE(survives(1));
  // The one that was heard of longest ago is forgotten.
  for (std::size_t i = 0; i < kMaxKnownSenders; ++i) {
    take(shortOf(0, withNul("POSE"), "others"), known(1000 + i));
  }
  EXPECT_FALSE(survives(2));
}

TEST_F(Reassembly, AFloodOfManySendersMustOvertakeAWholeRound) {
  const RawBytes payload = numbered(300);
  std::uint16_t port = 5000;
  const auto startFrom = [&](std::size_t senders) {
    for (std::size_t i = 0; i < senders; ++i) {
      take(fragmentOf({1, 1000, 0, 0, 2}, withNul("POSE") + "x"), {kAlice.address, ++port});
    }
  };
  startFrom(100);
  for (const RawBytes& bytes : cut("POSE", payload, 1, {100, 100})) {
    take(bytes);
    startFrom(kMaxPartialMessages - 1);
  }
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].payload, payload);
}

TEST_F(Reassembly, AnAddressWithManyPortsPushesOutOnlyItsOwn) {
  const RawBytes payload = numbered(300);
  std::uint16_t port = 5000;
  for (const RawBytes& bytes : cut("POSE", payload, 1, {100, 100})) {
    take(bytes, {0x0200000a, 77});
    for (int i = 0; i < 100; ++i) {
      take(fragmentOf({1, 1000, 0, 0, 2}, withNul("POSE") + "x"), {kAlice.address, ++port});
    }
  }
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].payload, payload);
}

TEST_F(Reassembly, LargeOnesThatNeverEndMakeWayInMemory) {
  const RawBytes hostile = numbered(kMaxMessageBytes);
  const std::vector<std::size_t> sizes(69, 60'000);
  const RawBytes payload = numbered(1'000'000, 2);
  const auto valid = cut("POSE", payload, 1, std::vector<std::size_t>(16, 60'000));
  std::size_t most = 0, next = 0;
  for (std::uint16_t port = 1; port <= 10; ++port) {
    auto fragments = cut("POSE", hostile, 1, sizes);
    fragments.pop_back();
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      take(fragments[i], {kAlice.address, port});
      most = std::max(most, reassembler_.bytesHeld());
      if (i % 40 == 0 && next < valid.size()) take(valid[next++], {0x0200000a, 77});
    }
  }
  EXPECT_GT(most, kMaxPartialBytes / 2);  // else nothing had to make way
  EXPECT_EQ(next, valid.size());
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].payload, payload);
}

TEST_F(Reassembly, NamesOfChannelsCostNothing) {
  const std::size_t before = reassembler_.bytesHeld();
  for (std::uint32_t i = 0; i < 200'000; ++i) {
    take(shortOf(i, withNul("CHANNEL_" + std::to_string(i))));
  }
  EXPECT_EQ(reassembler_.bytesHeld(), before);
  EXPECT_EQ(reassembler_.counts().otherChannels, 200'000u);
}

// Random traffic of honest senders, with loss, shuffling and repeats, and of a dishonest one.
class Traffic {
 public:
  explicit Traffic(std::uint32_t seed) : random_(seed) {}

  struct Datagram {
    UdpmSender sender;
    RawBytes bytes;
  };

  /// Some messages of one sender, one after the other.
  std::vector<Datagram> messagesOf(const UdpmSender& sender, std::uint32_t count) {
    std::vector<Datagram> sent;
    for (std::uint32_t sequence = 0; sequence < count; ++sequence) {
      const bool isWanted = below(5) != 0;
      const std::string channel = isWanted ? (below(2) == 0 ? "POSE" : "SKELETON") : "OTHER";
      const RawBytes payload = numbered(below(20) == 0 ? below(400'000) : below(3000), any());
      auto datagrams = datagramsFor(channel, payload, sequence);
      const bool isLossy = below(4) == 0;
      if (isLossy) datagrams.erase(datagrams.begin() + below(datagrams.size()));
      // A repeated short one is another message: only the stream above knows better.
      if (!datagrams.empty() && datagrams[0][3] == '3' && below(3) == 0) {
        datagrams.push_back(datagrams[below(datagrams.size())]);
      }
      std::shuffle(datagrams.begin(), datagrams.end(), random_);
      if (isWanted && !isLossy) expected_.insert({{sender.port, payload}, channel});
      for (RawBytes& bytes : datagrams) sent.push_back({sender, std::move(bytes)});
    }
    return sent;
  }

  std::vector<Datagram> garbageOf(const UdpmSender& sender, std::uint32_t count) {
    std::vector<Datagram> sent;
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool isFragment = below(2) == 0;
      RawBytes bytes = isFragment ? fragmentOf({i, 2000, 0, 0, 3}, withNul("POSE") + "garbage")
                                  : numbered(below(200), any());
      if (isFragment && below(3) == 0)
        bytes[below(bytes.size())] ^= static_cast<std::uint8_t>(1u << below(8));
      sent.push_back({sender, std::move(bytes)});
    }
    return sent;
  }

  /// Merges what several senders sent; each one's order stays.
  std::vector<Datagram> interleaved(std::vector<std::vector<Datagram>> queues) {
    std::vector<Datagram> all;
    std::vector<std::size_t> next(queues.size(), 0);
    while (true) {
      std::vector<std::size_t> ready;
      for (std::size_t i = 0; i < queues.size(); ++i) {
        if (next[i] < queues[i].size()) ready.push_back(i);
      }
      if (ready.empty()) return all;
      const std::size_t chosen = ready[below(ready.size())];
      all.push_back(std::move(queues[chosen][next[chosen]++]));
    }
  }

  /// (sender's port, payload) -> channel, of what must come out. Payloads are random: unique.
  using Expected = std::multimap<std::pair<std::uint16_t, RawBytes>, std::string>;
  [[nodiscard]] const Expected& expected() const { return expected_; }

 private:
  std::uint32_t below(std::size_t bound) { return static_cast<std::uint32_t>(random_() % bound); }
  std::uint32_t any() { return static_cast<std::uint32_t>(random_()); }

  std::vector<RawBytes> datagramsFor(const std::string& channel, const RawBytes& payload,
                                     std::uint32_t sequence) {
    if (payload.size() < 50 || payload.size() > 60'000) {
      return datagramsOf(channel, payload, sequence);
    }
    std::vector<std::size_t> sizes;
    for (std::size_t left = payload.size() - 1; left > 1 && sizes.size() < 40;) {
      sizes.push_back(1 + below(std::min<std::size_t>(left, 600)));
      left -= sizes.back();
      if (left == 0) break;
    }
    return cut(channel, payload, sequence, sizes);
  }

  std::mt19937 random_;
  Expected expected_;
};

TEST_F(Reassembly, DeliversExactlyTheCompleteMessagesOfRandomTraffic) {
  std::size_t delivered = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    reassembler_ = UdpmReassembler({"POSE", "SKELETON"});
    Traffic traffic(seed);
    std::vector<std::vector<Traffic::Datagram>> queues;
    for (std::uint16_t port = 1; port <= 4; ++port) {
      queues.push_back(traffic.messagesOf({kAlice.address, port}, 60));
    }
    queues.push_back(traffic.garbageOf(kMallory, 2000));

    Traffic::Expected got;
    for (const auto& datagram : traffic.interleaved(std::move(queues))) {
      messages_.clear();
      take(datagram.bytes, datagram.sender);
      for (const WireMessage& message : messages_) {
        got.insert({{datagram.sender.port, message.payload}, message.channel});
      }
    }
    EXPECT_TRUE(got == traffic.expected())
        << seed << ": " << got.size() << " came out, expected " << traffic.expected().size();
    delivered += got.size();
  }
  EXPECT_GT(delivered, 2000u);
}

TEST_F(Reassembly, FlippedHeaderBitsLoseMessagesButChangeNone) {
  std::mt19937 random(8);
  const RawBytes payload = numbered(500);
  std::uint32_t sequence = 0;
  for (int round = 0; round < 20'000; ++round) {
    auto fragments = cut("POSE", payload, ++sequence, {100, 150, 100});
    for (auto flips = 1 + random() % 3; flips > 0; --flips) {
      RawBytes& bytes = fragments[random() % fragments.size()];
      bytes[random() % 20] ^= static_cast<std::uint8_t>(1u << random() % 8);
    }
    std::shuffle(fragments.begin(), fragments.end(), random);
    takeAll(fragments);
  }
  // A few: two flips that cancel, or a sequence number that becomes an unfinished message's.
  EXPECT_GT(messages_.size(), 0u);
  EXPECT_LT(messages_.size(), 2000u);
  for (const WireMessage& message : messages_) {
    ASSERT_EQ(message.channel, "POSE");
    ASSERT_TRUE(message.payload == payload);
  }
}

}  // namespace
}  // namespace foretouch
