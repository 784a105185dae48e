// network/watch/view_event.h: the server-sent events for viewers. All viewers share one text per
// event. A viewer that cannot keep up gets the newest event of each topic, preceded by the contacts
// of the events it replaces. Not installed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace foretouch {

using SharedText = std::shared_ptr<const std::string>;

/// Contacts of one event: JSON values with commas between them.
struct ContactTexts {
  SharedText text;  ///< None if there is no contact.
  std::size_t count = 0;
};

struct ViewEvent {
  std::size_t topic = 0;  ///< The newer of two events of a topic replaces the older one.
  std::string name;       ///< "step"
  SharedText fields;      ///< Those of a JSON object, separated by commas.
  /// For an event about steps, further fields: contacts, the number of steps it covers (skipped is
  /// one less), and the number of contacts without room.
  std::uint64_t steps = 0;  ///< 0: no further fields.
  ContactTexts contacts;
  std::uint64_t numLeftOut = 0;
};

/// The event's text: `event: NAME`, one line of data, an empty line. `earlier` go before its own
/// contacts.
[[nodiscard]] std::string sentText(const ViewEvent& event,
                                   const std::vector<ContactTexts>& earlier = {});

/// A source of events. Used by one thread.
class EventSource {
 public:
  using Time = std::chrono::steady_clock::time_point;
  virtual ~EventSource() = default;
  /// The number of viewers from now on.
  virtual void setViewers(std::size_t count) = 0;
  /// Appends new events; called every few milliseconds while anybody watches.
  virtual void collect(Time now, std::vector<ViewEvent>& events) = 0;
  /// Called about once a second while nobody watches.
  virtual void rest() = 0;
};

}  // namespace foretouch
