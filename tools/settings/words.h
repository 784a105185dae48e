// tools/settings/words.h: the names of settings' values, for input and output.
#pragma once

#include "assets/import/imported_scene.h"
#include "middleware/query_options.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

[[nodiscard]] inline Words<UpAxis> upAxisWords() {
  return {{"y", UpAxis::Y}, {"z", UpAxis::Z}};
}

[[nodiscard]] inline Words<Fidelity> fidelityWords() {
  Words<Fidelity> words;
  for (const Fidelity fidelity : {Fidelity::Ellipsoid, Fidelity::Avatar, Fidelity::Limb,
                                  Fidelity::Link, Fidelity::Exact, Fidelity::Skinned}) {
    words.emplace_back(toString(fidelity), fidelity);
  }
  return words;
}

[[nodiscard]] inline Words<Culler> cullerWords() {
  return {{"flat", Culler::FlatBvh}, {"point-query", Culler::PointQuery}};
}

[[nodiscard]] inline Words<LeafMethod> leafMethodWords() {
  Words<LeafMethod> words;
  for (const LeafMethod method : {LeafMethod::Advancement, LeafMethod::Cubics}) {
    words.emplace_back(toString(method), method);
  }
  return words;
}

[[nodiscard]] inline Words<Scope> scopeWords() {
  Words<Scope> words;
  for (const Scope scope : {Scope::EveryLink, Scope::FirstOfAvatar}) {
    words.emplace_back(toString(scope), scope);
  }
  return words;
}

[[nodiscard]] inline Words<Descent> descentWords() {
  Words<Descent> words;
  for (const Descent descent : {Descent::Straight, Descent::ByNeed}) {
    words.emplace_back(toString(descent), descent);
  }
  return words;
}

}  // namespace foretouch::tools
