// judge/surface.h: a judge's interface to the surface of a moving link: it proves spans of the
// motion free of the scene. Made of pieces, each the points within `radius` of a core: one segment
// (capsule_prover.h), or many triangles without radius (mesh_prover.h).
#pragma once

#include <cstdint>
#include <optional>

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
  /// At one instant, the least over the scene; `within` if nothing is nearer.
  [[nodiscard]] virtual Real separationAt(Real t, double within) const = 0;
  /// At one instant, of one piece and one triangle of the scene.
  [[nodiscard]] virtual Real separationFrom(int piece, int triangle, Real t) const = 0;
  /// Of a point and a piece's core.
  [[nodiscard]] virtual Real distanceToCore(int piece, const Vec3r& point, Real t) const = 0;
  [[nodiscard]] virtual Real radius() const = 0;
  [[nodiscard]] virtual int numPieces() const = 0;
  /// The length that multiplies the guards.
  [[nodiscard]] virtual Real scale() const = 0;
};

}  // namespace foretouch::oracle
