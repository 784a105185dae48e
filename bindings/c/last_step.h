// bindings/c/last_step.h: the lists that a query's last step has.
#pragma once

#include "bindings/c/handles.h"

namespace foretouch::c {

/// Refuses a query whose last step has no answer,
[[nodiscard]] ft_status checkedStep(const ft_query* query);
/// no contacts by object,
[[nodiscard]] ft_status checkedObjects(const ft_query* query);
/// or no contacts of own links.
[[nodiscard]] ft_status checkedPairs(const ft_query* query);

}  // namespace foretouch::c
