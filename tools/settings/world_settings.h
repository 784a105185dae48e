// tools/settings/world_settings.h: what a replay and a service have in common: a scene, and what is
// asked of whoever moves in it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "assets/import/imported_scene.h"
#include "middleware/query_options.h"
#include "tools/settings/policy_rule.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// One minute a step: whoever waits longer has no stream.
inline constexpr std::int64_t kMostBudgetUs = 60'000'000;

inline constexpr NumberRange kAboveZero{0.0, std::numeric_limits<double>::max()};
inline constexpr NumberRange kAnyNumber{std::numeric_limits<double>::lowest(),
                                        std::numeric_limits<double>::max()};
inline constexpr NumberRange kZeroOrAbove{0.0, std::numeric_limits<double>::max(), "", "", true};
inline constexpr NumberRange kMetresPerUnit{0.0, std::numeric_limits<double>::max(), "", "m"};
inline constexpr NumberRange kToleranceRange{kMinTolerance, kMaxTolerance, "metres", "m"};

/// A scene and a question, each setting legal by itself. Paths can be opened as they are; an empty
/// one is of nothing that is asked for.
struct WorldRequest {
  std::string scenePath;
  SceneImportOptions sceneImport;
  /// As asked: what hangs on an avatar's names, surface or policies is added by queryOptionsFor().
  QueryOptions query;
  std::int64_t budgetUs = 0;        ///< What a step may take, made its workBudget; 0: no limit.
  std::vector<std::string> ignore;  ///< For parseIgnoredPairs() (tools/inputs/ignored_pairs.h).
  std::string policyPath;
  std::vector<PolicyRule> policies;  ///< Of that file, or of a configuration; later ones win.
  std::string skinPath;              ///< The model whose skin touches, at skinned fidelity.
  SceneImportOptions skinImport;
};

// Each adds its part of the table; `request` outlives the settings.

/// --scene, --scene-scale and --up: the scene, and how its file is read.
void addSceneSettings(Settings& settings, WorldRequest& request);
/// What services can be asked, too: --tolerance, --fidelity, --ignore, --budget-us.
void addQuerySettings(Settings& settings, WorldRequest& request);
/// The rest: --scope, --leaves, --skin and how it is read, --culler, --policy (whose file is not
/// read here).
void addReplayQuerySettings(Settings& settings, WorldRequest& request);

}  // namespace foretouch::tools
