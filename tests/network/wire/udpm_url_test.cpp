#include <cstdint>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "network/wire/wire.h"

namespace foretouch {
namespace {

TEST(ParseUdpmUrl, ReadsWhatLcmWrites) {
  const auto url = parseUdpmUrl("udpm://239.1.2.3:7700?ttl=1&recv_buf_size=2097152");
  ASSERT_TRUE(url.ok()) << describe(url.error());
  EXPECT_EQ(url.value().group, "239.1.2.3");
  EXPECT_EQ(url.value().port, 7700);
  EXPECT_EQ(url.value().ttl, 1);
  EXPECT_EQ(url.value().receiveBufferBytes, 2097152u);
}

TEST(ParseUdpmUrl, FillsInWhatIsLeftOut) {
  for (const char* text : {kDefaultUrl, "udpm://", "udpm://239.255.76.67", "udpm://:7667",
                           "udpm://?ttl=0", "udpm://239.255.76.67:7667?"}) {
    const auto url = parseUdpmUrl(text);
    ASSERT_TRUE(url.ok()) << text << describe(url.error());
    EXPECT_EQ(url.value().group, UdpmUrl().group) << text;
    EXPECT_EQ(url.value().port, UdpmUrl().port) << text;
    EXPECT_EQ(url.value().ttl, 0) << text;
  }
}

TEST(ParseUdpmUrl, NamesThePartThatIsWrong) {
  const auto complaint = [](const std::string& text) {
    const auto url = parseUdpmUrl(text);
    return url.ok() ? "read" : describe(url.error());
  };
  const auto says = [&](const std::string& text, const std::string& word) {
    EXPECT_NE(complaint(text).find(word), std::string::npos) << complaint(text);
  };
  says("tcpq://127.0.0.1:7700", "expected udpm://");
  says("", "expected udpm://");
  says("udpm://\033[2J", "\\x1b[2J");
  says("udpm://10.0.0.1:7667", "group: expected an address from 224.0.0.0");
  says("udpm://240.0.0.1", "group:");
  says("udpm://localhost:7667", "found 'localhost'");
  says("udpm://239.255.76.67:0", "port: expected 1 to 65535, found '0'");
  says("udpm://239.255.76.67:", "port:");
  says("udpm://239.255.76.67:65536", "port:");
  says("udpm://239.255.76.67:77x", "port:");
  says("udpm://239.255.76.67:7667?ttl=256", "ttl: expected 0 to 255");
  says("udpm://239.255.76.67:7667?ttl=-1", "ttl:");
  says("udpm://239.255.76.67:7667?ttl", "ttl:");
  says("udpm://239.255.76.67:7667?recv_buf_size=0", "recv_buf_size: expected 1 to");
  says("udpm://239.255.76.67:7667?recv_buf_size=99999999999999999999", "recv_buf_size:");
  says("udpm://239.255.76.67:7667?TTL=1", "found 'TTL'");
  says("udpm://239.255.76.67:7667?ttl=1&&ttl=1", "found ''");
}

TEST(Network, IsAnAddressAndItsLeadingBits) {
  const auto read = [](const std::string& text) {
    const auto network = parseNetwork(text);
    EXPECT_TRUE(network.ok()) << text;
    return network.ok() ? std::pair(network.value().address, network.value().bits)
                        : std::pair(std::uint32_t{0}, -1);
  };
  EXPECT_EQ(read("10.0.0.0/24"), std::pair(0x0a000000U, 24));
  EXPECT_EQ(read("10.1.2.3"), std::pair(0x0a010203U, 32));
  EXPECT_EQ(read("10.1.2.3/32"), std::pair(0x0a010203U, 32));
  EXPECT_EQ(read("0.0.0.0/0"), std::pair(0U, 0));
  for (const std::string bad : {"", "10.0.0/24", "10.0.0.0/", "10.0.0.0/33", "10.0.0.0/-1",
                                "10.0.0.0/8x", "ten", "10.0.0.7/24", "::1/128", "1.0.0.0/0"}) {
    const auto network = parseNetwork(bad);
    ASSERT_FALSE(network.ok()) << bad;
    EXPECT_NE(network.error().message.find("'" + bad + "'"), std::string::npos);
  }
}

}  // namespace
}  // namespace foretouch
