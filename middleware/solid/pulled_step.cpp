#include "middleware/solid/pulled_step.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"

namespace foretouch::internal {

PulledStep::PulledStep(const Avatar& avatar, const std::vector<double>& visibility)
    : skeleton_(avatar.skeleton()), body_(avatar, visibility) {
  inertia_.reset(skeleton_.parents());
  const auto n = countOf(skeleton_.numJoints());
  isSeen_.assign(n, 0);
  for (const VisualBody::Point& point : body_.points()) isSeen_[slotOf(point.link)] = 1;
  for (std::size_t j = n; j-- > 0;) {
    const JointId parent = skeleton_.parents()[j];
    if (isSeen_[j] != 0 && parent != kNoParent) isSeen_[slotOf(parent)] = 1;
  }
  change_.resize(n);
}

void PulledStep::place(const Pose& pose, BodyState& state) const {
  placeLinks(skeleton_, pose, state.states);
  body_.place(state.states, state.places);
}

void PulledStep::evaluate(const Pose& target, const std::vector<Eigen::Vector3d>& wanted,
                          const Pose& pose, BodyState& state) const {
  state.turns.resize(pose.rotations.size());
  for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
    state.turns[j] = turnBetween(pose.rotations[j], target.rotations[j]);
  }
  state.cost = body_.cost(state.places, wanted, state.turns);
}

void PulledStep::aim(const Pose& target, const std::vector<Eigen::Vector3d>& wanted,
                     const BodyState& here, const Pose& shown) {
  const std::vector<JointId>& parents = skeleton_.parents();
  const std::size_t n = parents.size();
  const std::vector<LinkState>& states = here.states;
  origin_ = states[0].p_WL;
  pull_.forces.assign(n, Vector6d::Zero());
  pull_.torques.resize(n);
  pull_.drifts.resize(n);
  inertia_.begin();
  for (std::size_t j = 0; j < n; ++j) {
    const Eigen::Vector3d& turn = here.turns[j];
    const double stiffness = body_.stiffness()[j];
    if (parents[j] == kNoParent) {
      pull_.torques[j] = stiffness * turn;
      pull_.drifts[j].setZero();
    } else {
      const auto parent = slotOf(parents[j]);
      change_.shift[j] = target.translations[j] - shown.translations[j];
      pull_.torques[j] = stiffness * (states[parent].R_WL * turn);
      pull_.drifts[j] = pull_.drifts[parent] + states[parent].R_WL * change_.shift[j];
    }
    inertia_.setOrigin(static_cast<JointId>(j), states[j].p_WL - origin_);
  }
  const auto& points = body_.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto link = slotOf(points[k].link);
    const Eigen::Vector3d x = here.places[k] - origin_;
    const Eigen::Vector3d error = wanted[k] - here.places[k] - pull_.drifts[link];
    pull_.forces[link] += points[k].weight * wrench(x, error);
    inertia_.addPoint(points[k].link, x, points[k].weight);
  }
  findStiffness(here, wanted);
  inertia_.factor(stiffness_);
  inertia_.solve(pull_.forces, pull_.torques, free_.turns, free_.shifts, free_.twists);
}

/// A joint turns points on circles. The linear step does not see what these bend away from a target
/// that is beyond them: it would turn too far, and back in the next tick (solid.md 2).
void PulledStep::findStiffness(const BodyState& here, const std::vector<Eigen::Vector3d>& wanted) {
  const std::vector<JointId>& parents = skeleton_.parents();
  const auto& points = body_.points();
  bends_.assign(parents.size(), {});
  for (std::size_t k = 0; k < points.size(); ++k) {
    Bend& bend = bends_[slotOf(points[k].link)];
    const Eigen::Vector3d error = points[k].weight * (wanted[k] - here.places[k]);
    bend.force += error;
    bend.moment += (here.places[k] - origin_).dot(error);
  }
  stiffness_ = body_.stiffness();
  for (std::size_t j = parents.size(); j-- > 0;) {
    const Bend& bend = bends_[j];
    const double about = bend.moment - (here.states[j].p_WL - origin_).dot(bend.force);
    stiffness_[j] += std::max(0.0, about);
    if (parents[j] == kNoParent) continue;
    Bend& above = bends_[slotOf(parents[j])];
    above.force += bend.force;
    above.moment += bend.moment;
  }
}

void PulledStep::pullLess(double share) {
  for (std::size_t j = 0; j < pull_.forces.size(); ++j) {
    pull_.forces[j] *= share;
    pull_.torques[j] *= share;
    pull_.drifts[j] *= share;
    if (skeleton_.parents()[j] != kNoParent) change_.shift[j] *= share;
    free_.turns[j] *= share;
    free_.shifts[j] *= share;
    free_.twists[j].w *= share;
    free_.twists[j].v *= share;
  }
}

std::size_t PulledStep::solve(std::vector<ContactRow>& rows) {
  step_ = free_;
  return push_.solve(inertia_, pull_, origin_, rows, step_);
}

void PulledStep::farthestFree(const BodyState& here, std::vector<double>& far) const {
  far.assign(skeleton_.parents().size(), 0.0);
  const auto& points = body_.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto link = slotOf(points[k].link);
    const double step =
        (free_.twists[link].at(here.places[k] - origin_) + pull_.drifts[link]).norm();
    far[link] = std::max(far[link], step);
  }
}

double PulledStep::sizeOf(const TreeStep& step, const BodyState& here) const {
  double most = 0.0;
  const auto& points = body_.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto link = slotOf(points[k].link);
    const Eigen::Vector3d moved =
        step.twists[link].at(here.places[k] - origin_) + pull_.drifts[link];
    most = std::max(most, moved.squaredNorm());
  }
  most = std::sqrt(most);
  for (std::size_t j = 0; j < isSeen_.size(); ++j) {
    if (isSeen_[j] != 0) most = std::max(most, kTwistLever * step.turns[j].norm());
  }
  return most;
}

Moved PulledStep::moveOf(const BodyState& here, const Pace& pace) const {
  Moved most;
  const auto& points = body_.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto link = slotOf(points[k].link);
    const double far =
        (step_.twists[link].at(here.places[k] - origin_) + pull_.drifts[link]).norm();
    most.all = std::max(most.all, far);
    if (pace.isOfHead(k)) most.head = std::max(most.head, far);
  }
  for (const Eigen::Vector3d& turn : step_.turns) most.turn = std::max(most.turn, turn.norm());
  return most;
}

void PulledStep::move(const BodyState& here, const Pose& shown, double share, Pose& moved) {
  for (std::size_t j = 0; j < step_.turns.size(); ++j) {
    change_.turn[j] = step_.turns[j];
    if (skeleton_.parents()[j] == kNoParent) change_.shift[j] = step_.shifts[j];
  }
  moveBy(skeleton_, shown, here.states, change_, share, moved);
}

}  // namespace foretouch::internal
