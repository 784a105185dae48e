// judge/pair_prover.h: proves a span of two links' motion free of contact between them, or finds an
// instant of contact in it. Both move; each is a set of hulls.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "judge/ball_tree.h"
#include "judge/certificate.h"
#include "judge/motion.h"
#include "judge/surface.h"

namespace foretouch::oracle {

/// Two pieces that count with another sum of radii (m) than their own; each with the same share of
/// its radius.
struct RadiusSum {
  int piece = 0, other = 0;
  double sum = 0.0;
};

/// Looks at both links from the frame of the deepest joint that moves both, where the joints above
/// it move neither. Tries parts of both as balls first; halves a part if one of the balls is larger
/// than the path of one part seen from the other, else the span; certificates decide pairs of
/// single hulls as they do capsules (capsule_prover.h). Keeps a reference: the motion outlives it.
class PairProver final : public MovingSurface {
 public:
  /// Neither link may be without hulls; all hulls of a side name the same link.
  PairProver(const Motion& motion, std::vector<Hull> one, std::vector<Hull> other,
             std::vector<RadiusSum> sums = {});

  [[nodiscard]] SpanOutcome prove(Real from, Real to) override;
  [[nodiscard]] Real separationAt(Real t, double within) const override;
  [[nodiscard]] Real separationFrom(int piece, int other, Real t) const override;
  [[nodiscard]] Real distanceToCore(int piece, const Vec3r& point, Real t) const override;
  [[nodiscard]] Real distanceToOther(int other, const Vec3r& point, Real t) const override;
  [[nodiscard]] Real radius(int piece, int other) const override;
  [[nodiscard]] Real radiusOfOther(int piece, int other) const override;
  [[nodiscard]] int numPieces() const override { return static_cast<int>(one_.hulls.size()); }
  [[nodiscard]] int numOthers() const override { return static_cast<int>(other_.hulls.size()); }
  [[nodiscard]] Real scale() const override { return scale_; }
  [[nodiscard]] Real scaleInWorld() const override { return scaleInWorld_; }

  /// Looks after which a proof stops; SpanOutcome is then neither free nor touching.
  static constexpr std::uint64_t kMostLooks = 4'000'000;

 private:
  struct Side {
    std::vector<Hull> hulls;
    BallTree parts;
    int link;

    explicit Side(std::vector<Hull> ofLink);
    [[nodiscard]] const Hull& hull(int piece) const {
      return hulls[static_cast<std::size_t>(piece)];
    }
  };
  /// A part of each side.
  struct Parts {
    int one = 0, other = 0;
  };

  bool proveInstant(Real t);
  bool proveSpan(Parts parts, Real from, Real to);
  bool proveHalves(Parts parts, Real from, Real to);
  [[nodiscard]] HullCheck examine(Parts parts, Real middle, Real half);
  void nearest(Parts parts, Real t, Real& least) const;
  /// Both halves of the part with the larger ball.
  [[nodiscard]] std::array<Parts, 2> halved(Parts parts) const;
  [[nodiscard]] MovingPoint centerOf(const Side& side, int part, Real t, Real half) const;
  [[nodiscard]] Real sumOf(int piece, int other) const;
  [[nodiscard]] Real shareOf(int piece, int other) const;
  [[nodiscard]] HullLook lookAt(const Side& side, int piece, Real middle, Real half,
                                const Vec3d* reference) const;
  [[nodiscard]] Real distanceInWorld(const Side& side, int piece, const Vec3r& point, Real t) const;

  const Motion& motion_;
  Side one_, other_;
  std::vector<RadiusSum> sums_;  // by piece, then by other
  int frame_;
  Real scale_ = 1, scaleInWorld_ = 1, guard_ = 0;
  SpanOutcome outcome_;
};

}  // namespace foretouch::oracle
