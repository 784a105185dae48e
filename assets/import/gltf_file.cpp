#include "assets/import/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "articulated/quoted.h"
#include "assets/import/failure.h"
#include "assets/import/faults.h"
#include "assets/import/gltf_rules.h"
#include "assets/import/memory_budget.h"
#include "assets/import/text.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

using nlohmann::json;

constexpr std::uint64_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// As four characters if they are printable, else as numbers.
std::string wordText(std::uint32_t word) {
  std::array<char, 4> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(word >> (8 * i));
  return inQuotes({bytes.data(), bytes.size()});
}

std::string expected(const std::string& what, const std::string& found) {
  return "expected " + what + ", found " + found;
}

/// A chunk, from its header.
struct Chunk {
  std::uint64_t offset = 0;  ///< Where the header is.
  std::uint32_t length = 0, type = 0;
  [[nodiscard]] std::uint64_t begin() const { return offset + kChunkHeaderBytes; }
  [[nodiscard]] std::uint64_t end() const { return begin() + length; }
};

/// The container: its header, its chunk of JSON and its chunk of bytes.
class Glb {
 public:
  explicit Glb(std::string_view bytes) : bytes_(bytes), size_(bytes.size()) {}

  /// False if it cannot look for JSON.
  bool checkContainer(Faults& faults) {
    if (size_ < kHeaderBytes + kChunkHeaderBytes) {
      faults.add(byteAt(0), expected("a header of 12 bytes and one of a chunk of 8 bytes",
                                     "a file of " + std::to_string(size_) + " bytes"));
      if (size_ >= 4) checkMagic(faults);
      return false;
    }
    if (!checkMagic(faults)) return false;
    const std::uint32_t version = wordAt(4), length = wordAt(8);
    if (version != 2) faults.add(byteAt(4), expected("version 2", std::to_string(version)));
    if (length != size_) {
      faults.add(byteAt(8), expected("the file's length of " + std::to_string(size_) + " bytes",
                                     std::to_string(length)));
    }
    json_ = chunkAt(kHeaderBytes, faults);
    if (json_.type != kJsonChunk) {
      faults.add(byteAt(json_.offset + 4),
                 expected("a chunk of type 'JSON'", wordText(json_.type)));
    }
    return true;
  }

  /// The JSON chunk, as far as present.
  [[nodiscard]] std::string_view text() const {
    return bytes_.substr(json_.begin(), std::min(json_.end(), size_) - json_.begin());
  }
  [[nodiscard]] std::uint64_t textBegin() const { return json_.begin(); }

  /// The second chunk, as far as present; nothing if there is none.
  std::optional<Chunk> binary(Faults& faults) const {
    if (json_.end() >= size_) return std::nullopt;
    if (size_ - json_.end() < kChunkHeaderBytes) {
      faults.add(byteAt(json_.end()),
                 expected("the end of the file or the 8 bytes of a chunk's header",
                          std::to_string(size_ - json_.end()) + " bytes"));
      return std::nullopt;
    }
    const Chunk binary = chunkAt(json_.end(), faults);
    if (binary.type != kBinaryChunk) {
      faults.add(byteAt(binary.offset + 4),
                 expected("a chunk of type 'BIN' and a zero byte", wordText(binary.type)));
      return std::nullopt;
    }
    return binary;
  }

 private:
  bool checkMagic(Faults& faults) const {
    const std::uint32_t magic = wordAt(0);
    if (magic == kMagic) return true;
    faults.add(byteAt(0), expected("'glTF', as every GLB file begins", wordText(magic)));
    return false;
  }

  [[nodiscard]] Chunk chunkAt(std::uint64_t offset, Faults& faults) const {
    const Chunk chunk{offset, wordAt(offset), wordAt(offset + 4)};
    if (chunk.end() > size_) {
      faults.add(byteAt(offset),
                 expected("a chunk of at most the " + std::to_string(size_ - chunk.begin()) +
                              " bytes that follow its header",
                          "a length of " + std::to_string(chunk.length)));
    }
    return chunk;
  }

