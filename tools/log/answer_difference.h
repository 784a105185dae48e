// tools/log/answer_difference.h: the first field in which two answers to one pose differ.
#pragma once

#include <string>

#include "network/wire/messages.h"
#include "network/wire/world_messages.h"

namespace foretouch::tools {

/// "the separation of 'LeftHand' is 0.00031 in the log, 0.0003 here, in the step from
/// 1700000001366667 to 1700000001400000 us". Compares the options of the answers first: if one of
/// them differs, reports that instead of a verdict, without the step.
[[nodiscard]] std::string firstDifference(const ContactsMessage& recorded,
                                          const ContactsMessage& replayed);
/// The same for what a solid avatar shows.
[[nodiscard]] std::string firstDifference(const SolidMessage& recorded,
                                          const SolidMessage& replayed);

/// The same for what is known of a person.
[[nodiscard]] std::string firstDifference(const PersonMessage& recorded,
                                          const PersonMessage& replayed);
/// The same for what moves and presses against a solid body.
[[nodiscard]] std::string firstDifference(const PushesMessage& recorded,
                                          const PushesMessage& replayed);
/// The same for what a moving world reports.
[[nodiscard]] std::string firstDifference(const EventsMessage& recorded,
                                          const EventsMessage& replayed);

}  // namespace foretouch::tools
