// verify/proof.h: is what a certificate claims proven by its spans and planes?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "verify/certificate.h"
#include "verify/motion.h"
#include "verify/statement.h"

namespace verify {

struct Tally {
  std::int64_t steps = 0, links = 0, capsules = 0, spans = 0, planes = 0;
  std::int64_t byBoxes = 0, byPlanes = 0;  ///< Triangles, each once per span.
};

/// Triangles and their boxes.
class SceneProof {
 public:
  explicit SceneProof(std::vector<Triangle> triangles);

  /// Where the claim is not proven: its line, and which span of which LSS; nothing: it is proven.
  ///
  /// Over a span of length D in t, a point of a capsule's axis is within A D^2 / 8 of the chord
  /// between its places at both ends, A at least its acceleration. So the capsule stays in the hull
  /// of four points (both ends of the axis at both instants), grown by that and its radius. Every
  /// triangle has to be apart from the box around it, or behind one of the span's planes, in front
  /// of which it has to be. The spans have to follow each other from t = 0 to t = 1.
  [[nodiscard]] Fault prove(const std::vector<Link>& links, const StepClaim& claim, Motion& motion,
                            Tally& tally) const;

 private:
  struct Hull {
    std::vector<Vector> corners;
    double reach = 0.0;
  };
  [[nodiscard]] static Hull hullOf(const Capsule& capsule, std::size_t link, const Span& span,
                                   Motion& motion);
  [[nodiscard]] static bool isInFront(const Hull& hull, const Plane& plane);
  [[nodiscard]] static bool isBehind(const Triangle& triangle, const Plane& plane);
  [[nodiscard]] std::string proveSpan(const Hull& hull, const Span& span, Tally& tally) const;

  std::vector<Triangle> triangles_;
  std::array<std::vector<double>, 3> least_, most_;  // of each triangle's box
};

}  // namespace verify
