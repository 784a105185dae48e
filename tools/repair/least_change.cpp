#include "tools/repair/least_change.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCholesky>

namespace foretouch::tools {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Above the stiffness of the smoothest change by so much that a row is missed by no more than a
/// thousandth of what it asks after one round of multipliers; below what doubles resolve beside it.
constexpr double kStiffness = 1e8;
/// Rounds of multipliers, and of the choice of rows that push in each.
constexpr int kMultiplierRounds = 4, kChoices = 8;
/// A row is met within this (m, or the knob's unit).
constexpr double kMet = 1e-6;
/// Smoothing over more poses than this is no smoother to the eye, and doubles cannot tell.
constexpr double kMostReach = 14.0;

/// Differences of order 0 to 3, and what each counts in (1 - reach^2 d^2)^3: times reach^(2 order).
constexpr std::size_t kOrders = 4;
constexpr double kDifference[kOrders][kOrders] = {
    {1.0, 0.0, 0.0, 0.0}, {-1.0, 1.0, 0.0, 0.0}, {1.0, -2.0, 1.0, 0.0}, {-1.0, 3.0, -3.0, 1.0}};
constexpr double kCounts[kOrders] = {1.0, 3.0, 3.0, 1.0};

class Solver {
 public:
  Solver(const std::vector<Knob>& knobs, std::int32_t poses, std::vector<Row>& rows,
         const LeastChangeOptions& options)
      : knobs_(knobs), poses_(poses), rows_(rows), options_(options) {
    findPlaces();
  }

  LeastChange solve();

 private:
  /// Whether and to what bound a row pushes.
  struct Pull {
    bool isOn = false;
    double bound = 0.0;
  };

  void findPlaces();
  void addCost(Triplets& entries) const;
  void addDifference(std::size_t order, std::int32_t pose, std::int32_t knob, double scale,
                     Triplets& entries) const;
  [[nodiscard]] std::vector<Pull> pullsAt(const Eigen::VectorXd& x) const;
  [[nodiscard]] bool solveFor(const std::vector<Pull>& pulls, Eigen::VectorXd& x);
  [[nodiscard]] double valueOf(const Row& row, const Eigen::VectorXd& x) const;
  [[nodiscard]] int placeOf(std::int32_t pose, std::int32_t knob) const {
    if (pose < 0 || pose >= poses_) return -1;
    const int at = poseAt_[static_cast<std::size_t>(pose)];
    return at < 0 ? -1 : at * numKnobs_ + knobAt_[static_cast<std::size_t>(knob)];
  }

