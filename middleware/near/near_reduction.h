// middleware/near/near_reduction.h: the places that a solver of contacts needs, of all those where
// one LSS is near. Metres, W. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "middleware/lanes/near_bins.h"
#include "middleware/near/near_places.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// Nearer first, then by the triangles' vertices, so that the order does not depend on their
/// numbers.
[[nodiscard]] bool comesBefore(const Scene& scene, const NearPlace& x, const NearPlace& y);

/// Keeps the nearest place in each bin, and of these the ones that no nearer one stands for. The
/// result is a function of the set of places that were offered. Fixed memory.
class NearReduction final : public NearFilter {
 public:
  NearReduction();

  /// Forgets the last LSS. `R_WL`: its link's; directions are told apart in its frame, so
  /// that a motion of all does not change the answer.
  void begin(const Scene& scene, const StandingLss& lss, const Eigen::Matrix3d& R_WL);
  void offer(const NearPlace& place);
  /// False: both bins that it could be in have a nearer one.
  [[nodiscard]] bool mayWin(const Eigen::Vector3d& difference, double along,
                            double distance) const override;
  /// What a place must not exceed to win.
  [[nodiscard]] const NearBins& bins() const { return bins_; }
  /// Appends what is left. O(bins^2) at most, few in practice.
  void finish(std::vector<NearPlace>& left);

 private:
  [[nodiscard]] std::size_t binsOf(const Eigen::Vector3d& direction_W, double along) const;
  void accept(bool faces);
  [[nodiscard]] bool isStoodFor(const NearPlace& place) const;
  [[nodiscard]] bool isKeptAbove(const NearPlace& place) const;
  [[nodiscard]] bool isKeptAbove(const NearPlace& face, bool atB) const;

  const Scene* scene_ = nullptr;
  const StandingLss* lss_ = nullptr;
  NearBins bins_;
  std::array<std::uint16_t, NearBins::kCount> slots_{};  // one more than the place's; 0: none
  std::vector<NearPlace> places_, accepted_;
  std::vector<std::size_t> heldBins_;  // of places_
  std::vector<std::uint16_t> order_;
};

}  // namespace foretouch::internal
