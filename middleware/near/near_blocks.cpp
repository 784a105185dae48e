#include "middleware/near/near_blocks.h"

#include <algorithm>
#include <array>

#include "lss/closest_features.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// Classes of gaps: a thousand triangles come thirty per class, where order no longer matters.
constexpr std::size_t kClasses = 32;
/// So many triangles take less by themselves than in a block.
constexpr std::size_t kFew = 2;

}  // namespace

PlacedLss placedLss(const StandingLss& lss) {
  const double within = lss.radius + lss.reach;
  return {{lss.a.x(), lss.a.y(), lss.a.z()},
          {lss.b.x(), lss.b.y(), lss.b.z()},
          within * within,
          kNearParallelSin2,
          kFlatDirection};
}

void NearBlocks::order(const Scene& scene, const IgnoredObjects& ignored,
                       const NearTriangles& near) {
  order_.clear();
  if (near.count == 0) return;
  const auto [least, most] = std::minmax_element(near.gap.data(), near.gap.data() + near.count);
  const float low = *least, scale = static_cast<float>(kClasses) / (*most - low);
  classOf_.resize(near.count);
  std::array<std::size_t, kClasses + 2> begin{};
  for (std::size_t k = 0; k < near.count; ++k) {
    const float place = scale * (near.gap[k] - low);
    // Written so that what is not a number has a class.
    std::size_t one =
        place < static_cast<float>(kClasses) ? static_cast<std::size_t>(place) : kClasses - 1;
    if (ignored.has(scene, near.id[k])) one = kClasses;  // beyond all
    classOf_[k] = static_cast<std::uint8_t>(one);
    ++begin[one + 1];
  }
  for (std::size_t i = 1; i <= kClasses; ++i) begin[i] += begin[i - 1];
  const std::size_t asked = begin[kClasses];
  order_.resize(near.count);
  for (std::size_t k = 0; k < near.count; ++k) {
    order_[begin[classOf_[k]]++] = {near.id[k], near.gap[k]};
    // They lie all over the scene's memory.
    const double* const vertices = scene.triangle(near.id[k]).vertices[0].data();
    __builtin_prefetch(vertices);
    __builtin_prefetch(vertices + 8);
  }
  order_.resize(asked);
}

PlaceChoice NearBlocks::mayWin(const Scene& scene, const FlatEdges& flat, const StandingLss& lss,
                               const NearBins& bins, std::size_t from) {
  const std::size_t count = std::min(order_.size() - from, PlaceBlock::kSize);
  const unsigned used = (1U << count) - 1U;
  if (count <= kFew) return {used, {}, {}};
  for (std::size_t i = 0; i < PlaceBlock::kSize; ++i) {
    const TriangleId id = order_[from + std::min(i, count - 1)].id;
    const Triangle& triangle = scene.triangle(id);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        block_.vertex[corner][axis][i] = triangle.vertices[corner][axis];
      }
    }
    block_.flat[i] = flat.bitsOf(id);
  }
  PlaceChoice choice = mayWinBins(placedLss(lss), bins, block_);
  choice.unsure &= used;
  for (unsigned& may : choice.may) may &= used;
  return choice;
}

}  // namespace foretouch::internal
