// middleware/solid/least_push.h: the least change of a step that keeps all rows: min |dq - dq0|_M
// subject to J dq >= b, by its dual, whose unknowns are the pushes of the rows (solid.md 4). Not
// installed.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/mechanics/tree_inertia.h"
#include "middleware/solid/contact_row.h"
#include "middleware/solid/grown_factor.h"

namespace foretouch::internal {

/// A step of all links, as TreeInertia::solve() gives it.
struct TreeStep {
  std::vector<Eigen::Vector3d> turns, shifts;
  std::vector<Twist> twists;  ///< Without `drift`.
};

/// What the target pulls with.
struct TreePull {
  std::vector<Vector6d> forces;          ///< One per link.
  std::vector<Eigen::Vector3d> torques;  ///< One per joint.
  /// How far given changes of bone lengths move each link (m).
  std::vector<Eigen::Vector3d> drifts;
};

/// For one thread; keeps its memory.
class LeastPush {
 public:
  /// At most so many rows push at once; the certificate of the step sees to all others.
  static constexpr std::size_t kMostRows = GrownFactor::kMost;

  /// Forgets the rows that solve() has taken up: their places, or the inertia, are others now.
  void begin();
  /// `step` is the free one on entry, and the constrained one on return; rows get their pushes.
  /// `origin`: the inertia's coordinates'. Returns how many rows it has taken up since begin();
  /// since then, only bounds may have changed.
  std::size_t solve(TreeInertia& inertia, const TreePull& pull, const Eigen::Vector3d& origin,
                    std::vector<ContactRow>& rows, TreeStep& step);

 private:
  struct Taken {
    std::size_t row;  // its place among all
    std::size_t wayBegin, wayEnd;
    Vector6d onLink, onOther;  // wrench of a unit push
    double free;               // the row's excess at the free step
    double push;
  };
  [[nodiscard]] double excess(const ContactRow& row, const TreeStep& step, const TreePull& pull,
                              const Eigen::Vector3d& origin) const;
  [[nodiscard]] bool takeViolated(const TreeInertia& inertia, const Eigen::Vector3d& origin,
                                  const std::vector<ContactRow>& rows);
  void findExcesses(const std::vector<ContactRow>& rows, const TreeStep& step, const TreePull& pull,
                    const Eigen::Vector3d& origin);
  void take(const TreeInertia& inertia, const Eigen::Vector3d& origin, const ContactRow& row,
            std::size_t index);
  void findPushes();
  [[nodiscard]] bool exchangeBlocks();
  void exchangeOneByOne();
  void findSlacks();
  std::size_t solveAsEquations();
  [[nodiscard]] bool goTowardsEquations();
  [[nodiscard]] double& product(std::size_t i, std::size_t k) {
    return products_[i * kMostRows + k];
  }
  [[nodiscard]] double product(std::size_t i, std::size_t k) const {
    return products_[i * kMostRows + k];
  }

  std::vector<Taken> taken_;
  std::vector<WayPart> ways_;
  std::vector<double> products_;                   // J M^-1 J^T of the taken rows
  std::vector<std::uint8_t> isPushing_, isWrong_;  // of the taken rows
  GrownFactor factor_;                             // that of those that push
  std::vector<double> right_;     // of the taken rows: what pushes have to make up for
  std::vector<double> wanted_;    // of the taken rows: pushes that hold the pushing ones exactly
  std::vector<double> slacks_;    // of the taken rows, with the pushes
  std::vector<double> frees_;     // of all rows: their excess at the free step
  std::vector<double> excesses_;  // of all rows, at the step
  std::vector<std::uint8_t> isTaken_;
  std::vector<Vector6d> forces_;
};

}  // namespace foretouch::internal
