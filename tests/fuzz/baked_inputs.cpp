#include "tests/fuzz/baked_inputs.h"

#define XXH_INLINE_ALL
#include <array>
#include <cmath>
#include <cstring>
#include <vector>
#include <xxhash.h>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "assets/import/scene_import.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene_parts.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

/// docs/formats.md, "Baked scenes".
constexpr std::size_t kHeader = 320, kCheck = 16, kBytes = 24;

void set(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint64_t value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// A ball that moves through the middle.
void ask(const Scene& scene) {
  RawSkeleton raw;
  raw.joints.push_back({"ball", kNoParent, Eigen::Vector3d::Zero()});
  const auto skeleton = Skeleton::build(raw);
  require(skeleton.ok(), "there is a skeleton");
  const auto avatar = Avatar::build(skeleton.value(), {{{{0, 0, 0}, {0.1, 0, 0}, 0.05}}});
  require(avatar.ok(), "there is an avatar");
  const auto query = Query::build(avatar.value(), scene);
  require(query.ok(), "a scene that was read can be asked");
  Pose from = restPose(skeleton.value()), to = from;
  from.translations[0] = scene.parts().origin - Eigen::Vector3d::Ones();
  to.translations[0] = scene.parts().origin + Eigen::Vector3d::Ones();
  Scratch scratch;
  static_cast<void>(query.value().answer(ChainMotion(skeleton.value(), from, to), scratch));
}

}  // namespace

bool feedBakedScene(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  if (size >= kHeader) {
    constexpr std::array<std::uint8_t, 16> kBegin{'F', 'T', 'S', 'C', 'E', 'N', 'E', '\n',
                                                  4,   3,   2,   1,   1,   0,   0,   0};
    std::memcpy(bytes.data(), kBegin.data(), kBegin.size());
    set(bytes, kBytes, size);
    set(bytes, kCheck, XXH3_64bits(bytes.data() + kBytes, size - kBytes));
  }
  const MemoryFile file(bytes.data(), bytes.size());
  const auto loaded = readScene(file.path());
  if (!loaded.ok()) {
    checkReason(loaded.error());
    return false;
  }
  const Scene& scene = loaded.value().scene;
  require(std::isfinite(loaded.value().frame.metresPerUnit), "its unit is a number");
  require(scene.audit().boxMin.allFinite() && scene.audit().boxMax.allFinite(), "so is its box");
  const auto raw = importScene(file.path());
  require(!raw.ok() || raw.value().scene.triangles.size() == scene.numTriangles(), "one size");
  static_cast<void>(checkScene(scene));
  ask(scene);
  return true;
}

}  // namespace foretouch::fuzz
