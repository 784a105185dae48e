#include "tools/setup/setup.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/body_parts.h"
#include "assets/import/scene_import.h"
#include "tools/inputs/played_clip.h"
#include "tools/setup/body_offer.h"
#include "tools/setup/frame_checks.h"
#include "tools/setup/scene_offer.h"

namespace foretouch::tools {
namespace {

template <typename Value>
Finding<Value> saidByUser(Value value) {
  return {{value, true, "as you said"}, false, true};
}
template <typename Value>
Finding<Value> saidByFile(Value value, const char* format) {
  return {{value, true, format}, true, false};
}

const char* whoSays(const DeclaredFrame& declared) {
  return declared.isOfFormat ? "its format has no other" : "the file says so";
}

void noteObjects(const SetupRequest& request, const RawScene& raw,
                 std::vector<std::string>& notes) {
  const std::vector<std::string>& names = raw.objectNames;
  if (names.size() == 1) {
    notes.push_back(
        fmt::format("{}: is one object, {}, so --ignore cannot name its floor; ground "
                    "contact is told by normal and height (--ground)",
                    request.scene, inQuotes(names.front())));
  }
  const std::set<std::string> different(names.begin(), names.end());
  if (different.size() < names.size()) {
    notes.push_back(
        fmt::format("{}: {} of {} objects share a name with another one, so --ignore "
                    "means all of a name",
                    request.scene, names.size() - different.size() + 1, names.size()));
  }
}

Result<ImportedScene> importWith(const SetupRequest& request, std::optional<double> scale,
                                 std::optional<UpAxis> up) {
  SceneImportOptions options;
  options.scale = scale;
  options.up = up;
  return importScene(request.scene, options);
}

/// Axis first: the unit of a level shows in its height.
Result<ImportedScene> readScene(const SetupRequest& request, Setup& setup) {
  FORETOUCH_TRY(auto imported, importWith(request, request.sceneScale, request.sceneUp));
  const DeclaredFrame& declared = imported.frame.declared;
  if (request.sceneUp) {
    setup.sceneUp = saidByUser(*request.sceneUp);
  } else if (declared.up) {
    setup.sceneUp = saidByFile(*declared.up, whoSays(declared));
  } else {
    setup.sceneUp.offer = sceneUpAxisOf(imported.scene);
    if (setup.sceneUp.offer.value == UpAxis::Z) {
      FORETOUCH_TRY(imported, importWith(request, request.sceneScale, UpAxis::Z));
    }
  }
  if (request.sceneScale) {
    setup.sceneScale = saidByUser(*request.sceneScale);
  } else if (declared.metresPerUnit) {
    setup.sceneScale = saidByFile(*declared.metresPerUnit, whoSays(declared));
  } else {
    setup.sceneScale.offer = sceneUnitOf(imported.scene);
    if (setup.sceneScale.offer.value != 1.0) {
      FORETOUCH_TRY(imported,
                    importWith(request, setup.sceneScale.offer.value, setup.sceneUp.offer.value));
    }
  }
  for (const std::string& note : imported.report.notes) {
    setup.notes.push_back(request.scene + ": " + note);
  }
  noteObjects(request, imported.scene, setup.notes);
  return imported;
}

/// A file's own word counts, unless the body's size contradicts it: exporters forget to convert.
Finding<double> bodyUnit(const BodyRequest& request, const BodySource& source) {
  if (request.motionScale) return saidByUser(*request.motionScale);
  const DeclaredFrame& declared = source.frame.declared;
  const Clip clip = source.clipOrRest();
  const bool isInMetres = declared.metresPerUnit.has_value();
  Offer<double> offer = unitOf(clip, isInMetres);
  if (!isInMetres) return {std::move(offer), false, false};
  const bool isTrue = offer.value == 1.0;
  offer.value *= *declared.metresPerUnit;
  return {std::move(offer), isTrue, false};
}

Finding<UpAxis> bodyUpAxis(const BodyRequest& request, const BodySource& source) {
  if (request.motionUp) return saidByUser(*request.motionUp);
  const DeclaredFrame& declared = source.frame.declared;
  Offer<UpAxis> offer = upAxisOf(source.clipOrRest(), declared.up.has_value());
  if (!declared.up) return {std::move(offer), false, false};
  offer.value = *declared.up;
  return {std::move(offer), true, false};
}

/// First as the files say, to find unit and axis; then with these, if they are others.
Result<Done> readBodyTwice(const SetupRequest& request, const std::string& meshFile, Setup& setup) {
  FORETOUCH_TRY(setup.body, readBody(request.body, meshFile));
  setup.bodyScale = bodyUnit(request.body, setup.body);
  setup.bodyUp = bodyUpAxis(request.body, setup.body);
  BodyRequest& body = setup.request.body;
  if (!setup.bodyScale.isSaidByFile) body.motionScale = setup.bodyScale.offer.value;
  if (!setup.bodyUp.isSaidByFile) body.motionUp = setup.bodyUp.offer.value;
  const FileFrame& frame = setup.body.frame;
  if (setup.bodyScale.offer.value == frame.metresPerUnit && setup.bodyUp.offer.value == frame.up) {
    return Done{};
  }
  FORETOUCH_TRY(setup.body, readBody(body, meshFile));
  return Done{};
}

/// What setup only guessed is a doubt, even if what it makes of the file looks right.
template <typename Value>
void doubtGuess(const Finding<Value>& finding, PlacementCheck& check) {
  if (finding.offer.isSure || finding.isSaidByFile || finding.isSaidByUser) return;
  if (check.state == CheckState::Good) check.state = CheckState::Doubt;
}

/// Unit and axis, by the sentences of `foretouch view`.
void addFrameChecks(const RawScene& raw, const FileFrame& frame, Setup& setup) {
  setup.checks = sceneFrameChecks(raw, frame);
  const BodySource& body = setup.body;
  for (PlacementCheck& check : clipFrameChecks(body.clipOrRest(), body.frame, body.isUpright)) {
    setup.checks.push_back(std::move(check));
  }
  doubtGuess(setup.sceneScale, setup.checks[0]);
  doubtGuess(setup.sceneUp, setup.checks[1]);
  doubtGuess(setup.bodyScale, setup.checks[2]);
  doubtGuess(setup.bodyUp, setup.checks[3]);
}

void noteStillness(Setup& setup) {
  const std::optional<Clip>& clip = setup.body.clip;
  if (!clip) return;
  const Pose& first = clip->frames.front();
  const bool moves = std::any_of(clip->frames.begin(), clip->frames.end(), [&](const Pose& pose) {
    for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
      if (!(pose.rotations[i].coeffs() == first.rotations[i].coeffs())) return true;
      if (pose.translations[i] != first.translations[i]) return true;
    }
    return false;
  });
  if (moves) return;
  setup.notes.push_back(setup.request.body.motionPath +
                        ": never moves, so nothing can happen between its poses");
}

/// Adds a note if the path is judged by the trunk, and nothing shows what that is.
void noteTrunk(Setup& setup) {
  const Skeleton& skeleton = setup.body.avatar->skeleton();
  if (!namedTrunkOf(skeleton).empty()) return;
  std::vector<std::string> names;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    names.push_back(skeleton.name(joint));
  }
  setup.notes.push_back(fmt::format(
      "{}: no joint is called a pelvis, spine, neck or head, so what is said of its trunk is about "
      "all its {} links: {}",
      setup.request.body.motionPath.empty() ? setup.request.body.avatarPath
                                            : setup.request.body.motionPath,
      names.size(), firstOf(names)));
}

