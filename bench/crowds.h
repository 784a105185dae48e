// bench/crowds.h: the senders of poses to a service that is measured, and where they stand.
#pragma once

#include <vector>

#include "bench/stream.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// "10x90,1x1000": how many avatars, and how many poses per second each sends.
Setting& addCrowds(Settings& settings, const char* option, const char* value,
                   std::vector<StreamCrowd>& crowds, const char* help);

/// The option --workers of a service.
void addWorkers(Settings& settings, int& workers);

/// The option --place of the bundled dancer.
void addDancerPlace(Settings& settings, Placement& place);

}  // namespace foretouch::tools
