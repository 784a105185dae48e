// judge/capsule_prover.h: proves a span of a capsule's motion free of the scene, or finds an
// instant of contact in it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "judge/distance.h"
#include "judge/motion.h"
#include "judge/scene.h"
#include "judge/surface.h"

namespace foretouch::oracle {

/// All points within `radius` of the axis ends[0] to ends[1], in the link's frame.
struct Capsule {
  std::array<Vec3d, 2> ends;
  double radius = 0.0;
};

/// Halves a span until each part is proved: at its middle the distance exceeds the farthest that
/// the axis can move in half the span, or the axis cannot cross a plane between it and the
/// triangle.
class CapsuleProver final : public SurfaceInScene {
 public:
  CapsuleProver(const Scene& scene, const Motion& motion, int link, const Capsule& capsule);

  [[nodiscard]] SpanOutcome prove(Real from, Real to) override;
  [[nodiscard]] Real separationAt(Real t, double within = Box::kEmpty) const override;
  [[nodiscard]] Real separationFrom(int piece, int triangle, Real t) const override;
  [[nodiscard]] Real distanceToCore(int piece, const Vec3r& point, Real t) const override;
  [[nodiscard]] Real radius(int, int) const override { return static_cast<Real>(capsule_.radius); }
  [[nodiscard]] int numPieces() const override { return 1; }
  [[nodiscard]] Real scale() const override { return scale_; }

  /// Looks at spans after which a proof stops; SpanOutcome is then neither free nor touching.
  static constexpr std::uint64_t kMostLooks = 400'000;

 private:
  struct Look;
  bool proveSpan(Real from, Real to, const std::vector<int>* inherited);
  [[nodiscard]] bool gather(const Look& look, const std::vector<int>* inherited,
                            std::vector<int>& candidates) const;
  [[nodiscard]] bool isNear(const Look& look, int triangle) const;
  bool examine(const Look& look, int triangle);
  [[nodiscard]] Look lookAt(Real from, Real to) const;
  [[nodiscard]] std::array<Vec3r, 2> axisAt(Real t) const;
  [[nodiscard]] Real pairSeparation(const std::array<Vec3r, 2>& axis, int triangle) const;
  /// Beyond doubt: inside by more than the guard, or the axis itself is pierced (the only sign for
  /// a capsule without radius).
  [[nodiscard]] bool touches(Real separation) const {
    return separation < -guard_ || separation <= -static_cast<Real>(capsule_.radius);
  }

  const Motion& motion_;
  int link_;
  Capsule capsule_;
  Real scale_, guard_;
  SpanOutcome outcome_;
};

}  // namespace foretouch::oracle
