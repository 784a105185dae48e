#include "network/wire/udpm_datagram.h"

#include <cstdint>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "network/wire/messages.h"
#include "tests/network/wire/udpm_bytes.h"

namespace foretouch {
namespace {

using test::FragmentHeader;
using test::fragmentOf;
using test::RawBytes;
using test::shortOf;
using test::withNul;

DatagramFault faultOf(const RawBytes& bytes) {
  // On the heap at its exact size, so that AddressSanitizer sees a byte too far.
  const RawBytes exact(bytes);
  UdpmDatagram datagram;
  return parseDatagram(exact, datagram);
}

DatagramFault faultOf(const FragmentHeader& header, const std::string& rest) {
  return faultOf(fragmentOf(header, rest));
}

std::string textOf(ByteView view) {
  return {view.data, view.data + view.size};
}

TEST(ParseDatagram, ReadsShortOnes) {
  const RawBytes bytes = shortOf(0x01020304, withNul("POSE"), std::string("a\0b", 3));
  UdpmDatagram datagram;
  ASSERT_EQ(parseDatagram(bytes, datagram), DatagramFault::None);
  EXPECT_EQ(datagram.sequence, 0x01020304u);
  EXPECT_EQ(datagram.channel, "POSE");
  EXPECT_EQ(textOf(datagram.payload), std::string("a\0b", 3));
  EXPECT_FALSE(datagram.isFragment);
}

TEST(ParseDatagram, ReadsFragments) {
  UdpmDatagram datagram;
  const RawBytes first = fragmentOf({9, 5, 0, 0, 2}, withNul("POSE") + "abc");
  ASSERT_EQ(parseDatagram(first, datagram), DatagramFault::None);
  EXPECT_TRUE(datagram.isFragment);
  EXPECT_EQ(datagram.sequence, 9u);
  EXPECT_EQ(datagram.channel, "POSE");
  EXPECT_EQ(textOf(datagram.payload), "abc");
  const RawBytes second = fragmentOf({9, 5, 3, 1, 2}, "de");
  ASSERT_EQ(parseDatagram(second, datagram), DatagramFault::None);
  EXPECT_EQ(datagram.channel, "");
  EXPECT_EQ(textOf(datagram.payload), "de");
  EXPECT_EQ(datagram.messageBytes, 5u);
  EXPECT_EQ(datagram.offset, 3u);
  EXPECT_EQ(datagram.fragment, 1);
  EXPECT_EQ(datagram.fragments, 2);
}

TEST(ParseDatagram, RefusesWhatIsNoDatagramOfLcm) {
  EXPECT_EQ(faultOf(RawBytes{}), DatagramFault::Short);
  EXPECT_EQ(faultOf(RawBytes(7, 'L')), DatagramFault::Short);
  EXPECT_EQ(faultOf(RawBytes(100, 'L')), DatagramFault::Magic);
  RawBytes bytes = shortOf(1, withNul("POSE"), "payload");
  bytes[3] = '1';
  EXPECT_EQ(faultOf(bytes), DatagramFault::Magic);
}

TEST(ParseDatagram, RefusesChannelsThatDoNotEndOrAreNotNames) {
  EXPECT_EQ(faultOf(shortOf(1, "")), DatagramFault::Short);
  // liblcm hands this one over with a size of 4294967286.
  EXPECT_EQ(faultOf(shortOf(1, "POSE")), DatagramFault::Short);
  EXPECT_EQ(faultOf(shortOf(1, std::string(63, 'A'))), DatagramFault::Short);
  EXPECT_EQ(faultOf(shortOf(1, std::string(64, 'A'))), DatagramFault::Channel);
  EXPECT_EQ(faultOf(shortOf(1, withNul(std::string(63, 'A')))), DatagramFault::None);
  EXPECT_EQ(faultOf(shortOf(1, withNul(std::string(64, 'A')))), DatagramFault::Channel);
  EXPECT_EQ(faultOf(shortOf(1, withNul(std::string(60000, 'A')))), DatagramFault::Channel);
  EXPECT_EQ(faultOf(shortOf(1, withNul(""))), DatagramFault::Channel);
  for (int c = 1; c < 256; ++c) {
    const bool isPrintable = c >= 0x20 && c <= 0x7e;
    EXPECT_EQ(faultOf(shortOf(1, withNul(std::string("A") + static_cast<char>(c)))),
              isPrintable ? DatagramFault::None : DatagramFault::Channel)
        << c;
  }
}

TEST(ParseDatagram, RefusesFragmentsThatCannotBePart) {
  const std::string name = withNul("POSE");
  // A fragment's magic and no room for its header: liblcm's size underflows.
  for (std::size_t size = 8; size < 20; ++size) {
    RawBytes bytes = fragmentOf({7, 100, 0, 0, 2}, "");
    bytes.resize(size);
    EXPECT_EQ(faultOf(bytes), DatagramFault::Short) << size;
  }
  EXPECT_EQ(faultOf({7, 100, 0, 0, 2}, "POSE"), DatagramFault::Short);
  EXPECT_EQ(faultOf({7, kMaxMessageBytes + 1, 0, 0, 2}, name + "x"), DatagramFault::TooLarge);
  EXPECT_EQ(faultOf({7, 0xffffffff, 0, 0, 1}, name + "x"), DatagramFault::TooLarge);
  // An offset near 2^32: liblcm writes before its buffer.
  EXPECT_EQ(faultOf({7, 100, 0xfffffff0, 1, 2}, std::string(32, 'x')), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 100, 99, 1, 2}, "xx"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 100, 50, 2, 2}, "xx"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 100, 0, 0, 0}, name + "x"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 5000, 0, 0, kMaxFragments + 1}, name + "x"), DatagramFault::Fragment);
  // "1 of 1" of a message that is larger than it.
  EXPECT_EQ(faultOf({7, 4u << 20, 0, 0, 1}, name + "x"), DatagramFault::Fragment);
  // More fragments than bytes, the first not at 0, the last not at the end, nothing in it.
  EXPECT_EQ(faultOf({7, 3, 0, 0, 4}, name + "x"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 3, 1, 0, 2}, name + "x"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 3, 0, 1, 2}, "x"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 3, 1, 1, 2}, "x"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 3, 2, 1, 3}, "x"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 10, 1, 2, 4}, "x"), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 3, 0, 0, 2}, name), DatagramFault::Fragment);
  EXPECT_EQ(faultOf({7, 0, 0, 0, 1}, name), DatagramFault::Fragment);
}

