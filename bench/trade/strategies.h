// bench/trade/strategies.h: the strategies that `bench trade` measures, each short and after its
// source. All model a link by its LSS, and none is part of the product's queries. All but
// Foretouch's compute in plain doubles: they keep their promise except for rounding, which only
// Foretouch proves.
#pragma once

#include <memory>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "bench/judged.h"
#include "bench/trade/nearest_tree.h"
#include "bench/trade/strategy.h"
#include "bench/trade/voxels.h"
#include "judge/scene.h"
#include "middleware/query/query.h"
#include "tests/reference/reference_query.h"

namespace foretouch::tools {

/// Scene and avatar, with the strategies' search structures and the judge's scene.
struct TradeWorld {
  TradeWorld(const Avatar& anAvatar, const Scene& aScene)
      : avatar(anAvatar),
        scene(aScene),
        tree(aScene),
        voxels(aScene),
        judged(plain(finiteTriangles(aScene))) {}
  Avatar avatar;
  Scene scene;
  NearestTree tree;
  VoxelGrid voxels;
  oracle::Scene judged;  ///< The finite triangles.
};

/// At `instants` + 1 instants, both poses among them, is anything within the tolerance? 1: the
/// poses alone, like an engine without CCD.
[[nodiscard]] std::unique_ptr<Strategy> sampling(const TradeWorld& world, int instants,
                                                 double tolerance);
/// [Schwarzer05]: a span is free if the farthest that the link can move in it is less than the sum
/// of its clearances at both ends; else it halves the span.
[[nodiscard]] std::unique_ptr<Strategy> subdivision(const TradeWorld& world, double tolerance);
/// [Mirtich96] without a direction: steps of clearance over the largest speed.
[[nodiscard]] std::unique_ptr<Strategy> advancement(const TradeWorld& world, double tolerance);
/// Certificates carried from step to step: skips a link while it has moved less than its last known
/// clearance ([Mirtich96]'s collision heap, in terms of motion); else as advancement().
[[nodiscard]] std::unique_ptr<Strategy> certificates(const TradeWorld& world, double tolerance);
/// Sweeps the link through a grid of occupied cells, at samples so fine that it moves by at most
/// half a cell between instants, with everything grown by the possible error.
[[nodiscard]] std::unique_ptr<Strategy> voxelSweep(const TradeWorld& world);
/// Ours, with `options`, which determine its promise; the name is given. Precondition: options that
/// buildReference() takes.
[[nodiscard]] std::unique_ptr<Strategy> foretouchQuery(const TradeWorld& world,
                                                       const QueryOptions& options,
                                                       const std::string& name,
                                                       const ReferenceOptions& reference = {});

}  // namespace foretouch::tools
