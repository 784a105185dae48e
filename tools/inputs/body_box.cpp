#include "tools/inputs/body_box.h"

#include <limits>
#include <vector>

#include "articulated/motion.h"
#include "lss/index.h"

namespace foretouch::tools {

using Eigen::Vector3d;

Vector3d BodyBox::foot() const {
  return {0.5 * (min.x() + max.x()), min.y(), 0.5 * (min.z() + max.z())};
}

BodyBox boxOf(const Avatar& avatar, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(avatar.skeleton(), pose, pose).statesAt(0.0, states);
  BodyBox box{Vector3d::Constant(std::numeric_limits<double>::max()),
              Vector3d::Constant(std::numeric_limits<double>::lowest())};
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      for (const Vector3d& end : {lss.a, lss.b}) {
        const Vector3d p_W = states[slotOf(link)].pointAt(end);
        box.min = box.min.cwiseMin((p_W.array() - lss.radius).matrix());
        box.max = box.max.cwiseMax((p_W.array() + lss.radius).matrix());
      }
    }
  }
  return box;
}

}  // namespace foretouch::tools
