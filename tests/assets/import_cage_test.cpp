// The importer's cage: what a stand-in for a compromised importer achieves, and what an honest one
// reads and costs.
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <netinet/in.h>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "assets/import/cage.h"
#include "assets/import/model_import.h"
#include "assets/import/process.h"
#include "assets/import/scene_import.h"
#include "tests/assets/import_files.h"
#include "tests/support/environment.h"

namespace foretouch::test {
namespace {

/// A socket of this process that listens on this machine.
class Listener {
 public:
  Listener() : fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const bool done = bind(fd_, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                      listen(fd_, 4) == 0 &&
                      getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    port_ = done ? ntohs(address.sin_port) : 0;
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { close(fd_); }
  [[nodiscard]] int port() const { return port_; }

 private:
  int fd_, port_ = 0;
};

class ImporterCage : public testing::Test {
 protected:
  void SetUp() override {
    if (internal::kUnderSanitizer) GTEST_SKIP() << "no cage under sanitizers";
    std::filesystem::create_directory(folder_ / "model");
    std::filesystem::create_directory(folder_ / "secrets");
    for (const char* name : {"key", "long", "old", "named"}) {
      folder_.write(std::string("secrets/") + name, "secret");
    }
    folder_.write("model/SECRETS",
                  folder_ / "secrets" + "\n" + std::to_string(listener_.port()) + "\n");
    model_ = folder_.write("model/t.obj", kTriangleObj);
    test::setVariable("FORETOUCH_TEST_TOKEN", "secret");
  }
  void TearDown() override { test::unsetVariable("FORETOUCH_TEST_TOKEN"); }

  /// Everything of the stand-in's last line behind "done:".
  static std::string doneIn(const std::string& text) {
    EXPECT_NE(text.find("tried 10, done:"), std::string::npos) << text;
    const std::string done = text.substr(text.find("done:") + 5);
    return done.substr(0, done.find_first_of(")\n"));
  }

  [[nodiscard]] Error failureOf(const std::string& path) const {
    const auto result = importScene(path, withImporter());
    if (result.ok()) {
      ADD_FAILURE() << path << " was imported";
      return {};
    }
    return result.error();
  }

