// importScene() and importModel() of glTF files that the test writes: every way to store a number,
// every way to make triangles of vertices, and what extensions change.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
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

constexpr Stored kAllTypes[] = {Stored::Byte,   Stored::UByte, Stored::Short,
                                Stored::UShort, Stored::UInt,  Stored::Float};

/// Of triangles that nothing is left to chance in: a corner at the origin, two away from it.
const std::vector<double> kThree{0, 0, 0, 1, 0, 0, 0, 1, 0};

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

class GltfImport : public testing::Test {
 protected:
  ImportedScene sceneOf(const GltfWriter& writer, const std::string& name = "a.gltf") {
    auto scene = importScene(folder_.write(name, writer.gltf()), withImporter());
    EXPECT_TRUE(scene.ok()) << describe(scene.error());
    return scene.ok() ? std::move(scene).value() : ImportedScene{};
  }
  Model modelOf(const GltfWriter& writer) {
    auto model = importModel(folder_.write("a.gltf", writer.gltf()), withModelImporter());
    EXPECT_TRUE(model.ok()) << describe(model.error());
    return model.ok() ? std::move(model).value() : Model{};
  }
  std::string refusalOf(const GltfWriter& writer) {
    const auto scene = importScene(folder_.write("a.gltf", writer.gltf()), withImporter());
    EXPECT_FALSE(scene.ok());
    return scene.ok() ? "" : scene.error().message;
  }
  /// The corners of all triangles, one after the other.
  static std::vector<Vector3d> cornersIn(const ImportedScene& scene) {
    std::vector<Vector3d> corners;
    for (const Triangle& triangle : scene.scene.triangles) {
      corners.insert(corners.end(), triangle.vertices.begin(), triangle.vertices.end());
    }
    return corners;
  }

  TempFolder folder_;
};

TEST_F(GltfImport, ReadsEveryComponentTypeHoweverItLies) {
  Random random(1);
  int cases = 0;
  for (const Stored type : kAllTypes) {
    for (const bool isNormalised : {false, true}) {
      // The format normalises integers of up to 16 bits alone.
      if (isNormalised && (type == Stored::UInt || type == Stored::Float)) continue;
      const bool isSigned = type == Stored::Byte || type == Stored::Short || type == Stored::Float;
      std::vector<double> numbers;
      for (int i = 0; i < 18; ++i) {
        const double share = random.uniform(isSigned ? -1 : 0, 1);
        numbers.push_back(isNormalised ? share : share * 100);
      }
      // The integer below the one for -1 is -1, too.
      if (isNormalised && isSigned)
        numbers[4] = type == Stored::Byte ? -128 / 127. : -32768 / 32767.;
      for (const AccessorWay way :
           {AccessorWay{type, isNormalised, 0, 0}, AccessorWay{type, isNormalised, 20, 0},
            AccessorWay{type, isNormalised, 32, 8}}) {
        GltfWriter writer;
        const std::size_t position = writer.accessor(numbers, 3, way);
        writer.meshNode({{"attributes", {{"POSITION", position}}}});
        const auto corners = cornersIn(sceneOf(writer));
        ASSERT_EQ(corners.size(), 6U);
        for (std::size_t i = 0; i < 18; ++i) {
          EXPECT_NEAR(corners[i / 3][static_cast<Eigen::Index>(i % 3)],
                      storedAs(numbers[i], type, isNormalised), 1e-15)
              << static_cast<int>(type) << (isNormalised ? " normalised " : " ") << way.stride;
        }
        ++cases;
      }
    }
  }
  EXPECT_EQ(cases, 30);
}

TEST_F(GltfImport, ReadsInterleavedVertices) {
  // Three attributes in one view: positions are shorts, between floats and bytes.
  GltfWriter writer;
  std::string bytes;
  const std::int16_t positions[4][3] = {{0, 0, 0}, {7, 0, 0}, {7, -5, 0}, {0, -5, 3}};
  for (const auto& p : positions) {
    bytes += std::string(8, '\x33');
    bytes.append(reinterpret_cast<const char*>(p), 6);
    bytes += std::string(6, '\x44');
  }
  const std::size_t view = writer.view(bytes, 20);
  writer.root["accessors"].push_back({{"bufferView", view},
                                      {"byteOffset", 8},
                                      {"componentType", 5122},
                                      {"count", 4},
                                      {"type", "VEC3"}});
  const std::size_t indices = writer.accessor({0, 1, 2, 0, 2, 3}, 1, {Stored::UByte});
  writer.meshNode({{"attributes", {{"POSITION", 0}}}, {"indices", indices}});
  const auto corners = cornersIn(sceneOf(writer));
  ASSERT_EQ(corners.size(), 6U);
  EXPECT_EQ(corners[2], Vector3d(7, -5, 0));
  EXPECT_EQ(corners[5], Vector3d(0, -5, 3));
}

