#include "middleware/ask/ask.h"

#include <algorithm>

namespace foretouch {

WorldQuestion WorldQuestion::ray(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                 double reach, const WorldTime& time) {
  return cast({from, from, 0.0}, direction, reach, time);
}

WorldQuestion WorldQuestion::cast(const Lss& shape, const Eigen::Vector3d& direction, double reach,
                                  const WorldTime& time) {
  WorldQuestion question;
  question.shape = shape;
  question.direction = direction;
  question.reach = reach;
  question.time = time;
  return question;
}

WorldQuestion WorldQuestion::overlap(const Lss& shape, const WorldTime& time) {
  WorldQuestion question;
  question.what = AskWhat::Overlap;
  question.which = AskWhich::All;
  question.shape = shape;
  question.time = time;
  return question;
}

WorldQuestion WorldQuestion::nearest(const Lss& shape, double reach, const WorldTime& time) {
  WorldQuestion question;
  question.what = AskWhat::Nearest;
  question.shape = shape;
  question.reach = reach;
  question.time = time;
  return question;
}

WorldQuestion WorldQuestion::inside(const Eigen::Vector3d& point, const WorldTime& time) {
  WorldQuestion question = overlap({point, point, 0.0}, time);
  question.solids = true;
  return question;
}

std::vector<Eigen::Vector3d> boxCorners(const Eigen::Vector3d& halfExtents,
                                        const Eigen::Quaterniond& axes) {
  std::vector<Eigen::Vector3d> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3d signs((i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0,
                                (i & 4U) != 0 ? 1.0 : -1.0);
    corners.emplace_back(axes * halfExtents.cwiseProduct(signs));
  }
  return corners;
}

bool WorldAnswer::isComplete() const {
  return std::all_of(unknown.begin(), unknown.end(),
                     [](const UnknownBody& body) { return body.why == AskUnknown::Assumed; });
}

AskVerdict WorldAnswer::verdict() const {
  if (!hits.empty()) return AskVerdict::Hit;
  return isComplete() ? AskVerdict::Clear : AskVerdict::Unknown;
}

}  // namespace foretouch
