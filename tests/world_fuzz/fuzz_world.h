// tests/world_fuzz/fuzz_world.h: random worlds that a world file can say: who is where, who carries
// whom and who falls silent, and the text that says it. Made of plain numbers: the judge's world is
// made of the same, by the judge's own arithmetic.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "judge/world_judge.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

/// How a body's place is told where its carrier changes.
enum class FuzzBegin { GoesOn, Said, Posed, Stays };

/// A body between two instants at which carriers change.
struct FuzzSegment {
  bool isThere = true;
  int carrier = -1;    ///< -1: nobody.
  bool moves = false;  ///< Its poses are in the carrier's frame.
  FuzzBegin begin = FuzzBegin::GoesOn;
  oracle::OraclePlace place;  ///< At the begin, if it is told: Said and Posed.
  std::vector<std::int64_t> times;
  std::vector<oracle::OraclePlace> poses;  ///< At these.
};

struct FuzzBody {
  std::string name, group, whenSilent = "wait";
  bool isTrigger = false, stands = false, isBox = false;
  std::vector<oracle::OraclePart> parts;
  double half = 0.0;          ///< Of a box, whose centre is its origin.
  oracle::OraclePlace place;  ///< Where it stands, or is first.
  std::vector<FuzzSegment> segments;
  int silentFrom = -1;  ///< The segment in which it is told no more poses; -1: none.
  int watches = -1;     ///< Of a trigger: the one body that it looks at; -1: everybody.

  [[nodiscard]] bool isHeld(int segment) const {
    const FuzzSegment& now = segments[static_cast<std::size_t>(segment)];
    return now.carrier >= 0 && !now.moves;
  }
};

struct FuzzWorld {
  double size = 1.0, tolerance = 1e-3;
  double reach = 0.0;                   ///< No coordinate is larger (m).
  std::vector<std::int64_t> cuts;       ///< Where carriers may change; the last one: the end.
  std::vector<FuzzBody> bodies;         ///< Triggers behind all others.
  std::vector<std::vector<int>> ranks;  ///< Per segment: carriers come before whom they carry.
  bool areApart = false;                ///< Bodies of groups "one" and "other" are not asked.
  oracle::OracleWorld truth;  ///< Whoever is silent holds still. Times count from cuts[0].

  [[nodiscard]] int numSegments() const { return static_cast<int>(cuts.size()) - 1; }
};

template <typename T>
void shuffle(std::vector<T>& list, Random& random) {
  for (std::size_t i = list.size(); i > 1; --i) {
    std::swap(list[i - 1], list[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  }
}

[[nodiscard]] FuzzWorld drawFuzzWorld(std::uint64_t seed);

/// Of the world, its inner tables and its triggers in an order by `seed`; bodies keep theirs.
[[nodiscard]] std::string textOf(const FuzzWorld& world, std::uint64_t seed);

}  // namespace foretouch::test
