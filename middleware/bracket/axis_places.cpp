#include "middleware/bracket/axis_places.h"

#include <algorithm>

#include "lss/index.h"

namespace foretouch {

AxisPlacer::AxisPlacer(const Avatar& avatar) : avatar_(avatar) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    linkOf_.insert(linkOf_.end(), avatar.lss(link).size(), link);
  }
}

void AxisPlacer::place(const Pose& pose, AxisPlaces& places) {
  motion_.assign(avatar_.skeleton(), pose, pose);
  motion_.statesAt(0.0, states_);
  places.clear();
  for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
    const LinkState& state = states_[slotOf(link)];
    for (const Lss& lss : avatar_.lss(link)) {
      places.push_back({state.pointAt(lss.a), state.pointAt(lss.b)});
    }
  }
}

void AxisPlacer::differences(const AxisPlaces& one, const AxisPlaces& other,
                             std::vector<double>& most) const {
  most.assign(countOf(avatar_.numLinks()), 0.0);
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      double& own = most[slotOf(linkOf_[i])];
      own = std::max(own, (one[i][end] - other[i][end]).norm());
    }
  }
}

void AxisPlacer::bends(const std::vector<Bend>& given, std::vector<double>& most) const {
  most.assign(countOf(avatar_.numLinks()), 0.0);
  for (std::size_t i = 0; i < linkOf_.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      double sum = 0.0;
      for (const Bend& bend : given) {
        sum += ((*bend.x0)[i][end] - 2.0 * (*bend.x1)[i][end] + (*bend.x2)[i][end]).norm();
      }
      double& own = most[slotOf(linkOf_[i])];
      own = std::max(own, given.empty() ? 0.0 : sum / static_cast<double>(given.size()));
    }
  }
}

}  // namespace foretouch
