// tessellation/lss_table.h: an avatar's LSS as one plain array, and the number of spans of a motion
// that polynomials need to follow them. Metres. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/index.h"

namespace foretouch {

/// All LSS of an avatar in link order, with the values that every step needs. Immutable.
class LssTable {
 public:
  struct Entry {
    double a[3], b[3];  ///< Ends of the axis in the link's frame.
    double radius;
    double rhoA, rhoB;  ///< |a| and |b|, rounded up.
    LinkId link;
  };

  LssTable() = default;
  explicit LssTable(const Avatar& avatar);
  /// Becomes the table of other LSS, one list per link. Keeps its memory.
  void assign(const std::vector<std::vector<Lss>>& lssPerLink);

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(entries_.size()); }
  [[nodiscard]] const Entry* data() const { return entries_.data(); }
  [[nodiscard]] const Entry& operator[](std::int32_t lss) const { return entries_[slotOf(lss)]; }
  /// The link's LSS are [first(link), first(link + 1)).
  [[nodiscard]] std::int32_t first(LinkId link) const { return first_[slotOf(link)]; }
  [[nodiscard]] std::int32_t numLinks() const {
    return static_cast<std::int32_t>(first_.size()) - 1;
  }
  /// The links without LSS, ascending.
  [[nodiscard]] const std::vector<LinkId>& bareLinks() const { return bareLinks_; }
  /// Largest rhoA or rhoB of the link's LSS; 0 if it has none.
  [[nodiscard]] double rho(LinkId link) const { return rho_[slotOf(link)]; }
  /// The largest rhoA or rhoB, and the largest radius, of all links' LSS.
  [[nodiscard]] double largestRho() const { return largestRho_; }
  [[nodiscard]] double largestRadius() const { return largestRadius_; }

 private:
  void add(const std::vector<Lss>& lssOfLink);

  std::vector<Entry> entries_;
  std::vector<std::int32_t> first_{0};
  std::vector<double> rho_;
  std::vector<LinkId> bareLinks_;
  double largestRho_ = 0.0, largestRadius_ = 0.0;
};

/// Bound on the distance of a link's point at distance `rho` from the link's origin to the
/// polynomial of degree 7 through its positions at the nodes of a span of length `span` (of t):
/// interpolation alone, in exact arithmetic.
[[nodiscard]] double interpolationError(const MotionBounds& bounds, double rho, double span);

/// The least of 1, 2, 4, 8, 16 equal spans of [0,1] for which interpolationError() of every LSS is
/// at most `wantedError` (m); 16 if none is. O(links).
[[nodiscard]] int slabsFor(const LssTable& table, const ChainMotion& motion, double wantedError);

}  // namespace foretouch
