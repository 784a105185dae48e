#include <algorithm>
#include <atomic>

#include "middleware/scene/bvh_tree.h"

namespace foretouch::internal {
namespace {

#if FORETOUCH_HAS_EMBREE
constexpr TreeBuilder kFirst = TreeBuilder::Embree;
#else
constexpr TreeBuilder kFirst = TreeBuilder::Binned;
#endif

std::atomic<TreeBuilder> active{kFirst};

}  // namespace

const char* toString(TreeBuilder builder) {
  return builder == TreeBuilder::Embree ? "embree" : "binned";
}

const std::vector<TreeBuilder>& treeBuilders() {
  static const std::vector<TreeBuilder> builders =
      kFirst == TreeBuilder::Embree
          ? std::vector<TreeBuilder>{TreeBuilder::Embree, TreeBuilder::Binned}
          : std::vector<TreeBuilder>{TreeBuilder::Binned};
  return builders;
}

TreeBuilder activeTreeBuilder() {
  return active;
}

bool useTreeBuilder(std::optional<TreeBuilder> builder) {
  const std::vector<TreeBuilder>& known = treeBuilders();
  if (builder && std::find(known.begin(), known.end(), *builder) == known.end()) return false;
  active = builder.value_or(kFirst);
  return true;
}

}  // namespace foretouch::internal