  const std::vector<Knob>& knobs_;
  std::int32_t poses_;
  std::vector<Row>& rows_;
  const LeastChangeOptions& options_;
  std::vector<int> poseAt_, knobAt_;  // -1: does not change
  std::vector<std::int32_t> changing_;  // knobs
  int numPoses_ = 0, numKnobs_ = 0;
  Sparse cost_;
};

/// The poses and knobs that may change.
void Solver::findPlaces() {
  std::vector<std::uint8_t> isNear(static_cast<std::size_t>(poses_), 0);
  std::vector<std::uint8_t> isNamed(knobs_.size(), 0);
  for (const Row& row : rows_) {
    for (const RowTerm& term : row.terms) {
      isNear[static_cast<std::size_t>(term.pose)] = 1;
      isNamed[static_cast<std::size_t>(term.knob)] = 1;
    }
  }
  poseAt_.assign(isNear.size(), -1);
  std::int32_t until = -1;  // poses before it may change
  std::vector<std::uint8_t> mayChange(isNear.size(), 0);
  for (std::int32_t pose = 0; pose < poses_; ++pose) {
    if (isNear[static_cast<std::size_t>(pose)] != 0) {
      for (std::int32_t p = std::max({0, until, pose - options_.margin}); p < pose; ++p)
        mayChange[static_cast<std::size_t>(p)] = 1;
      until = pose + options_.margin + 1;
    }
    if (pose < until) mayChange[static_cast<std::size_t>(pose)] = 1;
  }
  for (std::size_t pose = 0; pose < mayChange.size(); ++pose) {
    if (mayChange[pose] != 0) poseAt_[pose] = numPoses_++;
  }
  knobAt_.assign(knobs_.size(), -1);
  for (std::size_t knob = 0; knob < knobs_.size(); ++knob) {
    if (isNamed[knob] == 0) continue;
    knobAt_[knob] = numKnobs_++;
    changing_.push_back(static_cast<std::int32_t>(knob));
  }
}

void Solver::addCost(Triplets& entries) const {
  const double square = std::pow(std::min(options_.reach, kMostReach), 2);
  for (const std::int32_t knob : changing_) {
    double scale = knobs_[static_cast<std::size_t>(knob)].weight;
    for (std::size_t order = 0; order < kOrders; ++order, scale *= square) {
      const auto last = static_cast<std::int32_t>(order);
      for (std::int32_t pose = -last; pose < poses_; ++pose) {
        // Beyond an end that is free nothing is known.
        const bool isBeyond =
            (pose < 0 && options_.isFreeBefore) || (pose + last >= poses_ && options_.isFreeAfter);
        if (!isBeyond) addDifference(order, pose, knob, scale * kCounts[order], entries);
      }
    }
  }
}

void Solver::addDifference(std::size_t order, std::int32_t pose, std::int32_t knob, double scale,
                           Triplets& entries) const {
  for (std::size_t i = 0; i <= order; ++i) {
    const int one = placeOf(pose + static_cast<std::int32_t>(i), knob);
    for (std::size_t j = 0; j <= order && one >= 0; ++j) {
      const int other = placeOf(pose + static_cast<std::int32_t>(j), knob);
      const double by = scale * kDifference[order][i] * kDifference[order][j];
      if (other >= 0) entries.emplace_back(one, other, by);
    }
  }
}

double Solver::valueOf(const Row& row, const Eigen::VectorXd& x) const {
  double value = 0.0;
  for (const RowTerm& term : row.terms) value += term.by * x[placeOf(term.pose, term.knob)];
  return value;
}

/// By the augmented Lagrangian: a row pushes where its multiplier and its miss say so.
std::vector<Solver::Pull> Solver::pullsAt(const Eigen::VectorXd& x) const {
  std::vector<Pull> pulls;
  pulls.reserve(rows_.size());
  for (const Row& row : rows_) {
    const double shifted = valueOf(row, x) - row.push / kStiffness;
    if (shifted < row.lower) {
      pulls.push_back({true, row.lower});
    } else if (shifted > row.upper) {
      pulls.push_back({true, row.upper});
    } else {
      pulls.push_back({});
    }
  }
  return pulls;
}

bool Solver::solveFor(const std::vector<Pull>& pulls, Eigen::VectorXd& x) {
  Triplets entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(cost_.rows());
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (!pulls[r].isOn) continue;
    const auto& terms = rows_[r].terms;
    const double towards = kStiffness * pulls[r].bound + rows_[r].push;
    for (const RowTerm& one : terms) {
      const int at = placeOf(one.pose, one.knob);
      right[at] += one.by * towards;
      for (const RowTerm& other : terms) {
        const int beside = placeOf(other.pose, other.knob);
        if (beside <= at) entries.emplace_back(at, beside, kStiffness * one.by * other.by);
      }
    }
  }
  Sparse system(cost_.rows(), cost_.cols());
  system.setFromTriplets(entries.begin(), entries.end());
  system += cost_.triangularView<Eigen::Lower>();
  const Eigen::SimplicialLDLT<Sparse> factor(system);
  if (factor.info() != Eigen::Success) return false;
  x = factor.solve(right);
  return x.allFinite();
}

LeastChange Solver::solve() {
  LeastChange answer;
  answer.changes = Changes::Zero(static_cast<Eigen::Index>(knobs_.size()), poses_);
  answer.isSolved = true;
  const int size = numPoses_ * numKnobs_;
  if (size == 0) return answer;
  Triplets entries;
  addCost(entries);
  cost_.resize(size, size);
  cost_.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  for (Row& row : rows_) row.push = 0.0;
  for (int round = 0; round < kMultiplierRounds && answer.isSolved; ++round) {
    std::vector<Pull> pulls = pullsAt(x);
    for (int choice = 0; choice < kChoices && answer.isSolved; ++choice) {
      answer.isSolved = solveFor(pulls, x);
      std::vector<Pull> next = pullsAt(x);
      const bool isSame = std::equal(pulls.begin(), pulls.end(), next.begin(), [](Pull a, Pull b) {
        return a.isOn == b.isOn && (!a.isOn || a.bound == b.bound);
      });
      pulls = std::move(next);
      if (isSame) break;
    }
    answer.worst = 0.0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Row& row = rows_[r];
      const double value = valueOf(row, x);
      answer.worst = std::max({answer.worst, row.lower - value, value - row.upper});
      row.push = pulls[r].isOn ? row.push + kStiffness * (pulls[r].bound - value) : 0.0;
    }
    if (answer.worst < kMet) break;
  }
  if (!answer.isSolved) return answer;
  for (std::int32_t pose = 0; pose < poses_; ++pose) {
    for (const std::int32_t knob : changing_) {
      const int at = placeOf(pose, knob);
      if (at >= 0) answer.changes(knob, pose) = x[at];
    }
  }
  return answer;
}

}  // namespace

LeastChange leastChange(const std::vector<Knob>& knobs, std::int32_t poses, std::vector<Row>& rows,
                        const LeastChangeOptions& options) {
  return Solver(knobs, poses, rows, options).solve();
}

}  // namespace foretouch::tools
