// tests/oracle/leaf_campaign.cpp: the linear half, and what both halves share.
#include "tests/oracle/leaf_campaign.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <thread>

#include "tests/reference/linear_query.h"

namespace foretouch::test {
namespace {

using oracle::LinearKind;
using oracle::LinearQuery;
using oracle::LinearTruth;

LinearPoint point(const oracle::Path& p) {
  return {{p.from.x, p.from.y, p.from.z}, {p.to.x, p.to.y, p.to.z}};
}

LeafAnswer answerOf(const LinearQuery& query) {
  const LinearPoint a = point(query.points[0]), b = point(query.points[1]),
                    c = point(query.points[2]), d = point(query.points[3]);
  switch (query.kind) {
    case LinearKind::VertexFace: return vertexFace(a, {b, c, d});
    case LinearKind::EdgeEdge: return edgeEdge({a, b}, {c, d});
    case LinearKind::VertexEdge: return vertexEdge(a, {b, c});
    case LinearKind::VertexVertex: break;
  }
  return vertexVertex(a, b);
}

/// Beyond doubt: the truth's bracket lies outside the answer's.
bool contradicts(const LeafAnswer& answer, const LinearTruth& truth) {
  return answer.toiLow > truth.high || answer.toiHigh < truth.low;
}

/// The truth's bracket reaches over the answer's: a narrower one may contradict.
bool needsNarrower(const LeafAnswer& answer, const LinearTruth& truth) {
  return answer.toiLow > truth.low || answer.toiHigh < truth.high;
}

bool isInterval(const LeafAnswer& a) {
  return a.toiLow >= 0 && a.toiLow <= a.toiHigh && a.toiHigh <= 1 &&
         a.toiHigh - a.toiLow <= kLeafTimeAccuracy;
}

std::string described(const LinearQuery& query, const std::string& name, const LeafAnswer& answer,
                      const LinearTruth& truth) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(),
                "%s, %s: answered %s [%a, %a] by stage %d, true %s [%a, %a]\n", name.c_str(),
                toString(query.kind), answer.hits ? "hit" : "miss", answer.toiLow, answer.toiHigh,
                static_cast<int>(answer.stage), truth.hits ? "hit" : "miss", truth.low, truth.high);
  return line.data() + inHex(query);
}

void judgeOne(std::size_t family, std::uint64_t seed, std::uint64_t index, LeafTally& tally) {
  const std::string name = linearFamilies()[family].name + " seed " + std::to_string(seed) +
                           " index " + std::to_string(index);
  judgeLinear(drawLinear(family, seed, index), name, tally);
}

}  // namespace

void LeafTally::fail(std::uint64_t& count, const std::string& text) {
  ++count;
  if (failures.size() < kKeptFailures) failures.push_back(text);
}

void LeafTally::add(const LeafTally& o) {
  queries += o.queries;
  trueHits += o.trueHits;
  falseNegatives += o.falseNegatives;
  falsePositives += o.falsePositives;
  wrongTimes += o.wrongTimes;
  thrown += o.thrown;
  nearHits += o.nearHits;
  unproved += o.unproved;
  hardTruths += o.hardTruths;
  for (std::size_t i = 0; i < stages.size(); ++i) stages[i] += o.stages[i];
  for (const std::string& f : o.failures) {
    if (failures.size() < kKeptFailures) failures.push_back(f);
  }
}

void judgeLinear(const LinearQuery& query, const std::string& name, LeafTally& tally) {
  LeafAnswer answer;
  try {
    answer = answerOf(query);
  } catch (const std::exception& e) {
    ++tally.queries;
    tally.fail(tally.thrown,
               name + ", " + toString(query.kind) + ": threw " + e.what() + "\n" + inHex(query));
    return;
  }
  judgeAnswer(query, answer, name, tally);
}

void judgeAnswer(const LinearQuery& query, const LeafAnswer& answer, const std::string& name,
                 LeafTally& tally) {
  LinearTruth truth = oracle::linearTruth(query);
  if (truth.hits && answer.hits && !truth.byRationals && needsNarrower(answer, truth)) {
    truth = oracle::linearTruthByRationals(query);
  }
  ++tally.queries;
  ++tally.stages[static_cast<std::size_t>(answer.stage)];
  tally.trueHits += truth.hits ? 1 : 0;
  tally.hardTruths += truth.byRationals ? 1 : 0;
  const bool timesAreWrong = answer.hits && (!isInterval(answer) || contradicts(answer, truth));
  if (answer.hits == truth.hits && !timesAreWrong) return;
  std::uint64_t& count = !answer.hits  ? tally.falseNegatives
                         : !truth.hits ? tally.falsePositives
                                       : tally.wrongTimes;
  tally.fail(count, described(query, name, answer, truth));
}

std::vector<LeafTally> judgeFamilies(std::size_t families, const LeafJob& job, JudgeOne judge) {
  const auto threads = static_cast<std::size_t>(job.threads);
  std::vector<std::vector<LeafTally>> parts(threads, std::vector<LeafTally>(families));
  std::vector<std::thread> workers;
  for (std::size_t w = 0; w < threads; ++w) {
    workers.emplace_back([&, w] {
      for (std::size_t f = 0; f < families; ++f) {
        for (std::uint64_t i = w; i < job.queries; i += threads) {
          judge(f, job.seed, i, parts[w][f]);
        }
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  std::vector<LeafTally> tallies(families);
  for (const auto& part : parts) {
    for (std::size_t f = 0; f < families; ++f) tallies[f].add(part[f]);
  }
  return tallies;
}

std::vector<LeafTally> judgeLinear(const LeafJob& job) {
  return judgeFamilies(linearFamilies().size(), job, judgeOne);
}

std::string tableOf(const std::vector<std::string>& names, const std::vector<LeafTally>& tallies) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(), "%-10s %10s %10s %6s %6s %6s %6s %6s %8s %8s %8s %8s\n",
                "family", "queries", "true hits", "FN", "FP", "times", "thrown", "near", "unproved",
                "filter%", "exact%", "hard%");
  std::string table = line.data(), failures;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const LeafTally& t = tallies[i];
    const auto share = [&](std::uint64_t n) {
      return t.queries == 0 ? 0.0 : 100.0 * static_cast<double>(n) / static_cast<double>(t.queries);
    };
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::snprintf(line.data(), line.size(),
                  "%-10s %10llu %10llu %6llu %6llu %6llu %6llu %6llu %8llu %8.3f %8.3f %8.3f\n",
                  names[i].c_str(), number(t.queries), number(t.trueHits), number(t.falseNegatives),
                  number(t.falsePositives), number(t.wrongTimes), number(t.thrown),
                  number(t.nearHits), number(t.unproved), share(t.stages[0]), share(t.stages[1]),
                  share(t.hardTruths));
    table += line.data();
    for (const std::string& f : t.failures) failures += f;
  }
  return table + failures;
}

}  // namespace foretouch::test
