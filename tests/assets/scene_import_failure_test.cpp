// importScene() on bad files and bad options: each an Error that names the file, and nothing left.
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "assets/import/process.h"
#include "assets/import/scene_import.h"
#include "tests/assets/import_files.h"

namespace foretouch::test {
namespace {

class ImportSceneFailure : public testing::Test {
 protected:
  void SetUp() override { descriptors_ = openDescriptors(); }
  void TearDown() override {
    EXPECT_EQ(openDescriptors(), descriptors_);
    EXPECT_FALSE(hasChildren());
  }

  Error failureOf(const std::string& path, const SceneImportOptions& options = withImporter()) {
    const auto result = importScene(path, options);
    if (result.ok()) {
      ADD_FAILURE() << path << " was imported";
      return {};
    }
    EXPECT_EQ(result.error().file, path);
    EXPECT_FALSE(result.error().message.empty());
    for (const char c : result.error().message) {
      EXPECT_GE(static_cast<unsigned char>(c), 0x20) << result.error().message;
    }
    EXPECT_LT(result.error().message.size(), 2000U);
    return result.error();
  }
  ErrorCode codeOf(const std::string& name, std::string_view content) {
    return failureOf(folder_.write(name, content)).code;
  }

  TempFolder folder_;
  std::size_t descriptors_ = 0;
};

TEST_F(ImportSceneFailure, NamesWhatIsNoModelFile) {
  EXPECT_EQ(failureOf(folder_ / "absent.obj").code, ErrorCode::FileNotFound);
  EXPECT_EQ(failureOf("").code, ErrorCode::FileNotFound);
  EXPECT_EQ(failureOf(folder_ / "").code, ErrorCode::FileUnreadable);
  EXPECT_EQ(codeOf("empty.obj", ""), ErrorCode::Empty);
  EXPECT_EQ(codeOf("no-extension", kTriangleObj), ErrorCode::UnknownName);
  EXPECT_EQ(codeOf("trailing.", kTriangleObj), ErrorCode::UnknownName);
  EXPECT_EQ(codeOf("unknown.foretouch", kTriangleObj), ErrorCode::UnknownName);
  const std::string fifo = folder_ / "pipe.obj";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(failureOf(fifo).code, ErrorCode::FileUnreadable);
}

TEST_F(ImportSceneFailure, CutsAPathAtItsNul) {
  const auto result = importScene(std::string("a.obj\0.obj", 10), withImporter());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::FileNotFound);
}

TEST_F(ImportSceneFailure, RefusesOptionsOutOfRange) {
  const std::string model = folder_.write("t.obj", kTriangleObj);
  const auto codeWith = [&](const std::function<void(SceneImportOptions&)>& change) {
    SceneImportOptions options = withImporter();
    change(options);
    return failureOf(model, options).code;
  };
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_EQ(codeWith([&](auto& o) { o.scale = bad; }), ErrorCode::OutOfRange);
    EXPECT_EQ(codeWith([&](auto& o) { o.timeLimitS = bad; }), ErrorCode::OutOfRange);
  }
  EXPECT_EQ(codeWith([](auto& o) { o.memoryLimitBytes = 1; }), ErrorCode::OutOfRange);
}

TEST_F(ImportSceneFailure, SaysWhereTheImporterWasLookedFor) {
  const std::string model = folder_.write("t.obj", kTriangleObj);
  SceneImportOptions options;
  for (const std::string& place : {folder_ / "nowhere", folder_ / "", model}) {
    options.importer = place;  // absent, a folder, not executable
    const Error error = failureOf(model, options);
    EXPECT_EQ(error.code, ErrorCode::FileNotFound);
    EXPECT_NE(error.message.find(place), std::string::npos) << error.message;
  }
}

TEST_F(ImportSceneFailure, SaysThatTheImporterCannotBeRun) {
  const std::string model = folder_.write("t.obj", kTriangleObj);
  SceneImportOptions options;
  options.importer = folder_.write("broken",
                                   "\x7F"
                                   "ELF but no more");
  std::filesystem::permissions(options.importer, std::filesystem::perms::owner_all);
  const Error error = failureOf(model, options);
  EXPECT_EQ(error.code, ErrorCode::ImportFailed);
  EXPECT_NE(error.message.find("cannot run"), std::string::npos) << error.message;
}

TEST_F(ImportSceneFailure, HandsOnWhyTheReaderRefusedAFile) {
  const Error error = failureOf(folder_.write("bad.gltf", R"({"asset":{"version":"2.0"},)"));
  EXPECT_EQ(error.code, ErrorCode::ImportFailed);
  EXPECT_NE(error.message.find("refused"), std::string::npos) << error.message;
}

