// judge/plain_motion.cpp: slerp by sine weights.
#include "judge/plain_motion.h"

namespace foretouch::oracle {
namespace {

/// Inputs need not be unit; the arc is the joint's.
PreciseQuaternion slerp(const Joint& joint, const Precise& t) {
  const auto p = unit(quaternionOf<Precise>(joint.fromRotation));
  auto q = unit(quaternionOf<Precise>(joint.toRotation));
  if (joint.takesOtherSign()) q = {-q.w, -q.x, -q.y, -q.z};
  const PreciseQuaternion minus{q.w - p.w, q.x - p.x, q.y - p.y, q.z - p.z};
  const PreciseQuaternion plus{q.w + p.w, q.x + p.x, q.y + p.y, q.z + p.z};
  // The angle between them from chord lengths, accurate near 0 and near pi alike.
  const Precise angle = 2 * atan2(norm(minus), norm(plus));
  Precise ofP = 1 - t, ofQ = t;
  if (angle > Precise("1e-22")) {
    ofP = sin((1 - t) * angle) / sin(angle);
    ofQ = sin(t * angle) / sin(angle);
  }
  return unit(PreciseQuaternion{ofP * p.w + ofQ * q.w, ofP * p.x + ofQ * q.x, ofP * p.y + ofQ * q.y,
                                ofP * p.z + ofQ * q.z});
}

}  // namespace

std::vector<PreciseFrame> preciseFrames(const std::vector<Joint>& joints, const Precise& t) {
  std::vector<PreciseFrame> frames;
  for (const Joint& joint : joints) {
    const PreciseFrame parent =
        joint.parent < 0 ? PreciseFrame{} : frames[static_cast<std::size_t>(joint.parent)];
    const auto from = joint.fromTranslation.as<Precise>();
    const auto to = joint.toTranslation.as<Precise>();
    PreciseFrame frame;
    frame.origin = parent.at(from + t * (to - from));
    frame.rotation = parent.rotation * slerp(joint, t);
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace foretouch::oracle
