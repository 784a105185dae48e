// OscReader against bytes made by hand.
#include "network/vmc/osc.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/vmc/performer.h"

namespace foretouch::test {
namespace {

std::vector<std::string> addressesIn(const Bytes& packet) {
  std::vector<std::string> all;
  OscReader reader(packet);
  OscMessage message;
  while (reader.next(message)) all.emplace_back(message.address);
  if (reader.isBroken()) all.emplace_back("broken");
  return all;
}

TEST(OscReader, ReadsMessagesInBundlesInBundles) {
  const Bytes time = oscTime(1.5), ok = oscState({1, 3, 0, 1});
  using All = std::vector<std::string>;
  EXPECT_EQ(addressesIn(time), All{"/VMC/Ext/T"});
  EXPECT_EQ(addressesIn(oscBundle({time, oscBundle({ok, ok}), time})),
            (All{"/VMC/Ext/T", "/VMC/Ext/OK", "/VMC/Ext/OK", "/VMC/Ext/T"}));
  EXPECT_EQ(addressesIn(oscBundle({})), All{});
  EXPECT_EQ(addressesIn(oscBundle({oscBundle({}), time})), All{"/VMC/Ext/T"});
}

TEST(OscReader, ReadsNumbersOfEveryTypeAndPassesOverTheRest) {
  Bytes bytes;
  addText(bytes, "/a");
  addText(bytes, ",ihfdsbTtc");
  addWord(bytes, 0xffffffff);  // -1
  addWord(bytes, 0xffffffff);
  addWord(bytes, 0xfffffffe);  // -2
  addFloat(bytes, 0.25);
  addWord(bytes, 0x3ff80000);  // 1.5
  addWord(bytes, 0);
  addText(bytes, "text");
  addWord(bytes, 5);  // a blob, padded
  addWord(bytes, 0x01020304);
  addWord(bytes, 0x05000000);
  addWord(bytes, 0);
  addWord(bytes, 1);
  addWord(bytes, 'x');
  OscReader reader(bytes);
  OscMessage message;
  ASSERT_TRUE(reader.next(message));
  ASSERT_EQ(message.numArguments, 9u);
  EXPECT_EQ(message.arguments[0].number, -1.0);
  EXPECT_EQ(message.arguments[1].number, -2.0);
  EXPECT_EQ(message.arguments[2].number, 0.25);
  EXPECT_EQ(message.arguments[3].number, 1.5);
  EXPECT_EQ(message.arguments[4].text, "text");
  EXPECT_FALSE(message.arguments[5].number || message.arguments[5].text);
  EXPECT_FALSE(reader.next(message));
  EXPECT_FALSE(reader.isBroken());
}

TEST(OscReader, RefusesWhatBreaksARule) {
  const Bytes whole = oscBundle({oscTime(1.5), oscState({1})});
  ASSERT_TRUE(isOscPacket(whole));
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const bool isWholeElements = n == 16 || n == 16 + 4 + oscTime(1.5).size();
    EXPECT_EQ(isOscPacket({whole.data(), n}), isWholeElements) << n;
  }
  const auto with = [&](std::size_t at, std::uint8_t byte) {
    Bytes bytes = whole;
    bytes[at] = byte;
    return isOscPacket(bytes);
  };
  EXPECT_FALSE(with(0, '$'));    // neither a bundle nor an address
  EXPECT_FALSE(with(19, 3));     // a size that is no multiple of four
  EXPECT_FALSE(with(19, 0));     // or none
  EXPECT_FALSE(with(16, 0x7f));  // or beyond the packet
  EXPECT_FALSE(with(20, 'x'));   // an address without its slash
  EXPECT_FALSE(with(31, 'x'));   // padding that is no zero
  EXPECT_FALSE(with(32, ';'));   // types without their comma
  EXPECT_FALSE(with(33, 'q'));   // a type that does not exist
  Bytes longer = oscTime(1.5);
  addWord(longer, 0);
  EXPECT_FALSE(isOscPacket(longer));
  Bytes deep = oscTime(1.5);
  for (std::size_t i = 0; i < kMaxOscDepth; ++i) deep = oscBundle({deep});
  EXPECT_TRUE(isOscPacket(deep));
  EXPECT_FALSE(isOscPacket(oscBundle({deep})));
}

TEST(OscReader, KeepsSoManyArguments) {
  OscReader reader(ByteView{});
  OscMessage message;
  EXPECT_FALSE(reader.next(message));
  EXPECT_TRUE(reader.isBroken());
  const Bytes many = oscState(std::vector<std::uint32_t>(kMaxOscArguments + 5, 7));
  OscReader second(many);
  ASSERT_TRUE(second.next(message));
  EXPECT_EQ(message.numArguments, kMaxOscArguments);
}

}  // namespace
}  // namespace foretouch::test
