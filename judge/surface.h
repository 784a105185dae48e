// judge/surface.h: a judge's interface to the surface of a moving link: it proves spans of the
// motion free of what the link may touch. Made of pieces, each the points within a radius of a
// core: one segment (capsule_prover.h), or many triangles without radius (mesh_prover.h), against
// the triangles of a scene; or segments and triangles against those of another link
// (pair_prover.h).
#pragma once

#include <cstdint>
#include <optional>

#include "judge/distance.h"
#include "judge/scene.h"
#include "judge/vector.h"

namespace foretouch::oracle {

/// Two numbers of the proof. Lengths in metres; `scale` is the larger of 1 m and the chain's reach.
/// The oracle's own rounding is about 1e-18 * scale, so this guard still detects a product that is
/// late by a few of its own last places.
inline constexpr Real kSoundGuard = 1e-15L;
/// Spans shorter than this that neither prove free nor show contact hold a separation within (speed
/// * 1e-12) of zero: a touch within rounding, which we count and ignore.
inline constexpr Real kShortestSpan = 0x1p-40L;

struct SpanOutcome {
  bool free = false;             ///< Separation > -guard proved throughout, grazing spans apart.
  Real freeUntil = 0;            ///< Proved from the span's start up to here.
  std::optional<Real> touching;  ///< An instant with separation < -guard; then not free.
  Real separation = 0;           ///< At `touching`.
  std::uint64_t grazing = 0, looks = 0;
};

class MovingSurface {
 public:
  virtual ~MovingSurface() = default;

  [[nodiscard]] virtual SpanOutcome prove(Real from, Real to) = 0;
  /// At one instant, the least over the other side; `within` if nothing is nearer.
  [[nodiscard]] virtual Real separationAt(Real t, double within) const = 0;
  /// At one instant, the separation of one piece and one of the other side's.
  [[nodiscard]] virtual Real separationFrom(int piece, int other, Real t) const = 0;
  /// The distance of a point in the world and a piece's core.
  [[nodiscard]] virtual Real distanceToCore(int piece, const Vec3r& point, Real t) const = 0;
  /// The same for the other side.
  [[nodiscard]] virtual Real distanceToOther(int other, const Vec3r& point, Real t) const = 0;
  /// The radius of a piece, and that of the other side's, where these two meet.
  [[nodiscard]] virtual Real radius(int piece, int other) const = 0;
  [[nodiscard]] virtual Real radiusOfOther(int piece, int other) const = 0;
  [[nodiscard]] virtual int numPieces() const = 0;
  /// The triangles of the scene, or the other link's pieces.
  [[nodiscard]] virtual int numOthers() const = 0;
  /// The length that multiplies the guards: for separations, and for points in the world.
  [[nodiscard]] virtual Real scale() const = 0;
  [[nodiscard]] virtual Real scaleInWorld() const { return scale(); }
};

/// What every surface answers alike against a scene, which must outlive it.
class SurfaceInScene : public MovingSurface {
 public:
  explicit SurfaceInScene(const Scene& scene) : scene_(scene) {}

  [[nodiscard]] Real distanceToOther(int other, const Vec3r& point, Real) const override {
    Corners<Real> corners = cornersOf<Real>(scene_.triangle(other));
    for (Vec3r& corner : corners) corner = corner - point;
    return closestPoints(Vec3r{}, Vec3r{}, corners).distance;
  }
  [[nodiscard]] Real radiusOfOther(int, int) const override { return 0; }
  [[nodiscard]] int numOthers() const override { return scene_.numTriangles(); }

 protected:
  const Scene& scene_;
};

}  // namespace foretouch::oracle
