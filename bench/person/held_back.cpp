#include "bench/person/held_back.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "judge/distance.h"
#include "judge/quaternion.h"

namespace foretouch::tools {
namespace {

using oracle::PlainPose;
using oracle::Vec3d;
using Turn = oracle::Quaternion<double>;

Turn turnOf(const PlainPose& pose, std::size_t joint) {
  return oracle::unit(oracle::quaternionOf<double>(pose.rotations[joint]));
}

std::array<double, 4> numbersOf(const Turn& q) {
  return {q.w, q.x, q.y, q.z};
}

/// Axis times angle, on the shorter arc.
Vec3d vectorOf(Turn q) {
  if (q.w < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
  const double sine = oracle::norm(q.vector());
  if (sine < 1e-300) return {};
  return (2.0 * std::atan2(sine, q.w) / sine) * q.vector();
}

Turn turnBy(const Vec3d& w) {
  const double angle = oracle::norm(w);
  if (angle < 1e-12) return oracle::unit(oracle::quaternion(1.0, 0.5 * w));
  return oracle::quaternion(std::cos(0.5 * angle), (std::sin(0.5 * angle) / angle) * w);
}

Vec3d turnBetween(const PlainPose& from, const PlainPose& to, std::size_t joint) {
  return vectorOf(oracle::conjugate(turnOf(from, joint)) * turnOf(to, joint));
}

/// The rate of the rotation vector at w while the body turns by `rate`: Bortz's equation.
Vec3d vectorRate(const Vec3d& w, const Vec3d& rate) {
  const double angle = oracle::norm(w);
  const Vec3d once = oracle::cross(w, rate), twice = oracle::cross(w, once);
  if (angle < 1e-3) return rate + 0.5 * once + (1.0 / 12.0) * twice;
  const double half = 0.5 * angle;
  return rate + 0.5 * once +
         ((1.0 - half * std::cos(half) / std::sin(half)) / (angle * angle)) * twice;
}

/// Hermite's basis, textbook form.
Vec3d hermite(const Vec3d& slope0, const Vec3d& change, const Vec3d& slope1, double u) {
  const double u2 = u * u, u3 = u2 * u;
  return (u3 - 2.0 * u2 + u) * slope0 + (3.0 * u2 - 2.0 * u3) * change + (u3 - u2) * slope1;
}

PlainPose between(const PlainPose& from, const PlainPose& to, double t) {
  PlainPose pose = from;
  for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
    pose.rotations[joint] =
        numbersOf(turnOf(from, joint) * turnBy(t * turnBetween(from, to, joint)));
    pose.translations[joint] =
        from.translations[joint] + t * (to.translations[joint] - from.translations[joint]);
  }
  return pose;
}

}  // namespace

HeldBack::HeldBack(const oracle::Scene& scene, oracle::WayBody body, std::vector<PlainPose> frames)
    : scene_(scene), body_(body), frames_(std::move(frames)), judge_(scene, std::move(body)) {
  for (const auto& capsules : body_.capsules) {
    first_.push_back(radii_.size());
    for (const oracle::Capsule& capsule : capsules) radii_.push_back(capsule.radius);
  }
  first_.push_back(radii_.size());
}

std::vector<HeldBackStep> HeldBack::steps(std::size_t every) const {
  std::vector<HeldBackStep> steps;
  for (std::size_t from = 0; from + every < frames_.size(); from += every) {
    const std::size_t to = from + every;
    steps.push_back({from, to, from >= every ? from - every : from,
                     to + every < frames_.size() ? to + every : to});
  }
  return steps;
}

const std::vector<HeldBack::Axis>& HeldBack::truthAt(const HeldBackStep& step, double u) {
  const double at = static_cast<double>(step.from) + u * static_cast<double>(step.to - step.from);
  const auto frame = std::min(static_cast<std::size_t>(at), step.to - 1);
  return judge_.endsAt(
      between(frames_[frame], frames_[frame + 1], at - static_cast<double>(frame)));
}

const std::vector<HeldBack::Axis>& HeldBack::posedAt(std::size_t frame) {
  return judge_.endsAt(frames_[frame]);
}

const std::vector<HeldBack::Axis>& HeldBack::modelAt(const HeldBackStep& step, MotionModel model,
                                                     double u) {
  return judge_.endsAt(modelled(step, model, u));
}

const std::vector<HeldBack::Axis>& HeldBack::aheadAt(const HeldBackStep& step, double steps) {
  const PlainPose &from = frames_[step.from], &to = frames_[step.to];
  PlainPose pose = to;
  for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
    pose.rotations[joint] =
        numbersOf(turnOf(to, joint) * turnBy(steps * turnBetween(from, to, joint)));
    pose.translations[joint] =
        to.translations[joint] + steps * (to.translations[joint] - from.translations[joint]);
  }
  return judge_.endsAt(pose);
}

