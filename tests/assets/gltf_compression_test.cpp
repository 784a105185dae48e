// Compressed glTF that the libraries' own encoders write, against the numbers that they were given.
#include <cmath>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <limits>
#include <meshoptimizer.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "tests/assets/gltf_writer.h"
#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"
#include "tests/support/random_geometry.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

std::vector<std::array<float, 3>> randomCorners(std::uint64_t seed, int triangles) {
  Random random(seed);
  std::vector<std::array<float, 3>> corners;
  for (int i = 0; i < 3 * triangles; ++i) {
    const Vector3d p = random.inBox(2);
    corners.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  return corners;
}

/// The triangles as Draco writes them, positions in `bits`; 0: as they are.
std::string dracoOf(const std::vector<std::array<float, 3>>& corners, int bits,
                    std::uint32_t& position) {
  draco::TriangleSoupMeshBuilder builder;
  const auto triangles = static_cast<int>(corners.size() / 3);
  builder.Start(triangles);
  const int attribute =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (int i = 0; i < triangles; ++i) {
    const auto at = static_cast<std::size_t>(3 * i);
    builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(static_cast<std::uint32_t>(i)),
                                      corners[at].data(), corners[at + 1].data(),
                                      corners[at + 2].data());
  }
  const auto mesh = builder.Finalize();
  position = mesh->attribute(attribute)->unique_id();
  draco::Encoder encoder;
  if (bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

GltfWriter gltfOf(const std::string& bytes, std::uint32_t position, std::size_t corners) {
  GltfWriter writer;
  const std::size_t view = writer.view(bytes);
  // Their elements are in the compressed data alone.
  writer.root["accessors"] = {{{"componentType", 5126}, {"count", corners}, {"type", "VEC3"}},
                              {{"componentType", 5125}, {"count", corners}, {"type", "SCALAR"}}};
  writer.meshNode({{"attributes", {{"POSITION", 0}}},
                   {"indices", 1},
                   {"extensions",
                    {{"KHR_draco_mesh_compression",
                      {{"bufferView", view}, {"attributes", {{"POSITION", position}}}}}}}});
  writer.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return writer;
}

class CompressedGltf : public testing::Test {
 protected:
  TempFolder folder_;
};

/// The farthest that a triangle is from the nearest of the others: Draco orders them anew.
double farthest(const ImportedScene& scene, const std::vector<std::array<float, 3>>& corners) {
  double worst = 0.0;
  for (const Triangle& triangle : scene.scene.triangles) {
    double best = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      for (std::size_t turn = 0; turn < 3; ++turn) {
        double off = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& c = corners[i + (k + turn) % 3];
          off = std::max(off, (triangle.vertices[k] - Vector3d(c[0], c[1], c[2])).norm());
        }
        best = std::min(best, off);
      }
    }
    worst = std::max(worst, best);
  }
  return worst;
}

TEST_F(CompressedGltf, OfDracoHasTheTrianglesThatWereCompressed) {
  for (const int bits : {0, 11, 16}) {
    const auto corners = randomCorners(static_cast<std::uint64_t>(bits), 40);
    std::uint32_t position = 0;
    const std::string bytes = dracoOf(corners, bits, position);
    const GltfWriter writer = gltfOf(bytes, position, corners.size());
    const auto scene = importScene(folder_.write("d.glb", writer.glb()), withImporter());
    ASSERT_TRUE(scene.ok()) << describe(scene.error());
    ASSERT_EQ(scene.value().scene.triangles.size(), 40U);
    // A box of 4 m, in steps of its share; half a step along each axis.
    const double step = bits == 0 ? 0.0 : 4.0 / (std::pow(2.0, bits) - 1);
    EXPECT_LE(farthest(scene.value(), corners), step * std::sqrt(0.75) * 1.01 + 1e-6) << bits;
  }
}

TEST_F(CompressedGltf, ThatIsDamagedIsRefusedAtItsPlace) {
  const auto corners = randomCorners(7, 40);
  std::uint32_t position = 0;
  const std::string bytes = dracoOf(corners, 11, position);
  int refused = 0;
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const GltfWriter writer = gltfOf(bytes.substr(0, size), position, corners.size());
    const auto scene = importScene(folder_.write("d.glb", writer.glb()), withImporter());
    if (scene.ok()) continue;
    EXPECT_EQ(scene.error().code, ErrorCode::ImportFailed);
    EXPECT_NE(scene.error().message.find(
                  "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: expected"),
              std::string::npos)
        << scene.error().message;
    ++refused;
  }
  EXPECT_GT(refused, 5);
  const GltfWriter other = gltfOf(bytes, position + 9, corners.size());
  const auto scene = importScene(folder_.write("d.glb", other.glb()), withImporter());
  ASSERT_FALSE(scene.ok());
  EXPECT_NE(scene.error().message.find("expected the number of an attribute of 3 components"),
            std::string::npos);
}

// A GLB whose second buffer is nowhere: what is not compressed need not be there.
TEST_F(CompressedGltf, OfMeshoptimizerNeedsNoFallback) {
  std::vector<float> numbers;
  for (const auto& corner : randomCorners(3, 50)) {
    numbers.insert(numbers.end(), corner.begin(), corner.end());
  }
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 150; ++i) indices.push_back(i);
  std::string vertexBytes(meshopt_encodeVertexBufferBound(150, 12), '\0');
  vertexBytes.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(vertexBytes.data()),
                                 vertexBytes.size(), numbers.data(), 150, 12));
  std::string indexBytes(meshopt_encodeIndexBufferBound(150, 150), '\0');
  indexBytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(indexBytes.data()),
                                              indexBytes.size(), indices.data(), 150));
  GltfWriter writer;
  json& views = writer.root["bufferViews"];
  const auto compress = [&](const std::string& bytes, std::size_t stride, const char* mode) {
    const std::size_t held = writer.view(bytes);
    json compression{{"buffer", 0},
                     {"byteOffset", views[held]["byteOffset"]},
                     {"byteLength", bytes.size()},
                     {"byteStride", stride},
                     {"count", 150},
                     {"mode", mode}};
    views.push_back({{"buffer", 1},
                     {"byteLength", 150 * stride},
                     {"extensions", {{"EXT_meshopt_compression", compression}}}});
    return views.size() - 1;
  };
  const std::size_t vertexView = compress(vertexBytes, 12, "ATTRIBUTES");
  const std::size_t indexView = compress(indexBytes, 4, "TRIANGLES");
  writer.root["accessors"] = {
      {{"bufferView", vertexView}, {"componentType", 5126}, {"count", 150}, {"type", "VEC3"}},
      {{"bufferView", indexView}, {"componentType", 5125}, {"count", 150}, {"type", "SCALAR"}}};
  writer.meshNode({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  writer.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  writer.moreBuffers = {
      {{"byteLength", 2400}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  const auto scene = importScene(folder_.write("m.glb", writer.glb()), withImporter());
  ASSERT_TRUE(scene.ok()) << describe(scene.error());
  ASSERT_EQ(scene.value().scene.triangles.size(), 50U);
  for (std::size_t i = 0; i < 450; ++i) {
    EXPECT_EQ(
        scene.value().scene.triangles[i / 9].vertices[i / 3 % 3][static_cast<Eigen::Index>(i % 3)],
        static_cast<double>(numbers[i]));
  }
}

}  // namespace
}  // namespace foretouch::test
