#include "assets/import/gltf_compression.h"

#include <draco/compression/decode.h>
#include <limits>
#include <meshoptimizer.h>
#include <utility>

#include "articulated/quoted.h"
#include "assets/import/failure.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// The library asserts what the extension demands of strides.
void checkStride(const MeshoptView& view, const std::string& place) {
  const std::uint64_t stride = view.stride;
  const bool isOfAttributes = view.mode == "ATTRIBUTES";
  const bool isOfIndices = view.mode == "TRIANGLES" || view.mode == "INDICES";
  if (!isOfAttributes && !isOfIndices) {
    refuseAt(place + ".mode",
             "expected one of ATTRIBUTES, TRIANGLES, INDICES, found " + inQuotes(view.mode));
  }
  if (isOfAttributes && (stride == 0 || stride > 256 || stride % 4 != 0)) {
    refuseAt(place + ".byteStride",
             "expected a multiple of 4 up to 256, found " + std::to_string(stride));
  }
  if (isOfIndices && stride != 2 && stride != 4) {
    refuseAt(place + ".byteStride", "expected 2 or 4, found " + std::to_string(stride));
  }
  if (view.mode == "TRIANGLES" && view.count % 3 != 0) {
    refuseAt(place + ".count", "expected a multiple of 3, found " + std::to_string(view.count));
  }
}

void applyFilter(const MeshoptView& view, std::string& bytes, const std::string& place) {
  const std::string& filter = view.filter;
  if (filter == "NONE") return;
  const bool isRight = (filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                       (filter == "QUATERNION" && view.stride == 8) || filter == "EXPONENTIAL";
  if (!isRight || view.mode != "ATTRIBUTES") {
    refuseAt(place + ".filter",
             "expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL as the mode and the stride of " +
                 std::to_string(view.stride) + " bytes allow, found " + inQuotes(filter));
  }
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), view.count, view.stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), view.count, view.stride);
}

}  // namespace

std::string decompress(const MeshoptView& view, const std::string& place) {
  checkStride(view, place);
  if (view.count > std::numeric_limits<std::uint32_t>::max()) {
    refuseAt(place + ".count", "expected a count below 2^32, found " + std::to_string(view.count));
  }
  std::string bytes(view.count * view.stride, '\0');
  const auto* const data = reinterpret_cast<const unsigned char*>(view.bytes.data());
  using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
  Decode decode = meshopt_decodeVertexBuffer;
  if (view.mode == "TRIANGLES") decode = meshopt_decodeIndexBuffer;
  if (view.mode == "INDICES") decode = meshopt_decodeIndexSequence;
  if (decode(bytes.data(), view.count, view.stride, data, view.bytes.size()) != 0) {
    refuseAt(place, "expected " + std::to_string(view.count) + " elements of " +
                        std::to_string(view.stride) + " bytes as meshoptimizer compresses " +
                        view.mode + ", found other data");
  }
  applyFilter(view, bytes, place);
  return bytes;
}

DracoMesh::DracoMesh(std::string_view bytes, std::string place) : place_(std::move(place)) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    refuseAt(place_, "expected a mesh as Draco compresses it, found " +
                         inQuotes(decoded.status().error_msg_string()));
  }
  mesh_ = std::move(decoded).value();
}

DracoMesh::~DracoMesh() = default;

std::vector<double> DracoMesh::indices() const {
  std::vector<double> indices;
  for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh_->face(f)) indices.push_back(corner.value());
  }
  return indices;
}

std::vector<double> DracoMesh::numbers(std::uint64_t attribute, const ElementLayout& layout) const {
  const bool isNumber = attribute <= std::numeric_limits<std::uint32_t>::max();
  const draco::PointAttribute* const found =
      isNumber ? mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(attribute)) : nullptr;
  if (found == nullptr || countOf(found->num_components()) != layout.width()) {
    refuseAt(place_ + ".attributes", "expected the number of an attribute of " +
                                         std::to_string(layout.width()) + " components, found " +
                                         std::to_string(attribute));
  }
  const bool isFloat = found->data_type() == draco::DT_FLOAT32;
  std::vector<double> numbers;
  std::vector<double> element(layout.width());
  for (draco::PointIndex i(0); i < mesh_->num_points(); ++i) {
    const auto value = found->mapped_index(i);
    const bool isThere = value.value() < found->size() &&
                         found->ConvertValue<double>(
                             value, static_cast<std::int8_t>(element.size()), element.data());
    if (!isThere) refuseAt(place_, "expected a value for every vertex, found none");
    for (const double number : element) {
      const bool isRaw = layout.isNormalized && !found->normalized() && !isFloat;
      numbers.push_back(isRaw ? normalisedNumber(number, layout.componentType) : number);
    }
  }
  return numbers;
}

}  // namespace foretouch::internal
