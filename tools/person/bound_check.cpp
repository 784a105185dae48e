#include "tools/person/bound_check.h"

#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// A clip breaks a bound beyond this (m): poses and places are rounded in files.
constexpr double kBreaks = 1e-6;

}  // namespace

void BoundCheck::begin(const PosedStep& step, MotionModel model) {
  model_.assign(avatar_.skeleton(), step, model);
  constant_.assign(avatar_.skeleton(), *step.from, *step.to);
}

void BoundCheck::place(const Pose& truth, double u) {
  model_.isConstantRate() ? constant_.poseAt(u, pose_) : model_.poseAt(u, pose_);
  placer_.place(truth, truth_);
  placer_.place(pose_, modelled_);
  placer_.differences(truth_, modelled_, apart_);
}

double BoundCheck::beyond(const LinkBracket& bracket, double u) const {
  const double error = bounds_[slotOf(bracket.link)].error;
  const double rho = error + 4.0 * (bracket.growth - error) * u * (1.0 - u);
  return apart_[slotOf(bracket.link)] - rho;
}

void BoundCheck::across(const PosedStep& step, const std::vector<LinkId>& links,
                        const std::vector<LinkBound>& bounds, double timeS, PersonCounts& counts) {
  placer_.place(*step.from, modelled_);
  placer_.place(*step.to, truth_);
  placer_.differences(truth_, modelled_, apart_);
  for (const LinkId link : links) {
    const LinkBound& bound = bounds[slotOf(link)];
    const double most = 2.0 * bound.error + step.seconds * bound.speed;
    count(link, apart_[slotOf(link)] - most, timeS, counts);
  }
}

void BoundCheck::count(LinkId link, double beyond, double timeS, PersonCounts& counts) const {
  if (!(beyond > kBreaks)) return;
  ++counts.broken;
  if (beyond <= counts.worstM) return;
  counts.worstM = beyond;
  counts.worstLink = link;
  counts.worstS = timeS;
}

}  // namespace foretouch::tools
