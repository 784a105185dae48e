// tools/glb/shown_touch.h: a touch with the contact that begins it, which is where a GLB shows it.
#pragma once

#include "tools/reported_contact.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

struct ShownTouch {
  ReportedContact first;
  Touch touch;
};

}  // namespace foretouch::tools
