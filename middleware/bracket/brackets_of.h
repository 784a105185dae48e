// middleware/bracket/brackets_of.h: what of an answer is about some of the links. Not installed.
#pragma once

#include <algorithm>
#include <vector>

#include "middleware/bracket/bracket.h"

namespace foretouch {

/// Keeps what is about a link for which `isOf` is true, on either side. O(brackets).
template <typename IsOf>
void keepBracketsOf(const IsOf& isOf, StepBrackets& brackets) {
  const auto isOther = [&](const LinkBracket& one) {
    return !isOf(one.link) && (one.other == kNoParent || !isOf(one.other));
  };
  for (std::vector<LinkBracket>* const list : {&brackets.links, &brackets.pairs}) {
    list->erase(std::remove_if(list->begin(), list->end(), isOther), list->end());
  }
}

}  // namespace foretouch
