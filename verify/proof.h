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
  std::int64_t pairs = 0;                  ///< Pairs of own links.
  std::int64_t byBoxes = 0, byPlanes = 0;  ///< Triangles, each once per span.
};

/// What a capsule stays in over a span: the hull of four points, grown by `reach`.
struct Hull {
  std::vector<Vector> corners;
  double reach = 0.0;
  std::array<double, 3> least{}, most{};  ///< A box around all of it, rounded outward.
  bool isKnown = false;                   ///< Else nothing may be made of it.

  /// Over a span of length D in t, a point of a capsule's axis is within A D^2 / 8 of the chord
  /// between its places at both ends, A at least its acceleration. `more`: beyond its radius.
  static Hull of(const Capsule& capsule, const LinkPlace& begin, const LinkPlace& end,
                 const Motion::Bound& bound, int level, double more);
  /// Every point of it is surely beyond the plane's offset.
  [[nodiscard]] bool isInFrontOf(const Plane& plane) const;
  /// Every point of it is surely not beyond the plane's offset.
  [[nodiscard]] bool isBehind(const Plane& plane) const;
};

/// The spans follow each other from t = 0 to t = 1, and `why` is empty for each; else which fails.
template <typename Why>
Fault proveSpans(const std::vector<Span>& spans, long long line, const Why& why) {
  std::int64_t reached = 0;  // in units of 2^-kDeepestLevel
  for (const Span& span : spans) {
    const int deeper = kDeepestLevel - span.level;
    if (span.index << deeper != reached)
      return {span.line, "it does not begin where the last ended"};
    reached = (span.index + 1) << deeper;
    std::string what = why(span);
    if (!what.empty()) return {span.line, std::move(what)};
  }
  if (reached != std::int64_t{1} << kDeepestLevel) return {line, "its spans end before t = 1"};
  return {};
}

/// Triangles and their boxes.
class SceneProof {
 public:
  explicit SceneProof(std::vector<Triangle> triangles);

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

  /// Where the claim is not proven: its line, and which span of which LSS; nothing: it is proven.
  ///
  /// Every triangle has to be apart from the box around the capsule's hull, or behind one of the
  /// span's planes, in front of which the hull has to be. The spans have to follow each other from
  /// t = 0 to t = 1.
  [[nodiscard]] Fault prove(const std::vector<Link>& links, const StepClaim& claim, Motion& motion,
                            Tally& tally) const;
  /// The same for one link, which has to keep more than `clearance` away from all that is not in
  /// `ignored`.
  [[nodiscard]] Fault prove(const std::vector<Link>& links, const LinkClaim& claim, Motion& motion,
                            double clearance, const std::vector<Ignored>& ignored,
                            Tally& tally) const;

 private:
  [[nodiscard]] static bool isBehind(const Triangle& triangle, const Plane& plane);
  [[nodiscard]] std::string proveSpan(const Hull& hull, const Span& span,
                                      const std::vector<Ignored>& ignored, Tally& tally) const;

  std::vector<Triangle> triangles_;
  std::array<std::vector<double>, 3> least_, most_;  // per triangle: its box
};

}  // namespace verify