TEST(DatagramsOf, AreWhatTheProtocolSays) {
  const Bytes payload{1, 2, 3};
  const auto datagrams = datagramsOf("POSE", payload, 0x0a0b0c0d);
  ASSERT_EQ(datagrams.size(), 1u);
  EXPECT_EQ(datagrams[0], shortOf(0x0a0b0c0d, withNul("POSE"), "\1\2\3"));
}

TEST(DatagramsOf, CutWhereLiblcmDoes) {
  // Channel, NUL and payload together: 65499 bytes are short, one more is two fragments.
  const auto countOf = [](std::size_t payloadBytes) {
    return datagramsOf("POSE", Bytes(payloadBytes, 0xab), 1).size();
  };
  EXPECT_EQ(countOf(0), 1u);
  EXPECT_EQ(countOf(65499 - 5), 1u);
  EXPECT_EQ(countOf(65499 - 5 + 1), 2u);
  EXPECT_EQ(countOf(2 * 65487 - 5), 2u);
  EXPECT_EQ(countOf(2 * 65487 - 5 + 1), 3u);
  Bytes payload(200'000);
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<std::uint8_t>(i * 7);
  EXPECT_EQ(datagramsOf("POSE", payload, 5),
            test::cut("POSE", payload, 5, {65487 - 5, 65487, 65487}));
  for (const Bytes& datagram : datagramsOf("P", Bytes(kMaxMessageBytes, 1), 1)) {
    EXPECT_LE(datagram.size(), kMaxDatagramBytes);
  }
}

// Whatever is read stays within its limits, and its views within the bytes.
void expectSound(const RawBytes& bytes) {
  UdpmDatagram datagram;
  if (parseDatagram(bytes, datagram) != DatagramFault::None) return;
  const auto* begin = bytes.data();
  const auto* end = begin + bytes.size();
  ASSERT_GE(datagram.payload.data, begin);
  ASSERT_EQ(datagram.payload.data + datagram.payload.size, end);
  ASSERT_EQ(datagram.channel.empty(), datagram.isFragment && datagram.fragment != 0);
  ASSERT_LE(datagram.channel.size(), kMaxChannelBytes);
  if (!datagram.isFragment) return;
  ASSERT_LE(datagram.messageBytes, kMaxMessageBytes);
  ASSERT_LT(datagram.fragment, datagram.fragments);
  ASSERT_LE(datagram.offset + datagram.payload.size, datagram.messageBytes);
}

TEST(ParseDatagram, SurvivesEveryFlippedBitAndEveryPrefix) {
  const std::string payload(50, 'p');
  const std::vector<RawBytes> valid = {shortOf(3, withNul("FORETOUCH_POSE"), payload),
                                       fragmentOf({3, 90, 0, 0, 2}, withNul("POSE") + payload),
                                       fragmentOf({3, 90, 40, 1, 2}, payload)};
  for (const RawBytes& bytes : valid) {
    ASSERT_EQ(faultOf(bytes), DatagramFault::None);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      expectSound(RawBytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)));
    }
    for (std::size_t a = 0; a < 8 * bytes.size(); ++a) {
      RawBytes flipped = bytes;
      flipped[a / 8] ^= static_cast<std::uint8_t>(1 << a % 8);
      expectSound(flipped);
      for (std::size_t b = 0; b < 8 * 28; ++b) {  // with any second bit of the header
        RawBytes twice = flipped;
        twice[b / 8] ^= static_cast<std::uint8_t>(1 << b % 8);
        expectSound(twice);
      }
    }
  }
}

TEST(ParseDatagram, SurvivesRandomBytesBehindAMagic) {
  std::mt19937 random(20);
  for (int round = 0; round < 200'000; ++round) {
    RawBytes bytes(random() % 64);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % (random() % 4 ? 256 : 2));
    const std::string magic = random() % 2 == 0 ? "LC02" : "LC03";
    std::copy_n(magic.begin(), std::min<std::size_t>(4, bytes.size()), bytes.begin());
    expectSound(bytes);
  }
}

TEST(DatagramFaults, HaveWordsOfTheirOwn) {
  std::set<std::string> words;
  for (std::size_t i = 0; i < kNumDatagramFaults; ++i) {
    words.insert(toString(static_cast<DatagramFault>(i)));
  }
  EXPECT_EQ(words.size(), kNumDatagramFaults);
}

}  // namespace
}  // namespace foretouch
