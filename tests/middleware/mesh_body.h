// tests/middleware/mesh_body.h: meshes and skins for the links of a random body.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/lss.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

/// Triangles inside the link's LSS, `count` in each: their corners lie within `share` of the radius
/// of the axis.
inline std::vector<std::vector<Triangle>> meshWithin(const Avatar& avatar, Random& random,
                                                     int count, double share) {
  std::vector<std::vector<Triangle>> meshes(static_cast<std::size_t>(avatar.numLinks()));
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      for (int i = 0; i < count; ++i) {
        Triangle triangle;
        const double along = random.uniform(0.0, 1.0);
        for (Eigen::Vector3d& v : triangle.vertices) {
          const double s = std::min(1.0, std::max(0.0, along + random.uniform(-0.1, 0.1)));
          v = lss.a + s * (lss.b - lss.a) + lss.radius * random.arrow(0.0, share);
        }
        meshes[static_cast<std::size_t>(link)].push_back(triangle);
      }
    }
  }
  return meshes;
}

/// Most LSS get a twin before or behind them: the same one again, or one of `thinnest` to 1.2 times
/// the radius.
inline Avatar withTwins(const Avatar& avatar, Random& random, double thinnest) {
  std::vector<std::vector<Lss>> lss;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    lss.push_back(avatar.lss(link));
    for (Lss twin : avatar.lss(link)) {
      if (random.chance(0.3)) continue;
      if (random.chance(0.6)) twin.radius *= random.uniform(thinnest, 1.2);
      lss.back().insert(random.chance(0.5) ? lss.back().end() : lss.back().begin(), twin);
    }
  }
  return Avatar::build(avatar.skeleton(), std::move(lss)).value();
}

/// Every vertex of a random mesh, `count` triangles per LSS, blended between its own link and two
/// others.
struct RandomSkin {
  Skin skin;
  std::vector<std::size_t> counts;
};

inline RandomSkin randomSkin(const Avatar& avatar, const ChainMotion& motion, Random& random,
                             int count = 8) {
  RandomSkin made;
  const auto meshes = meshWithin(avatar, random, count, 0.8);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const auto& triangles = meshes[static_cast<std::size_t>(link)];
    made.counts.push_back(triangles.size());
    for (const Triangle& triangle : triangles) {
      std::array<std::int32_t, 3> ids;
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d p_W = motion.stateAt(link, 0.0).pointAt(triangle.vertices[i]);
        const double own = random.uniform(0.5, 1.0);
        std::vector<SkinInfluence> influences{{link, own, triangle.vertices[i]}};
        const LinkId other = random.below(avatar.numLinks());
        const LinkState state = motion.stateAt(other, 0.0);
        influences.push_back({other, 1.0 - own, state.R_WL.transpose() * (p_W - state.p_WL)});
        ids[i] = static_cast<std::int32_t>(made.skin.vertices.size());
        made.skin.vertices.push_back(influences);
      }
      made.skin.triangles.push_back(ids);
    }
  }
  return made;
}

}  // namespace foretouch::test
