#include "tools/repair/least_change.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lss/index.h"
#include "tools/repair/banded.h"

namespace foretouch::tools {
namespace {

/// Cost per square metre (or unit) by which a row is missed, in the first round of multipliers, and
/// by how much it grows from one to the next: in the end above the stiffness of any smooth change,
/// and no higher, so that rows which contradict each other do not tear at the body.
constexpr double kFirstStiffness = 1e5, kGrowth = 10.0, kMostStiffness = 1e6;
/// The same for wishes: a millimetre costs as much as the body's way over some poses.
constexpr double kWish = 1e3;
/// Rounds of multipliers, and at most so many choices of the rows that push in each.
constexpr int kMultiplierRounds = 8, kChoices = 20;
/// A row is met within this (m, or the knob's unit).
constexpr double kMet = 1e-6;
/// Numbers that change by less do not change (m, rad).
constexpr double kNoWay = 1e-9;
/// More than this of a way is all of it.
constexpr double kWhole = 1.0 - 1e-6;
/// Smoothing over more poses than this is no smoother to the eye, and doubles cannot resolve it.
constexpr double kMostReach = 14.0;

/// Differences of order 0 to 3, and what each counts in (1 - reach^2 d^2)^3: times reach^(2 order).
constexpr std::int32_t kOrders = 4;
constexpr double kDifference[kOrders][kOrders] = {
    {1.0, 0.0, 0.0, 0.0}, {-1.0, 1.0, 0.0, 0.0}, {1.0, -2.0, 1.0, 0.0}, {-1.0, 3.0, -3.0, 1.0}};
constexpr double kCounts[kOrders] = {1.0, 3.0, 3.0, 1.0};

class Solver {
 public:
  Solver(const Eigen::MatrixXd& metric, std::int32_t poses, std::vector<Row>& rows,
         const LeastChangeOptions& options)
      : metric_(metric), poses_(poses), rows_(rows), options_(options) {
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
  void addCost(BandedSystem& system) const;
  [[nodiscard]] std::vector<Pull> pullsAt(const Eigen::VectorXd& x) const;
  [[nodiscard]] double shareTo(const Eigen::VectorXd& aim, const Eigen::VectorXd& x) const;
  [[nodiscard]] bool solveFor(const std::vector<Pull>& pulls, Eigen::VectorXd& x);
  [[nodiscard]] double valueOf(const Row& row, const Eigen::VectorXd& x) const;
  /// The place among the poses that change; -1 if it does not.
  [[nodiscard]] int placeOf(std::int32_t pose) const {
    return pose < 0 || pose >= poses_ ? -1 : poseAt_[slotOf(pose)];
  }
  /// The place of a number that changes.
  [[nodiscard]] int placeOf(const RowTerm& term) const {
    return placeOf(term.pose) * numKnobs_ + knobAt_[slotOf(term.knob)];
  }

  const Eigen::MatrixXd& metric_;
  double stiffness_ = kFirstStiffness;
  std::int32_t poses_;
  std::vector<Row>& rows_;
  const LeastChangeOptions& options_;
  std::vector<int> poseAt_, knobAt_;    // -1: does not change
  std::vector<std::int32_t> changing_;  // knobs
  int numPoses_ = 0, numKnobs_ = 0;
  std::unique_ptr<const BandedSystem> cost_;
};

/// The poses and knobs that may change. Wishes about others have nothing to wish for.
void Solver::findPlaces() {
  std::vector<std::uint8_t> isNear(static_cast<std::size_t>(poses_), 0);
  std::vector<std::uint8_t> isNamed(slotOf(metric_.rows()), 0);
  for (const Row& row : rows_) {
    if (row.isWish) continue;
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
  knobAt_.assign(slotOf(metric_.rows()), -1);
  for (std::size_t knob = 0; knob < slotOf(metric_.rows()); ++knob) {
    if (isNamed[knob] == 0) continue;
    knobAt_[knob] = numKnobs_++;
    changing_.push_back(static_cast<std::int32_t>(knob));
  }
  for (Row& row : rows_) {
    const auto stays = [&](const RowTerm& term) {
      return poseAt_[slotOf(term.pose)] < 0 || knobAt_[slotOf(term.knob)] < 0;
    };
    row.terms.erase(std::remove_if(row.terms.begin(), row.terms.end(), stays), row.terms.end());
  }
}

void Solver::addCost(BandedSystem& system) const {
  const double square = std::pow(std::min(options_.reach, kMostReach), 2);
  Eigen::MatrixXd metric(numKnobs_, numKnobs_);
  for (Eigen::Index k = 0; k < numKnobs_; ++k) {
    for (Eigen::Index l = 0; l < numKnobs_; ++l) {
      metric(k, l) = metric_(changing_[slotOf(k)], changing_[slotOf(l)]);
    }
  }
  double scale = 1.0;
  for (std::int32_t order = 0; order < kOrders; ++order, scale *= square) {
    for (std::int32_t pose = -order; pose < poses_; ++pose) {
      // Beyond an end that is free nothing is known.
      const bool isBeyond =
          (pose < 0 && options_.isFreeBefore) || (pose + order >= poses_ && options_.isFreeAfter);
      for (std::int32_t i = 0; i <= order && !isBeyond; ++i) {
        const int one = placeOf(pose + i);
        for (std::int32_t j = 0; j <= i && one >= 0; ++j) {
          const int other = placeOf(pose + j);
          if (other < 0) continue;
          const double by = kDifference[order][i] * kDifference[order][j];
          system.block(slotOf(one), slotOf(one - other)) += scale * kCounts[order] * by * metric;
        }
      }
    }
  }
}

double Solver::valueOf(const Row& row, const Eigen::VectorXd& x) const {
  double value = 0.0;
  for (const RowTerm& term : row.terms) value += term.by * x[placeOf(term)];
  return value;
}

/// By the augmented Lagrangian: a row pushes where its multiplier and its miss say so.
std::vector<Solver::Pull> Solver::pullsAt(const Eigen::VectorXd& x) const {
  std::vector<Pull> pulls;
  pulls.reserve(rows_.size());
  for (const Row& row : rows_) {
    const double shifted = valueOf(row, x) - (row.isWish ? 0.0 : row.push / stiffness_);
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
  BandedSystem system = *cost_;
  x.setZero();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (!pulls[r].isOn) continue;
    const auto& terms = rows_[r].terms;
    const double stiffness = rows_[r].isWish ? kWish : stiffness_;
    const double towards = stiffness * pulls[r].bound + (rows_[r].isWish ? 0.0 : rows_[r].push);
    for (const RowTerm& one : terms) {
      const int at = placeOf(one.pose);
      x[placeOf(one)] += one.by * towards;
      for (const RowTerm& other : terms) {
        const int beside = placeOf(other.pose);
        if (beside > at) continue;
        system.block(slotOf(at), slotOf(at - beside))(knobAt_[slotOf(one.knob)],
                                                      knobAt_[slotOf(other.knob)]) +=
            stiffness * one.by * other.by;
      }
    }
  }
  if (!system.factorize()) return false;
  system.solve(x);
  return x.allFinite();
}

/// How much of the way from x to `aim` the cost falls: between the places at which a row begins or
/// ends to pull, it is a parabola. Whole ways, without this, go round in circles.
double Solver::shareTo(const Eigen::VectorXd& aim, const Eigen::VectorXd& x) const {
  const Eigen::VectorXd way = aim - x;
  // The slope and how it grows: those of the change itself,
  const Eigen::VectorXd costs = cost_->times(way);
  double slope = x.dot(costs), grows = way.dot(costs);
  // and of each row, from where it begins to pull, or until it ends to.
  std::vector<std::pair<double, double>> bends;  // share of the way, growth
  for (const Row& row : rows_) {
    const double stiffness = row.isWish ? kWish : stiffness_;
    const double from = valueOf(row, x) - (row.isWish ? 0.0 : row.push / stiffness_);
    const double by = valueOf(row, way), growth = stiffness * by * by;
    if (by == 0.0) continue;
    const double lower = (row.lower - from) / by, upper = (row.upper - from) / by;
    const double missed = from < row.lower ? from - row.lower : std::max(0.0, from - row.upper);
    slope += stiffness * missed * by;
    if (missed != 0.0) grows += growth;
    const double ends = std::min(lower, upper), begins = std::max(lower, upper);
    if (ends > 0.0) bends.emplace_back(ends, -growth);
    if (begins > 0.0) bends.emplace_back(begins, growth);
  }
  std::sort(bends.begin(), bends.end());
  double at = 0.0;
  for (const auto& [bend, growth] : bends) {
    if (bend >= 1.0 || slope + grows * (bend - at) >= 0.0) break;
    slope += grows * (bend - at);
    at = bend;
    grows += growth;
  }
  return grows > 0.0 ? std::clamp(at - slope / grows, 0.0, 1.0) : 1.0;
}

LeastChange Solver::solve() {
  LeastChange answer;
  answer.changes = Changes::Zero(metric_.rows(), poses_);
  answer.isSolved = true;
  const int size = numPoses_ * numKnobs_;
  if (size == 0) return answer;
  auto cost = std::make_unique<BandedSystem>(slotOf(numPoses_), numKnobs_);
  addCost(*cost);
  cost_ = std::move(cost);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  for (Row& row : rows_) row.push = 0.0;
  for (int round = 0; round < kMultiplierRounds && answer.isSolved; ++round) {
    stiffness_ = std::min(kMostStiffness, kFirstStiffness * std::pow(kGrowth, round));
    std::vector<Pull> pulls = pullsAt(x);
    for (int choice = 0; choice < kChoices && answer.isSolved; ++choice) {
      Eigen::VectorXd aim = x;
      answer.isSolved = solveFor(pulls, aim);
      const double share = shareTo(aim, x);
      const double moved = share * (aim - x).lpNorm<Eigen::Infinity>();
      x += share * (aim - x);
      std::vector<Pull> next = pullsAt(x);
      const bool isSame = std::equal(pulls.begin(), pulls.end(), next.begin(), [](Pull a, Pull b) {
        return a.isOn == b.isOn && (!a.isOn || a.bound == b.bound);
      });
      pulls = std::move(next);
      if ((isSame && share > kWhole) || moved < kNoWay) break;
    }
    answer.worst = 0.0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Row& row = rows_[r];
      const double value = valueOf(row, x);
      if (row.isWish) continue;
      answer.worst = std::max({answer.worst, row.lower - value, value - row.upper});
      row.push = pulls[r].isOn ? row.push + stiffness_ * (pulls[r].bound - value) : 0.0;
    }
    if (answer.worst < kMet) break;
  }
  if (!answer.isSolved) return answer;
  for (std::int32_t pose = 0; pose < poses_; ++pose) {
    for (const std::int32_t knob : changing_) {
      if (placeOf(pose) >= 0) answer.changes(knob, pose) = x[placeOf({pose, knob, 0.0})];
    }
  }
  return answer;
}

}  // namespace

LeastChange leastChange(const Eigen::MatrixXd& metric, std::int32_t poses, std::vector<Row>& rows,
                        const LeastChangeOptions& options) {
  return Solver(metric, poses, rows, options).solve();
}

}  // namespace foretouch::tools
