#include "bench/person/bounded_person.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/solid/plain_body.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// Bounds follow from here on (m).
constexpr double kFollowFloor = 5e-5;

std::vector<Pose> placedFrames(const SolidActor& actor, const Placement& place) {
  std::vector<Pose> frames;
  for (const Pose& frame : actor.clip.frames) {
    auto valid = validatedPose(actor.clip.skeleton, placed(actor.clip.skeleton, frame, place));
    if (!valid.ok()) break;
    frames.push_back(std::move(valid).value());
  }
  return frames;
}
std::vector<oracle::PlainPose> plainOf(const std::vector<Pose>& frames) {
  std::vector<oracle::PlainPose> plain;
  for (const Pose& frame : frames) plain.push_back(plainPose(frame));
  return plain;
}

}  // namespace

BoundedPerson::BoundedPerson(const SolidStage& stage, const SolidActor& actor,
                             const Placement& place, const PersonTrial& trial)
    : trial_(trial),
      frames_(placedFrames(actor, place)),
      every_(static_cast<std::size_t>(
          std::max(1.0, std::round(1.0 / (trial.rateHz * actor.clip.frameTimeS))))),
      seconds_(static_cast<double>(every_) * actor.clip.frameTimeS),
      held_(stage.judged, plainBody(actor.avatar), plainOf(frames_)),
      bounds_(trial.bounds.empty() ? learn() : trial.bounds) {
  giveFrames();
  for (LinkBound& bound : bounds_) {
    if (trial.claimsPoseError) bound.error += kBetween * trial.poseErrorM;
  }
}

/// Errors change from pose to pose, so that they do not cancel.
void BoundedPerson::giveFrames() {
  given_ = frames_;
  for (std::size_t i = 0; i < given_.size(); ++i) {
    const double turn = 2.4 * static_cast<double>(i);
    const Eigen::Vector3d aside(std::cos(turn), std::sin(turn), 0.0);
    given_[i].translations.front() += trial_.poseErrorM * aside;
  }
  around_ = given_;
  if (!trial_.hasWrongSlopes) return;
  for (Pose& pose : around_) {
    std::rotate(pose.rotations.begin(), pose.rotations.begin() + 1, pose.rotations.end());
  }
}

/// The largest distance of each link's axes, person from model.
void BoundedPerson::distances(const HeldBackStep& step, double u, std::vector<double>& distances) {
  const std::vector<HeldBack::Axis> truth = held_.truthAt(step, u);
  const auto& model = held_.modelAt(step, trial_.model, u);
  distances.assign(held_.numLinks(), 0.0);
  for (std::size_t c = 0; c < truth.size(); ++c) {
    double& most = distances[slotOf(held_.linkOf()[c])];
    for (std::size_t end = 0; end < 2; ++end) {
      most = std::max(most, oracle::norm(truth[c][end] - model[c][end]));
    }
  }
}

/// How much the given poses around a step bend, per link: the mean of what is known at its ends.
void BoundedPerson::bendsOf(const HeldBackStep& step, std::vector<double>& bends) {
  const std::vector<HeldBack::Axis> before = held_.posedAt(step.before);
  const std::vector<HeldBack::Axis> from = held_.posedAt(step.from);
  const std::vector<HeldBack::Axis> to = held_.posedAt(step.to);
  const std::vector<HeldBack::Axis> after = held_.posedAt(step.after);
  const bool hasAfter = step.after != step.to && trial_.model == MotionModel::CubicLate;
  const int known = (step.before != step.from ? 1 : 0) + (hasAfter ? 1 : 0);
  bends.assign(held_.numLinks(), LinkBound::kNone);
  if (known == 0) return;
  std::fill(bends.begin(), bends.end(), 0.0);
  for (std::size_t c = 0; c < from.size(); ++c) {
    double& most = bends[slotOf(held_.linkOf()[c])];
    for (std::size_t e = 0; e < 2; ++e) {
      double sum = 0.0;
      if (step.before != step.from) {
        sum += oracle::norm((to[c][e] - from[c][e]) - (from[c][e] - before[c][e]));
      }
      if (hasAfter) {
        sum += oracle::norm((after[c][e] - to[c][e]) - (to[c][e] - from[c][e]));
      }
      most = std::max(most, sum / known);
    }
  }
}

/// The bounds that hold on this clip, per link.
std::vector<LinkBound> BoundedPerson::learn() {
  std::vector<LinkBound> bounds(held_.numLinks());
  for (LinkBound& bound : bounds) bound.acceleration = bound.followShare = 0.0;
  std::vector<double> most, bends, own;
  for (const HeldBackStep& step : steps()) {
    bendsOf(step, bends);
    most.assign(held_.numLinks(), 0.0);
    for (int i = 1; i < looks(); ++i) {
      const double u = static_cast<double>(i) / looks();
      distances(step, u, own);
      for (std::size_t link = 0; link < own.size(); ++link) {
        most[link] = std::max(most[link], own[link] / (4.0 * u * (1.0 - u)));
      }
    }
    for (std::size_t link = 0; link < most.size(); ++link) {
      const double needed = kBetween * most[link] + kBetweenM;
      LinkBound& bound = bounds[link];
      bound.acceleration = std::max(bound.acceleration, 8.0 * needed / (seconds_ * seconds_));
      if (std::isfinite(bends[link]) && bends[link] > 0.0) {
        bound.followShare = std::max(bound.followShare, (needed - kFollowFloor) / bends[link]);
      }
    }
  }
  for (LinkBound& bound : bounds) {
    bound.acceleration *= trial_.boundShare;
    bound.followShare *= trial_.boundShare;
    if (trial_.isFollowed) bound.followFloor = kFollowFloor * trial_.boundShare;
  }
  return bounds;
}

void BoundedPerson::growths(const HeldBackStep& step, std::vector<double>& most) {
  bendsOf(step, most);
  for (std::size_t link = 0; link < most.size(); ++link) {
    const LinkBound& bound = bounds_[link];
    const double followed = std::isfinite(most[link])
                                ? bound.followFloor + bound.followShare * most[link]
                                : LinkBound::kNone;
    most[link] = std::min(bound.acceleration * seconds_ * seconds_ / 8.0, followed);
  }
}

PosedStep BoundedPerson::posed(const HeldBackStep& step) const {
  const bool isLate = trial_.model == MotionModel::CubicLate;
  PosedStep posed;
  posed.before = step.before != step.from ? &around_[step.before] : nullptr;
  posed.from = &given_[step.from];
  posed.to = &given_[step.to];
  posed.after = step.after != step.to && isLate ? &around_[step.after] : nullptr;
  posed.secondsBefore = posed.seconds = posed.secondsAfter = seconds_;
  return posed;
}

}  // namespace foretouch::tools
