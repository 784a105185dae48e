#include "tools/inputs/npz_arrays.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>
#include <zlib.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/model/joint_table.h"
#include "assets/near_names.h"

namespace foretouch::tools {
namespace {

/// Limits for an array's file: its header is short, and its values are those of a table.
constexpr std::size_t kMaxHeader = std::size_t{64} << 10;
constexpr std::size_t kMaxUnpacked = internal::kMaxTableValues * 8 + kMaxHeader;
constexpr std::size_t kMaxEntries = 4096;
/// The limit for one text: numpy makes all as long as the longest.
constexpr std::size_t kMaxTextBytes = 4096;

Error damaged(const std::string& what) {
  return Error::of(ErrorCode::Syntax,
                   "expected a zip of arrays as numpy.savez() writes it, " + what);
}

/// Little-endian numbers at places that may lie outside the bytes.
template <typename Value>
std::optional<Value> valueAt(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < sizeof(Value)) return std::nullopt;
  Value value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

bool isAt(std::string_view bytes, std::size_t at, std::string_view mark) {
  return at <= bytes.size() && bytes.substr(at, mark.size()) == mark;
}

/// Where the zip's last record begins: at most a comment of 64 KiB before the end.
std::optional<std::size_t> endRecord(std::string_view bytes) {
  constexpr std::size_t kRecord = 22, kMostComment = 65535;
  if (bytes.size() < kRecord) return std::nullopt;
  const std::size_t last = bytes.size() - kRecord;
  for (std::size_t back = 0; back <= std::min(last, kMostComment); ++back) {
    if (isAt(bytes, last - back, "PK\x05\x06")) return last - back;
  }
  return std::nullopt;
}

/// What an array's file says before its values.
struct Header {
  std::string type;  ///< "<f8"
  bool isColumnMajor = false;
  std::vector<std::size_t> shape;
  std::size_t begin = 0;  ///< Where the values begin.
};

/// What stands behind `'key':` in the header's dictionary.
std::string_view behind(std::string_view text, const std::string& key) {
  const std::size_t at = text.find("'" + key + "':");
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + key.size() + 3);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  return text;
}

std::optional<std::vector<std::size_t>> shapeIn(std::string_view text) {
  std::vector<std::size_t> shape;
  if (text.empty() || text.front() != '(') return std::nullopt;
  text.remove_prefix(1);
  for (;;) {
    while (!text.empty() && (text.front() == ' ' || text.front() == ',')) text.remove_prefix(1);
    if (text.empty()) return std::nullopt;
    if (text.front() == ')') return shape;
    std::size_t size = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), size);
    if (read.ec != std::errc() || shape.size() == 8) return std::nullopt;
    shape.push_back(size);
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  }
}

Result<Header> headerOf(std::string_view content) {
  const auto bad = [] { return damaged("found one whose header is not as numpy writes it"); };
  if (!isAt(content, 0, "\x93NUMPY") || content.size() < 12) return bad();
  const bool isLong = content[6] != 1;  // versions 2 and 3 have a length of four bytes
  const std::size_t before = isLong ? 12 : 10;
  const std::size_t length =
      isLong ? *valueAt<std::uint32_t>(content, 8) : *valueAt<std::uint16_t>(content, 8);
  if (length > kMaxHeader || content.size() - before < length) return bad();
  const std::string_view text = content.substr(before, length);
  Header header;
  header.begin = before + length;
  std::string_view type = behind(text, "descr");
  if (type.empty() || type.front() != '\'' || type.find('\'', 1) == type.npos) {
    return Error::of(ErrorCode::Mismatch, "expected numbers or texts, found records");
  }
  header.type = type.substr(1, type.find('\'', 1) - 1);
  header.isColumnMajor = isAt(behind(text, "fortran_order"), 0, "True");
  auto shape = shapeIn(behind(text, "shape"));
  if (!shape) return bad();
  header.shape = *std::move(shape);
  return header;
}

/// How many values there are; nothing beyond the limit.
std::optional<std::size_t> countIn(const std::vector<std::size_t>& shape) {
  std::size_t count = 1;
  for (const std::size_t size : shape) {
    if (size > internal::kMaxTableValues) return std::nullopt;
    count *= size;
    if (count > internal::kMaxTableValues) return std::nullopt;
  }
  return count;
}

/// Where value `i` in C order lies in a file in Fortran's order, of two dimensions.
std::size_t placeOf(std::size_t i, const Header& header) {
  if (!header.isColumnMajor || header.shape.size() < 2) return i;
  return (i % header.shape[1]) * header.shape[0] + i / header.shape[1];
}

template <typename Value>
std::vector<double> numbersIn(std::string_view data, const Header& header, std::size_t count) {
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    numbers[i] = static_cast<double>(*valueAt<Value>(data, placeOf(i, header) * sizeof(Value)));
  }
  return numbers;
}

