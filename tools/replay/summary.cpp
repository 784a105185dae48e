#include "tools/replay/summary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include <fmt/format.h>

#include "lss/index.h"
#include "tools/percentile.h"

namespace foretouch::tools {
namespace {

/// "34.5 %" of a whole that may be empty.
std::string shareOf(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return "0 %";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string row(const char* what, std::int64_t number, const std::string& remark = "") {
  return fmt::format("{:<22}{:>10}{}{}\n", what, number, remark.empty() ? "" : "   ", remark);
}

double mean(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += static_cast<double>(value);
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

void addTo(ReplaySummary::Counts& counts, const LinkContact& contact) {
  counts.contacts += contact.verdict == Verdict::Contact ? 1 : 0;
  counts.startsInContact += contact.verdict == Verdict::StartsInContact ? 1 : 0;
  counts.undecided += contact.verdict == Verdict::Undecided ? 1 : 0;
}

/// Stands for every object that an undecided link has not met yet.
constexpr ObjectId kAnyOther = -1;
constexpr std::size_t kMaxRowsOfTwo = 20;

/// A last column that a table of two names may have.
template <typename Other>
struct LastColumn {
  std::string title;
  std::function<std::string(const std::pair<LinkId, Other>&)> cell;
};

/// The rows for two names each: those with the most contacts first.
template <typename Other, typename NameOf>
std::string rowsOfTwo(const char* title,
                      const std::map<std::pair<LinkId, Other>, ReplaySummary::Counts>& counts,
                      const Skeleton& skeleton, const NameOf& nameOfOther,
                      const LastColumn<Other>& last = {}) {
  using Row = std::pair<std::pair<LinkId, Other>, ReplaySummary::Counts>;
  std::vector<Row> rows(counts.begin(), counts.end());
  if (rows.empty()) return "";
  std::stable_sort(rows.begin(), rows.end(), [](const Row& x, const Row& y) {
    return std::make_pair(x.second.contacts, x.second.startsInContact) >
           std::make_pair(y.second.contacts, y.second.startsInContact);
  });
  std::string text = fmt::format("\n{:<50}{:>10}{:>19}{:>11}{}\n", title, "contacts",
                                 "starts in contact", "undecided", last.title);
  for (std::size_t i = 0; i < std::min(rows.size(), kMaxRowsOfTwo); ++i) {
    const auto& [two, c] = rows[i];
    text += fmt::format("{:<25}{:<25}{:>10}{:>19}{:>11}{}\n", skeleton.name(two.first),
                        nameOfOther(two.second), c.contacts, c.startsInContact, c.undecided,
                        last.cell ? last.cell(two) : "");
  }
  if (rows.size() > kMaxRowsOfTwo) {
    text += fmt::format("and {} more\n", rows.size() - kMaxRowsOfTwo);
  }
  return text;
}

}  // namespace

ReplaySummary::ReplaySummary(const ReplayInputs& inputs)
    : inputs_(inputs),
      ofLink_(countOf(inputs.avatar.numLinks())),
      touchesOfLink_(countOf(inputs.avatar.numLinks())) {}

void ReplaySummary::add(const ReplayTouches& touches) {
  touches_ = touches.counts();
  for (const Touch& touch : touches.listed()) {
    LinkTouches& row = touchesOfLink_[slotOf(touch.link)];
    row.counts.add(touch);
    row.longestS = std::max(row.longestS, touch.endS - touch.beginS);
  }
}

void ReplaySummary::add(const ReplayedStep& step) {
  const StepAnswer& answer = step.answer;
  ++steps_;
  bool touches = false;
  for (const LinkContact& contact : answer.contacts) {
    count(contact);
    touches = touches || contact.verdict != Verdict::Undecided;
    const bool missed =
        std::count(answer.missedByPoses.begin(), answer.missedByPoses.end(), contact.link) > 0;
    if (!missed) continue;
    ++total_.missedByPoses;
    ++ofLink_[slotOf(contact.link)].missedByPoses;
    const bool isFirstOfStep = contact.link == answer.missedByPoses.front();
    if (isFirstOfStep && firstMissed_.size() < kKeptMissed) {
      firstMissed_.push_back(
          {contact, answer.step, timeOf(contact, answer.t0S, answer.t1S), "", true});
    }
  }
  stepsWithContact_ += touches ? 1 : 0;
  countObjects(answer);
  countPairs(answer);
  work_.nodes += answer.counters.nodes;
  work_.candidates += answer.counters.candidates;
  work_.advancements += answer.counters.advancements;
  work_.hierarchyTests += answer.counters.hierarchyTests;
  work_.planeTests += answer.counters.planeTests;
  work_.partSteps += answer.counters.partSteps;
  work_.leafTests += answer.counters.leafTests;
  latenciesUs_.push_back(static_cast<float>(answer.latencyUs));
}

void ReplaySummary::count(const LinkContact& contact) {
  for (Counts* counts : {&total_, &ofLink_[slotOf(contact.link)]}) addTo(*counts, contact);
}

void ReplaySummary::countObjects(const StepAnswer& answer) {
  for (const LinkContact& contact : answer.objects) {
    const bool isTold = contact.verdict != Verdict::Undecided;
    const ObjectId object = isTold ? inputs_.scene.object(contact.triangle) : kAnyOther;
    for (Counts* counts : {&objects_, &ofObject_[{contact.link, object}]}) addTo(*counts, contact);
  }
}

void ReplaySummary::countPairs(const StepAnswer& answer) {
  bool touches = false;
  for (const PairContact& contact : answer.pairs) {
    for (Counts* counts : {&pairs_, &ofPair_[{contact.link, contact.other}]}) {
      addTo(*counts, contact);
    }
    touches = touches || contact.verdict != Verdict::Undecided;
    if (contact.verdict != Verdict::StartsInContact) continue;
    Deepest& deepest = deepest_[{contact.link, contact.other}];
    deepest.atLeast = std::max(deepest.atLeast, contact.penetration);
    const bool isByMesh = contact.linkTriangle >= 0 || contact.triangle >= 0;
    deepest.atMost =
        std::max(deepest.atMost, isByMesh ? contact.penetrationAtMost : contact.penetration);
  }
  stepsWithPairs_ += touches ? 1 : 0;
}

std::vector<StartingPair> ReplaySummary::startingPairs() const {
  constexpr double kNearlyEvery = 0.8;
  std::vector<StartingPair> pairs;
  for (const auto& [pair, counts] : ofPair_) {
    if (static_cast<double>(counts.startsInContact) < kNearlyEvery * static_cast<double>(steps_))
      continue;
    pairs.push_back({{pair.first, pair.second}, counts.startsInContact});
  }
  return pairs;
}

double ReplaySummary::latencyUs(double share) const {
  std::vector<float> latencies = latenciesUs_;
  return percentile(latencies, share);
}

std::string ReplaySummary::text(int threads) const {
  return head(threads) + headline() + touchTable(inputs_.avatar.skeleton(), touchesOfLink_) +
         verdicts() + byLink() + byObject() + ownPairs() + cost();
}

std::string ReplaySummary::head(int threads) const {
  const double clipHz = 1.0 / inputs_.clip.frameTimeS;
  const auto stride = static_cast<double>(inputs_.steps.stride);
  return fmt::format(
      "{} in {}: {} triangles, {} links\n{:.5g} of {:.5g} poses a second, tolerance {:.3g} m, "
      "{} fidelity{}, {} {}\n\n",
      inputs_.request.motionPath, inputs_.request.scenePath, inputs_.scene.audit().triangles,
      inputs_.avatar.numLinks(), clipHz / stride, clipHz, inputs_.request.query.tolerance,
      toString(inputs_.request.query.fidelity),
      inputs_.request.policies.empty() ? "" : ", some links by policy", threads,
      threads == 1 ? "thread" : "threads");
}

std::string ReplaySummary::verdicts() const {
  std::int64_t links = 0;
  for (LinkId link = 0; link < inputs_.avatar.numLinks(); ++link) {
    links += inputs_.avatar.lss(link).empty() ? 0 : 1;
  }
  std::string text = "step by step, where a touch has a contact in each step that it lasts:\n";
  text += row("steps", steps_);
  text += row("link-steps", steps_ * links, fmt::format("{} links with an LSS", links));
  text += row("steps with contact", stepsWithContact_, shareOf(stepsWithContact_, steps_));
  text += row("contacts", total_.contacts);
  text += row("starts in contact", total_.startsInContact);
  text += row("undecided", total_.undecided);
  text += fmt::format(
      "\nof {} contacts, {} ({}) touch nothing at either pose of their step; touches are counted "
      "above\n",
      total_.contacts, total_.missedByPoses, shareOf(total_.missedByPoses, total_.contacts));
  return text;
}

std::string ReplaySummary::byLink() const {
  constexpr std::size_t kMaxRows = 40;
  std::vector<LinkId> order;
  for (LinkId link = 0; link < inputs_.avatar.numLinks(); ++link) {
    const Counts& c = ofLink_[slotOf(link)];
    if (c.contacts + c.startsInContact + c.undecided > 0) order.push_back(link);
  }
  if (order.empty()) return "";
  std::stable_sort(order.begin(), order.end(), [&](LinkId a, LinkId b) {
    return ofLink_[slotOf(a)].contacts > ofLink_[slotOf(b)].contacts;
  });
  std::string text = fmt::format("\n{:<32}{:>10}{:>18}{:>19}{:>11}\n", "link", "contacts",
                                 "missed by poses", "starts in contact", "undecided");
  for (std::size_t i = 0; i < std::min(order.size(), kMaxRows); ++i) {
    const Counts& c = ofLink_[slotOf(order[i])];
    text +=
        fmt::format("{:<32}{:>10}{:>18}{:>19}{:>11}\n", inputs_.avatar.skeleton().name(order[i]),
                    c.contacts, c.missedByPoses, c.startsInContact, c.undecided);
  }
  if (order.size() > kMaxRows) text += fmt::format("and {} more\n", order.size() - kMaxRows);
  return text;
}

std::string ReplaySummary::byObject() const {
  if (inputs_.query.scope != Scope::EveryObject) return "";
  std::string text = "\n" + row("by object: contacts", objects_.contacts);
  text += row("  starts in contact", objects_.startsInContact);
  text += row("  undecided", objects_.undecided);
  return text + rowsOfTwo("link and object", ofObject_, inputs_.avatar.skeleton(),
                          [&](ObjectId object) -> std::string {
                            if (object == kAnyOther) return "(any other)";
                            return inputs_.scene.objectNames()[slotOf(object)];
                          });
}

std::string ReplaySummary::ownPairs() const {
  if (!inputs_.query.self) return "";
  const PairRules& rules = *inputs_.query.self;
  std::string text = "\n" + row("own pairs asked", rules.numAsked(),
                                fmt::format("of {} pairs of own links", rules.numPairs()));
  text += row("steps with own contact", stepsWithPairs_, shareOf(stepsWithPairs_, steps_));
  text += row("own contacts", pairs_.contacts);
  text += row("start in own contact", pairs_.startsInContact);
  text += row("own pairs undecided", pairs_.undecided);
  const Skeleton& skeleton = inputs_.avatar.skeleton();
  LastColumn<LinkId> depth;
  if (!deepest_.empty()) depth.title = fmt::format("{:>16}", "deepest, mm");
  if (!deepest_.empty()) depth.cell = [&](const auto& pair) { return deepestOf(pair); };
  text += rowsOfTwo<LinkId>(
      "own links", ofPair_, skeleton, [&](LinkId other) { return skeleton.name(other); }, depth);
  const bool isUnknown = std::any_of(deepest_.begin(), deepest_.end(),
                                     [](const auto& of) { return !(of.second.atLeast > 0.0); });
  if (isUnknown) {
    text += "?: not known; a mesh that encloses nothing has no inside (docs/formats.md, Results)\n";
  }
  return text;
}

/// "12.3", and where a mesh leaves it open, "12.3 to 14.0" or "? to 14.0".
std::string ReplaySummary::deepestOf(const std::pair<LinkId, LinkId>& pair) const {
  constexpr double kMmPerM = 1000.0, kSameMm = 0.1;
  const auto at = deepest_.find(pair);
  if (at == deepest_.end()) return fmt::format("{:>16}", "-");
  const double least = kMmPerM * at->second.atLeast, most = kMmPerM * at->second.atMost;
  std::string text = least > 0.0 ? fmt::format("{:.1f}", least) : "?";
  if (std::isfinite(most) && most - least >= kSameMm) text += fmt::format(" to {:.1f}", most);
  return fmt::format("{:>16}", text);
}

std::string ReplaySummary::cost() const {
  std::vector<float> latencies = latenciesUs_;
  std::string text = fmt::format(
      "\nlatency of a step, us    mean {:.1f}   p50 {:.1f}   p90 {:.1f}   p99 {:.1f}   max "
      "{:.1f}\n",
      mean(latenciesUs_), percentile(latencies, 0.5), percentile(latencies, 0.9),
      percentile(latencies, 0.99), percentile(latencies, 1.0));
  const auto aStep = [&](std::uint64_t work) {
    return static_cast<double>(work) / static_cast<double>(std::max<std::int64_t>(1, steps_));
  };
  text += fmt::format(
      "work of a step, mean     nodes {:.1f}   candidates {:.1f}   advancements {:.1f}\n",
      aStep(work_.nodes), aStep(work_.candidates), aStep(work_.advancements));
  if (inputs_.query.surface) {
    text += fmt::format(
        "of these advancements    LSS hierarchy {:.1f}   triangle pairs {:.1f}   (and by planes "
        "{:.1f}, in lanes {:.1f})\n",
        aStep(work_.hierarchyTests), aStep(work_.leafTests), aStep(work_.planeTests),
        aStep(work_.partSteps));
  }
  return text;
}

}  // namespace foretouch::tools
