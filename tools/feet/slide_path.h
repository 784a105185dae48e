// tools/feet/slide_path.h: the length of a way, as a divider measures it.
#pragma once

#include <algorithm>

#include <Eigen/Core>

namespace foretouch::tools {

/// Shaking that stays within the divider's opening has no length.
class SlidePath {
 public:
  /// `opening` in metres, > 0.
  explicit SlidePath(double opening) : opening_(opening) {}

  /// Goes on by `way`; true: the divider goes on, too.
  bool add(const Eigen::Vector3d& way) {
    at_ += way;
    farthest_ = std::max(farthest_, at_.norm());
    const double gap = (at_ - needle_).norm();
    if (gap < opening_) return false;
    length_ += gap;
    needle_ = at_;
    return true;
  }

  /// Where the divider stands, relative to where the way began.
  [[nodiscard]] const Eigen::Vector3d& needle() const { return needle_; }
  /// The remainder below the opening counts only where there was more before it.
  [[nodiscard]] double length() const {
    return length_ > 0.0 ? length_ + (at_ - needle_).norm() : 0.0;
  }
  /// The greatest distance from where the way began.
  [[nodiscard]] double farthest() const { return farthest_; }

 private:
  double opening_, length_ = 0.0, farthest_ = 0.0;
  Eigen::Vector3d at_ = Eigen::Vector3d::Zero(), needle_ = Eigen::Vector3d::Zero();
};

}  // namespace foretouch::tools
