// tests/assets/model_files.h: rigged models made by the test, and the options to read them.
#pragma once

#include <string>

#include "assets/import/model_import.h"
#include "assets/model/model.h"

namespace foretouch::test {

/// Options that name the importer under test.
ModelImportOptions withModelImporter();

/// A model with everything in it, different for every seed: nodes, meshes, bones, LSS, joints,
/// animations and notes.
Model randomModel(std::uint64_t seed);

/// Empty if both are the same, bit for bit; else the first part in which they differ.
std::string difference(const Model& a, const Model& b);

/// A glTF of two bones ("hip", and "knee" 1 m above it) under a node "body", a triangle skinned to
/// both, and an animation "bend" of 2 s that turns the knee by a quarter about x and lifts the hip
/// by 0.5 m.
std::string skinnedGltf();

std::size_t trianglesOf(const Model& model);
std::size_t bonesOf(const Model& model);
/// Position of the only node of that name; fails the test if there is none, or several.
std::int32_t nodeNamed(const Model& model, const std::string& name);
/// From the node's frame to the world, at rest.
Affine toWorld(const Model& model, std::int32_t node);

}  // namespace foretouch::test
