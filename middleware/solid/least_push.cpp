#include "middleware/solid/least_push.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr int kRounds = 8;
/// Rows of one LSS that one round takes up: its two ends.
constexpr int kRowsPerLss = 2;
/// A row counts as kept within this (m): a thousandth of the least skin.
constexpr double kKept = 1e-8;
/// Share of a row's own product: two plates nearer than two skins have pushes all the same.
constexpr double kCompliance = 1e-4;
/// Rows that do not push are kept within this, so that those taken up are.
constexpr double kKeptInside = 0.1 * kKept;
/// Solutions by blocks, and how many of them may not be better than the best.
constexpr int kMostBlocks = 20, kBlockPatience = 3;

}  // namespace

double LeastPush::excess(const ContactRow& row, const TreeStep& step, const TreePull& pull,
                         const Eigen::Vector3d& origin) const {
  const auto link = slotOf(row.link);
  if (row.isTurn) {
    return row.n.dot(step.twists[link].w - step.twists[slotOf(row.other)].w) - row.bound - row.bias;
  }
  double along = row.n.dot(step.twists[link].at(row.x - origin) + pull.drifts[link]);
  if (row.other != kNoParent) {
    const auto other = slotOf(row.other);
    along -= row.n.dot(step.twists[other].at(row.y - origin) + pull.drifts[other]);
  }
  return along - row.bound - row.bias;
}

void LeastPush::begin() {
  taken_.clear();
  ways_.clear();
  isTaken_.clear();
  factor_.begin();
  isPushing_.assign(kMostRows, 0);
}

std::size_t LeastPush::solve(TreeInertia& inertia, const TreePull& pull,
                             const Eigen::Vector3d& origin, std::vector<ContactRow>& rows,
                             TreeStep& step) {
  products_.resize(kMostRows * kMostRows);
  isPushing_.resize(kMostRows, 0);
  isTaken_.resize(rows.size(), 0);
  frees_.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].push = 0.0;
    frees_[i] = excess(rows[i], step, pull, origin);
  }
  excesses_ = frees_;
  for (Taken& taken : taken_) taken.free = frees_[taken.row];
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) findExcesses(rows, step, pull, origin);
    const bool isAnyTaken = takeViolated(inertia, origin, rows);
    if (!isAnyTaken && (round > 0 || taken_.empty())) break;
    findPushes();
    forces_ = pull.forces;
    for (const Taken& taken : taken_) {
      if (!(taken.push > 0.0)) continue;
      const ContactRow& row = rows[taken.row];
      forces_[slotOf(row.link)] += taken.push * taken.onLink;
      if (row.other != kNoParent) forces_[slotOf(row.other)] += taken.push * taken.onOther;
    }
    inertia.solve(forces_, pull.torques, step.turns, step.shifts, step.twists);
  }
  for (const Taken& taken : taken_) rows[taken.row].push = taken.push;
  return taken_.size();
}

/// Finds the excesses of the rows that are not taken up.
void LeastPush::findExcesses(const std::vector<ContactRow>& rows, const TreeStep& step,
                             const TreePull& pull, const Eigen::Vector3d& origin) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (isTaken_[i] == 0) excesses_[i] = excess(rows[i], step, pull, origin);
  }
}

/// Takes up the rows that the step breaks most, a few per LSS; false if there is none.
bool LeastPush::takeViolated(const TreeInertia& inertia, const Eigen::Vector3d& origin,
                             const std::vector<ContactRow>& rows) {
  bool isAnyTaken = false;
  std::size_t begin = 0;
  while (begin < rows.size()) {
    std::size_t end = begin + 1;
    while (end < rows.size() && rows[end].link == rows[begin].link &&
           rows[end].lss == rows[begin].lss) {
      ++end;
    }
    std::array<std::size_t, kRowsPerLss> worst{};
    std::array<double, kRowsPerLss> by{};
    by.fill(-kKept);
    for (std::size_t i = begin; i < end; ++i) {
      if (isTaken_[i] != 0) continue;
      const double excessHere = excesses_[i];
      if (excessHere < by[0]) {
        by[1] = by[0];
        worst[1] = worst[0];
        by[0] = excessHere;
        worst[0] = i;
      } else if (excessHere < by[1]) {
        by[1] = excessHere;
        worst[1] = i;
      }
    }
    for (std::size_t k = 0; k < kRowsPerLss && by[k] < -kKept; ++k) {
      if (taken_.size() == kMostRows) return isAnyTaken;
      take(inertia, origin, rows[worst[k]], worst[k]);
      isAnyTaken = true;
    }
    begin = end;
  }
  return isAnyTaken;
}

