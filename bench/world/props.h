// bench/world/props.h: what a rigid prop of ten thousand triangles adds to a person.
#pragma once

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// A ring: far off, thrown and spinning through the body, and held in a hand.
[[nodiscard]] BenchTable propTable(const Cast& cast);

}  // namespace foretouch::tools
