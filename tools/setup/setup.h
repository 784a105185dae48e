// tools/setup/setup.h: what `foretouch setup` finds out about a scene and a body, and what it
// offers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/import/scene_import.h"
#include "tools/settings/project_file.h"
#include "tools/setup/body_source.h"
#include "tools/setup/offer.h"
#include "tools/setup/placement_check.h"
#include "tools/setup/standing.h"

namespace foretouch::tools {

/// What the user has said; setup finds out what is empty.
struct SetupRequest {
  std::string scene;
  BodyRequest body;
  std::optional<double> sceneScale;
  std::optional<UpAxis> sceneUp;
  std::optional<Placement> place;
  std::string on;  ///< Objects on which the body is wanted, as a name pattern; empty: the floor.
};

/// One answer, and whether it needs an option: a file that itself says its unit is read so.
template <typename Value>
struct Finding {
  Offer<Value> offer;
  bool isSaidByFile = false;
  bool isSaidByUser = false;
};

/// All answers. `place` is the best one even if the body stands wrong there: the checks say so.
struct Setup {
  SetupRequest request;
  Finding<double> sceneScale, bodyScale;
  Finding<UpAxis> sceneUp, bodyUp;
  Placement place;
  bool isPlaceFound = false;
  BodySource body;                     ///< Read with these answers.
  std::vector<PlacementCheck> checks;  ///< Those of units, axes and the place.
  std::vector<std::string> notes;

  /// True if all is good or doubtful, and nothing wrong.
  [[nodiscard]] bool isUsable() const;
};

/// Reads the files and settles what the user has not said. `meshFile`: for an avatar that is made
/// of a model. Errors name the file. Some seconds at most beyond reading.
[[nodiscard]] Result<Setup> findSetup(const SetupRequest& request, const std::string& meshFile);

/// The project that holds its answers. `avatar`: the avatar's file.
[[nodiscard]] Project projectOf(const Setup& setup, const std::string& avatar);

/// For people: every answer with its reason, and the checks.
[[nodiscard]] std::string describe(const Setup& setup);
/// The fields of one JSON object.
void writeSetup(const Setup& setup, JsonWriter& out);

}  // namespace foretouch::tools
