#include "tools/replay/place_doubts.h"

#include <algorithm>

#include <fmt/format.h>

#include "assets/bvh/body_parts.h"
#include "lss/index.h"

namespace foretouch::tools {

PlaceDoubts::PlaceDoubts(const Skeleton& skeleton, bool asksSelf)
    : isTrunk_(countOf(skeleton.numJoints()), false), asksSelf_(asksSelf) {
  for (const LinkId link : trunkOf(skeleton)) isTrunk_[slotOf(link)] = true;
  knowsTrunk_ = !namedTrunkOf(skeleton).empty();
}

void PlaceDoubts::add(const StepAnswer& answer) {
  ++steps_;
  const bool isIn =
      std::any_of(answer.contacts.begin(), answer.contacts.end(), [&](const LinkContact& contact) {
        return contact.verdict == Verdict::StartsInContact && isTrunk_[slotOf(contact.link)];
      });
  trunkSteps_ += isIn ? 1 : 0;
  cameNear_ = cameNear_ || answer.counters.candidates > 0 || !answer.contacts.empty();
}

std::vector<std::string> PlaceDoubts::remarks() const {
  std::vector<std::string> remarks;
  if (2 * trunkSteps_ > steps_) {
    remarks.push_back(fmt::format(
        "{} starts in contact in {} of {} steps: does the body stand in a wall or in the floor? "
        "foretouch view says where it stands, and where it could",
        knowsTrunk_ ? "the trunk" : "a link (no name tells which are its trunk)", trunkSteps_,
        steps_));
  }
  if (steps_ > 0 && !cameNear_ && !asksSelf_) {
    remarks.push_back(
        "nothing of the scene ever came near the body: does it stand elsewhere? foretouch view "
        "says where it stands, and where it could");
  }
  return remarks;
}

}  // namespace foretouch::tools
