#include "tools/setup/walkable_floor.h"

#include <algorithm>
#include <cmath>

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Nothing is above the main floor where nothing is higher than this (share of the body's height).
constexpr double kNothingAbove = 0.3;
/// A floor smaller than this is that of a thing (square of the body's height: 1.5 square metres).
constexpr double kSmall = 0.5;

}  // namespace

std::pair<std::uint32_t, std::uint32_t> WalkableFloor::spansAlong(const Vector3d& p_W) const {
  const Vector3d way = (p_W - corner_) / cell_;
  if (!(way.x() >= 0.0 && way.x() < width_ && way.z() >= 0.0 && way.z() < depth_)) return {0, 0};
  const auto column =
      static_cast<std::size_t>(static_cast<int>(way.x()) + static_cast<int>(way.z()) * width_);
  return {begins_[column], begins_[column + 1]};
}

const WalkableFloor::Span* WalkableFloor::spanAt(const Vector3d& p_W, double up,
                                                 double down) const {
  const Span* nearest = nullptr;
  const auto [first, end] = spansAlong(p_W);
  for (std::size_t i = first; i < end; ++i) {
    const double above = spans_[i].y - p_W.y();
    if (above > up || above < -down) continue;
    if (nearest == nullptr || std::abs(above) < std::abs(nearest->y - p_W.y())) {
      nearest = &spans_[i];
    }
  }
  return nearest;
}

FloorKind WalkableFloor::kindAt(const Vector3d& p_W, double up, double down) const {
  const Span* const span = spanAt(p_W, up, down);
  if (span == nullptr || span->area < 0) return FloorKind::None;
  if (span->area == main_) return FloorKind::Main;
  return areas_[static_cast<std::size_t>(span->area)].isOver() ? FloorKind::Over : FloorKind::Apart;
}

bool WalkableFloor::isAskedAt(const Vector3d& p_W, double up, double down) const {
  const Span* const span = spanAt(p_W, up, down);
  return span != nullptr && span->isAsked;
}

Vector3d WalkableFloor::pointOf(std::size_t column, const Span& span) const {
  const auto width = static_cast<std::size_t>(width_);
  return {corner_.x() + (static_cast<double>(column % width) + 0.5) * cell_, span.y,
          corner_.z() + (static_cast<double>(column / width) + 0.5) * cell_};
}

std::vector<Vector3d> WalkableFloor::spots(std::size_t count, bool onAsked) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;  // column and span
  for (std::uint32_t column = 0; column + 1 < begins_.size(); ++column) {
    for (std::uint32_t i = begins_[column]; i < begins_[column + 1]; ++i) {
      const bool isMain = spans_[i].isCore && spans_[i].area == main_;
      if (onAsked ? spans_[i].isAsked : isMain) all.emplace_back(column, i);
    }
  }
  std::vector<Vector3d> chosen;
  double at = 0.5;
  for (std::size_t i = 0; i < std::min(count, all.size()); ++i) {
    const double place =
        all.size() <= count ? static_cast<double>(i) : at * static_cast<double>(all.size());
    const auto& [column, span] = all[static_cast<std::size_t>(place)];
    chosen.push_back(pointOf(column, spans_[span]));
    // Steps of the golden ratio: even along each row, and from row to row.
    at = std::fmod(at + 0.6180339887498949, 1.0);
  }
  return chosen;
}

std::vector<Vector3d> WalkableFloor::spotsAlong(const Vector3d& p_W) const {
  std::vector<Vector3d> found;
  const auto [first, end] = spansAlong(p_W);
  for (std::size_t i = first; i < end; ++i) {
    if (main_ >= 0 && spans_[i].area == main_) found.emplace_back(p_W.x(), spans_[i].y, p_W.z());
  }
  return found;
}

double WalkableFloor::area() const {
  return hasMain() ? static_cast<double>(mainArea().cells) * cell_ * cell_ : 0.0;
}

bool WalkableFloor::isHigh() const {
  return hasMain() && mainArea().lowest - levelLowest_ > kOnTop * room_.height;
}

bool WalkableFloor::showsBack() const {
  return hasMain() && 2 * mainArea().facingUp < mainArea().cells;
}

bool WalkableFloor::hangs() const {
  return isHigh() && 2 * mainArea().hanging > mainArea().cells;
}

bool WalkableFloor::isSmall() const {
  return area() < kSmall * room_.height * room_.height;
}

bool WalkableFloor::isOnTop() const {
  return isHigh() && levelHighest_ - mainArea().highest < kNothingAbove * room_.height;
}

}  // namespace foretouch::tools
