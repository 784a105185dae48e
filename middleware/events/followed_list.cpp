#include "middleware/events/followed_list.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "middleware/events/pair_key.h"

namespace foretouch::internal {

void FollowedList::tellKnown(const WorldParts& world, std::int64_t fromUs, std::int64_t toUs,
                             FollowedLinks& known) const {
  known.pairs.clear();
  for (const auto& both : bodies_) {
    const auto& [a, b] = both->bodies;
    if (isOfObjects(world, both->bodies) || a == b) continue;
    const bool isTraced = both->beginUs <= fromUs && toUs <= both->endUs;
    for (const FollowedSides& side : both->sides) {
      if (!side.isOpen && !(isTraced && side.isTraced)) continue;
      // What is open goes on in any motion.
      const std::int64_t sinceUs =
          side.isOpen ? std::numeric_limits<std::int64_t>::max() : both->beginUs;
      known.pairs.push_back({a, b, side.links.a, side.links.b, sinceUs});
    }
  }
}

void FollowedList::plan(std::int64_t fromUs, const std::vector<ListedPair>& listed,
                        std::vector<TracedBodies>& tasks) {
  retire(fromUs);
  addListed(listed);
  tasks.clear();
  std::size_t first = 0;
  for (const auto& both : bodies_) {
    std::size_t last = first;
    while (last < listed.size() && listed[last].bodies == both->bodies) ++last;
    if (last > first || both->isActive()) tasks.push_back({both.get(), first, last - first, 0});
    first = last;
  }
}

/// Drops those of which nothing is known any more.
void FollowedList::retire(std::int64_t fromUs) {
  std::size_t kept = 0;
  for (auto& both : bodies_) {
    if (both->endUs <= fromUs && !both->isActive()) {
      unused_.push_back(std::move(both));
    } else {
      std::swap(bodies_[kept++], both);
    }
  }
  bodies_.resize(kept);
}

void FollowedList::addListed(const std::vector<ListedPair>& listed) {
  const std::size_t known = bodies_.size();
  std::size_t next = 0;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const BodyPair& bodies = listed[i].bodies;
    if (i > 0 && listed[i - 1].bodies == bodies) continue;
    while (next < known && bodies_[next]->bodies < bodies) ++next;
    if (next == known || bodies < bodies_[next]->bodies) add(bodies);
  }
  if (bodies_.size() > known) sort();
}

FollowedBodies& FollowedList::add(const BodyPair& bodies) {
  if (unused_.empty()) unused_.push_back(std::make_unique<FollowedBodies>());
  bodies_.push_back(std::move(unused_.back()));
  unused_.pop_back();
  bodies_.back()->bodies = bodies;
  bodies_.back()->clear();
  return *bodies_.back();
}

void FollowedList::sort() {
  std::sort(bodies_.begin(), bodies_.end(),
            [](const auto& x, const auto& y) { return x->bodies < y->bodies; });
}

void FollowedList::assign(const std::vector<OpenPart>& open) {
  bodies_.clear();
  for (const OpenPart& part : open) {
    const PairKey key = keyOf(part, part.object);
    if (isOfEveryLink(key)) continue;
    const BodyPair bodies{key.bodyOfA, key.bodyOfB};
    const auto known = std::find_if(bodies_.begin(), bodies_.end(),
                                    [&](const auto& both) { return both->bodies == bodies; });
    FollowedBodies& both = known == bodies_.end() ? add(bodies) : **known;
    FollowedSides side;
    side.links = {key.linkOfA, key.linkOfB};
    side.object = key.object;
    side.isOpen = true;
    side.kind = part.kind;
    side.reason = part.reason;
    side.since = part.since;
    both.sides.push_back(side);
  }
  sort();
}

}  // namespace foretouch::internal
