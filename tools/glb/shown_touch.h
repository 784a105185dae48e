// tools/glb/shown_touch.h: a touch with the contact that begins it, which is where a GLB shows it.
#pragma once

#include <optional>

#include "tools/reported_contact.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

struct ShownTouch {
  ReportedContact first;
  Touch touch;
  std::optional<double> untilS;  ///< When it is no longer shown; else by its steps.
  std::optional<double> push;    ///< The push of a solid avatar (m).
};

}  // namespace foretouch::tools
