#include "tests/reference/rung_query.h"

#include <algorithm>
#include <utility>

#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/contact.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/work_meter.h"
#include "middleware/query/body.h"
#include "middleware/query/lane_query.h"
#include "middleware/query/scalar_query.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/scratch.h"
#include "tests/reference/rung_volumes.h"
#include "tests/reference/spheroid_query.h"

namespace foretouch::internal {
namespace {

/// Memory that one thread's queries reuse.
struct RungScratch {
  RungVolumes volumes;
  std::vector<std::vector<Lss>> perLink;  // the volumes by their carriers
  LssTable table;
  std::vector<IgnoredPair> ignored;   // of the volumes, by their carriers
  std::vector<std::uint8_t> isAsked;  // per link: not ignored altogether
  StepContacts carriers;              // their answers, for their volumes
  std::vector<LinkContact> answers;   // of the volumes
};

RungScratch& scratchOfThread() {
  thread_local RungScratch scratch;
  return scratch;
}

/// One query. A group is the links of one volume: a limb, or a tree.
class RungQuery {
 public:
  RungQuery(Rung rung, const QueryPlan& plan, const ChainMotion& motion, const WorkMeter& meter,
            QueryMemory& scratch)
      : rung_(rung),
        plan_(plan),
        avatar_(plan.avatar),
        motion_(motion),
        scene_(plan.scene),
        options_(plan.options),
        scratch_(scratch),
        meter_(meter),
        rungs_(scratchOfThread()) {}

  void evaluate(QueryCounters& counters) {
    scratch_.lanes.evaluateNodes(motion_, 0.0, 1.0, scene_.parts().origin, counters);
    rungs_.volumes.evaluate(avatar_, motion_, scratch_.lanes.nodes(), rung_ != Rung::Limb);
    counters.rungTests += numGroups();
  }

  void run(StepContacts& step) {
    evaluate(step.counters);
    findIgnored();
    if (rung_ == Rung::Ellipsoid) {
      askSpheroids(step);
    } else {
      askLss(step);
    }
    spread(step);
  }

  [[nodiscard]] std::size_t numGroups() const {
    return byLimb() ? limbs().limbs().size() : limbs().trees().size();
  }
  [[nodiscard]] LinkId carrierOf(std::size_t group) const {
    return byLimb() ? limbs().limbs()[group].carrier : limbs().trees()[group].root;
  }
  [[nodiscard]] const std::vector<LinkId>& linksOf(std::size_t group) const {
    return byLimb() ? limbs().limbs()[group].links : limbs().trees()[group].links;
  }
  [[nodiscard]] const Lss& volumeOf(std::size_t group) const {
    return byLimb() ? rungs_.volumes.limb(group) : rungs_.volumes.tree(group);
  }
  [[nodiscard]] Spheroid spheroidOf(std::size_t group) const {
    return spheroidAround(volumeOf(group), carrierOf(group), motion_, scratch_.lanes.nodes());
  }

 private:
  [[nodiscard]] bool byLimb() const { return rung_ == Rung::Limb; }
  [[nodiscard]] const Limbs& limbs() const { return rungs_.volumes.limbs(); }
  [[nodiscard]] bool isAsked(LinkId link) const { return rungs_.isAsked[slotOf(link)] != 0; }

  /// Finds the links that are not ignored, and the objects that all links of a group ignore.
  void findIgnored() {
    rungs_.isAsked.assign(countOf(avatar_.numLinks()), 1);
    rungs_.ignored.clear();
    for (const IgnoredPair& pair : options_.ignored) {
      if (pair.object == IgnoredPair::kEveryObject) {
        rungs_.isAsked[slotOf(pair.link)] = 0;
      }
    }
    for (std::size_t group = 0; group < numGroups(); ++group) {
      const std::vector<LinkId>& links = linksOf(group);
      const auto first =
          std::find_if(links.begin(), links.end(), [this](LinkId link) { return isAsked(link); });
      if (first == links.end()) {
        rungs_.ignored.push_back({carrierOf(group), IgnoredPair::kEveryObject});
        continue;
      }
      for (const IgnoredPair& pair : options_.ignored) {
        if (pair.link == *first && allIgnore(links, pair.object)) {
          rungs_.ignored.push_back({carrierOf(group), pair.object});
        }
      }
    }
  }

  [[nodiscard]] bool allIgnore(const std::vector<LinkId>& links, ObjectId object) const {
    return std::all_of(links.begin(), links.end(), [&](LinkId link) {
      const auto isPair = [&](const IgnoredPair& pair) {
        return pair.link == link && pair.object == object;
      };
      return !isAsked(link) ||
             std::any_of(options_.ignored.begin(), options_.ignored.end(), isPair);
    });
  }