TEST_F(GltfImport, ReadsIndicesOfEveryWidth) {
  std::vector<double> vertices;
  for (int i = 0; i < 300; ++i) vertices.insert(vertices.end(), {1.0 * i, 0, 0});
  for (const Stored type : {Stored::UByte, Stored::UShort, Stored::UInt}) {
    GltfWriter writer;
    const double last = type == Stored::UByte ? 254 : 299;
    const std::size_t position = writer.accessor(vertices, 3);
    const std::size_t indices = writer.accessor({3, 250, last}, 1, {type});
    writer.meshNode({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
    const auto corners = cornersIn(sceneOf(writer));
    ASSERT_EQ(corners.size(), 3U);
    EXPECT_EQ(corners[1].x(), 250);
    EXPECT_EQ(corners[2].x(), last);
  }
}

/// The triangles, each as the numbers of its vertices, turned so that the smallest comes first:
/// which corner a triangle begins with says nothing.
std::vector<std::array<int, 3>> numbered(const ImportedScene& scene) {
  std::vector<std::array<int, 3>> triangles;
  for (const Triangle& triangle : scene.scene.triangles) {
    std::array<int, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = static_cast<int>(triangle.vertices[k].x());
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  return triangles;
}

TEST_F(GltfImport, MakesTrianglesOfListsStripsAndFans) {
  using Triangles = std::vector<std::array<int, 3>>;
  std::vector<double> vertices;
  for (int i = 0; i < 6; ++i) vertices.insert(vertices.end(), {1.0 * i, 0, 0});
  const auto trianglesOf = [&](int mode, const std::vector<double>& corners) {
    GltfWriter writer;
    json primitive{{"attributes", {{"POSITION", writer.accessor(vertices, 3)}}}, {"mode", mode}};
    if (!corners.empty()) {
      primitive["indices"] = writer.accessor(corners, 1, {Stored::UShort});
    }
    writer.meshNode(primitive);
    return numbered(sceneOf(writer));
  };
  EXPECT_EQ(trianglesOf(4, {}), (Triangles{{0, 1, 2}, {3, 4, 5}}));
  // Every other triangle of a strip is turned, so that all show the same side.
  EXPECT_EQ(trianglesOf(5, {}), (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}));
  EXPECT_EQ(trianglesOf(5, {5, 1, 0, 4}), (Triangles{{0, 5, 1}, {0, 1, 4}}));
  EXPECT_EQ(trianglesOf(6, {}), (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
  EXPECT_EQ(trianglesOf(6, {2, 4, 5, 3}), (Triangles{{2, 4, 5}, {2, 5, 3}}));
}

TEST_F(GltfImport, ReadsSparseAccessors) {
  for (const Stored type : {Stored::UByte, Stored::UShort, Stored::UInt}) {
    GltfWriter writer;
    const auto base = static_cast<int>(writer.accessor(kThree, 3));
    const std::size_t changed = writer.sparse(base, 3, 3, {0, 2}, {9, 8, 7, 6, 5, 4}, type);
    const std::size_t alone = writer.sparse(-1, 3, 3, {1}, {0.5, 0.25, 2}, type);
    writer.meshNode({{"attributes", {{"POSITION", changed}}}});
    writer.meshNode({{"attributes", {{"POSITION", alone}}}});
    const auto corners = cornersIn(sceneOf(writer));
    const std::vector<Vector3d> expected{{9, 8, 7}, {1, 0, 0},      {6, 5, 4},
                                         {0, 0, 0}, {0.5, 0.25, 2}, {0, 0, 0}};
    EXPECT_EQ(corners, expected);
  }
  GltfWriter writer;
  const auto base = static_cast<int>(writer.accessor(kThree, 3));
  writer.meshNode({{"attributes", {{"POSITION", writer.sparse(base, 3, 3, {3}, {9, 8, 7})}}}});
  EXPECT_NE(refusalOf(writer).find("accessors[1].sparse.indices: expected the numbers of the 3 "
                                   "elements, found 3"),
            std::string::npos);
}

TEST_F(GltfImport, MakesNoMoreZerosThanItHasRoomFor) {
  GltfWriter writer;
  constexpr std::size_t kEndless = std::size_t{1} << 58;
  writer.meshNode({{"attributes", {{"POSITION", writer.sparse(-1, kEndless, 3, {1}, {0, 0, 1})}}}});
  EXPECT_NE(refusalOf(writer).find("accessors[0].count: expected at most 44739242 elements"),
            std::string::npos)
      << refusalOf(writer);
}

TEST_F(GltfImport, CountsFacesOfVerticesThatAreNotThere) {
  GltfWriter writer;
  const std::size_t position = writer.accessor(kThree, 3);
  const std::size_t indices =
      writer.accessor({0, 1, 2, 0, 1, 3, 2, 1, 0, 65535, 0, 1, 0}, 1, {Stored::UShort});
  writer.meshNode({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  const ImportedScene scene = sceneOf(writer);
  EXPECT_EQ(scene.scene.triangles.size(), 2U);
  EXPECT_EQ(scene.report.skippedFaces, 2U);
  EXPECT_TRUE(
      mentions(scene.report.notes, "2 faces with vertex indices out of range are left out"));
  EXPECT_TRUE(mentions(scene.report.notes, "13 corners, no multiple of 3"));
  EXPECT_TRUE(
      mentions(modelOf(writer).notes, "2 faces with vertex indices out of range are left out"));
}

TEST_F(GltfImport, StandsWithItsDefaultMorphWeights) {
  GltfWriter writer;
  const std::size_t position = writer.accessor(kThree, 3);
  const std::size_t up = writer.accessor({0, 5, 0, 0, 5, 0, 0, 5, 0}, 3);
  const std::size_t corner = writer.sparse(-1, 3, 3, {1}, {0, 0, 1});
  const std::size_t small = writer.accessor({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3, {Stored::Byte, true});
  const json primitive{
      {"attributes", {{"POSITION", position}}},
      {"targets", {{{"POSITION", up}}, {{"POSITION", corner}}, {{"POSITION", small}}}}};
  writer.meshNode(primitive, "by mesh");
  writer.meshNode(primitive, "by node")["weights"] = {0, 2, 0.5};
  writer.root["meshes"][0]["weights"] = {0.5, -1, 0};
  writer.root["meshes"][1]["weights"] = {1, 1, 1};
  writer.meshNode(primitive, "by none");
  const ImportedScene scene = sceneOf(writer);
  const std::vector<Vector3d> expected{{0, 2.5, 0}, {1, 2.5, -1}, {0, 3.5, 0},
                                       {0, 0, 0.5}, {1, 0, 2.5},  {0, 1, 0.5},
                                       {0, 0, 0},   {1, 0, 0},    {0, 1, 0}};
  EXPECT_EQ(cornersIn(scene), expected);
  EXPECT_TRUE(mentions(scene.report.notes, "morph targets stand at their default weights"));
  EXPECT_EQ(modelOf(writer).meshes.at(1).vertices.at(1), Vector3d(1, 0, 2.5));
}

TEST_F(GltfImport, PlacesEveryInstance) {
  GltfWriter writer;
  const std::size_t position = writer.accessor(kThree, 3);
  const std::size_t translation = writer.accessor({0, 0, 0, 10, 0, 0, 0, 0, 20}, 3);
  // A quarter about z, as normalised shorts: (x, y, z) becomes (-y, x, z).
  const double half = std::sqrt(0.5);
  const std::size_t rotation =
      writer.accessor({0, 0, 0, 1, 0, 0, half, half, 0, 0, 0, 1}, 4, {Stored::Short, true});
  const std::size_t scale = writer.accessor({1, 1, 1, 2, 2, 2, 1, -3, 1}, 3);
  json& node = writer.meshNode({{"attributes", {{"POSITION", position}}}});
  node["translation"] = {0, 100, 0};
  node["extensions"] = {{"EXT_mesh_gpu_instancing",
                         {{"attributes",
                           {{"TRANSLATION", translation},
                            {"ROTATION", rotation},
                            {"SCALE", scale},
                            {"_ID", position}}}}}};
  writer.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const ImportedScene scene = sceneOf(writer);
  EXPECT_EQ(scene.report.meshInstances, 3U);
  const std::vector<Vector3d> expected{{0, 100, 0},  {1, 100, 0},  {0, 101, 0},
                                       {10, 100, 0}, {10, 102, 0}, {8, 100, 0},
                                       {0, 100, 20}, {1, 100, 20}, {0, 97, 20}};
  const auto corners = cornersIn(scene);
  ASSERT_EQ(corners.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((corners[i] - expected[i]).norm(), 1e-4) << i;
  }
  const Model model = modelOf(writer);
  ASSERT_EQ(model.meshes.size(), 3U);
  EXPECT_LT((model.meshes[1].vertices[1] - Vector3d(10, 2, 0)).norm(), 1e-4);
}

TEST_F(GltfImport, NamesARequiredExtensionThatItDoesNotKnow) {
  GltfWriter writer;
  writer.meshNode({{"attributes", {{"POSITION", writer.accessor(kThree, 3)}}}});
  writer.root["extensionsUsed"] = {"KHR_materials_unlit", "KHR_texture_transform", "VENDOR_shape"};
  const ImportedScene scene = sceneOf(writer);
  ASSERT_EQ(scene.report.notes.size(), 1U);
  EXPECT_EQ(scene.report.notes[0],
            "the extension 'VENDOR_shape' is not understood and passed over");
  writer.root["extensionsRequired"] = {"KHR_materials_unlit", "VENDOR_shape"};
  EXPECT_NE(refusalOf(writer).find("extensionsRequired: the file cannot be read without the "
                                   "extension 'VENDOR_shape'"),
            std::string::npos);
}

TEST_F(GltfImport, SaysHowManyNotesItDoesNotSay) {
  GltfWriter writer;
  writer.meshNode({{"attributes", {{"POSITION", writer.accessor(kThree, 3)}}}});
  for (int i = 0; i < 100; ++i) {
    writer.root["extensionsUsed"].push_back("VENDOR_" + std::to_string(i));
  }
  const auto notes = sceneOf(writer).report.notes;
  ASSERT_EQ(notes.size(), 64U);
  EXPECT_TRUE(mentions({notes[62]}, "'VENDOR_62'"));
  EXPECT_EQ(notes[63], "37 more notes");
}

TEST_F(GltfImport, ReadsSkinsWithQuantisedWeights) {
  for (const Stored type : {Stored::UByte, Stored::UShort, Stored::Float}) {
    const bool isNormalised = type != Stored::Float;
    GltfWriter writer;
    const std::size_t position = writer.accessor(kThree, 3);
    const std::size_t joints = writer.accessor({0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4,
                                               {type == Stored::UByte ? type : Stored::UShort});
    const std::size_t weights =
        writer.accessor({0.25, 0.75, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, 4, {type, isNormalised});
    writer.meshNode(
        {{"attributes", {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}},
        "skin")["skin"] = 0;
    writer.node({{"name", "hip"}, {"children", {2}}});
    writer.node({{"name", "knee"}, {"translation", {0, 1, 0}}}, false);
    writer.root["skins"] = {{{"joints", {1, 2}}}};
    const Model model = modelOf(writer);
    ASSERT_EQ(model.meshes.size(), 1U);
    ASSERT_EQ(model.meshes[0].bones.size(), 2U);
    const ModelBone& knee = model.meshes[0].bones[1];
    EXPECT_EQ(model.nodes[static_cast<std::size_t>(knee.node)].name, "knee");
    std::vector<double> of(3, 0.0);
    for (const auto& weight : knee.weights) {
      of[static_cast<std::size_t>(weight.vertex)] += weight.weight;
    }
    EXPECT_NEAR(of[0], storedAs(0.75, type, isNormalised), 1e-12);
    EXPECT_NEAR(of[1], 1.0, 1e-12);
    EXPECT_NEAR(of[2], storedAs(0.5, type, isNormalised), 1e-12);
  }
}

TEST_F(GltfImport, ReadsWhatIsUnderTheOtherExtension) {
  GltfWriter writer;
  writer.meshNode({{"attributes", {{"POSITION", writer.accessor(kThree, 3)}}}});
  for (const char* name : {"a.glb", "a.gltf"}) {
    const auto scene = importScene(folder_.write(name, writer.glb()), withImporter());
    ASSERT_TRUE(scene.ok()) << describe(scene.error());
    EXPECT_EQ(scene.value().scene.triangles.size(), 1U);
  }
}

}  // namespace
}  // namespace foretouch::test
