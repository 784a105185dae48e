#include "verify/edge_proof.h"

#include <algorithm>
#include <set>

namespace verify {
namespace {

bool isApart(const Hull& a, const Hull& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.most[axis] < b.least[axis] || a.least[axis] > b.most[axis]) return true;
  }
  return false;
}

std::vector<Hull> hullsOf(const std::vector<Capsule>& capsules, const LinkPlace& begin,
                          const LinkPlace& end, const Motion::Bound& bound, int level,
                          double more) {
  std::vector<Hull> hulls;
  for (const Capsule& capsule : capsules) {
    hulls.push_back(Hull::of(capsule, begin, end, bound, level, more));
  }
  return hulls;
}

}  // namespace

/// It has LSS, and may not touch some triangle of the scene.
bool EdgeProof::isAsked(std::size_t link) const {
  const std::vector<Ignored>& ignored = statement_.ignored[link];
  const bool isAll =
      ignored.size() == 1 && ignored[0].first == 0 && ignored[0].end == scene_.size();
  return !links_[link].capsules.empty() && !isAll;
}

std::string EdgeProof::provePairSpan(const PairClaim& claim, const Span& span, int carrier,
                                     const Motion::Bound& ofA, const Motion::Bound& ofB,
                                     Motion& motion) const {
  const auto hulls = [&](std::size_t link, const Motion::Bound& bound, double more) {
    const LinkPlace begin = motion.in(carrier, span.level, span.index, link);
    const LinkPlace end = motion.in(carrier, span.level, span.index + 1, link);
    return hullsOf(links_[link].capsules, begin, end, bound, span.level, more);
  };
  // The clearance is between them: one of the two is grown by all of it.
  const auto a = hulls(claim.a, ofA, statement_.clearance), b = hulls(claim.b, ofB, 0.0);
  constexpr std::size_t kPairsPerWork = 16;
  motion.spend(a.size() * b.size() * (span.planes.size() + 1) / kPairsPerWork);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (!a[i].isKnown || !b[j].isKnown) return "a place that is not known";
      if (isApart(a[i], b[j])) continue;
      const bool isHeld = std::any_of(
          span.planes.begin(), span.planes.end(),
          [&](const Plane& plane) { return a[i].isInFrontOf(plane) && b[j].isBehind(plane); });
      if (!isHeld) {
        return "LSS " + std::to_string(i) + " of link " + std::to_string(claim.a) + " and LSS " +
               std::to_string(j) + " of link " + std::to_string(claim.b) +
               " have none of its planes between them";
      }
    }
  }
  return "";
}

Fault EdgeProof::provePair(const PairClaim& claim, Motion& motion, Tally& tally) const {
  if (claim.a >= links_.size() || claim.b >= links_.size() || claim.a == claim.b) {
    return {claim.line, "the avatar has no such pair of links"};
  }
  const int carrier = motion.carrierOf(claim.a, claim.b);
  const auto ofA = motion.boundIn(carrier, claim.a), ofB = motion.boundIn(carrier, claim.b);
  const auto why = [&](const Span& span) {
    std::string what = provePairSpan(claim, span, carrier, ofA, ofB, motion);
    if (!what.empty()) return what;
    ++tally.spans;
    tally.planes += static_cast<std::int64_t>(span.planes.size());
    return what;
  };
  Fault fault = proveSpans(claim.spans, claim.line, why);
  if (fault.what.empty()) ++tally.pairs;
  return fault;
}

Fault EdgeProof::prove(const StepClaim& claim, Motion& motion, Tally& tally) const {
  std::set<std::size_t> named;
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const LinkClaim& link : claim.links) {
    if (link.link >= links_.size()) return {link.line, "the avatar has no such link"};
    Fault fault = scene_.prove(links_, link, motion, statement_.clearance,
                               statement_.ignored[link.link], tally);
    if (!fault.what.empty()) return fault;
    named.insert(link.link);
  }
  for (const PairClaim& pair : claim.pairs) {
    Fault fault = provePair(pair, motion, tally);
    if (!fault.what.empty()) return fault;
    pairs.insert({pair.a, pair.b});
  }
  for (std::size_t link = 0; link < links_.size(); ++link) {
    if (isAsked(link) && named.count(link) == 0) {
      return {claim.line, "link " + std::to_string(link) + " is not proven apart from the scene"};
    }
  }
  for (const auto& [a, b] : statement_.pairs) {
    if (pairs.count({a, b}) > 0) continue;
    return {claim.line,
            "links " + std::to_string(a) + " and " + std::to_string(b) + " are not proven apart"};
  }
  ++tally.steps;
  return {};
}

}  // namespace verify