  void askLss(StepContacts& step) {
    rungs_.perLink.resize(countOf(avatar_.numLinks()));
    for (std::vector<Lss>& lss : rungs_.perLink) lss.clear();
    for (std::size_t group = 0; group < numGroups(); ++group) {
      if (linksOf(group).empty()) continue;
      rungs_.perLink[slotOf(carrierOf(group))].push_back(volumeOf(group));
    }
    const Body body(rungs_.perLink, rungs_.ignored);
    leaveUnanswered(avatar_.numLinks(), rungs_.carriers.links);
    rungs_.carriers.counters = step.counters;
    if (plan_.inLanes) {
      rungs_.table.assign(rungs_.perLink);
      LaneQuery(plan_, body, rungs_.table, motion_, meter_, scratch_).run(rungs_.carriers);
    } else {
      scalarQuery(plan_, body, motion_, meter_, scratch_, rungs_.carriers);
    }
    step.counters = rungs_.carriers.counters;
    rungs_.answers.clear();
    for (std::size_t group = 0; group < numGroups(); ++group) {
      rungs_.answers.push_back(rungs_.carriers.links[slotOf(carrierOf(group))]);
    }
  }

  void askSpheroids(StepContacts& step) {
    rungs_.answers.clear();
    for (std::size_t group = 0; group < numGroups(); ++group) {
      rungs_.answers.push_back(clearContact(carrierOf(group)));
      if (scratch_.ignored.collect(rungs_.ignored, carrierOf(group))) continue;
      const Spheroid spheroid = spheroidOf(group);
      const SpheroidQuery query{spheroid,           scene_, *plan_.culler,
                                options_.tolerance, meter_, scratch_.ignored};
      rungs_.answers.back() = firstContactOf(query, scratch_.found, step.counters);
    }
  }

  /// Gives every link that is not ignored its group's answer. Ignored links, and links without LSS,
  /// which are in no group, touch nothing.
  void spread(StepContacts& step) const {
    for (LinkContact& contact : step.links) {
      if (isAsked(contact.link) && !avatar_.lss(contact.link).empty()) continue;
      contact = clearContact(contact.link);
    }
    for (std::size_t group = 0; group < numGroups(); ++group) {
      for (const LinkId link : linksOf(group)) {
        if (!isAsked(link)) continue;
        LinkContact& contact = step.links[slotOf(link)];
        contact = rungs_.answers[group];
        contact.link = link;
      }
    }
  }

  const Rung rung_;
  const QueryPlan& plan_;
  const Avatar& avatar_;
  const ChainMotion& motion_;
  const Scene& scene_;
  const QueryOptions& options_;
  QueryMemory& scratch_;
  const WorkMeter& meter_;
  RungScratch& rungs_;
};

}  // namespace

bool RungAnswerer::answers(const QueryPlan& plan, const ChainMotion& motion, const WorkMeter& meter,
                           QueryMemory& scratch, StepContacts& step) const {
  RungQuery(rung_, plan, motion, meter, scratch).run(step);
  return true;
}

}  // namespace foretouch::internal

namespace foretouch {

const char* toString(Rung rung) {
  switch (rung) {
    case Rung::Limb: return "limb";
    case Rung::Avatar: return "avatar";
    case Rung::Ellipsoid: return "ellipsoid";
  }
  return "limb";
}

std::vector<RungVolume> rungVolumes(const Avatar& avatar, const ChainMotion& motion,
                                    const Scene& scene, Rung rung) {
  FORETOUCH_ASSERT(motion.numLinks() == avatar.numLinks());
  Scratch scratch;
  const QueryOptions options;
  const auto plan = internal::QueryPlan::make(avatar, scene, options);
  const internal::WorkMeter meter(options);
  internal::RungQuery query(rung, plan.value(), motion, meter, scratch.of<internal::QueryMemory>());
  QueryCounters counters;
  query.evaluate(counters);
  std::vector<RungVolume> volumes;
  for (std::size_t group = 0; group < query.numGroups(); ++group) {
    if (query.linksOf(group).empty()) continue;
    RungVolume volume{query.carrierOf(group), query.linksOf(group), query.volumeOf(group), {}};
    if (rung == Rung::Ellipsoid) volume.spheroid = query.spheroidOf(group);
    volumes.push_back(std::move(volume));
  }
  return volumes;
}

}  // namespace foretouch
