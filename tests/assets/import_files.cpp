#include "tests/assets/import_files.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/wait.h>

namespace foretouch::test {

namespace fs = std::filesystem;

SceneImportOptions withImporter() {
  SceneImportOptions options;
  options.importer = FORETOUCH_TEST_IMPORTER;
  return options;
}

namespace {

template <typename T>
void append(std::string& bytes, const T& value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof value);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

std::string binaryPly(const std::vector<Eigen::Vector3f>& vertices,
                      const std::vector<std::array<int, 3>>& faces) {
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3f& v : vertices) {
    for (int k = 0; k < 3; ++k) append(ply, v[k]);
  }
  for (const auto& face : faces) {
    append(ply, std::uint8_t{3});
    for (const int index : face) append(ply, index);
  }
  return ply;
}

std::string gltfWithNodes(const std::string& nodes, int copies) {
  std::string buffer;
  for (int i = 0; i < copies; ++i) {
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) append(buffer, x);
  }
  const std::string bytes = std::to_string(buffer.size());
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"name":"triangle","primitives":[{"attributes":{"POSITION":0},"mode":4}]},
{"name":"wire","primitives":[{"attributes":{"POSITION":1},"mode":0},
{"attributes":{"POSITION":1},"mode":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
         std::to_string(3 * copies) + R"(,"type":"VEC3"},
{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":)" +
         bytes + R"(}],"buffers":[{"byteLength":)" + bytes +
         R"(,"uri":"data:application/octet-stream;base64,)" + base64(buffer) + R"("}]})";
}

std::string bvhThatCrashesTheReader() {
  constexpr int kJoints = 100'000;
  const std::string body = "\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
  std::string bvh = "HIERARCHY\nROOT a" + body, zeros;
  for (int i = 1; i < kJoints; ++i) bvh += "JOINT b" + body;
  for (int i = 0; i < kJoints; ++i) zeros += "0 0 0 ";
  return bvh + "End Site\n{\nOFFSET 0 1 0\n}\n" + std::string(kJoints, '}') +
         "\nMOTION\nFrames: 1\nFrame Time: 0.01\n" + zeros + "\n";
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

Eigen::Matrix3d rows(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Eigen::Matrix3d matrix;
  matrix << a.transpose(), b.transpose(), c.transpose();
  return matrix;
}

Eigen::Matrix3d cornersOf(const ImportedScene& imported, std::size_t i) {
  const auto& v = imported.scene.triangles.at(i).vertices;
  return rows(v[0], v[1], v[2]);
}

std::size_t openDescriptors() {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

bool hasChildren() {
  siginfo_t info{};
  return waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

}  // namespace foretouch::test