  TempFolder folder_;
  Listener listener_;
  std::string model_;
};

/// That the stand-in's attempts succeed where nothing holds them: else the next test shows nothing.
TEST_F(ImporterCage, IsNeeded) {
  ::prctl(PR_SET_PTRACER, PR_SET_PTRACER_ANY);  // where Yama asks for it
  const auto end = internal::runLimited(
      "/usr/bin/env", {"FORETOUCH_TEST_TOKEN=secret", FORETOUCH_STAND_IN_IMPORTER, model_},
      {std::size_t{1} << 30, 20.0}, [](std::string_view) { return true; });
  const std::string done = doneIn(end.errorOutput);
  for (const char* attempt :
       {"environment", "read", "connect", "make", "truncate", "delete", "link"}) {
    EXPECT_NE(done.find(attempt), std::string::npos) << attempt << " of" << done;
  }
}

TEST_F(ImporterCage, LetsNothingSucceedThatACompromisedImporterTries) {
  if (internal::partsOfThisKernel().landlock == 0) GTEST_SKIP() << "this kernel has no Landlock";
  if (!internal::partsOfThisKernel().seccomp) GTEST_SKIP() << "this kernel has no seccomp";
  SceneImportOptions options;
  options.importer = FORETOUCH_STAND_IN_IMPORTER;
  const auto result = importScene(model_, options);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(doneIn(result.error().message), "");
  for (const char* name : {"key", "long", "old", "named"}) {
    EXPECT_EQ(contentOf(folder_ / (std::string("secrets/") + name)), "secret") << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "secrets/made"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "secrets/linked"));
}

TEST_F(ImporterCage, SaysWhatAKernelLacks) {
  const std::string whole = internal::weaknessOf({7, true});
  EXPECT_EQ(whole, "");
  EXPECT_NE(internal::weaknessOf({0, true}).find("Landlock"), std::string::npos);
  EXPECT_NE(internal::weaknessOf({7, false}).find("seccomp"), std::string::npos);
}

/// A triangle whose indices are bytes of the named file.
std::string gltfThatReads(const std::string& uri) {
  std::string gltf = gltfWithNodes(R"([{"mesh":0}])");
  const std::size_t begin = gltf.find("data:");
  return gltf.replace(begin, gltf.find('"', begin) - begin, uri);
}

TEST_F(ImporterCage, ReadsPartsBesideTheModelAlone) {
  const std::string bytes(36, '\1');
  std::filesystem::create_directory(folder_ / "model/parts");
  std::filesystem::create_directory(folder_ / "model/.hidden");
  for (const char* name : {"model/own.bin", "model/parts/own.bin", "model/.hidden/key.bin",
                           "model/.key.bin", "model/id_rsa", "secrets/key.bin"}) {
    folder_.write(name, bytes);
  }
  std::filesystem::create_symlink(folder_ / "secrets/key.bin", folder_ / "model/link.bin");
  const auto imported = [&](const std::string& uri) {
    return importScene(folder_.write("model/m.gltf", gltfThatReads(uri)), withImporter());
  };
  for (const char* good : {"own.bin", "parts/own.bin", "./parts/../own.bin"}) {
    const auto result = imported(good);
    EXPECT_TRUE(result.ok()) << good << ": " << describe(result.error());
  }
  for (const std::string& bad :
       {std::string("../secrets/key.bin"), folder_ / "secrets/key.bin", std::string("link.bin"),
        std::string(".hidden/key.bin"), std::string(".key.bin"), std::string("id_rsa"),
        "file://" + (folder_ / "secrets/key.bin")}) {
    const auto result = imported(bad);
    ASSERT_FALSE(result.ok()) << bad;
    EXPECT_EQ(result.error().code, ErrorCode::ImportFailed) << bad;
    EXPECT_NE(result.error().message.find("buffers[0].uri: expected"), std::string::npos)
        << result.error().message;
  }
}

/// The model whose index buffer is a file that nobody named: none of its bytes come back.
TEST_F(ImporterCage, TellsNoByteOfAFileThatNobodyNamed) {
  std::string vertices, nothing;
  for (int i = 0; i < 256; ++i) {
    for (const float x : {static_cast<float>(i) * 0.01F, 0.0F, static_cast<float>(i % 7)}) {
      vertices.append(reinterpret_cast<const char*>(&x), sizeof x);
    }
  }
  folder_.write("secrets/secret.key", "-----BEGIN PRIVATE KEY-----abcdefghijklmnopqr");
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":3072,
"uri":"data:application/octet-stream;base64,)" +
      base64(vertices) + R"("},{"byteLength":45,"uri":"../secrets/secret.key"}],
"bufferViews":[{"buffer":0,"byteLength":3072},{"buffer":1,"byteLength":45}],
"accessors":[{"bufferView":0,"componentType":5126,"count":256,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":45,"type":"SCALAR"}]})";
  const Error error = failureOf(folder_.write("model/chair.gltf", gltf));
  EXPECT_EQ(error.code, ErrorCode::ImportFailed);
  EXPECT_NE(error.message.find("'../secrets/secret.key'"), std::string::npos) << error.message;
  EXPECT_EQ(error.message.find("PRIVATE"), std::string::npos);
  // Beside the model and with the name of a buffer it is read: the file is a good one.
  std::string honest = gltf;
  honest.replace(honest.find("../secrets/secret.key"), 21, "secret.bin");
  std::filesystem::copy(folder_ / "secrets/secret.key", folder_ / "model/secret.bin");
  const auto read = importScene(folder_.write("model/honest.gltf", honest), withImporter());
  ASSERT_TRUE(read.ok()) << describe(read.error());
  EXPECT_EQ(read.value().scene.triangles.size(), 15U);
}

TEST_F(ImporterCage, IsNotHeldUpByAPipeBesideTheModel) {
  ASSERT_EQ(mkfifo((folder_ / "model/pipe.mtl").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder_ / "model/pipe.bin").c_str(), 0600), 0);
  SceneImportOptions options = withImporter();
  options.timeLimitS = 20.0;
  const auto withMaterials = importScene(
      folder_.write("model/p.obj", "mtllib pipe.mtl\n" + std::string(kTriangleObj)), options);
  EXPECT_TRUE(withMaterials.ok()) << describe(withMaterials.error());
  EXPECT_EQ(failureOf(folder_.write("model/p.gltf", gltfThatReads("pipe.bin"))).code,
            ErrorCode::ImportFailed);
}

TEST_F(ImporterCage, ReadsNoFormatThatIsNotNamed) {
  for (const char* extension : {"md5mesh", "lwo", "md3", "q3o", "ifc", "blend", "3mf", "zae"}) {
    const Error error = failureOf(folder_.write(std::string("model/m.") + extension, "any"));
    EXPECT_EQ(error.code, ErrorCode::UnknownName) << extension << error.message;
  }
}

/// Nodes that place their child twice, 31 of them: gigabytes for 3 kB, if nothing bounds it.
std::string instancesOfInstances() {
  std::string nodes = "[";
  for (int i = 1; i <= 30; ++i) {
    const std::string child = std::to_string(i);
    nodes += R"({"mesh":0,"children":[)" + child + "," + child + "]},";
  }
  return gltfWithNodes(nodes + R"({"mesh":0}])");
}

TEST_F(ImporterCage, GivesASmallFileAtMostAGigabyte) {
  const std::string path = folder_.write("model/inst.gltf", instancesOfInstances());
  EXPECT_LT(std::filesystem::file_size(path), 4000U);
  rusage before{}, after{};
  getrusage(RUSAGE_CHILDREN, &before);
  const Error error = failureOf(path);
  getrusage(RUSAGE_CHILDREN, &after);
  EXPECT_LT(after.ru_maxrss, 1'000'000'000 / 1024) << "kB; before: " << before.ru_maxrss;
  EXPECT_TRUE(error.code == ErrorCode::ImportCrashed || error.code == ErrorCode::ImportFailed)
      << error.message;
}

TEST_F(ImporterCage, EndsByItselfOnEmptyAccessorsThatCount) {
  SceneImportOptions options = withImporter();
  EXPECT_EQ(options.timeLimitS, 60.0);
  std::string gltf = gltfWithNodes(R"([{"mesh":0}])");
  const std::string view = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  const std::size_t at = gltf.find(view);
  ASSERT_NE(at, std::string::npos);
  gltf.replace(at, view.size(), R"({"componentType":5126,"count":100000000,"type":"VEC3",
"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}})");
  EXPECT_FALSE(importScene(folder_.write("model/sparse.gltf", gltf), options).ok());
}

TEST_F(ImporterCage, IsTheFirstToDieWhereMemoryEnds) {
  // A program that tells of itself needs no cage, only the limits.
  std::string output;
  const auto end = internal::runLimited("/bin/cat", {"/proc/self/oom_score_adj"},
                                        {std::size_t{1} << 30, 20.0}, [&](std::string_view bytes) {
                                          output += bytes;
                                          return true;
                                        });
  EXPECT_EQ(end.kind, internal::ProcessEnd::Kind::Exited);
  EXPECT_EQ(output, "1000\n");
}

TEST_F(ImporterCage, ReadsSkinsWithoutInverseBindMatrices) {
  std::string bytes;
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) {
    bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  }
  bytes += std::string(12, '\0');  // joints
  for (int i = 0; i < 3; ++i) {
    for (const float x : {1.F, 0.F, 0.F, 0.F}) {
      bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
    }
  }
  const auto gltf = [&](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0,"skin":0,"name":"m"},{"name":"bone","translation":[0,2,0],"children":[2]},
{"name":"tip"}],"skins":[{"joints":[1,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],
"buffers":[{"byteLength":96)" +
           uri + R"(}],"bufferViews":[{"buffer":0,"byteLength":36},
{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":48}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},
{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"}]})";
  };
  std::string json = gltf("");
  while (json.size() % 4 != 0) json += ' ';
  const auto word = [](std::size_t value) {
    std::string text;
    for (int k = 0; k < 4; ++k) text += static_cast<char>(value >> (8 * k) & 0xFF);
    return text;
  };
  const std::string glb = "glTF" + word(2) + word(12 + 8 + json.size() + 8 + bytes.size()) +
                          word(json.size()) + "JSON" + json + word(bytes.size()) +
                          std::string("BIN\0", 4) + bytes;
  ModelImportOptions options;
  options.import = withImporter();
  const std::string uri = R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"";
  for (const std::string& path :
       {folder_.write("model/s.gltf", gltf(uri)), folder_.write("model/s.glb", glb)}) {
    const auto model = importModel(path, options);
    ASSERT_TRUE(model.ok()) << describe(model.error());
    ASSERT_EQ(model.value().meshes.size(), 1U);
    const ModelMesh& mesh = model.value().meshes[0];
    EXPECT_EQ(mesh.vertices.at(1), Eigen::Vector3d(1, 0, 0));
    ASSERT_EQ(mesh.bones.size(), 2U);
    for (const ModelBone& bone : mesh.bones) {
      EXPECT_TRUE(bone.meshToBone.linear.isIdentity(0.0));
      EXPECT_TRUE(bone.meshToBone.translation.isZero(0.0));
    }
  }
}

}  // namespace
}  // namespace foretouch::test
