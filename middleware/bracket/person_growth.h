// middleware/bracket/person_growth.h: how far a link may be from the pieces that stand for it, as a
// growth of its radii in each piece. Proof: bracket.md 2 to 4. Not installed.
#pragma once

#include <optional>

#include "middleware/bracket/bracket.h"
#include "middleware/pair/growth.h"

namespace foretouch::internal {

/// A person who may be farther (m) from the model may be anywhere: nothing is claimed of them, and
/// the triangles around so large a body are not looked at.
[[nodiscard]] bool isSaid(double growth);

/// error + 4 most u (1 - u) with u in [0,1] of the step: nothing if no bound is claimed. `bend`: of
/// the poses around the step (m); infinite if they are not known.
struct StepGrowth {
  double error = 0.0, most = 0.0;

  [[nodiscard]] static std::optional<StepGrowth> of(const LinkBound& bound, double seconds,
                                                    double bend);
  /// The growth in the piece [begin, end] of the step, in the piece's own t; `stray`: how far the
  /// piece is from the model between its ends (m).
  [[nodiscard]] Growth in(double begin, double end, double stray) const;
  [[nodiscard]] double largest() const { return error + most; }
};

}  // namespace foretouch::internal
