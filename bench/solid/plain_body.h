// bench/solid/plain_body.h: an avatar and its poses in the judge's plain form.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"
#include "articulated/skeleton.h"
#include "bench/judged.h"
#include "judge/way_judge.h"
#include "lss/index.h"

namespace foretouch::tools {

inline oracle::PlainPose plainPose(const Pose& pose) {
  oracle::PlainPose result;
  for (const Quaternion& q : pose.rotations) result.rotations.push_back(plain(q));
  for (const Eigen::Vector3d& p : pose.translations) result.translations.push_back(plain(p));
  return result;
}

/// `links`: only these, one per link; empty: all.
inline oracle::WayBody plainBody(const Avatar& avatar, const std::vector<bool>& links = {}) {
  oracle::WayBody body;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    body.parents.push_back(avatar.skeleton().parent(link));
    body.capsules.emplace_back();
    if (!links.empty() && !links[slotOf(link)]) continue;
    for (const Lss& lss : avatar.lss(link)) {
      body.capsules.back().push_back({{plain(lss.a), plain(lss.b)}, lss.radius});
    }
  }
  return body;
}

/// The largest difference of two poses: of a rotation as a vector of four, or of a place (m).
inline double difference(const Pose& one, const Pose& other) {
  double most = 0.0;
  for (std::size_t j = 0; j < one.rotations.size(); ++j) {
    most = std::max(most, (one.rotations[j].coeffs() - other.rotations[j].coeffs()).norm());
    most = std::max(most, (one.translations[j] - other.translations[j]).norm());
  }
  return most;
}

/// The pairs of links that the rules ask about: what the judge must look at.
inline std::vector<std::array<int, 2>> askedPairs(const Avatar& avatar, const PairRules& rules) {
  std::vector<std::array<int, 2>> pairs;
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (avatar.lss(a).empty() || avatar.lss(b).empty()) continue;
      if (rules.reasonOf(a, b) == PairReason::Asked) pairs.push_back({a, b});
    }
  }
  return pairs;
}

}  // namespace foretouch::tools
