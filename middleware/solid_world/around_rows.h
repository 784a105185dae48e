// middleware/solid_world/around_rows.h: where a solid avatar is near to the bodies around it, as
// rows for its solver, and how far their surfaces come while it moves. Metres in W. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/near/near_features.h"
#include "middleware/solid/contact_row.h"
#include "middleware/solid/own_features.h"
#include "middleware/solid_world/passage.h"

namespace foretouch::internal {

/// What a row is about, beyond what the row says.
struct AroundFeature {
  const AroundBody* body = nullptr;
  JointId joint = 0;         ///< On the leg's chain at the begin.
  JointId jointAtEnd = 0;    ///< On that at the end, where another one may carry it.
  std::int32_t lss = -1;     ///< On that joint; -1: a mesh.
  TriangleId triangle = -1;  ///< In the mesh.
  double comes = 0.0;        ///< How far its surface comes along the row's normal (m).
  Eigen::Vector3d velocity_W = Eigen::Vector3d::Zero();  ///< Its surface's in the window, m/s.
};

/// For one thread; keeps its memory.
class AroundRows {
 public:
  /// Finds the rows of everything within reach at the window's begin: `rows` gets them appended,
  /// without bounds. `states`: the avatar's links there. `reach`: per link; what a body itself
  /// moves in the window comes on top.
  void append(PassageProver& prover, const Surroundings& around, std::int64_t beginUs,
              std::int64_t endUs, const std::vector<LinkState>& states,
              const std::vector<double>& reach, std::vector<ContactRow>& rows);
  /// Those of the rows appended, in order.
  [[nodiscard]] const std::vector<AroundFeature>& features() const { return features_; }
  /// The gap of a row's pair at the window's end, with the avatar's links at `states`: a lower
  /// bound.
  [[nodiscard]] double gapAtEnd(const ContactRow& row, const AroundFeature& feature,
                                const std::vector<std::vector<Lss>>& volumes,
                                const std::vector<LinkState>& states) const;
  /// How far any body near the avatar moves in the window, at most.
  [[nodiscard]] double farthestMove() const { return farthestMove_; }
  /// A body's joint at both ends of the window; it must have been there (placed()).
  struct Placed {
    const AroundBody* body;
    const AroundLeg *atBegin, *atEnd;
    std::vector<LinkState> begin, end;
    double moves;
  };
  [[nodiscard]] const Placed* placed(const AroundBody* body) const;

 private:
  [[nodiscard]] Placed& place(const AroundBody& body, std::int64_t beginUs, std::int64_t endUs);
  void appendLss(const Placed& at, const PassageProver& prover,
                 const std::vector<LinkState>& states, const std::vector<double>& reach,
                 std::vector<ContactRow>& rows);
  void appendMesh(const Placed& at, PassageProver& prover, const std::vector<LinkState>& states,
                  const std::vector<double>& reach, std::vector<ContactRow>& rows);
  void push(const Placed& at, JointId joint, const ContactRow& row, std::int32_t lss,
            TriangleId triangle, std::vector<ContactRow>& rows);

  std::vector<AroundFeature> features_;
  std::vector<Placed> placed_;  // longer than the count
  std::size_t count_ = 0;
  double farthestMove_ = 0.0, windowS_ = 0.0;
  Scratch scratch_;
  NearFeatures near_;
  std::vector<LinkState> seen_;
  std::vector<double> reach_;
};

}  // namespace foretouch::internal
