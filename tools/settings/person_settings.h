// tools/settings/person_settings.h: what is claimed of a person, not of the model, in a replay, a
// stream or its log.
#pragma once

#include <cstdint>
#include <string>

#include "articulated/motion_model.h"
#include "middleware/bracket/bracket.h"
#include "middleware/query_options.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

struct PersonRequest {
  std::string boundsPath;  ///< Empty: not asked.
  MotionModel model = MotionModel::ConstantRate;
  std::int64_t aheadUs = 0;  ///< For a stream: how far it looks ahead; 0: not at all.
  [[nodiscard]] bool isAsked() const { return !boundsPath.empty(); }
};

/// The options for brackets of what a query asks: its surfaces, own links and ignored pairs.
[[nodiscard]] BracketOptions bracketOptionsOf(const QueryOptions& query);

/// --bounds, --between and --ahead. `request` outlives the settings.
void addPersonSettings(Settings& settings, PersonRequest& request);

}  // namespace foretouch::tools
