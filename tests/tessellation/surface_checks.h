// tests/tessellation/surface_checks.h: independent checks of a swept surface: counts edges, decides
// inside and outside by exact crossings of a ray, and takes the true sweep from the oracle's motion
// in long double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "judge/motion.h"
#include "lss/lss.h"
#include "tessellation/swept_surface.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"
#include "tests/support/random_motion.h"

namespace foretouch::test {

/// Edges that are not shared by exactly two triangles in opposite directions.
inline std::size_t looseEdges(const SweptSurface& surface) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  std::size_t loose = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool isTwice = i > 0 && edges[i] == edges[i - 1];
    const bool hasOther =
        std::binary_search(edges.begin(), edges.end(), std::pair{edges[i].second, edges[i].first});
    loose += isTwice || !hasOther || edges[i].first == edges[i].second;
  }
  return loose;
}

/// Vertices around which the triangles are not one ring.
inline std::size_t brokenRings(const SweptSurface& surface) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> next;
  for (const auto& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) next[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
  }
  std::size_t broken = 0;
  for (const auto& [vertex, ring] : next) {
    std::size_t seen = 0;
    std::uint32_t at = ring.begin()->first;
    do {
      const auto step = ring.find(at);
      if (step == ring.end()) break;
      at = step->second;
      ++seen;
    } while (at != ring.begin()->first && seen <= ring.size());
    broken += seen != ring.size();
  }
  return broken + (surface.vertices.size() - next.size());
}

inline double volumeOf(const SweptSurface& surface) {
  long double six = 0.0L;
  const Eigen::Vector3d origin = surface.vertices[0];
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d a = surface.vertices[t[0]] - origin, b = surface.vertices[t[1]] - origin,
                          c = surface.vertices[t[2]] - origin;
    six += static_cast<long double>(a.dot(b.cross(c)));
  }
  return static_cast<double>(six / 6.0L);
}

/// How often a surface winds around a point: the signed crossings of a ray along +z, in whole
/// numbers. Shifts points' x and y by less than a thousandth of the spacing, so that they lie over
/// no edge.
class Winding {
 public:
  explicit Winding(const SweptSurface& surface) : unit_(surface.spacing / kFiner) {
    low_ = high_ = surface.vertices[0];
    for (const auto& v : surface.vertices) {
      low_ = low_.cwiseMin(v);
      high_ = high_.cwiseMax(v);
    }
    const double area = (high_.x() - low_.x()) * (high_.y() - low_.y());
    cell_ = std::max(std::sqrt(area / (4.0 * static_cast<double>(surface.triangles.size()))), 1e-9);
    for (const auto& t : surface.triangles) {
      Triangle triangle;
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d& v = surface.vertices[t[i]];
        triangle.x[i] = std::llround(v.x() / unit_);
        triangle.y[i] = std::llround(v.y() / unit_);
        triangle.z[i] = v.z();
      }
      const auto [x0, x1] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2]});
      const auto [y0, y1] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2]});
      triangle.box = {x0, x1, y0, y1};
      triangles_.push_back(triangle);
    }
    // Long triangles lie over many cells: coarser ones, until there are few enough places.
    while (!bucket()) cell_ *= 2.0;
  }

  /// At `p`, whose coordinates are at least a spacing from the surface.
  [[nodiscard]] int at(const Eigen::Vector3d& p) const {
    if (!(low_.array() <= p.array()).all() || !(p.array() <= high_.array()).all()) return 0;
    for (std::int64_t shift = 0;; ++shift) {
      const std::int64_t x = std::llround(p.x() / unit_) + shift;
      const std::int64_t y = std::llround(p.y() / unit_) - 3 * shift;
      int winding = 0;
      bool isOverEdge = false;
      const std::size_t bin = column(p.x()) + columns_ * row(p.y());
      for (std::uint32_t k = starts_[bin]; k < starts_[bin + 1] && !isOverEdge; ++k) {
        winding += crossing(triangles_[members_[k]], x, y, p.z(), isOverEdge);
      }
      if (!isOverEdge) return winding;
    }
  }

 private:
  static constexpr double kFiner = 1 << 14;
  __extension__ typedef __int128 Whole;
  struct Triangle {
    std::array<std::int64_t, 3> x{}, y{};  // in units, exact
    std::array<double, 3> z{};
    std::array<std::int64_t, 4> box{};
  };

  [[nodiscard]] std::size_t column(double x) const {
    return std::min(columns_ - 1, static_cast<std::size_t>(std::max(0.0, (x - low_.x()) / cell_)));
  }
  [[nodiscard]] std::size_t row(double y) const {
    return std::min(rows_ - 1, static_cast<std::size_t>(std::max(0.0, (y - low_.y()) / cell_)));
  }
  template <typename Visit>
  void binsOf(const Triangle& t, const Visit& visit) const {
    // A margin for the shift of x and y.
    const double margin = 100.0 * unit_;
    const double x0 = static_cast<double>(t.box[0]) * unit_ - margin;
    const double x1 = static_cast<double>(t.box[1]) * unit_ + margin;
    const double y0 = static_cast<double>(t.box[2]) * unit_ - margin;
    const double y1 = static_cast<double>(t.box[3]) * unit_ + margin;
    for (std::size_t r = row(y0); r <= row(y1); ++r) {
      for (std::size_t c = column(x0); c <= column(x1); ++c) visit(c + columns_ * r);
    }
  }
  bool bucket() {
    columns_ = static_cast<std::size_t>((high_.x() - low_.x()) / cell_) + 1;
    rows_ = static_cast<std::size_t>((high_.y() - low_.y()) / cell_) + 1;
    starts_.assign(columns_ * rows_ + 2, 0);
    const std::size_t most = 64 * triangles_.size() + 1000;
    std::size_t places = 0;
    for (const Triangle& t : triangles_) {
      binsOf(t, [&](std::size_t bin) {
        ++starts_[bin + 2];
        ++places;
      });
      if (places > most) return false;
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    members_.resize(starts_.back());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      binsOf(triangles_[t], [&](std::size_t bin) { members_[starts_[bin + 1]++] = t; });
    }
    return true;
  }
  /// +1 if the ray leaves through the triangle, -1 if it enters.
  [[nodiscard]] int crossing(const Triangle& t, std::int64_t x, std::int64_t y, double z,
                             bool& isOverEdge) const {
    if (x < t.box[0] || x > t.box[1] || y < t.box[2] || y > t.box[3]) return 0;
    std::array<std::int64_t, 3> dx{}, dy{};
    for (std::size_t i = 0; i < 3; ++i) {
      dx[i] = t.x[i] - x;
      dy[i] = t.y[i] - y;
    }
    std::array<Whole, 3> area{};
    int positive = 0, negative = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      area[i] = static_cast<Whole>(dx[i]) * dy[j] - static_cast<Whole>(dy[i]) * dx[j];
      positive += area[i] > 0;
      negative += area[i] < 0;
    }
    if (positive > 0 && negative > 0) return 0;
    if (positive + negative < 3) {  // or edge-on
      isOverEdge = true;
      return 0;
    }
    long double height = 0.0L, total = 0.0L;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto weight = static_cast<long double>(area[i]);
      height += weight * static_cast<long double>(t.z[(i + 2) % 3]);
      total += weight;
    }
    if (height / total <= static_cast<long double>(z)) return 0;
    return positive == 3 ? 1 : -1;
  }

  double unit_, cell_ = 1.0;
  Eigen::Vector3d low_, high_;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> starts_, members_;
};

