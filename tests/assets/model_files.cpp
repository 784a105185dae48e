#include "tests/assets/model_files.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/assets/import_files.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

Affine randomAffine(Random& random) {
  Affine affine;
  affine.linear << random.inBox(2), random.inBox(2), random.inBox(2);
  affine.translation = random.inBox(5);
  return affine;
}

ModelNode randomNode(Random& random, std::int32_t index) {
  ModelNode node;
  node.name = "node " + std::to_string(index);
  node.parent = index == 0 ? -1 : random.below(index);
  node.toParent = randomAffine(random);
  for (int i = random.below(3); i > 0; --i) {
    node.lss.push_back({random.inBox(1), random.inBox(1), random.uniform(0, 2)});
  }
  node.joint = static_cast<ModelJointType>(random.below(6));
  node.jointName = "joint " + std::to_string(index);
  node.axis = random.direction();
  node.lowerLimit = random.uniform(-3, 0);
  node.upperLimit = random.uniform(0, 3);
  return node;
}

ModelMesh randomMesh(Random& random, std::int32_t nodes) {
  ModelMesh mesh;
  mesh.name = "mesh";
  mesh.node = random.below(nodes);
  const int vertices = 3 + random.below(40000) / (random.chance(0.05) ? 1 : 1000);
  for (int i = 0; i < vertices; ++i) mesh.vertices.push_back(random.inBox(3));
  mesh.vertices[0].x() = std::nan("");
  for (int i = random.below(vertices); i >= 0; --i) {
    mesh.triangles.push_back(
        {random.below(vertices), random.below(vertices), random.below(vertices)});
  }
  for (int i = random.below(3); i > 0; --i) {
    ModelBone bone{random.below(nodes + 1) - 1, "bone", randomAffine(random), {}};
    for (int w = random.below(9); w > 0; --w) {
      bone.weights.push_back({random.below(vertices), random.uniform(-1, 1)});
    }
    mesh.bones.push_back(bone);
  }
  return mesh;
}

ModelTrack randomTrack(Random& random, std::int32_t nodes) {
  ModelTrack track;
  track.node = random.below(nodes);
  for (int i = random.below(5); i > 0; --i) track.positions.push_back({1.0 * i, random.inBox(1)});
  for (int i = random.below(5); i > 0; --i) track.scales.push_back({2.0 * i, random.inBox(1)});
  for (int i = random.below(5); i > 0; --i) track.rotations.push_back({0.5 * i, random.rotation()});
  return track;
}

/// Bits, as NaN is to be handed on.
template <typename T>
bool sameBits(const T& a, const T& b) {
  static_assert(sizeof(T) % sizeof(double) == 0);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same(const Affine& a, const Affine& b) {
  return sameBits(a.linear, b.linear) && sameBits(a.translation, b.translation);
}

bool same(const ModelNode& a, const ModelNode& b) {
  return a.name == b.name && a.parent == b.parent && same(a.toParent, b.toParent) &&
         a.lss.size() == b.lss.size() &&
         std::equal(a.lss.begin(), a.lss.end(), b.lss.begin(),
                    [](const Lss& x, const Lss& y) { return sameBits(x, y); }) &&
         a.joint == b.joint && a.jointName == b.jointName && sameBits(a.axis, b.axis) &&
         a.lowerLimit == b.lowerLimit && a.upperLimit == b.upperLimit;
}

bool same(const ModelMimic& a, const ModelMimic& b) {
  return a.node == b.node && a.leader == b.leader && a.factor == b.factor && a.offset == b.offset;
}

bool same(const ModelBone& a, const ModelBone& b) {
  return a.node == b.node && a.name == b.name && same(a.meshToBone, b.meshToBone) &&
         std::equal(a.weights.begin(), a.weights.end(), b.weights.begin(), b.weights.end(),
                    [](const auto& x, const auto& y) {
                      return x.vertex == y.vertex && x.weight == y.weight;
                    });
}

bool same(const ModelMesh& a, const ModelMesh& b) {
  return a.name == b.name && a.node == b.node && a.triangles == b.triangles &&
         std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                    [](const auto& x, const auto& y) { return sameBits(x, y); }) &&
         std::equal(a.bones.begin(), a.bones.end(), b.bones.begin(), b.bones.end(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

template <typename Keys>
bool sameKeys(const Keys& a, const Keys& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.timeS == y.timeS && sameBits(x.value, y.value);
  });
}

bool same(const ModelAnimation& a, const ModelAnimation& b) {
  return a.name == b.name && a.durationS == b.durationS &&
         std::equal(a.tracks.begin(), a.tracks.end(), b.tracks.begin(), b.tracks.end(),
                    [](const ModelTrack& x, const ModelTrack& y) {
                      return x.node == y.node && sameKeys(x.positions, y.positions) &&
                             sameKeys(x.scales, y.scales) && sameKeys(x.rotations, y.rotations);
                    });
}

template <typename Parts>
std::string differenceOf(const char* what, const Parts& a, const Parts& b) {
  if (a.size() != b.size()) return std::string("number of ") + what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same(a[i], b[i])) return std::string(what) + " " + std::to_string(i);
  }
  return "";
}

