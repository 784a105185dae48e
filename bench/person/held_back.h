// bench/person/held_back.h: a person whose full-rate poses are known, but only every n-th of them
// is given: where they truly were, where a model has them, and how near the two are. Kinematics,
// model and distances are the judge's own. Metres, seconds.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "articulated/motion_model.h"
#include "judge/scene.h"
#include "judge/way_judge.h"

namespace foretouch::tools {

/// The judge rounds (m), and looks at instants: bounds hold in between with this much more.
inline constexpr double kJudgeRounding = 1e-8, kBetween = 1.01, kBetweenM = 1e-6;

/// A step, u in [0,1].
struct HeldBackStep {
  std::size_t from = 0, to = 0;       ///< Frames.
  std::size_t before = 0, after = 0;  ///< Frames; the same as the end itself: there is none.
};

/// One body on one way of full-rate poses. For one thread.
class HeldBack {
 public:
  using Axis = std::array<oracle::Vec3d, 2>;

  /// The scene must outlive it.
  HeldBack(const oracle::Scene& scene, oracle::WayBody body, std::vector<oracle::PlainPose> frames);

  /// Every n-th frame; the last step may be left out.
  [[nodiscard]] std::vector<HeldBackStep> steps(std::size_t every) const;
  /// The ends of all capsules, link by link: the person's, and the model's.
  [[nodiscard]] const std::vector<Axis>& truthAt(const HeldBackStep& step, double u);
  [[nodiscard]] const std::vector<Axis>& modelAt(const HeldBackStep& step, MotionModel model,
                                                 double u);
  /// The ends for the model that goes on as it went in the step, so many steps after its end.
  [[nodiscard]] const std::vector<Axis>& aheadAt(const HeldBackStep& step, double steps);
  /// The ends at one given pose.
  [[nodiscard]] const std::vector<Axis>& posedAt(std::size_t frame);
  [[nodiscard]] const std::vector<int>& linkOf() const { return judge_.linkOf(); }
  [[nodiscard]] std::size_t numLinks() const { return body_.parents.size(); }

  /// The least separation of a link's capsules from the scene, or of two links; `cutoff` if nothing
  /// is nearer.
  [[nodiscard]] double fromScene(const std::vector<Axis>& axes, int link, double cutoff) const;
  /// The same for a point; `cutoff` if nothing is nearer.
  [[nodiscard]] double fromScene(const oracle::Vec3d& point, double cutoff) const;
  [[nodiscard]] double fromLink(const std::vector<Axis>& axes, int link, int other) const {
    return fromLinkOf(*this, axes, link, axes, other);
  }
  [[nodiscard]] double fromLinkOf(const HeldBack& other, const std::vector<Axis>& axes, int link,
                                  const std::vector<Axis>& otherAxes, int otherLink) const;
  [[nodiscard]] double radiusOf(std::size_t capsule) const { return radii_[capsule]; }
  /// The box in which a link's capsules lie.
  [[nodiscard]] oracle::Box boxOf(const std::vector<Axis>& axes, int link) const;

 private:
  [[nodiscard]] oracle::PlainPose modelled(const HeldBackStep& step, MotionModel model, double u);

  const oracle::Scene& scene_;
  oracle::WayBody body_;
  std::vector<oracle::PlainPose> frames_;
  oracle::WayJudge judge_;
  std::vector<double> radii_;       // of each capsule
  std::vector<std::size_t> first_;  // of each link, and one past the last
};

}  // namespace foretouch::tools
