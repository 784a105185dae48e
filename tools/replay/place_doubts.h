// tools/replay/place_doubts.h: signs in a replay's answers that the body stands where it was not
// meant to stand.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/skeleton.h"
#include "tools/replay/results_writer.h"

namespace foretouch::tools {

class PlaceDoubts {
 public:
  /// `asksSelf`: own links are asked, so a scene that nothing comes near may be meant.
  PlaceDoubts(const Skeleton& skeleton, bool asksSelf);

  void add(const StepAnswer& answer);

  /// A sentence for each of these: the trunk starts in contact in most steps; nothing of the scene
  /// ever came near.
  [[nodiscard]] std::vector<std::string> remarks() const;

 private:
  std::vector<bool> isTrunk_;
  bool knowsTrunk_ = false;  ///< Per link.
  bool asksSelf_ = false;
  std::size_t steps_ = 0, trunkSteps_ = 0;
  bool cameNear_ = false;
};

}  // namespace foretouch::tools
