// bench/extremes/families.h: the families of extremes, each with random members and hand-made worst
// ones. Family, seed and the sizes below determine a case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/extremes/extreme_case.h"

namespace foretouch::tools::extremes {

/// Sizes of the large members; smaller ones for quick trials.
struct ExtremeSizes {
  std::size_t coincident = 100'000;  ///< Triangles in one place.
  int chain = 128;                   ///< Links in a row.
};

struct Member {
  std::string name;
  std::function<ExtremeCase(Draw&, const ExtremeSizes&)> make;
};

struct Family {
  std::string name;
  std::string about;  ///< For people: what is extreme in it.
  std::vector<Member> members;
  int share = 1;  ///< Runs one in so many of the requested cases: a case costs so much more.
};

/// All families, in the order of docs/extremes.md.
[[nodiscard]] const std::vector<Family>& families();
/// The family's `seed % members`-th member, drawn from `seed`.
[[nodiscard]] ExtremeCase makeCase(const Family& family, std::uint64_t seed,
                                   const ExtremeSizes& sizes);

namespace internal {
// By kind of extreme: places, shapes, motions, illegal input.
void addPlaces(std::vector<Family>& families);
void addShapes(std::vector<Family>& families);
void addMotions(std::vector<Family>& families);
void addRefusals(std::vector<Family>& families);
}  // namespace internal

}  // namespace foretouch::tools::extremes
