// Oracle: bytes as the formats say they are (APPNOTE 6.3, numpy's format 1.0), and the check value
// of CRC-32, which every description of it gives.
#include "tools/feet/npz_file.h"

#include <cstring>

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) {
    word = (word << 8) | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  }
  return word;
}

/// CRC-32 bit by bit.
std::uint32_t crcOf(const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) * 0xEDB88320U);
  }
  return ~crc;
}

TEST(NpzFile, StoresAnArrayAsNumpyReadsIt) {
  ASSERT_EQ(crcOf("123456789"), 0xCBF43926U);
  NpzFile file;
  file.add("slide", std::vector<float>{0.0F, 1.5F, 2.0F, 3.0F, 4.0F, 5.0F}, {2, 3});
  const std::string bytes = file.bytes();
  ASSERT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  const std::size_t begin = 30 + std::strlen("slide.npy");
  EXPECT_EQ(bytes.substr(30, 9), "slide.npy");
  const std::uint32_t size = wordAt(bytes, 22);
  EXPECT_EQ(wordAt(bytes, 18), size);
  const std::string npy = bytes.substr(begin, size);
  EXPECT_EQ(wordAt(bytes, 14), crcOf(npy));
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ((npy.size() - 6 * sizeof(float)) % 64, 0u);
  EXPECT_NE(npy.find("{'descr': '<f4', 'fortran_order': False, 'shape': (2,3,), }"),
            std::string::npos);
  float second = 0.0F;
  std::memcpy(&second, npy.data() + npy.size() - 5 * sizeof(float), sizeof second);
  EXPECT_EQ(second, 1.5F);
  const std::size_t end = bytes.size() - 22;
  EXPECT_EQ(bytes.substr(end, 4), "PK\x05\x06");
  EXPECT_EQ(wordAt(bytes, end + 16), begin + size);
  EXPECT_EQ(bytes.substr(begin + size, 4), "PK\x01\x02");
}

}  // namespace
}  // namespace foretouch::tools
