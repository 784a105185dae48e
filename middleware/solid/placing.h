// middleware/solid/placing.h: the nearest free place for an avatar that would begin inside
// something. Metres in W. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "middleware/solid/certifier.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/unfolding.h"

namespace foretouch::internal {

/// What else has a say about a place.
class PlaceJudge {
 public:
  PlaceJudge() = default;
  PlaceJudge(const PlaceJudge&) = delete;
  PlaceJudge& operator=(const PlaceJudge&) = delete;
  virtual ~PlaceJudge() = default;
  [[nodiscard]] virtual bool isFree(const Pose& place) = 0;
};

/// Tries the pose itself, unfolded where it touches itself, then moved on a grid, nearest first: up
/// and to the sides, not down through a floor. A search that one tick's work does not finish goes
/// on in the next. Free is not outside: a body inside a closed cupboard touches nothing.
class Placing {
 public:
  Placing(const Skeleton& skeleton, const SolidOptions& options);

  /// Forgets how far the search is.
  void reset() { next_ = 0; }
  /// Goes on searching around `asked`; true: `place` is free. Spends at most the tick's work, and
  /// leaves none if it found nothing. `judge`: asked about places that the certifier finds free.
  [[nodiscard]] bool search(const Pose& asked, Certifier& certifier, Pose& place,
                            PlaceJudge* judge = nullptr);

 private:
  void listOffsets();

  Skeleton skeleton_;
  Unfolding unfolding_;
  Eigen::Vector3d up_;
  double reach_;
  std::vector<Eigen::Vector3d> offsets_;  // listed at the first search
  std::size_t next_ = 0;
  Eigen::Vector3d begunAt_ = Eigen::Vector3d::Zero();  // the first root's place
};

}  // namespace foretouch::internal
