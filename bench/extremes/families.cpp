#include "bench/extremes/families.h"

namespace foretouch::tools::extremes {

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
    internal::addPlaces(list);
    internal::addShapes(list);
    internal::addMotions(list);
    internal::addRefusals(list);
    return list;
  }();
  return all;
}

ExtremeCase makeCase(const Family& family, std::uint64_t seed, const ExtremeSizes& sizes) {
  const Member& member = family.members[seed % family.members.size()];
  // Neighbouring seeds are neighbouring members: the name makes two families' draws differ.
  std::uint64_t mixed = seed * 0x9e3779b97f4a7c15u;
  for (const char c : family.name) mixed = (mixed ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  Draw draw(mixed);
  ExtremeCase extreme = member.make(draw, sizes);
  extreme.family = family.name;
  extreme.member = member.name;
  extreme.seed = seed;
  return extreme;
}

}  // namespace foretouch::tools::extremes
