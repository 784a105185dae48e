#include "network/wire/message_key.h"

#include <array>
#include <cstdint>
#include <openssl/evp.h>
#include <string>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

constexpr std::array<std::uint8_t, kKeyBytes> kCounting{0, 1, 2,  3,  4,  5,  6,  7,
                                                        8, 9, 10, 11, 12, 13, 14, 15};

std::uint64_t codeIn(const Bytes& payload) {
  std::uint64_t code = 0;
  for (std::size_t i = payload.size() - 8; i < payload.size(); ++i) code = code << 8 | payload[i];
  return code;
}

/// SipHash-2-4 as [Aumasson12], section 2, states it: an oracle, which shares no code.
std::uint64_t sipHash(const std::array<std::uint8_t, kKeyBytes>& key, const Bytes& text) {
  const auto word = [](const std::uint8_t* at) {
    std::uint64_t value = 0;
    for (int i = 7; i >= 0; --i) value = value << 8 | at[i];
    return value;
  };
  const auto turned = [](std::uint64_t x, int by) { return x << by | x >> (64 - by); };
  const std::uint64_t k0 = word(key.data()), k1 = word(key.data() + 8);
  std::uint64_t a = k0 ^ 0x736f6d6570736575U, b = k1 ^ 0x646f72616e646f6dU;
  std::uint64_t c = k0 ^ 0x6c7967656e657261U, d = k1 ^ 0x7465646279746573U;
  const auto round = [&] {
    a += b, b = turned(b, 13) ^ a, a = turned(a, 32);
    c += d, d = turned(d, 16) ^ c;
    a += d, d = turned(d, 21) ^ a;
    c += b, b = turned(b, 17) ^ c, c = turned(c, 32);
  };
  Bytes padded = text;
  while (padded.size() % 8 != 7) padded.push_back(0);
  padded.push_back(static_cast<std::uint8_t>(text.size()));
  for (std::size_t at = 0; at < padded.size(); at += 8) {
    const std::uint64_t m = word(&padded[at]);
    d ^= m;
    round(), round();
    a ^= m;
  }
  c ^= 0xff;
  for (int i = 0; i < 4; ++i) round();
  return a ^ b ^ c ^ d;
}

TEST(SipHashOracle, GivesTheValueOfThePaper) {
  Bytes text;
  for (std::uint8_t i = 0; i < 15; ++i) text.push_back(i);
  EXPECT_EQ(sipHash(kCounting, text), 0xa129ca6149be45e5U);  // [Aumasson12], appendix A
}

TEST(MessageKey, SignsWithSipHashOfChannelAndPayload) {
  const MessageKey key(kCounting);
  for (std::size_t size = 0; size < 100; ++size) {
    Bytes payload(size, static_cast<std::uint8_t>(size));
    const std::string channel(size % 7 + 1, 'C');
    key.sign(channel, 1'700'000'000'000'000, payload);
    ASSERT_EQ(payload.size(), size + kSignatureBytes);
    Bytes covered(channel.begin(), channel.end());
    covered.push_back(0);
    covered.insert(covered.end(), payload.begin(), payload.end() - 8);
    EXPECT_EQ(codeIn(payload), sipHash(kCounting, covered));
    SignedPayload opened;
    ASSERT_EQ(key.open(channel, payload, opened), Reject::None);
    EXPECT_EQ(opened.content.size, size);
    EXPECT_EQ(opened.sentUtimeUs, 1'700'000'000'000'000);
    EXPECT_EQ(withoutSignature(payload).size, size);
  }
}

TEST(MessageKey, OpensNothingThatWasChanged) {
  const MessageKey key(kCounting);
  Bytes payload(40, 7);
  key.sign("POSE", 5, payload);
  SignedPayload opened;
  for (std::size_t i = 0; i < payload.size() * 8; ++i) {
    Bytes changed = payload;
    changed[i / 8] ^= static_cast<std::uint8_t>(1u << (i % 8));
    EXPECT_EQ(key.open("POSE", changed, opened), Reject::Unauthenticated);
  }
  for (std::size_t size = 0; size < payload.size(); ++size) {
    EXPECT_EQ(key.open("POSE", {payload.data(), size}, opened), Reject::Unauthenticated);
  }
  EXPECT_EQ(key.open("POSF", payload, opened), Reject::Unauthenticated);
  EXPECT_EQ(key.open("POS", payload, opened), Reject::Unauthenticated);
}

TEST(MessageKey, IsAFileThatItsOwnerAloneReads) {
  const test::TempFolder folder;
  const auto read = [&](const std::string& text, unsigned mode) {
    const std::string path = folder.write("key", text);
    EXPECT_EQ(::chmod(path.c_str(), mode), 0);
    const auto key = MessageKey::read(path);
    return key.ok() ? std::string() : key.error().message;
  };
  const std::string digits = "000102030405060708090a0b0c0d0e0F";
  EXPECT_EQ(read(digits + "\n", 0600), "");
  EXPECT_EQ(read(digits, 0400), "");
  for (const unsigned mode : {0640U, 0604U, 0620U}) {
    EXPECT_NE(read(digits, mode).find("chmod 600"), std::string::npos);
  }
  for (const std::string& bad :
       {std::string(), digits.substr(1), digits + "0", digits + "\n\n", digits.substr(2) + "0g"}) {
    EXPECT_NE(read(bad, 0600).find("expected 32 hexadecimal digits"), std::string::npos);
  }
  EXPECT_FALSE(MessageKey::read(folder / "none").ok());
  EXPECT_FALSE(MessageKey::read("/dev/zero").ok());

  Bytes payload(3, 1);
  const std::string path = folder.write("key", digits);
  EXPECT_EQ(::chmod(path.c_str(), 0600), 0);
  MessageKey::read(path).value().sign("POSE", 1, payload);
  SignedPayload opened;
  EXPECT_EQ(MessageKey(kCounting).open("POSE", payload, opened), Reject::None);
}

TEST(MessageKey, IsAnErrorWhereTheSystemGivesNoSipHash) {
  const test::TempFolder folder;
  const std::string path = folder.write("key", "000102030405060708090a0b0c0d0e0f");
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  ASSERT_EQ(EVP_set_default_properties(nullptr, "provider=none"), 1);
  const auto key = MessageKey::read(path);
  ASSERT_EQ(EVP_set_default_properties(nullptr, ""), 1);
  ASSERT_FALSE(key.ok());
  EXPECT_EQ(key.error().file, path);
  EXPECT_NE(key.error().message.find("SipHash"), std::string::npos);
  EXPECT_TRUE(MessageKey::read(path).ok());
}

TEST(ReplayGuard, TakesEachTimeOnceAndOnlyNow) {
  constexpr std::int64_t kNowUs = 1'700'000'000'000'000;
  ReplayGuard guard;
  EXPECT_EQ(guard.take(kNowUs - kMostSignatureAgeUs - 1, kNowUs), Reject::Replayed);
  EXPECT_EQ(guard.take(kNowUs - kMostSignatureAgeUs, kNowUs), Reject::None);
  EXPECT_EQ(guard.take(kNowUs, kNowUs), Reject::None);
  EXPECT_EQ(guard.take(kNowUs, kNowUs), Reject::Replayed);
  EXPECT_EQ(guard.take(kNowUs - 1, kNowUs), Reject::Replayed);
  EXPECT_EQ(guard.take(kNowUs + kMostSignatureAgeUs + 1, kNowUs), Reject::Replayed);
  EXPECT_EQ(guard.take(kNowUs + 1, kNowUs), Reject::None);
}

}  // namespace
}  // namespace foretouch
