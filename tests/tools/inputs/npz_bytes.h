// tests/tools/inputs/npz_bytes.h: arrays in numpy's format, and the zip around them, by zlib's own
// check sum and deflate.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>
#include <zlib.h>

namespace foretouch::test {

/// An array's file, version 1.0, whose header says what one likes.
inline std::string npyOf(const std::string& header, const std::string& data) {
  const std::string text = header + "\n";
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size() & 0xFF) +
         static_cast<char>(text.size() >> 8) + text + data;
}

template <typename Value>
std::string npyOf(const std::string& type, const std::string& shape,
                  const std::vector<Value>& values) {
  std::string data(values.size() * sizeof(Value), '\0');
  if (!values.empty()) std::memcpy(data.data(), values.data(), data.size());
  return npyOf("{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }", data);
}

/// numpy's text of fixed width, four bytes per letter.
inline std::string npyOfTexts(const std::vector<std::string>& texts, std::size_t width) {
  std::vector<std::uint32_t> letters;
  for (std::string text : texts) {
    text.resize(width);
    for (const char c : text) letters.push_back(static_cast<unsigned char>(c));
  }
  return npyOf("<U" + std::to_string(width), "(" + std::to_string(texts.size()) + ",)", letters);
}

inline std::string deflated(const std::string& plain) {
  std::string packed(compressBound(plain.size()), '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// The whole file; each content is that of NAME.npy.
inline std::string npzOf(const std::vector<std::pair<std::string, std::string>>& contents,
                         bool isDeflated) {
  std::string file, directory;
  const auto put = [](std::string& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
  };
  for (const auto& [array, content] : contents) {
    const std::string name = array + ".npy", packed = isDeflated ? deflated(content) : content;
    std::string fields;
    for (const int field : {20, 0, isDeflated ? 8 : 0, 0, 0x21}) {
      put(fields, static_cast<std::uint64_t>(field), 2);
    }
    put(fields,
        crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())),
        4);
    put(fields, packed.size(), 4), put(fields, content.size(), 4), put(fields, name.size(), 2);
    put(fields, 0, 2);
    directory += std::string("PK\x01\x02\x14\x00", 6) + fields + std::string(10, '\0');
    put(directory, file.size(), 4);
    directory += name;
    file += "PK\x03\x04" + fields + name + packed;
  }
  std::string end = std::string("PK\x05\x06\0\0\0\0", 8);
  put(end, contents.size(), 2), put(end, contents.size(), 2), put(end, directory.size(), 4);
  put(end, file.size(), 4), put(end, 0, 2);
  return file + directory + end;
}

}  // namespace foretouch::test
