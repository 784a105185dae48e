// tests/oracle/pair_campaign.cpp: twenty-one questions to the linear oracle a pair.
#include "tests/oracle/pair_campaign.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "middleware/exact/triangles_meet.h"
#include "tests/reference/linear_query.h"

namespace foretouch::test {
namespace {

using oracle::LinearKind;
using oracle::LinearQuery;
using oracle::LinearTruth;
using oracle::Path;
using oracle::Vec3d;
using Corners = std::array<Path, 3>;

Vec3d inBox(Random& random, double half) {
  const Eigen::Vector3d v = random.inBox(half);
  return {v.x(), v.y(), v.z()};
}

PairQuery moving(Random& random, double travel) {
  PairQuery q;
  const Vec3d apart = random.uniform(0.0, 2.0) * inBox(random, 1.0);
  for (Path& p : q.one) {
    p.from = inBox(random, 0.7);
    p.to = p.from + inBox(random, travel);
  }
  for (Path& p : q.other) {
    p.from = inBox(random, 0.7) + apart;
    p.to = p.from + inBox(random, travel) - 0.5 * apart;
  }
  return q;
}

PairQuery onLattice(Random& random, int dimensions) {
  PairQuery q;
  const int half = 1 + random.below(3);
  const auto draw = [&](int axis) {
    return axis < dimensions ? static_cast<double>(random.below(2 * half + 1) - half) : 0.0;
  };
  for (Corners* corners : {&q.one, &q.other}) {
    for (Path& p : *corners) {
      p.from = {draw(0), draw(1), draw(2)};
      p.to = random.chance(0.3) ? p.from : Vec3d{draw(0), draw(1), draw(2)};
    }
  }
  return q;
}

bool edgesMeet(const Corners& edges, const Corners& face) {
  for (std::size_t i = 0; i < 3; ++i) {
    LinearQuery q;
    q.points[0] = {edges[i].from, edges[(i + 1) % 3].from};
    for (std::size_t j = 0; j < 3; ++j) q.points[j + 1] = {face[j].from, face[j].from};
    if (oracle::linearTruth(q).hits) return true;
  }
  return false;
}

void takeEarlier(const LinearTruth& found, LinearTruth& first) {
  if (!found.hits) return;
  first.low = std::min(first.low, found.low);
  first.high = std::min(first.high, found.high);
  first.hits = true;
  first.byRationals = first.byRationals || found.byRationals;
}

void verticesAndFace(const Corners& vertices, const Corners& face, LinearTruth& first) {
  for (const Path& vertex : vertices) {
    takeEarlier(oracle::linearTruth({LinearKind::VertexFace, {vertex, face[0], face[1], face[2]}}),
                first);
  }
}

std::array<LinearPoint, 3> points(const Corners& corners) {
  std::array<LinearPoint, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Path& p = corners[i];
    result[i] = {{p.from.x, p.from.y, p.from.z}, {p.to.x, p.to.y, p.to.z}};
  }
  return result;
}

Triangle atStart(const std::array<LinearPoint, 3>& p) {
  return {{p[0].from, p[1].from, p[2].from}};
}

std::string rows(const PairQuery& query) {
  std::string text;
  for (const Corners* corners : {&query.one, &query.other}) {
    for (const Path& p : *corners) {
      std::array<char, 256> row{};
      std::snprintf(row.data(), row.size(), "%a %a %a  %a %a %a\n", p.from.x, p.from.y, p.from.z,
                    p.to.x, p.to.y, p.to.z);
      text += row.data();
    }
  }
  return text;
}

void judgeOne(std::size_t family, std::uint64_t seed, std::uint64_t index, LeafTally& tally) {
  const PairQuery query = drawPair(family, seed, index);
  const auto one = points(query.one), other = points(query.other);
  const TrianglePairAnswer answer = trianglePair(one, other);
  const PairTruth truth = pairTruth(query);
  ++tally.queries;
  ++tally.stages[static_cast<std::size_t>(answer.leaf.stage)];
  tally.trueHits += truth.first.hits ? 1 : 0;
  tally.hardTruths += truth.first.byRationals ? 1 : 0;
  const auto fail = [&](std::uint64_t& count, const char* what) {
    tally.fail(count, pairFamilies()[family] + " seed " + std::to_string(seed) + " index " +
                          std::to_string(index) + ": " + what + "\n" + rows(query));
  };
  if (trianglesMeet(atStart(one), atStart(other)) != truth.startsInContact) {
    fail(truth.startsInContact ? tally.falseNegatives : tally.falsePositives, "trianglesMeet");
  }
  const LeafAnswer& leaf = answer.leaf;
  if (leaf.hits != truth.first.hits) {
    fail(truth.first.hits ? tally.falseNegatives : tally.falsePositives, "trianglePair");
    return;
  }
  const bool timesAreRight = !leaf.hits || (leaf.toiLow >= 0 && leaf.toiLow <= truth.first.high &&
                                            leaf.toiHigh >= truth.first.low && leaf.toiHigh <= 1 &&
                                            leaf.toiHigh - leaf.toiLow <= kLeafTimeAccuracy);
  if (!timesAreRight || answer.startsInContact != truth.startsInContact) {
    fail(tally.wrongTimes, "times of trianglePair");
  }
}

}  // namespace

const std::vector<std::string>& pairFamilies() {
  static const std::vector<std::string> names = {"moving", "still", "lattice", "plane"};
  return names;
}

PairQuery drawPair(std::size_t family, std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t kMix = 0xd1342543de82ef95u;  // spreads what is mixed; any odd number
  Random random((seed * kMix + family + 2000) * kMix + index);
  switch (family) {
    case 0: return moving(random, 1.0);
    case 1: return moving(random, 0.0);
    case 2: return onLattice(random, 3);
    default: return onLattice(random, 2);
  }
}

PairTruth pairTruth(const PairQuery& query) {
  PairTruth truth;
  truth.startsInContact = edgesMeet(query.one, query.other) || edgesMeet(query.other, query.one);
  LinearTruth& first = truth.first;
  if (truth.startsInContact) {
    first.hits = true;
    first.low = first.high = 0.0;
    return truth;
  }
  verticesAndFace(query.one, query.other, first);
  verticesAndFace(query.other, query.one, first);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      takeEarlier(oracle::linearTruth({LinearKind::EdgeEdge,
                                       {query.one[i], query.one[(i + 1) % 3], query.other[j],
                                        query.other[(j + 1) % 3]}}),
                  first);
    }
  }
  return truth;
}

std::vector<LeafTally> judgePairs(const LeafJob& job) {
  return judgeFamilies(pairFamilies().size(), job, judgeOne);
}

}  // namespace foretouch::test
