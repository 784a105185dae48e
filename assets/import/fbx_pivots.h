// assets/import/fbx_pivots.h: counts the pivots of FBX once. In foretouch-import only. Not
// installed.
//
// The frame of an FBX node is T * Roff * Rp * Rpre * R * Rpost^-1 * Rp^-1 * Soff * Sp * S * Sp^-1.
// assimp 5.2 makes a chain of nodes of it, X_$AssimpFbx$_Translation down to X. Where a node has
// offsets or pivots, its animations move nodes of that chain. Where it has none, one track of X
// holds the whole product; the chain of pre- and post-rotation stays above it all the same, and
// would count twice. That track takes the post-rotation itself, not its inverse.
#pragma once

#include <string>
#include <vector>

#include "assets/model/model.h"

namespace foretouch::internal {

/// Folds a chain into its node where a track moves the node itself.
void countPivotsOnce(Model& model);

/// The nodes of chains whose tracks hold 0 throughout for a component that is not 0 at rest: assimp
/// reads one without a curve so. By the name of the node that the chain belongs to.
[[nodiscard]] std::vector<std::string> nodesWithoutSomeCurve(const Model& model);

}  // namespace foretouch::internal
