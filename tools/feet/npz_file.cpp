#include "tools/feet/npz_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "tools/little_endian.h"

namespace foretouch::tools {
namespace {

/// The polynomial of zip (ISO 3309), bits reversed.
std::uint32_t crcOf(const std::string& data) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t crc = i;
      for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? 0xEDB88320U ^ (crc >> 1) : crc >> 1;
      table[i] = crc;
    }
    return table;
  }();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : data)
    crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (crc >> 8);
  return ~crc;
}

template <typename Value>
std::string bytesOf(const std::vector<Value>& values) {
  std::string data(values.size() * sizeof(Value), '\0');
  if (!values.empty()) std::memcpy(data.data(), values.data(), data.size());
  return data;
}

std::string headerOf(const std::string& type, const std::vector<std::size_t>& shape) {
  std::string sizes;
  for (const std::size_t size : shape) sizes += std::to_string(size) + ",";
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + sizes + "), }";
  constexpr std::size_t kBefore = 10, kAligned = 64;  // magic, version and length; the format's own
  const std::size_t whole = (kBefore + header.size() + 1 + kAligned - 1) / kAligned * kAligned;
  header.append(whole - kBefore - header.size() - 1, ' ');
  header += '\n';
  std::string text("\x93NUMPY\x01\x00", 8);
  appendBytes(text, static_cast<std::uint16_t>(header.size()));
  return text + header;
}

/// The fields that both headers of a zip's entry have.
template <typename Entry>
void appendCommon(const Entry& entry, std::string& out) {
  constexpr std::uint16_t kVersion = 20, kUtf8 = 0x800, kStored = 0, kTime = 0, kDate = 0x21;
  for (const std::uint16_t field : {kVersion, kUtf8, kStored, kTime, kDate}) {
    appendBytes(out, field);
  }
  appendBytes(out, entry.crc);
  appendBytes(out, entry.size);  // stored: as large as it is
  appendBytes(out, entry.size);
  appendBytes(out, static_cast<std::uint16_t>(entry.name.size()));
  appendBytes(out, std::uint16_t{0});  // nothing extra
}

}  // namespace

void NpzFile::addArray(const std::string& name, const std::string& type,
                       const std::vector<std::size_t>& shape, const std::string& data) {
  addContent(name, headerOf(type, shape) + data);
}

void NpzFile::addContent(const std::string& name, const std::string& content) {
  const Entry entry{name + ".npy", crcOf(content), static_cast<std::uint32_t>(content.size()),
                    file_.size()};
  file_ += "PK\x03\x04";
  appendCommon(entry, file_);
  file_ += entry.name + content;
  entries_.push_back(entry);
}

void NpzFile::add(const std::string& name, const std::vector<float>& values,
                  const std::vector<std::size_t>& shape) {
  addArray(name, "<f4", shape, bytesOf(values));
}

void NpzFile::add(const std::string& name, const std::vector<double>& values) {
  addArray(name, "<f8", {values.size()}, bytesOf(values));
}

void NpzFile::add(const std::string& name, const std::vector<std::int64_t>& values) {
  addArray(name, "<i8", {values.size()}, bytesOf(values));
}

void NpzFile::addBools(const std::string& name, const std::vector<std::uint8_t>& values,
                       const std::vector<std::size_t>& shape) {
  addArray(name, "|b1", shape, bytesOf(values));
}

void NpzFile::add(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string data;
  for (std::string text : texts) {
    text.resize(longest, '\0');
    data += text;
  }
  addArray(name, "|S" + std::to_string(longest), {texts.size()}, data);
}

std::string NpzFile::bytes() const {
  std::string out = file_;
  for (const Entry& entry : entries_) {
    out += "PK\x01\x02";
    appendBytes(out, std::uint16_t{20});  // made by: as it needs
    appendCommon(entry, out);
    appendBytes(out, std::uint16_t{0});  // no comment
    appendBytes(out, std::uint16_t{0});  // on the first disk
    appendBytes(out, std::uint16_t{0});
    appendBytes(out, std::uint32_t{0});
    appendBytes(out, static_cast<std::uint32_t>(entry.offset));
    out += entry.name;
  }
  const auto directory = static_cast<std::uint32_t>(out.size() - file_.size());
  out += "PK\x05\x06";
  appendBytes(out, std::uint32_t{0});
  appendBytes(out, static_cast<std::uint16_t>(entries_.size()));
  appendBytes(out, static_cast<std::uint16_t>(entries_.size()));
  appendBytes(out, directory);
  appendBytes(out, static_cast<std::uint32_t>(file_.size()));
  appendBytes(out, std::uint16_t{0});
  return out.size() < std::numeric_limits<std::uint32_t>::max() ? out : std::string();
}

}  // namespace foretouch::tools
