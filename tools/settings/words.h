// tools/settings/words.h: the names of settings' values, for input and output.
#pragma once

#include "middleware/query_options.h"
#include "tools/settings/ground_rule.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

[[nodiscard]] inline Words<Fidelity> fidelityWords() {
  Words<Fidelity> words;
  for (const Fidelity fidelity : {Fidelity::Link, Fidelity::Exact, Fidelity::Skinned}) {
    words.emplace_back(toString(fidelity), fidelity);
  }
  return words;
}

[[nodiscard]] inline Words<Scope> scopeWords() {
  Words<Scope> words;
  for (const Scope scope : {Scope::EveryLink, Scope::FirstOfAvatar, Scope::EveryObject}) {
    words.emplace_back(toString(scope), scope);
  }
  return words;
}

[[nodiscard]] inline Words<GroundUse> groundWords() {
  return {{"apart", GroundUse::Apart}, {"keep", GroundUse::Keep}, {"ignore", GroundUse::Ignore}};
}

}  // namespace foretouch::tools