/// The user's place is judged and kept; without one, the best is taken; without a floor, the
/// origin.
Result<Done> findPlace(RawScene raw, Setup& setup) {
  const SetupRequest& request = setup.request;
  FORETOUCH_TRY(const auto level, inFile(Level::build(std::move(raw)), request.scene));
  FORETOUCH_TRY(const auto body, walkingBody(setup.body, request.body));
  const Placement wish = request.place.value_or(Placement());
  FORETOUCH_TRY(const auto walker, Walker::build(body, level, wish.origin, request.on));
  Standing standing = standingAt(walker, request.place ? wish : originPlace(walker));
  std::optional<Standing> best;
  if (!request.place || isWrong(standing)) best = bestStanding(walker, wish);
  if (best && !request.place) {
    standing = *best;
    best.reset();
  }
  setup.place = standing.place;
  setup.isPlaceFound = standing.standsFree();
  for (PlacementCheck& check : checksOf(walker, standing, best ? &*best : nullptr)) {
    setup.checks.push_back(std::move(check));
  }
  return Done{};
}

}  // namespace

bool Setup::isUsable() const {
  return areUsable(checks);
}

Result<Setup> findSetup(const SetupRequest& request, const std::string& meshFile) {
  Setup setup;
  setup.request = request;
  FORETOUCH_TRY(auto imported, readScene(request, setup));
  FORETOUCH_CHECK(readBodyTwice(request, meshFile, setup));
  addFrameChecks(imported.scene, imported.frame, setup);
  noteStillness(setup);
  noteTrunk(setup);
  FORETOUCH_CHECK(findPlace(std::move(imported.scene), setup));
  setup.notes.insert(setup.notes.end(), setup.body.notes.begin(), setup.body.notes.end());
  return setup;
}

Project projectOf(const Setup& setup, const std::string& avatar) {
  Project project;
  project.scene = setup.request.scene;
  project.avatar = avatar;
  const BodyRequest& body = setup.request.body;
  project.clip = setup.body.clip ? body.motionPath : "";
  project.jointMap = body.mapPath;
  project.robot = body.robotPath;
  project.packages = body.packagePaths;
  // What a file says about itself is not repeated: the file may be exported anew.
  if (!setup.sceneScale.isSaidByFile) project.sceneScale = setup.sceneScale.offer.value;
  if (!setup.sceneUp.isSaidByFile) project.sceneUp = setup.sceneUp.offer.value;
  if (!setup.bodyScale.isSaidByFile) project.clipScale = setup.bodyScale.offer.value;
  if (!setup.bodyUp.isSaidByFile) project.clipUp = setup.bodyUp.offer.value;
  project.place = textOf(setup.place);
  return project;
}

}  // namespace foretouch::tools
