// examples/track.cpp: see the header.
#include "examples/track.h"

#include <algorithm>

namespace foretouch::examples {

void Track::key(double timeS, double value) {
  if (!keys_.empty() && timeS <= keys_.back().timeS) {
    keys_.back().value = value;
  } else {
    keys_.push_back({timeS, value});
  }
}

double Track::slopeAt(std::size_t k) const {
  if (k == 0 || k + 1 == keys_.size()) {
    return 0.0;  // starts and ends at rest
  }
  const double before = keys_[k].timeS - keys_[k - 1].timeS;
  const double after = keys_[k + 1].timeS - keys_[k].timeS;
  const double slopeBefore = (keys_[k].value - keys_[k - 1].value) / before;
  const double slopeAfter = (keys_[k + 1].value - keys_[k].value) / after;
  if (slopeBefore * slopeAfter <= 0.0) {
    return 0.0;  // a turning point, or a hold
  }
  const double w1 = 2.0 * after + before, w2 = after + 2.0 * before;
  return (w1 + w2) / (w1 / slopeBefore + w2 / slopeAfter);
}

double Track::at(double timeS) const {
  const auto next = std::upper_bound(keys_.begin(), keys_.end(), timeS,
                                     [](double t, const Key& key) { return t < key.timeS; });
  if (next == keys_.begin() || next == keys_.end()) {
    return next == keys_.begin() ? keys_.front().value : keys_.back().value;
  }
  const auto k = static_cast<std::size_t>(next - keys_.begin()) - 1;
  const double span = keys_[k + 1].timeS - keys_[k].timeS, s = (timeS - keys_[k].timeS) / span;
  const double s2 = s * s, s3 = s2 * s;
  return (2.0 * s3 - 3.0 * s2 + 1.0) * keys_[k].value + (3.0 * s2 - 2.0 * s3) * keys_[k + 1].value +
         span * ((s3 - 2.0 * s2 + s) * slopeAt(k) + (s3 - s2) * slopeAt(k + 1));
}

}  // namespace foretouch::examples
