// tools/settings/world_settings.h: shared by replay and service: a scene, and the query in it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "assets/import/scene_import.h"
#include "middleware/query_options.h"
#include "tools/settings/ground_rule.h"
#include "tools/settings/policy_rule.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// One minute per step: slower is not a stream.
inline constexpr std::int64_t kMostBudgetUs = 60'000'000;

inline constexpr NumberRange kAboveZero{0.0, std::numeric_limits<double>::max()};
inline constexpr NumberRange kAnyNumber{std::numeric_limits<double>::lowest(),
                                        std::numeric_limits<double>::max()};
inline constexpr NumberRange kZeroOrAbove{0.0, std::numeric_limits<double>::max(), "", "", true};
inline constexpr NumberRange kGroundAngleRange{0.0, 90.0, "degrees", "", true};
inline constexpr NumberRange kGroundHeightRange{0.0, 1e6, "metres", "m", true};
inline constexpr NumberRange kToleranceRange{kMinTolerance, kMaxTolerance, "metres", "m"};

/// The usual formats of scenes and rigged models, for a shell that completes files.
inline constexpr char kModelEndings[] = "obj ply stl off 3ds glb gltf vrm fbx dae x";

/// A scene and a query; each setting is legal by itself. Paths are ready to open; an empty one
/// means: not requested.
struct WorldRequest {
  std::string scenePath;
  SceneImportOptions sceneImport;
  /// As requested; queryOptionsFor() adds the parts that depend on an avatar's names, surface or
  /// policies.
  QueryOptions query;
  std::int64_t budgetUs = 0;        ///< Time per step, converted to workBudget; 0: no limit.
  std::vector<std::string> ignore;  ///< For parseIgnoredPairs() (tools/inputs/ignored_pairs.h).
  std::string policyPath;
  std::vector<PolicyRule> policies;  ///< From that file, or from a configuration; later ones win.
  std::string skinPath;              ///< The model whose skin is the surface, at skinned fidelity.
  SceneImportOptions skinImport;
  bool asksSelf =
      false;  ///< Own links, too: completes `query.self`, by the rules of the next file.
  std::string pairsPath;  ///< Empty: derived from the avatar and its motion.
  GroundRule ground;      ///< The rule for touches; no query depends on it.
};

// Each adds its part of the table; `request` outlives the settings.

/// --scene, --scene-scale and --scene-up: the scene, and how to read its file.
void addSceneSettings(Settings& settings, WorldRequest& request);
/// Makes --fidelity refuse the words that it once took, by name, with an error that says why.
void refuseGoneFidelities(Setting& setting);
/// The settings that services have, too: --tolerance, --fidelity, --ignore, --budget-us.
void addQuerySettings(Settings& settings, WorldRequest& request);
/// --self and --pairs (does not read its file).
void addSelfSettings(Settings& settings, WorldRequest& request);
/// The rest: --scope, --pass-separating, --skin and how to read it, --policy and --pairs (does not
/// read their files),
/// --self.
void addReplayQuerySettings(Settings& settings, WorldRequest& request);
/// How touches are reported: --ground, --ground-angle and --ground-height.
void addTouchSettings(Settings& settings, WorldRequest& request);

}  // namespace foretouch::tools
