// tools/log/answer_difference.h: the first field in which two answers to one pose differ.
#pragma once

#include <string>

#include "network/wire/messages.h"

namespace foretouch::tools {

/// "the separation of 'LeftHand' is 0.00031 in the log, 0.0003 here, in the step from
/// 1700000001366667 to 1700000001400000 us". The options under which they were given first: where
/// one of them differs, it is that, and not the verdicts alone, and the step is of no matter.
[[nodiscard]] std::string firstDifference(const ContactsMessage& recorded,
                                          const ContactsMessage& replayed);

}  // namespace foretouch::tools