TEST_F(ImportSceneFailure, SaysThatAFileHoldsNoTriangles) {
  EXPECT_EQ(codeOf("points.ply",
                   "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                   "property float z\nend_header\n0 0 0\n1 1 1\n"),
            ErrorCode::Empty);
  EXPECT_EQ(codeOf("empty.gltf", gltfWithNodes(R"([{"name":"nothing"}])")), ErrorCode::Empty);
  EXPECT_EQ(codeOf("wire.gltf", gltfWithNodes(R"([{"mesh":1}])")), ErrorCode::Empty);
}

TEST_F(ImportSceneFailure, RefusesSideFilesThatAreMissing) {
  std::string gltf = gltfWithNodes(R"([{"mesh":0}])");
  const std::size_t uri = gltf.find("data:");
  gltf.replace(uri, gltf.find('"', uri) - uri, "absent.bin");
  EXPECT_EQ(codeOf("lonely.gltf", gltf), ErrorCode::ImportFailed);
}

TEST_F(ImportSceneFailure, SurvivesCountsThatLie) {
  SceneImportOptions options = withImporter();
  options.memoryLimitBytes = std::size_t{1} << 30;
  for (const char* count : {"2000000000", "4294967295", "99999999999999999999", "-1"}) {
    const std::string path = folder_.write(
        "huge.ply", std::string("ply\nformat binary_little_endian 1.0\nelement vertex ") + count +
                        "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                        count + "\nproperty list uchar int vertex_indices\nend_header\n\1\2\3\4");
    failureOf(path, options);
  }
  std::string stl(80, ' ');
  stl += "\xFF\xFF\xFF\xFF" + std::string(50, '\0');
  failureOf(folder_.write("huge.stl", stl), options);
}

TEST_F(ImportSceneFailure, RefusesInstancesBeyondTheLimit) {
  // Half a megabyte of file, 50 010 000 triangles once every instance is placed.
  std::string nodes = R"([{"children":[1)";
  for (int i = 2; i <= 5001; ++i) nodes += "," + std::to_string(i);
  nodes += "]}";
  for (int i = 1; i <= 5001; ++i) nodes += R"(,{"mesh":0})";
  const Error error = failureOf(folder_.write("instances.gltf", gltfWithNodes(nodes + "]", 10000)));
  EXPECT_EQ(error.code, ErrorCode::LimitExceeded) << error.message;
}

TEST_F(ImportSceneFailure, ReportsAnImporterThatRanOutOfMemory) {
  if (internal::kUnderSanitizer) GTEST_SKIP() << "no memory limit under sanitizers";
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < 1'500'000; ++i) {
    vertices.emplace_back(static_cast<float>(i), 0.0F, 1.0F);
    faces.push_back({i, (i + 1) % 1'500'000, (i + 2) % 1'500'000});
  }
  SceneImportOptions options = withImporter();
  options.memoryLimitBytes = std::size_t{128} << 20;
  const Error error = failureOf(folder_.write("large.ply", binaryPly(vertices, faces)), options);
  EXPECT_EQ(error.code, ErrorCode::ImportCrashed);
  EXPECT_NE(error.message.find("memory limit of 134217728"), std::string::npos) << error.message;
}

TEST_F(ImportSceneFailure, ReportsACrashOfTheReader) {
  const Error error = failureOf(folder_.write("deep.bvh", bvhThatCrashesTheReader()));
  EXPECT_EQ(error.code, ErrorCode::ImportCrashed) << error.message;
  if (!internal::kUnderSanitizer) {
    EXPECT_NE(error.message.find("crashed on the file with signal"), std::string::npos)
        << error.message;
  }
}

TEST_F(ImportSceneFailure, SurvivesTruncationsAndGarblings) {
  const std::string gltf = gltfWithNodes(R"([{"mesh":0,"children":[1]},{"mesh":1}])");
  std::string obj = "o thing\n";
  for (int i = 0; i < 20; ++i) obj += kTriangleObj;
  int refused = 0, read = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    std::mt19937 random(seed);
    std::string bytes = seed % 2 == 0 ? gltf : obj;
    if (seed % 3 == 0) {
      bytes.resize(1 + random() % (bytes.size() - 1));
    } else {
      for (unsigned k = 0; k < seed % 7 + 1; ++k) {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
    }
    const auto result = importScene(
        folder_.write(seed % 2 == 0 ? "garbled.gltf" : "garbled.obj", bytes), withImporter());
    if (!result.ok()) {
      ++refused;
      continue;
    }
    ++read;
    ASSERT_EQ(result.value().scene.objectOf.size(), result.value().scene.triangles.size());
  }
  EXPECT_GT(refused, 40);
  EXPECT_GT(read, 20);
}

TEST_F(ImportSceneFailure, SurvivesNoiseUnderEveryExtension) {
  for (const char* extension : {"obj", "ply", "stl", "gltf", "glb", "dae", "fbx", "3ds", "blend",
                                "x", "off", "ifc", "lwo", "ms3d", "bvh"}) {
    for (unsigned seed = 0; seed < 3; ++seed) {
      std::mt19937 random(seed);
      std::string bytes(400, '\0');
      for (char& byte : bytes) byte = static_cast<char>(random());
      const auto result =
          importScene(folder_.write(std::string("noise.") + extension, bytes), withImporter());
      if (result.ok()) {
        EXPECT_FALSE(result.value().scene.triangles.empty()) << extension;
      }
    }
  }
}

}  // namespace
}  // namespace foretouch::test
