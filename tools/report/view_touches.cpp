#include "tools/report/view_touches.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

namespace foretouch::tools {
namespace {

/// A link and what it touches: its touches never share a step.
using TouchedBy = std::tuple<LinkId, LinkId, std::string>;

bool isBefore(const ViewTouch& x, const ViewTouch& y) {
  return isListedBefore(x.touch, y.touch);
}

/// Gives each contact to the touch whose step it is in.
void addRows(const std::vector<ReportedContact>& contacts, std::vector<ViewTouch>& touches) {
  std::map<TouchedBy, std::vector<ViewTouch*>> ofPair;
  for (ViewTouch& shown : touches) {
    const Touch& touch = shown.touch;
    ofPair[{touch.link, touch.other, touch.object}].push_back(&shown);
  }
  for (std::size_t row = 0; row < contacts.size(); ++row) {
    const ReportedContact& found = contacts[row];
    if (found.contact.verdict == Verdict::Undecided) continue;
    const auto pair = ofPair.find({found.contact.link, found.other, found.object});
    if (pair == ofPair.end()) continue;
    const auto isOver = [](const ViewTouch* shown, std::int64_t step) {
      return shown->touch.lastStep < step;
    };
    const auto at = std::lower_bound(pair->second.begin(), pair->second.end(), found.step, isOver);
    if (at == pair->second.end() || (*at)->touch.firstStep > found.step) continue;
    (*at)->rows.push_back(static_cast<std::uint32_t>(row));
  }
}

}  // namespace

void addTouches(const std::vector<Touch>& touches, std::size_t avatar, ViewDocument& document) {
  std::vector<ViewTouch> added;
  for (const Touch& touch : touches) added.push_back({avatar, touch, {}});
  std::stable_sort(added.begin(), added.end(), isBefore);
  addRows(document.avatars[avatar].contacts, added);
  if (!document.touches) document.touches.emplace();
  std::vector<ViewTouch>& all = *document.touches;
  all.insert(all.end(), added.begin(), added.end());
  std::stable_sort(all.begin(), all.end(), isBefore);
}

void noteGround(const TouchCounts& counts, const GroundRule& ground,
                std::vector<std::string>& notes) {
  if (ground.use != GroundUse::Ignore || counts.ground == 0) return;
  notes.push_back("Touches of the ground are not listed (--ground ignore): " +
                  std::to_string(counts.ground) + ". Their contacts are.");
}

std::vector<ViewRow> touchRows(const TouchCounts& counts, bool isOwnAsked) {
  std::vector<ViewRow> rows{
      {"touches", std::to_string(counts.touches),
       "from a first contact of a link with an object to where it ends; without the ground"},
      {"touches_missed", std::to_string(counts.missed),
       "of these: a check of the poses alone sees nothing of them"},
      {"touches_ground", std::to_string(counts.ground), "counted apart"}};
  if (isOwnAsked) rows.push_back({"touches_own", std::to_string(counts.own), "of own links"});
  return rows;
}

}  // namespace foretouch::tools
