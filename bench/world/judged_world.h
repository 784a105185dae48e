// bench/world/judged_world.h: bodies and poses of a world in the judge's plain form.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "bench/judged.h"
#include "judge/world_judge.h"
#include "lss/index.h"

namespace foretouch::tools {

/// A body that is there from its first pose on, without a carrier.
inline oracle::OracleBody judgedBody(const Avatar& avatar) {
  oracle::OracleBody body;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    body.parents.push_back(avatar.skeleton().parent(link));
    for (const Lss& lss : avatar.lss(link)) {
      body.parts.push_back({link, 2, {plain(lss.a), plain(lss.b), plain(lss.b)}, lss.radius});
    }
  }
  return body;
}

inline void pushJudged(oracle::OracleBody& body, std::int64_t utimeUs, const Pose& pose) {
  if (body.episodes.empty()) body.episodes.push_back({utimeUs, -1, 0, {}, {}});
  std::vector<oracle::OraclePlace> places;
  for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
    places.push_back({plain(pose.rotations[j]), plain(pose.translations[j])});
  }
  body.episodes.back().times.push_back(utimeUs);
  body.episodes.back().poses.push_back(std::move(places));
}

}  // namespace foretouch::tools
