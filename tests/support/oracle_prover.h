// tests/support/oracle_prover.h: proves a span of a capsule's motion free of the scene, or finds an
// instant of contact in it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/support/oracle_distance.h"
#include "tests/support/oracle_motion.h"
#include "tests/support/oracle_scene.h"

namespace foretouch::oracle {

/// All points within `radius` of the axis ends[0] to ends[1], in the link's frame.
struct Capsule {
  std::array<Vec3d, 2> ends;
  double radius = 0.0;
};

/// Two numbers of the proof. Lengths in metres; `scale` is the larger of 1 m and the chain's reach.
/// The oracle's own rounding is about 1e-18 * scale, so this guard still sees a product that is
/// late by a few of its own last places.
inline constexpr Real kSoundGuard = 1e-15L;
/// Spans shorter than this that neither prove free nor show contact hold a separation within
/// (speed * 1e-12) of zero: a touch within rounding, counted and let pass.
inline constexpr Real kShortestSpan = 0x1p-40L;

struct SpanOutcome {
  bool free = false;             ///< Separation > -guard proved throughout, grazing spans apart.
  Real freeUntil = 0;            ///< Proved from the span's start up to here.
  std::optional<Real> touching;  ///< An instant with separation < -guard; then not free.
  Real separation = 0;           ///< At `touching`.
  std::uint64_t grazing = 0, looks = 0;
};

/// Cuts a span in halves until each is proved: at its middle the distance exceeds all the way that
/// the axis can go in half the span, or a plane between axis and triangle stays uncrossed.
class Prover {
 public:
  Prover(const Scene& scene, const Motion& motion, int link, const Capsule& capsule);

  [[nodiscard]] SpanOutcome prove(Real from, Real to);

  /// At one instant, the least over the scene; `within` if nothing is nearer than that.
  [[nodiscard]] Real separationAt(Real t, double within = Box::kEmpty) const;
  /// At one instant, of one triangle.
  [[nodiscard]] Real separationFrom(int triangle, Real t) const;
  [[nodiscard]] std::array<Vec3r, 2> axisAt(Real t) const;
  [[nodiscard]] const Capsule& capsule() const { return capsule_; }

  /// The length that guards are multiplied with.
  [[nodiscard]] Real scale() const { return scale_; }
  /// Looks at spans after which a proof is given up; SpanOutcome then is neither free nor touching.
  static constexpr std::uint64_t kMostLooks = 400'000;

 private:
  struct Look;
  bool proveSpan(Real from, Real to, const std::vector<int>* inherited);
  [[nodiscard]] bool gather(const Look& look, const std::vector<int>* inherited,
                            std::vector<int>& candidates) const;
  [[nodiscard]] bool isNear(const Look& look, int triangle) const;
  bool examine(const Look& look, int triangle);
  [[nodiscard]] Look lookAt(Real from, Real to) const;
  [[nodiscard]] Real pairSeparation(const std::array<Vec3r, 2>& axis, int triangle) const;
  /// Beyond doubt: inside by more than the guard, or the axis itself is pierced (all that there is
  /// to see of a capsule without radius).
  [[nodiscard]] bool touches(Real separation) const {
    return separation < -guard_ || separation <= -static_cast<Real>(capsule_.radius);
  }

  const Scene& scene_;
  const Motion& motion_;
  int link_;
  Capsule capsule_;
  Real scale_, guard_;
  SpanOutcome outcome_;
};

}  // namespace foretouch::oracle