/// The true sweep of one LSS over consecutive motions.
class TrueSweep {
 public:
  struct Part {
    oracle::Motion motion;
    double beginT = 0.0, endT = 1.0;
  };
  TrueSweep(std::vector<Part> parts, int link, const Lss& lss)
      : parts_(std::move(parts)), link_(link), lss_(lss) {}

  /// A point of the swept volume, a third of them on the sphere or the tube itself.
  [[nodiscard]] Eigen::Vector3d sample(Random& random) const {
    const Part& part =
        parts_[static_cast<std::size_t>(random.below(static_cast<int>(parts_.size())))];
    const double u = random.chance(0.1) ? (random.chance(0.5) ? 0.0 : 1.0) : random.uniform(0, 1);
    const auto [a, b] = axisAt(part, part.beginT + u * (part.endT - part.beginT));
    const double s = random.chance(0.3) ? (random.chance(0.5) ? 0.0 : 1.0) : random.uniform(0, 1);
    const double depth = random.chance(0.7) ? 1.0 : random.uniform(0, 1);
    // A hair inside: the sample itself is rounded.
    const double radius = lss_.radius * depth * (1.0 - 1e-12);
    return a + s * (b - a) + radius * random.direction();
  }

  /// An upper bound, close, on the distance of `p` from the swept volume; 0 inside.
  [[nodiscard]] double distance(const Eigen::Vector3d& p, int steps = 64) const {
    double least = 1e300;
    for (const Part& part : parts_) {
      double best = part.beginT, value = 1e300;
      const double length = part.endT - part.beginT;
      for (int i = 0; i <= steps; ++i) {
        const double t = part.beginT + length * i / steps;
        const double found = apart(part, t, p);
        if (found < value) {
          value = found;
          best = t;
        }
      }
      for (double step = length / steps; step > 1e-7 * length; step *= 0.6) {
        for (const double t : {best - step, best + step}) {
          if (t < part.beginT || t > part.endT) continue;
          const double found = apart(part, t, p);
          if (found < value) {
            value = found;
            best = t;
          }
        }
      }
      least = std::min(least, value);
    }
    return std::max(0.0, least - lss_.radius);
  }

 private:
  [[nodiscard]] std::pair<Eigen::Vector3d, Eigen::Vector3d> axisAt(const Part& part,
                                                                   double t) const {
    const auto at = part.motion.pointsAt<2>(link_, plain(lss_).ends, t, 0);
    const auto rich = [](const oracle::Vec3r& v) {
      return Eigen::Vector3d(static_cast<double>(v.x), static_cast<double>(v.y),
                             static_cast<double>(v.z));
    };
    return {rich(at[0].position), rich(at[1].position)};
  }
  [[nodiscard]] double apart(const Part& part, double t, const Eigen::Vector3d& p) const {
    const auto [a, b] = axisAt(part, t);
    const Eigen::Vector3d axis = b - a;
    const double square = axis.squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(axis) / square, 0.0, 1.0) : 0.0;
    return (a + s * axis - p).norm();
  }

  std::vector<Part> parts_;
  int link_;
  Lss lss_;
};

}  // namespace foretouch::test
