// judge/skin_prover.h: proves a span of a skin's motion free of the scene, or finds an instant of
// contact in it. Every corner of the skin's triangles is a weighted sum of points of several links.
#pragma once

#include <array>
#include <vector>

#include "judge/certificate.h"
#include "judge/motion.h"
#include "judge/scene.h"
#include "judge/surface.h"

namespace foretouch::oracle {

/// A link's share of a corner: weight times its place as the link moves it.
struct SkinShare {
  int link = 0;
  double weight = 0;
  Vec3d point;  ///< In the link's frame.
};
using SkinCorner = std::vector<SkinShare>;
using SkinTriangle = std::array<SkinCorner, 3>;

/// Triangle by triangle, each span halved until certificates decide it. Keeps references: scene and
/// motion outlive it.
class SkinProver final : public SurfaceInScene {
 public:
  SkinProver(const Scene& scene, const Motion& motion, std::vector<SkinTriangle> skin);

  [[nodiscard]] SpanOutcome prove(Real from, Real to) override;
  [[nodiscard]] Real separationAt(Real t, double within) const override;
  [[nodiscard]] Real separationFrom(int piece, int triangle, Real t) const override;
  [[nodiscard]] Real distanceToCore(int piece, const Vec3r& point, Real t) const override;
  [[nodiscard]] Real radius(int, int) const override { return 0; }
  [[nodiscard]] int numPieces() const override { return static_cast<int>(skin_.size()); }
  [[nodiscard]] Real scale() const override { return scale_; }

  /// Looks after which a proof stops; SpanOutcome is then neither free nor touching.
  static constexpr std::uint64_t kMostLooks = 4'000'000;

 private:
  using Candidates = std::vector<int>;

  bool proveSpan(int piece, Real from, Real to, const Candidates& inherited);
  void examine(const std::array<MovingPoint, 3>& corners, Real middle, Real half,
               Candidates& candidates);
  [[nodiscard]] std::array<MovingPoint, 3> cornersAt(int piece, Real t, Real half) const;
  [[nodiscard]] Corners<Real> pieceAt(int piece, Real t) const;
  [[nodiscard]] Box boxOf(const std::array<MovingPoint, 3>& corners, Real half) const;

  const Motion& motion_;
  std::vector<SkinTriangle> skin_;
  Real scale_ = 1, guard_ = 0;
  SpanOutcome outcome_;
};

}  // namespace foretouch::oracle