void append(std::string& bytes, std::initializer_list<float> numbers) {
  for (const float number : numbers) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
}

}  // namespace

ModelImportOptions withModelImporter() {
  ModelImportOptions options;
  options.import = withImporter();
  return options;
}

Model randomModel(std::uint64_t seed) {
  Random random(seed);
  Model model;
  const std::int32_t nodes = 1 + random.below(20);
  for (std::int32_t i = 0; i < nodes; ++i) model.nodes.push_back(randomNode(random, i));
  for (int i = random.below(3); i > 0; --i) {
    model.mimics.push_back(
        {random.below(nodes), random.below(nodes), random.uniform(-2, 2), random.uniform(-1, 1)});
  }
  for (int i = random.below(4); i > 0; --i) model.meshes.push_back(randomMesh(random, nodes));
  for (int i = random.below(3); i > 0; --i) {
    ModelAnimation animation{"animation", random.uniform(0, 9), {}};
    for (int t = random.below(4); t > 0; --t)
      animation.tracks.push_back(randomTrack(random, nodes));
    model.animations.push_back(animation);
  }
  for (int i = random.below(3); i > 0; --i) model.notes.push_back("note " + std::to_string(i));
  return model;
}

std::string difference(const Model& a, const Model& b) {
  for (const std::string& found :
       {differenceOf("nodes", a.nodes, b.nodes), differenceOf("mimics", a.mimics, b.mimics),
        differenceOf("meshes", a.meshes, b.meshes),
        differenceOf("animations", a.animations, b.animations)}) {
    if (!found.empty()) return found;
  }
  return a.notes == b.notes ? "" : "notes";
}

std::string skinnedGltf() {
  std::string buffer;
  append(buffer, {0, 0, 0, 1, 0, 0, 0, 1, 0});                        // 0: positions, bytes 0 to 36
  append(buffer, {1, 0, 0, 0, 0, 1, 0, 0});                           // weights of vertices 0, 1
  append(buffer, {0.25F, 0.75F, 0, 0});                               // vertex 2, up to byte 84
  append(buffer, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});   // hip's inverse bind
  append(buffer, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});  // knee's, up to 212
  append(buffer, {0, 2});                                             // times, up to 220
  append(buffer, {0, 0, 0, 1, 0.70710678F, 0, 0, 0.70710678F});       // rotations, up to 252
  append(buffer, {0, 0, 0, 0, 0.5F, 0});  // positions of the hip, up to 276
  for (int i = 0; i < 3; ++i) buffer += std::string("\0\1\0\0", 4);  // joints, up to 288
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"body","children":[1,3]},{"name":"hip","children":[2]},
{"name":"knee","translation":[0,1,0]},{"name":"skin","mesh":0,"skin":0}],
"meshes":[{"name":"leg","primitives":[{"attributes":{"POSITION":0,"WEIGHTS_0":1,"JOINTS_0":2}}]}],
"skins":[{"joints":[1,2],"inverseBindMatrices":3}],
"animations":[{"name":"bend","samplers":[{"input":4,"output":5},{"input":4,"output":6}],
"channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}},
{"sampler":1,"target":{"node":1,"path":"translation"}}]}],
"accessors":[{"bufferView":0,"byteOffset":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC4"},
{"bufferView":0,"byteOffset":276,"componentType":5121,"count":3,"type":"VEC4"},
{"bufferView":0,"byteOffset":84,"componentType":5126,"count":2,"type":"MAT4"},
{"bufferView":0,"byteOffset":212,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":0,"byteOffset":220,"componentType":5126,"count":2,"type":"VEC4"},
{"bufferView":0,"byteOffset":252,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":288}],
"buffers":[{"byteLength":288,"uri":"data:application/octet-stream;base64,)" +
         base64(buffer) + R"("}]})";
}

std::size_t trianglesOf(const Model& model) {
  std::size_t count = 0;
  for (const ModelMesh& mesh : model.meshes) count += mesh.triangles.size();
  return count;
}

std::size_t bonesOf(const Model& model) {
  std::size_t count = 0;
  for (const ModelMesh& mesh : model.meshes) count += mesh.bones.size();
  return count;
}

std::int32_t nodeNamed(const Model& model, const std::string& name) {
  std::int32_t found = -1;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].name != name) continue;
    EXPECT_EQ(found, -1) << "several nodes " << name;
    found = static_cast<std::int32_t>(i);
  }
  EXPECT_NE(found, -1) << "no node " << name;
  return std::max(found, 0);
}

Affine toWorld(const Model& model, std::int32_t node) {
  Affine world;
  for (; node >= 0; node = model.nodes[static_cast<std::size_t>(node)].parent) {
    world = model.nodes[static_cast<std::size_t>(node)].toParent * world;
  }
  return world;
}

}  // namespace foretouch::test
