#include "assets/import/gltf_skins.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include <nlohmann/json.hpp>

#include "assets/import/text.h"

namespace foretouch::internal {
namespace {

using nlohmann::json;

constexpr std::size_t kGlbHeaderBytes = 12, kGlbChunkHeaderBytes = 8;
constexpr std::size_t kJsonBegin = kGlbHeaderBytes + kGlbChunkHeaderBytes;
/// A parsed text takes about ten times its size.
constexpr std::size_t kMostJsonBytes = std::size_t{512} << 20;

std::size_t countIn(std::string_view text, std::string_view word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + word.size())) {
    ++count;
  }
  return count;
}

/// Every skin has "joints", and nothing else does: parsing all of a large file is saved for those
/// that lack something.
bool mayLackMatrices(std::string_view text) {
  return countIn(text, "\"joints\"") > countIn(text, "\"inverseBindMatrices\"");
}

json& listIn(json& document, const char* name) {
  return document.contains(name) ? document[name] : document[name] = json::array();
}

/// As a data URI.
std::string identitiesAsUri(std::size_t count) {
  // Columns of floats: 1 is 00 00 80 3F.
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < 16; ++k) {
      bytes += k % 5 == 0 ? std::string_view("\0\0\x80\x3F", 4) : std::string_view("\0\0\0\0", 4);
    }
  }
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = "data:application/octet-stream;base64,";
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  bytes.append(padding, '\0');
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | static_cast<unsigned char>(bytes[i + k]);
    }
    for (const int shift : {18, 12, 6, 0}) uri += kDigits[group >> shift & 63];
  }
  uri.replace(uri.size() - padding, padding, padding, '=');
  return uri;
}

/// A buffer, a view and an accessor of so many identities; the accessor's number.
std::size_t addIdentities(json& document, std::size_t count) {
  json& buffers = listIn(document, "buffers");
  json& views = listIn(document, "bufferViews");
  json& accessors = listIn(document, "accessors");
  const std::size_t bytes = 64 * count;
  buffers.push_back({{"byteLength", bytes}, {"uri", identitiesAsUri(count)}});
  views.push_back({{"buffer", buffers.size() - 1}, {"byteLength", bytes}});
  accessors.push_back({{"bufferView", views.size() - 1},
                       {"componentType", 5126},
                       {"count", count},
                       {"type", "MAT4"}});
  return accessors.size() - 1;
}

/// The completed text; nothing if nothing was lacking. Throws json::exception.
std::optional<std::string> completed(std::string_view text) {
  if (!mayLackMatrices(text)) return std::nullopt;
  json document = json::parse(text);
  bool isChanged = false;
  for (std::size_t i = 0; i < document.at("skins").size(); ++i) {
    const json& skin = document["skins"].at(i);
    if (skin.contains("inverseBindMatrices") || skin.at("joints").empty()) continue;
    const std::size_t count = skin.at("joints").size();
    const std::size_t accessor = addIdentities(document, count);
    document["skins"][i]["inverseBindMatrices"] = accessor;
    isChanged = true;
  }
  return isChanged ? std::optional(document.dump()) : std::nullopt;
}

std::uint32_t wordIn(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 4; k > 0; --k) {
    word = word << 8 | static_cast<unsigned char>(bytes[at + k - 1]);
  }
  return word;
}

void appendWord(std::string& bytes, std::size_t word) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(word >> (8 * k) & 0xFF);
}

std::optional<std::string> completedGlb(std::ifstream& file) {
  std::string head(kJsonBegin, '\0');
  if (!file.read(head.data(), kJsonBegin)) return std::nullopt;
  const std::size_t length = wordIn(head, kGlbHeaderBytes);
  if (head.compare(0, 4, "glTF") != 0 || length > kMostJsonBytes) return std::nullopt;
  std::string text(length, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(length))) return std::nullopt;
  auto whole = completed(text);
  if (!whole) return std::nullopt;
  while (whole->size() % 4 != 0) *whole += ' ';
  const std::string rest(std::istreambuf_iterator<char>(file), {});
  const std::size_t total = kJsonBegin + whole->size() + rest.size();
  if (total > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  std::string bytes = head.substr(0, 8);  // magic and version
  appendWord(bytes, total);
  appendWord(bytes, whole->size());
  return bytes + head.substr(kGlbHeaderBytes + 4, 4) + *whole + rest;
}

std::optional<std::string> completedGltf(std::ifstream& file) {
  const std::string text(std::istreambuf_iterator<char>(file), {});
  return text.size() > kMostJsonBytes ? std::nullopt : completed(text);
}

}  // namespace

std::optional<std::string> withBindMatrices(const std::string& path) {
  const std::string extension = lowerExtensionOf(path);
  if (extension != ".gltf" && extension != ".glb") return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  try {
    return extension == ".glb" ? completedGlb(file) : completedGltf(file);
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace foretouch::internal
