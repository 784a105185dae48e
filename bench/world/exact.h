// bench/world/exact.h: what it costs if people touch by their triangles.
#pragma once

#include "bench/report.h"
#include "bench/world/people.h"

namespace foretouch::tools {

/// Two mannequins of 15 links and about 20,000 triangles each, triangles against triangles: near
/// and far, beside both alone, and their own links.
[[nodiscard]] BenchTable exactTable(const Cast& cast);

}  // namespace foretouch::tools
