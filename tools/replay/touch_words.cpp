#include "tools/replay/touch_words.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "lss/index.h"
#include "tools/replay/step_follower.h"

namespace foretouch::tools {
namespace {

/// "the dancer" of dancer.avatar.json; other names than plain words in quotes.
std::string calledBy(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  name = name.substr(0, name.find('.', 1));
  const bool isWord = !name.empty() && std::all_of(name.begin(), name.end(),
                                                   [](char c) { return c >= 'a' && c <= 'z'; });
  return isWord ? "the " + name : inQuotes(name);
}

std::string capitalised(std::string sentence) {
  if (sentence.rfind("the ", 0) == 0) sentence.front() = 'T';
  return sentence;
}

std::string times(std::int64_t count) {
  if (count == 1) return "once";
  return count == 2 ? "twice" : fmt::format("{} times", count);
}

std::string ofPoses(const TouchCounts& counts) {
  const std::string check = " Checking the poses alone would ";
  if (counts.touches == 1) return check + (counts.missed == 1 ? "miss it." : "not miss it.");
  const std::string all = counts.touches == 2 ? "both" : fmt::format("all {}", counts.touches);
  if (counts.missed == counts.touches) return check + "miss " + all + ".";
  if (counts.missed == 0) return check + "miss none of them.";
  return check + fmt::format("miss {} of them.", counts.missed);
}

/// What one contact per link and step does not show.
std::string onHiddenObjects(const ReplayInputs& inputs, const TouchCounts& counts) {
  const Fidelity fidelity = inputs.query.fidelity;
  const bool mayAsk = fidelity == Fidelity::Link || fidelity == Fidelity::Exact;
  const bool isHidden = inputs.query.scope == Scope::EveryLink && !StepFollower::canFollow(inputs);
  if (counts.ground == 0 || !isHidden || !mayAsk) return "";
  return "What a link touches while it is on the ground is told by --scope objects only.\n";
}

}  // namespace

std::string touchHeadline(const ReplayInputs& inputs, const TouchCounts& counts) {
  const std::string avatar = calledBy(inputs.request.avatarPath);
  const std::string scene = calledBy(inputs.request.scenePath);
  std::string text = capitalised(avatar);
  if (counts.touches == 0) {
    text += fmt::format(" touches {} {}.\n",
                        counts.ground > 0 ? "nothing but the ground of" : "nothing of", scene);
  } else {
    text += fmt::format(" touches {} {}.{}\n", scene, times(counts.touches), ofPoses(counts));
  }
  if (counts.ground > 0) {
    const bool isListed = inputs.request.ground.use != GroundUse::Ignore;
    text +=
        fmt::format("The ground{}: {}.\n", isListed ? " is counted apart" : ", which is not listed",
                    times(counts.ground));
  }
  if (inputs.query.self) {
    text += fmt::format("Its own links touch each other {}.\n",
                        counts.own == 0 ? "never" : times(counts.own));
  }
  return text + onHiddenObjects(inputs, counts) + "\n";
}

std::string touchTable(const Skeleton& skeleton, const std::vector<LinkTouches>& ofLink) {
  constexpr std::size_t kMaxRows = 40;
  std::vector<LinkId> order;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    const TouchCounts& c = ofLink[slotOf(link)].counts;
    if (c.touches + c.ground + c.own > 0) order.push_back(link);
  }
  if (order.empty()) return "";
  std::stable_sort(order.begin(), order.end(), [&](LinkId a, LinkId b) {
    return ofLink[slotOf(a)].counts.touches > ofLink[slotOf(b)].counts.touches;
  });
  std::string text = fmt::format("{:<32}{:>10}{:>18}{:>10}{:>12}\n", "link", "touches",
                                 "missed by poses", "ground", "longest, s");
  for (std::size_t i = 0; i < std::min(order.size(), kMaxRows); ++i) {
    const LinkTouches& row = ofLink[slotOf(order[i])];
    text += fmt::format("{:<32}{:>10}{:>18}{:>10}{:>12.3f}\n", skeleton.name(order[i]),
                        row.counts.touches, row.counts.missed, row.counts.ground, row.longestS);
  }
  if (order.size() > kMaxRows) text += fmt::format("and {} more\n", order.size() - kMaxRows);
  return text + "\n";
}

}  // namespace foretouch::tools