  /// Little-endian. Precondition: the file is long enough.
  [[nodiscard]] std::uint32_t wordAt(std::uint64_t offset) const {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i > 0; --i) {
      word = word << 8 | static_cast<unsigned char>(bytes_[offset + i - 1]);
    }
    return word;
  }

  std::string_view bytes_;
  std::uint64_t size_;
  Chunk json_;
};

/// The part of the parser's text that is free of the file's bytes: "unexpected ','; expected string
/// literal".
std::string reasonIn(std::string_view what) {
  const std::size_t begin = what.find(" - ");
  const std::size_t last = what.find("; last read");
  const std::size_t wanted = what.rfind("; expected ");
  std::string reason = "broken JSON";
  if (begin != std::string_view::npos) {
    reason += ", " + std::string(what.substr(begin + 3, std::min(last, wanted) - begin - 3));
  }
  return wanted == std::string_view::npos ? reason : reason + std::string(what.substr(wanted));
}

/// The text around a byte, in quotes.
std::string near(std::string_view text, std::size_t at) {
  constexpr std::size_t kBefore = 12, kAfter = 12;
  const std::size_t begin = at - std::min(at, kBefore);
  return begin >= text.size() ? "the end" : inQuotes(text.substr(begin, at - begin + kAfter));
}

/// Line and column, both from 1, or the byte in the file for a text that is one line of a GLB.
std::string placeOf(std::string_view text, std::size_t at, std::uint64_t textBegin) {
  if (textBegin > 0) return byteAt(textBegin + at);
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
  return "line " + std::to_string(line) + ", column " + std::to_string(1 + at - lineStart);
}

/// False if it cannot be parsed, which it then adds to the faults.
bool parse(std::string_view text, std::uint64_t textBegin, json& document, Faults& faults) {
  try {
    document = json::parse(text);
    return true;
  } catch (const json::parse_error& error) {
    // It counts the bytes taken, including the offending one.
    const std::size_t at = std::min(error.byte - std::min<std::size_t>(error.byte, 1), text.size());
    faults.add(placeOf(text, at, textBegin), reasonIn(error.what()) + ", near " + near(text, at));
  } catch (const json::exception&) {
    faults.add(textBegin > 0 ? byteAt(textBegin) : "line 1",
               "broken JSON, a number is too large for a double");
  }
  return false;
}

[[noreturn]] void refuseFor(const Faults& faults) {
  refuse(faults.text());
}

std::string bytesIn(const std::string& path) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!unknown) grantMemoryFor(size);
  // A GLB counts its bytes in 32 bits.
  constexpr std::size_t kMostBytes = std::size_t{4} << 30;
  auto bytes = readWholeFile(path, kMostBytes);
  if (!bytes.ok()) refuse(bytes.error().message);
  return std::move(bytes).value();
}

void readDocument(GltfFile& file, std::string_view text, std::uint64_t textBegin, Faults& faults) {
  if (parse(text, textBegin, file.document, faults)) checkRules(file.document, faults);
  if (!faults.text().empty()) refuseFor(faults);
}

}  // namespace

bool isGltf(const std::string& path) {
  const std::string extension = lowerExtensionOf(path);
  return extension == ".gltf" || extension == ".glb" || extension == ".vrm";
}

GltfFile openGltf(const std::string& path) {
  GltfFile file;
  file.path = path;
  file.bytes = bytesIn(path);
  Faults faults;
  // Tools save a GLB under the other name now and then; the first bytes decide.
  const std::string extension = lowerExtensionOf(path);
  const bool isNamedBinary = extension == ".glb" || extension == ".vrm";
  file.isBinary = isNamedBinary || file.bytes.rfind("glTF", 0) == 0;
  if (!file.isBinary) {
    readDocument(file, file.bytes, 0, faults);
    return file;
  }
  Glb glb(file.bytes);
  if (!glb.checkContainer(faults)) refuseFor(faults);
  if (const auto binary = glb.binary(faults)) {
    file.chunkBegin = binary->begin();
    file.chunkBytes = std::min<std::size_t>(binary->end(), file.bytes.size()) - binary->begin();
  }
  readDocument(file, glb.text(), glb.textBegin(), faults);
  return file;
}

}  // namespace foretouch::internal
