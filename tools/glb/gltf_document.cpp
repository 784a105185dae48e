#include "tools/glb/gltf_document.h"

#include <cstring>
#include <utility>

#include "lss/assert.h"
#include "tools/little_endian.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::uint32_t kHeadBytes = 12, kChunkHeadBytes = 8;
constexpr std::size_t kAlignment = 4;
constexpr std::size_t kMostBytes = 0xFFFF'FFFF;

}  // namespace

GltfDocument::GltfDocument(const std::string& generator)
    : root_{{"asset", {{"version", "2.0"}, {"generator", generator}}},
            {"scene", 0},
            {"scenes", json::array({{{"nodes", json::array()}}})}} {}

std::size_t GltfDocument::addView(std::size_t byteLength, ViewTarget target,
                                  std::size_t byteStride) {
  FORETOUCH_ASSERT(byteLength > 0 && byteLength % kAlignment == 0);
  json view = {{"buffer", 0}, {"byteOffset", binaryBytes_}, {"byteLength", byteLength}};
  if (byteStride > 0) view["byteStride"] = byteStride;
  if (target != ViewTarget::None) view["target"] = static_cast<int>(target);
  binaryBytes_ += byteLength;
  return add("bufferViews", std::move(view));
}

std::size_t GltfDocument::addAccessor(const Accessor& accessor) {
  json entry = {{"bufferView", accessor.view},
                {"componentType", static_cast<int>(accessor.componentType)},
                {"count", accessor.count},
                {"type", accessor.type}};
  if (accessor.byteOffset > 0) entry["byteOffset"] = accessor.byteOffset;
  if (!accessor.low.is_null()) entry["min"] = accessor.low;
  if (!accessor.high.is_null()) entry["max"] = accessor.high;
  return add("accessors", std::move(entry));
}

std::size_t GltfDocument::add(const char* list, json entry) {
  json& entries = root_[list];
  entries.push_back(std::move(entry));
  return entries.size() - 1;
}

void GltfDocument::extend(const char* extension, json content) {
  add("extensionsUsed", extension);
  if (!content.is_null()) root_["extensions"][extension] = std::move(content);
}

Result<std::string> GltfDocument::glbHead() const {
  json root = root_;
  if (binaryBytes_ > 0) root["buffers"] = json::array({{{"byteLength", binaryBytes_}}});
  std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
  text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  const std::size_t chunks = binaryBytes_ > 0 ? 2 : 1;  // an empty one should be left out
  const std::size_t total = kHeadBytes + chunks * kChunkHeadBytes + text.size() + binaryBytes_;
  if (total > kMostBytes) {
    return Error::of(ErrorCode::LimitExceeded,
                     "a GLB file holds at most 4 GiB, and this one would take " +
                         std::to_string(total) + " bytes");
  }
  std::string head;
  for (const std::size_t word : {std::size_t{kGlbMagic}, std::size_t{kGlbVersion}, total,
                                 text.size(), std::size_t{kJsonChunk}}) {
    appendBytes(head, static_cast<std::uint32_t>(word));
  }
  head += text;
  if (binaryBytes_ == 0) return head;
  appendBytes(head, static_cast<std::uint32_t>(binaryBytes_));
  appendBytes(head, kBinaryChunk);
  return head;
}

json gltfVector(const Eigen::Vector3d& v) {
  return json::array({v.x(), v.y(), v.z()});
}

void appendFloat(std::string& bytes, double value) {
  appendBytes(bytes, static_cast<float>(value));
}

void appendIndex(std::string& bytes, std::uint32_t index) {
  appendBytes(bytes, index);
}

}  // namespace foretouch::tools
