// bindings/python/pair_rules.h: pair rules, and their avatar.
#pragma once

#include <memory>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"

namespace foretouch::python {

struct PairRules {
  std::shared_ptr<Avatar> avatar;
  foretouch::PairRules rules;
};

}  // namespace foretouch::python
