// judge/mesh_prover.h: proves a span of a link's motion free of the scene, or finds an instant of
// contact in it. The link's surface is a set of triangles.
#pragma once

#include <vector>

#include "judge/ball_tree.h"
#include "judge/certificate.h"
#include "judge/motion.h"
#include "judge/scene.h"
#include "judge/surface.h"

namespace foretouch::oracle {

/// Tries whole parts of the link as balls first: a part without scene triangles near it needs one
/// look. Otherwise halves the part if it is larger than its path in the span, else the span;
/// certificates decide single triangles as they do capsules (capsule_prover.h). Keeps references:
/// scene and motion outlive it.
class MeshProver final : public SurfaceInScene {
 public:
  /// `mesh` in the link's frame; may be empty.
  MeshProver(const Scene& scene, const Motion& motion, int link, const std::vector<Triangle>& mesh);

  [[nodiscard]] SpanOutcome prove(Real from, Real to) override;
  [[nodiscard]] Real separationAt(Real t, double within) const override;
  [[nodiscard]] Real separationFrom(int piece, int triangle, Real t) const override;
  [[nodiscard]] Real distanceToCore(int piece, const Vec3r& point, Real t) const override;
  [[nodiscard]] Real radius(int, int) const override { return 0; }
  [[nodiscard]] int numPieces() const override { return static_cast<int>(mesh_.size()); }
  [[nodiscard]] Real scale() const override { return scale_; }

  /// Looks after which a proof stops; SpanOutcome is then neither free nor touching.
  static constexpr std::uint64_t kMostLooks = 4'000'000;

 private:
  using Candidates = std::vector<int>;

  bool proveSpan(int part, Real from, Real to, const Candidates* inherited);
  bool proveHalves(const BallPart& part, Real from, Real to, const Candidates* candidates);
  /// False, with `candidates` unfinished, if there are too many.
  bool gather(const MovingPoint& center, double around, bool all, const Candidates* inherited,
              Candidates& candidates) const;
  void examine(int piece, Real middle, Real half, Candidates& candidates);
  void nearest(int index, Real t, Real& least) const;
  [[nodiscard]] Corners<Real> pieceAt(int piece, Real t) const;

  const Motion& motion_;
  int link_;
  std::vector<Triangle> mesh_;
  BallTree parts_;
  Real scale_ = 1, guard_ = 0;
  SpanOutcome outcome_;
};

}  // namespace foretouch::oracle
