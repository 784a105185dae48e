// network/watch/view_event.h: what those who watch are told, as server-sent events. A text is made
// once and shared by all of them; a viewer who cannot keep up gets the newest one of each topic,
// with the contacts of those that it replaces put before its own.
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
  SharedText text;  ///< None where there is no contact.
  std::size_t count = 0;
};

struct ViewEvent {
  std::size_t topic = 0;  ///< The newer of two events of a topic replaces the older one.
  std::string name;       ///< "step"
  SharedText fields;      ///< Of a JSON object, with commas between them.
  /// What these lack, where the event is of steps: contacts, how many steps it stands for (skipped
  /// is one less), and how many contacts found no room.
  std::uint64_t steps = 0;  ///< 0: the fields are all there is.
  ContactTexts contacts;
  std::uint64_t numLeftOut = 0;
};

/// The event as it is sent: `event: NAME`, one line of data, an empty line. `earlier` go before its
/// own contacts.
[[nodiscard]] std::string sentText(const ViewEvent& event,
                                   const std::vector<ContactTexts>& earlier = {});

/// Where events come from. Used by one thread.
class EventSource {
 public:
  using Time = std::chrono::steady_clock::time_point;
  virtual ~EventSource() = default;
  /// So many from now on.
  virtual void setViewers(std::size_t count) = 0;
  /// Appends what is new; called every few milliseconds while somebody watches.
  virtual void collect(Time now, std::vector<ViewEvent>& events) = 0;
  /// Called about once a second while nobody does.
  virtual void rest() = 0;
};

}  // namespace foretouch
