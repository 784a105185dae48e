// tests/support/judged.h: converts the product's types to the judge's plain ones.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "bench/judged.h"
#include "judge/capsule_prover.h"

namespace foretouch::test {

using tools::plain;
using tools::plainJoints;

inline oracle::Capsule plain(const Lss& lss) {
  return {{plain(lss.a), plain(lss.b)}, lss.radius};
}
inline std::vector<oracle::Capsule> plainCapsules(const Avatar& avatar, LinkId link) {
  std::vector<oracle::Capsule> capsules;
  for (const Lss& lss : avatar.lss(link)) capsules.push_back(plain(lss));
  return capsules;
}

}  // namespace foretouch::test
