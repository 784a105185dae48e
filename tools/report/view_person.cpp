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
  if (touch.triangle < 0) return {touch, ""};
  return {touch, scene.objectNames()[slotOf(scene.object(touch.triangle))]};
}

/// Cuts what comes after the last pose that is shown; false if that is the whole touch.
bool cutAt(double endS, PersonTouch& touch) {
  if (touch.beginsS[0] > endS) return false;
  if (touch.endsS[1] <= endS) return true;
  touch.endsAfter = true;
  touch.isCertain = touch.isCertain && touch.beginsS[1] <= endS;
  touch.endsS[0] = std::min(touch.endsS[0], endS);
  touch.endsS[1] = endS;
  return true;
}

void addCounts(const ViewPerson& person, const std::string& who, ViewDocument& document) {
  const auto certain = std::count_if(person.touches.begin(), person.touches.end(),
                                     [](const ViewPersonTouch& of) { return of.touch.isCertain; });
  document.summary.push_back({who + " surely touched", std::to_string(certain),
                              fmt::format("whatever they did within {}", person.bounds)});
  document.summary.push_back(
      {who + " perhaps touched",
       std::to_string(static_cast<std::int64_t>(person.touches.size()) - certain), ""});
}

/// Appends a word that is not there yet.
void list(const std::string& word, std::string& words) {
  if ((", " + words + ",").find(", " + word + ",") != std::string::npos) return;
  words += (words.empty() ? "" : ", ") + word;
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
    if (cutAt(endS, shown.touch)) person.touches.push_back(std::move(shown));
  }
  addCounts(person, "the person", document);
  for (std::string& note : personNotes(inputs, *answer)) document.notes.push_back(std::move(note));
  document.person = std::move(person);
}

void addPersons(const LoadedWorld& world, const WorldPersons& persons, ViewDocument& document) {
  ViewPerson all;
  for (const FileBody& body : world.file.bodies) {
    if (body.boundsPath.empty()) continue;
    list(fileName(body.boundsPath), all.bounds);
    list(toString(body.between), all.between);
  }
  for (const WorldPersonTouch& of : persons.touches) {
    ViewPersonTouch shown{of.touch, "", slotOf(of.body)};
    if (of.other) {
      shown.object = world.labelOf(*of.other, of.touch.other);
      shown.touch.other = kNoParent;
    } else if (of.touch.triangle >= 0) {
      shown.object = world.scene->objectNames()[slotOf(world.scene->object(of.touch.triangle))];
    }
    const auto& track = document.avatars[shown.avatar].track;
    const double endS = track && track->poses() > 0 ? track->poseTimesS.back() : 0.0;
    if (cutAt(endS, shown.touch)) all.touches.push_back(std::move(shown));
  }
  addCounts(all, "persons", document);
  document.notes.insert(document.notes.end(), persons.notes.begin(), persons.notes.end());
  document.person = std::move(all);
}

}  // namespace foretouch::tools