/// All given poses are as far apart, so central differences are means.
PlainPose HeldBack::modelled(const HeldBackStep& step, MotionModel model, double u) {
  const PlainPose &from = frames_[step.from], &to = frames_[step.to];
  const bool hasBefore = step.before != step.from;
  const bool hasAfter = step.after != step.to && model == MotionModel::CubicLate;
  if (model == MotionModel::ConstantRate || (!hasBefore && !hasAfter)) return between(from, to, u);
  const PlainPose &before = frames_[step.before], &after = frames_[step.after];
  PlainPose pose = from;
  for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
    const Vec3d turn = turnBetween(from, to, joint);
    const Vec3d shift = to.translations[joint] - from.translations[joint];
    Vec3d turn0, turn1, shift0, shift1;
    if (hasBefore) {
      turn0 = 0.5 * (turnBetween(before, from, joint) + turn);
      shift0 = 0.5 * (to.translations[joint] - before.translations[joint]);
    }
    if (hasAfter) {
      turn1 = vectorRate(turn, 0.5 * (turn + turnBetween(to, after, joint)));
      shift1 = 0.5 * (after.translations[joint] - from.translations[joint]);
    }
    if (!hasBefore) {
      turn0 = 1.5 * turn - 0.5 * turn1;
      shift0 = 1.5 * shift - 0.5 * shift1;
    }
    if (!hasAfter) {
      turn1 = 1.5 * turn - 0.5 * turn0;
      shift1 = 1.5 * shift - 0.5 * shift0;
    }
    if (oracle::norm(turn) > 2.5) turn0 = turn1 = turn;
    pose.rotations[joint] = numbersOf(turnOf(from, joint) * turnBy(hermite(turn0, turn, turn1, u)));
    pose.translations[joint] = from.translations[joint] + hermite(shift0, shift, shift1, u);
  }
  return pose;
}

double HeldBack::fromScene(const std::vector<Axis>& axes, int link, double cutoff) const {
  double least = cutoff;
  for (std::size_t c = first_[static_cast<std::size_t>(link)];
       c < first_[static_cast<std::size_t>(link) + 1]; ++c) {
    oracle::Box box;
    for (const Vec3d& end : axes[c]) box.add(end);
    double within = least + radii_[c];
    scene_.visitNear(box, within, [&](int id) {
      const double distance =
          oracle::closestPoints(axes[c][0], axes[c][1], scene_.triangle(id)).distance;
      within = std::min(within, distance);
    });
    least = std::min(least, within - radii_[c]);
  }
  return least;
}

double HeldBack::fromScene(const Vec3d& point, double cutoff) const {
  oracle::Box box;
  box.add(point);
  double least = cutoff;
  scene_.visitNear(box, least, [&](int id) {
    least = std::min(least, oracle::closestPoints(point, point, scene_.triangle(id)).distance);
  });
  return least;
}

double HeldBack::fromLinkOf(const HeldBack& other, const std::vector<Axis>& axes, int link,
                            const std::vector<Axis>& otherAxes, int otherLink) const {
  double least = oracle::Box::kEmpty;
  for (std::size_t c = first_[static_cast<std::size_t>(link)];
       c < first_[static_cast<std::size_t>(link) + 1]; ++c) {
    for (std::size_t d = other.first_[static_cast<std::size_t>(otherLink)];
         d < other.first_[static_cast<std::size_t>(otherLink) + 1]; ++d) {
      const Axis& far = otherAxes[d];
      const double distance =
          oracle::closestPoints(axes[c][0], axes[c][1], oracle::Triangle{far[0], far[1], far[1]})
              .distance;
      least = std::min(least, distance - radii_[c] - other.radii_[d]);
    }
  }
  return least;
}

oracle::Box HeldBack::boxOf(const std::vector<Axis>& axes, int link) const {
  oracle::Box box;
  for (std::size_t c = first_[static_cast<std::size_t>(link)];
       c < first_[static_cast<std::size_t>(link) + 1]; ++c) {
    const Vec3d out{radii_[c], radii_[c], radii_[c]};
    for (const Vec3d& end : axes[c]) {
      box.add(end + out);
      box.add(end - out);
    }
  }
  return box;
}

}  // namespace foretouch::tools
