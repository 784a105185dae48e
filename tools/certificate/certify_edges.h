// tools/certificate/certify_edges.h: foretouch certify --edges: a robot's edges from a file, and
// why the clear ones are clear.
#pragma once

#include <string>

#include "tools/console.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

struct AskedEdges {
  std::string path;  ///< Empty if no edges are asked.
  double clearance = 0.0;
};

/// --edges, and the options that only it takes.
void addEdgeSettings(Settings& settings, AskedEdges& asked, WorldRequest& request);

/// Writes the files into `folder`. `settings`: the command's; refuses those of clips.
ExitCode certifyEdgesOf(const Settings& settings, const AskedEdges& asked,
                        const ReplayRequest& request, const std::string& folder, bool asJson);

}  // namespace foretouch::tools
