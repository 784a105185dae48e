// verify/edge_proof.h: is what a certificate claims of an edge all that the statement asks, and is
// it proven?
#pragma once

#include <vector>

#include "verify/edges.h"
#include "verify/proof.h"

namespace verify {

class EdgeProof {
 public:
  /// All outlive it.
  EdgeProof(const SceneProof& scene, const std::vector<Link>& links, const EdgeStatement& statement)
      : scene_(scene), links_(links), statement_(statement) {}

  /// Where it is not proven; nothing: it is. Every link with LSS has to be named, but for those
  /// that may touch the whole scene, and every pair of the statement.
  ///
  /// For a pair, every LSS of one and every LSS of the other must have boxes apart, or a plane of
  /// the span between them, seen from the nearest link that carries both: only the joints below it
  /// move them against each other.
  [[nodiscard]] Fault prove(const StepClaim& claim, Motion& motion, Tally& tally) const;

 private:
  [[nodiscard]] Fault provePair(const PairClaim& claim, Motion& motion, Tally& tally) const;
  [[nodiscard]] std::string provePairSpan(const PairClaim& claim, const Span& span, int carrier,
                                          const Motion::Bound& ofA, const Motion::Bound& ofB,
                                          Motion& motion) const;
  [[nodiscard]] bool isAsked(std::size_t link) const;

  const SceneProof& scene_;
  const std::vector<Link>& links_;
  const EdgeStatement& statement_;
};

}  // namespace verify