void LeastPush::take(const TreeInertia& inertia, const Eigen::Vector3d& origin,
                     const ContactRow& row, std::size_t index) {
  Taken taken;
  taken.row = index;
  taken.onLink = taken.onOther = Vector6d::Zero();
  if (row.isTurn) {
    taken.onLink.head<3>() = row.n;
    taken.onOther.head<3>() = -row.n;
  } else {
    taken.onLink = wrench(row.x - origin, row.n);
    if (row.other != kNoParent) taken.onOther = -wrench(row.y - origin, row.n);
  }
  taken.free = frees_[index];
  taken.push = 0.0;
  taken.wayBegin = ways_.size();
  inertia.appendWay(row.link, taken.onLink, row.other, taken.onOther, ways_);
  taken.wayEnd = ways_.size();
  const std::size_t i = taken_.size();
  taken_.push_back(taken);
  isTaken_[index] = 1;
  const WayPart* const ways = ways_.data();
  for (std::size_t k = 0; k <= i; ++k) {
    product(i, k) = product(k, i) =
        TreeInertia::product(ways + taken.wayBegin, ways + taken.wayEnd, ways + taken_[k].wayBegin,
                             ways + taken_[k].wayEnd);
  }
  product(i, i) *= 1.0 + kCompliance;
}

/// Adds row by row of those that push, so that vectors add.
void LeastPush::findSlacks() {
  const std::size_t n = taken_.size();
  slacks_.resize(n);
  for (std::size_t i = 0; i < n; ++i) slacks_[i] = taken_[i].free;
  for (std::size_t k = 0; k < n; ++k) {
    const double push = taken_[k].push;
    if (push == 0.0) continue;
    const double* const row = &products_[k * kMostRows];
    for (std::size_t i = 0; i < n; ++i) slacks_[i] += row[i] * push;
  }
}

/// min 1/2 p A p + free p over p >= 0, exactly; A is positive definite. Goes on from what pushed
/// before.
void LeastPush::findPushes() {
  if (!exchangeBlocks()) exchangeOneByOne();
}

/// Block pivoting ([Kim11], REFERENCES.md): whatever is on the wrong side changes sides, all at
/// once. Nearly always done in a few solutions; false if it was not.
bool LeastPush::exchangeBlocks() {
  std::size_t fewest = taken_.size() + 1;
  int patience = kBlockPatience;
  for (int solution = 0; solution < kMostBlocks; ++solution) {
    std::size_t wrong = solveAsEquations();
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      taken_[i].push = isPushing_[i] != 0 ? wanted_[i] : 0.0;
    }
    findSlacks();
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      const bool isPushing = isPushing_[i] != 0;
      isWrong_[i] = isPushing ? !(wanted_[i] > 0.0) : slacks_[i] < -kKeptInside;
      if (isWrong_[i] != 0 && !isPushing) ++wrong;
    }
    if (wrong == 0) return true;
    if (wrong < fewest) {
      fewest = wrong;
      patience = kBlockPatience;
    } else if (--patience < 0) {
      return false;
    }
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      if (isWrong_[i] != 0) isPushing_[i] ^= 1U;
    }
  }
  return false;
}

/// The active set of [Lawson74] 23.3, which always ends.
void LeastPush::exchangeOneByOne() {
  for (Taken& taken : taken_) taken.push = 0.0;
  isPushing_.assign(kMostRows, 0);
  const std::size_t mostSteps = 3 * taken_.size() + 10;
  for (std::size_t step = 0; step < mostSteps; ++step) {
    std::size_t worst = taken_.size();
    double by = -kKeptInside;
    findSlacks();
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      if (isPushing_[i] != 0 || !(slacks_[i] < by)) continue;
      by = slacks_[i];
      worst = i;
    }
    if (worst == taken_.size()) return;
    isPushing_[worst] = 1;
    while (!goTowardsEquations()) {
    }
  }
}

/// Finds the pushes that hold all pushing rows exactly: wanted_. Returns how many are not above 0.
std::size_t LeastPush::solveAsEquations() {
  const std::size_t n = taken_.size();
  wanted_.assign(n, 0.0);
  isWrong_.assign(n, 0);
  right_.resize(n);
  for (std::size_t i = 0; i < n; ++i) right_[i] = -taken_[i].free;
  factor_.choose(isPushing_, n, products_.data());
  factor_.solve(right_, wanted_);
  return static_cast<std::size_t>(
      std::count_if(factor_.rows().begin(), factor_.rows().end(),
                    [this](std::size_t row) { return !(wanted_[row] > 0.0); }));
}

/// Moves the pushes towards those of the equations; false if one had to be let go on the way.
bool LeastPush::goTowardsEquations() {
  if (solveAsEquations() == 0) {
    for (std::size_t i = 0; i < taken_.size(); ++i) taken_[i].push = wanted_[i];
    return true;
  }
  double share = 1.0;
  std::size_t stops = taken_.size();
  for (std::size_t i = 0; i < taken_.size(); ++i) {
    if (isPushing_[i] == 0 || wanted_[i] > 0.0) continue;
    const double now = taken_[i].push;
    const double here = now > 0.0 ? now / (now - wanted_[i]) : 0.0;
    if (stops == taken_.size() || here < share) {
      share = here;
      stops = i;
    }
  }
  for (std::size_t i = 0; i < taken_.size(); ++i) {
    if (isPushing_[i] != 0) taken_[i].push += share * (wanted_[i] - taken_[i].push);
  }
  taken_[stops].push = 0.0;
  isPushing_[stops] = 0;
  return false;
}

}  // namespace foretouch::internal