/// Appends a code point as UTF-8; a question mark if it is not one.
void appendCodePoint(std::uint32_t c, std::string& out) {
  if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) c = '?';
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xC0 | (c >> 6));
  } else {
    c < 0x10000 ? put(0xE0 | (c >> 12)) : put(0xF0 | (c >> 18));
    if (c >= 0x10000) put(0x80 | ((c >> 12) & 0x3F));
    put(0x80 | ((c >> 6) & 0x3F));
  }
  put(0x80 | (c & 0x3F));
}

std::vector<std::string> textsIn(std::string_view data, std::size_t width, bool isWide) {
  std::vector<std::string> texts;
  for (std::size_t at = 0; at + width <= data.size(); at += width) {
    std::string text;
    if (isWide) {
      for (std::size_t i = 0; i < width; i += 4) {
        const std::uint32_t c = *valueAt<std::uint32_t>(data, at + i);
        if (c != 0) appendCodePoint(c, text);
      }
    } else {
      text = data.substr(at, width);
      text.resize(text.find_last_not_of('\0') + 1);
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

/// "<f8": how many bytes a value has; 0: not one of the types that are read.
std::size_t widthOf(const std::string& type) {
  if (type == "<f8" || type == "<i8" || type == "<u8") return 8;
  if (type == "<f4" || type == "<i4" || type == "<u4") return 4;
  std::size_t size = 0;
  const bool isText = type.size() > 2 && (isAt(type, 0, "|S") || isAt(type, 0, "<U"));
  if (!isText) return 0;
  const auto read = std::from_chars(type.data() + 2, type.data() + type.size(), size);
  if (read.ec != std::errc() || size == 0 || size > kMaxTextBytes / 4) return 0;
  return type[1] == 'U' ? 4 * size : size;
}

Error unreadable(const std::string& type) {
  std::string why = "found " + inQuotes(type);
  if (!type.empty() && type.front() == '>') why += ", in the byte order of other machines";
  if (type.find('O') != type.npos) why += ", Python's objects, which only a program could read";
  return Error::of(ErrorCode::Mismatch,
                   "expected floats or integers of 4 or 8 bytes, or texts, " + why);
}

Result<NpzArray> decoded(const std::string& content) {
  FORETOUCH_TRY(const Header header, headerOf(content));
  const std::size_t width = widthOf(header.type);
  if (width == 0) return unreadable(header.type);
  const auto count = countIn(header.shape);
  if (!count) {
    return Error::of(ErrorCode::LimitExceeded,
                     "expected at most " + std::to_string(internal::kMaxTableValues) + " values");
  }
  const std::string_view data = std::string_view(content).substr(header.begin);
  if (data.size() != *count * width) {
    return damaged("found one with " + std::to_string(data.size()) +
                   " bytes where its shape needs " + std::to_string(*count * width));
  }
  if (header.isColumnMajor && header.shape.size() > 2) {
    return Error::of(ErrorCode::Mismatch, "expected rows before columns (C order)");
  }
  NpzArray array{header.shape, {}, {}};
  const char kind = header.type[1];
  if (kind == 'S' || kind == 'U') array.texts = textsIn(data, width, kind == 'U');
  if (header.type == "<f8") array.numbers = numbersIn<double>(data, header, *count);
  if (header.type == "<f4") array.numbers = numbersIn<float>(data, header, *count);
  if (header.type == "<i8") array.numbers = numbersIn<std::int64_t>(data, header, *count);
  if (header.type == "<i4") array.numbers = numbersIn<std::int32_t>(data, header, *count);
  if (header.type == "<u8") array.numbers = numbersIn<std::uint64_t>(data, header, *count);
  if (header.type == "<u4") array.numbers = numbersIn<std::uint32_t>(data, header, *count);
  const auto odd = std::find_if_not(array.numbers.begin(), array.numbers.end(),
                                    [](double number) { return std::isfinite(number); });
  if (odd == array.numbers.end()) return array;
  return Error::of(ErrorCode::NonFinite, "expected finite numbers, found one that is not, value " +
                                             std::to_string(odd - array.numbers.begin()));
}

/// A raw deflate stream of a zip; nothing if it is damaged or does not unpack to `size` bytes.
std::optional<std::string> inflated(std::string_view packed, std::size_t size) {
  std::string out(size + 1, '\0');  // one more, to see that there is no more
  z_stream stream{};
  constexpr int kRaw = -15;
  if (inflateInit2(&stream, kRaw) != Z_OK) return std::nullopt;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int ended = inflate(&stream, Z_FINISH);
  const std::size_t written = stream.total_out;
  inflateEnd(&stream);
  if (ended != Z_STREAM_END || written != size) return std::nullopt;
  out.resize(size);
  return out;
}

}  // namespace

Result<NpzArrays> NpzArrays::of(std::string bytes) {
  NpzArrays arrays;
  arrays.bytes_ = std::move(bytes);
  const std::string_view all = arrays.bytes_;
  const auto end = endRecord(all);
  if (!end) return damaged("found no directory at its end");
  const std::size_t count = *valueAt<std::uint16_t>(all, *end + 10);
  std::size_t at = *valueAt<std::uint32_t>(all, *end + 16);
  if (count > kMaxEntries) return damaged("found " + std::to_string(count) + " files in it");
  for (std::size_t i = 0; i < count; ++i) {
    constexpr std::size_t kRecord = 46, kLocal = 30;
    const auto wrong = [&](const char* what) {
      return damaged("found " + std::string(what) + " at entry " + std::to_string(i));
    };
    if (!isAt(all, at, "PK\x01\x02") || !valueAt<char>(all, at + kRecord - 1)) {
      return wrong("no record of a file");
    }
    const auto u16 = [&](std::size_t field) { return *valueAt<std::uint16_t>(all, at + field); };
    const auto u32 = [&](std::size_t field) { return *valueAt<std::uint32_t>(all, at + field); };
    const std::size_t local = u32(42);
    Entry entry{"", 0, u32(20), u32(24), u32(16), u16(10) == 8, (u16(8) & 1) != 0, false};
    entry.isOtherwisePacked = u16(10) != 0 && u16(10) != 8;
    const std::size_t nameBytes = u16(28);
    if (all.size() - at - kRecord < nameBytes) return wrong("a name that is cut off");
    entry.name = all.substr(at + kRecord, nameBytes);
    if (!isAt(all, local, "PK\x03\x04") || !valueAt<char>(all, local + kLocal - 1)) {
      return wrong("no file where the directory says");
    }
    entry.begin = local + kLocal + *valueAt<std::uint16_t>(all, local + 26) +
                  *valueAt<std::uint16_t>(all, local + 28);
    if (entry.begin > all.size() || all.size() - entry.begin < entry.packed) {
      return wrong("a file that is cut off");
    }
    constexpr std::string_view kEnd = ".npy";
    if (entry.name.size() > kEnd.size() &&
        isAt(entry.name, entry.name.size() - kEnd.size(), kEnd)) {
      entry.name.resize(entry.name.size() - kEnd.size());
      arrays.entries_.push_back(entry);
    }
    at += kRecord + nameBytes + u16(30) + u16(32);
  }
  return arrays;
}

std::vector<std::string> NpzArrays::names() const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_) names.push_back(entry.name);
  return names;
}

