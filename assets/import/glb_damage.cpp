#include "assets/import/glb_damage.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "assets/import/faults.h"
#include "assets/import/gltf_extents.h"
#include "assets/import/gltf_rules.h"
#include "assets/import/gltf_uses.h"
#include "articulated/quoted.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

using nlohmann::json;

/// A parsed text takes about ten times its size: does not examine larger ones.
constexpr std::uint64_t kMaxJsonBytes = 64U << 20;

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
  std::uint64_t offset = 0;  ///< Of the header.
  std::uint32_t length = 0, type = 0;
  [[nodiscard]] std::uint64_t begin() const { return offset + kChunkHeaderBytes; }
  [[nodiscard]] std::uint64_t end() const { return begin() + length; }
};

/// The container: its header, its chunk of JSON and its chunk of bytes.
class Glb {
 public:
  explicit Glb(const std::string& path) : file_(path, std::ios::binary) {
    size_ = std::filesystem::file_size(path);
  }

  [[nodiscard]] bool isWithoutItsJson() {
    return size_ >= kHeaderBytes + kChunkHeaderBytes && wordAt(0) == kMagic && wordAt(4) == 2 &&
           Chunk{kHeaderBytes, wordAt(kHeaderBytes), 0}.end() > size_;
  }

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

  /// The JSON chunk, as far as present; nothing if it is too large.
  std::optional<std::string> text() {
    const std::uint64_t count = std::min(json_.end(), size_) - json_.begin();
    if (count > kMaxJsonBytes) return std::nullopt;
    std::string bytes(count, '\0');
    file_.seekg(static_cast<std::streamoff>(json_.begin()));
    file_.read(bytes.data(), static_cast<std::streamsize>(count));
    return bytes;
  }

  [[nodiscard]] std::uint64_t textBegin() const { return json_.begin(); }

  /// The bytes of the second chunk; nothing if there is none.
  std::optional<std::uint64_t> binaryBytes(Faults& faults) {
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
    return std::min(binary.end(), size_) - binary.begin();
  }

 private:
  bool checkMagic(Faults& faults) {
    const std::uint32_t magic = wordAt(0);
    if (magic == kMagic) return true;
    faults.add(byteAt(0), expected("'glTF', as every GLB file begins", wordText(magic)));
    return false;
  }

  Chunk chunkAt(std::uint64_t offset, Faults& faults) {
    const Chunk chunk{offset, wordAt(offset), wordAt(offset + 4)};
    if (chunk.end() > size_) {
      faults.add(byteAt(offset),
                 expected("a chunk of at most the " + std::to_string(size_ - chunk.begin()) +
                              " bytes that follow its header",
                          "a length of " + std::to_string(chunk.length)));
    }
    return chunk;
  }

  /// Little-endian; 0 if the file is too short.
  std::uint32_t wordAt(std::uint64_t offset) {
    std::array<unsigned char, 4> bytes{};
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
           std::uint32_t{bytes[3]} << 24;
  }

  std::ifstream file_;
  std::uint64_t size_ = 0;
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

/// Nothing if it cannot be parsed, which it then adds to the faults.
std::optional<json> parsed(const std::string& text, std::uint64_t textBegin, Faults& faults) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    // It counts the bytes taken, including the offending one.
    const std::size_t at = std::min(error.byte - std::min<std::size_t>(error.byte, 1), text.size());
    faults.add(placeOf(text, at, textBegin), reasonIn(error.what()) + ", near " + near(text, at));
  } catch (const json::exception& error) {
    faults.add(textBegin > 0 ? byteAt(textBegin) : "line 1",
               "broken JSON, a number is too large for a double");
  }
  return std::nullopt;
}

void checkDocument(const json& document, const GltfSources& sources, Faults& faults) {
  checkRules(document, faults);
  // The rest makes sense only if indices and counts do.
  if (!faults.text().empty()) return;
  checkExtents(document, sources, faults);
  checkUses(document, faults);
}

std::string folderOf(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

}  // namespace

std::string damageOfGlb(const std::string& path) {
  Faults faults;
  Glb glb(path);
  if (!glb.checkContainer(faults)) return faults.text();
  const auto text = glb.text();
  if (!text) return faults.text();
  GltfSources sources{true, glb.binaryBytes(faults), folderOf(path)};
  const auto document = parsed(*text, glb.textBegin(), faults);
  if (document) checkDocument(*document, sources, faults);
  return faults.text();
}

std::string damageOfGltf(const std::string& path) {
  Faults faults;
  const auto text = readWholeFile(path, kMaxJsonBytes);
  if (!text.ok()) return "";
  const auto document = parsed(text.value(), 0, faults);
  if (document) checkDocument(*document, {false, std::nullopt, folderOf(path)}, faults);
  return faults.text();
}

bool isGlbWithoutItsJson(const std::string& path) {
  return Glb(path).isWithoutItsJson();
}

}  // namespace foretouch::internal
