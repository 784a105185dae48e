#include "tools/glb/appearances.h"

#include <cmath>
#include <limits>
#include <optional>

namespace foretouch::tools {
namespace {

/// When a node appears, disappears, or both; one float each, ascending.
struct Keys {
  std::vector<float> times;
  bool isThereFirst = false;
};

Keys keysOf(const Appearance& appearance, double endS) {
  Keys keys;
  const auto from = static_cast<float>(appearance.fromS);
  keys.isThereFirst = !(from > 0.0f);
  keys.times.push_back(0.0f);
  if (!keys.isThereFirst) keys.times.push_back(from);
  if (appearance.untilS < endS) {
    const float next = std::nextafter(keys.times.back(), std::numeric_limits<float>::max());
    keys.times.push_back(std::max(next, static_cast<float>(appearance.untilS)));
  }
  return keys;
}

/// Alternating scales, beginning with one or the other.
std::vector<float> scalesFor(std::size_t keys, bool isThereFirst) {
  std::vector<float> scales;
  for (std::size_t i = 0; i < keys; ++i) {
    scales.insert(scales.end(), 3, (i % 2 == 0) == isThereFirst ? 1.0f : 0.0f);
  }
  return scales;
}

/// The accessors of scales, each added on first use.
class Scales {
 public:
  explicit Scales(GlbContent& content) : content_(content) {}
  std::size_t accessor(const Keys& keys) {
    auto& known = accessors_[keys.isThereFirst ? 1 : 0][keys.times.size() - 1];
    if (!known) known = content_.addRows(scalesFor(keys.times.size(), keys.isThereFirst), 3);
    return *known;
  }

 private:
  static constexpr int kMostKeys = 3;
  GlbContent& content_;
  std::optional<std::size_t> accessors_[2][kMostKeys];
};

}  // namespace

void addAppearances(const std::vector<Appearance>& appearances, double endS, GlbContent& content,
                    GlbAnimation& animation) {
  if (appearances.empty()) return;
  std::vector<Keys> keys;
  std::vector<std::vector<float>> times;
  for (const Appearance& appearance : appearances) {
    keys.push_back(keysOf(appearance, endS));
    times.push_back(keys.back().times);
  }
  const std::size_t first = content.addLists(times);
  Scales scales(content);
  for (std::size_t i = 0; i < appearances.size(); ++i) {
    const std::size_t node = appearances[i].node;
    const double atFirst = keys[i].isThereFirst ? 1.0 : 0.0;
    content.document().at("nodes", node)["scale"] = gltfVector(Eigen::Vector3d::Constant(atFirst));
    animation.add(node, "scale", first + i, scales.accessor(keys[i]), "STEP");
  }
}

}  // namespace foretouch::tools
