// network/world_stream/shown_body.h: what a solid body of a live world shows at one tick, as two
// messages: about itself and what stands still, and about what moves and presses against it. Not
// installed.
#pragma once

#include "network/wire/messages.h"
#include "network/wire/world_messages.h"

namespace foretouch {

/// Both messages, but for the stamps of receiving and sending.
struct ShownBody {
  SolidMessage solid;
  PushesMessage pushes;
};

}  // namespace foretouch