const NpzArrays::Entry* NpzArrays::find(const std::string& name) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

Result<std::string> NpzArrays::contentOf(const Entry& entry) const {
  if (entry.isEncrypted) return damaged("found an encrypted one");
  if (entry.isOtherwisePacked) return damaged("found one packed in another way than by deflate");
  if (entry.unpacked > kMaxUnpacked) return damaged("found one that is too large");
  const std::string_view packed = std::string_view(bytes_).substr(entry.begin, entry.packed);
  auto content = entry.isDeflated ? inflated(packed, entry.unpacked) : std::string(packed);
  if (!content || content->size() != entry.unpacked) {
    return damaged("found one that does not unpack to its size");
  }
  const auto* const first = reinterpret_cast<const Bytef*>(content->data());
  if (crc32(0, first, static_cast<uInt>(content->size())) != entry.crc) {
    return damaged("found one whose check sum differs");
  }
  return *std::move(content);
}

Result<std::string> NpzArrays::content(const std::string& name) const {
  const auto named = [&](Error error) {
    error.message = "array " + inQuotes(name) + ": " + error.message;
    return error;
  };
  const Entry* const entry = find(name);
  if (entry == nullptr) {
    return Error::of(ErrorCode::UnknownName,
                     "has no array " + inQuotes(name) + didYouMean(name, names()));
  }
  FORETOUCH_TRY_OR(named, auto content, contentOf(*entry));
  return content;
}

Result<NpzArray> NpzArrays::array(const std::string& name) const {
  const auto named = [&](Error error) {
    error.message = "array " + inQuotes(name) + ": " + error.message;
    return error;
  };
  FORETOUCH_TRY(const auto text, content(name));
  FORETOUCH_TRY_OR(named, auto array, decoded(text));
  return array;
}

Result<Done> NpzArrays::replaceNumbers(const std::vector<double>& numbers, std::string& content) {
  FORETOUCH_TRY(const Header header, headerOf(content));
  const bool isWide = header.type == "<f8";
  if (!isWide && header.type != "<f4") return unreadable(header.type);
  const std::size_t width = isWide ? 8 : 4;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    char* const at = &content[header.begin + placeOf(i, header) * width];
    const auto narrow = static_cast<float>(numbers[i]);
    isWide ? std::memcpy(at, &numbers[i], width) : std::memcpy(at, &narrow, width);
  }
  return Done{};
}

}  // namespace foretouch::tools
