#include "tools/report/view_person.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lss/index.h"
#include "tools/report/document_parts.h"

namespace foretouch::tools {
namespace {

ViewPersonTouch shownOf(const PersonTouch& touch, const Scene& scene) {
  ViewPersonTouch shown;
  shown.link = touch.link;
  shown.other = touch.other;
  if (touch.triangle >= 0) {
    shown.object = scene.objectNames()[slotOf(scene.object(touch.triangle))];
  }
  shown.isCertain = touch.isCertain;
  std::copy(touch.beginsS, touch.beginsS + 2, shown.beginsS);
  std::copy(touch.endsS, touch.endsS + 2, shown.endsS);
  shown.beganBefore = touch.beginsBefore;
  shown.goesOn = touch.endsAfter;
  shown.growth = touch.growth;
  return shown;
}

/// Of what comes after the last pose that is shown, nothing is; false: all of the touch does.
bool cutAt(double endS, ViewPersonTouch& touch) {
  if (touch.beginsS[0] > endS) return false;
  if (touch.endsS[1] <= endS) return true;
  touch.goesOn = true;
  touch.isCertain = touch.isCertain && touch.beginsS[1] <= endS;
  touch.endsS[0] = std::min(touch.endsS[0], endS);
  touch.endsS[1] = endS;
  return true;
}

}  // namespace

void addPerson(const ReplayInputs& inputs, const PersonRequest& request,
               const std::optional<PersonAnswer>& answer, ViewDocument& document) {
  if (!answer) return;
  const std::optional<ViewTrack>& track = document.avatars.front().track;
  const double endS = track && track->poses() > 0 ? track->poseTimesS.back() : 0.0;
  ViewPerson person;
  person.bounds = fileName(request.boundsPath);
  person.between = toString(request.model);
  person.rateHz = answer->rateHz;
  for (const PersonTouch& touch : answer->touches) {
    ViewPersonTouch shown = shownOf(touch, inputs.scene);
    if (cutAt(endS, shown)) person.touches.push_back(std::move(shown));
  }
  const auto certain = std::count_if(person.touches.begin(), person.touches.end(),
                                     [](const ViewPersonTouch& touch) { return touch.isCertain; });
  document.summary.push_back({"the person surely touched", std::to_string(certain),
                              fmt::format("whatever they did within {}", person.bounds)});
  document.summary.push_back(
      {"the person perhaps touched",
       std::to_string(static_cast<std::int64_t>(person.touches.size()) - certain), ""});
  for (std::string& note : personNotes(inputs, *answer)) document.notes.push_back(std::move(note));
  document.person = std::move(person);
}

}  // namespace foretouch::tools
