// network/watch/viewer_backlog.h: the events still to send to one viewer, in bounded memory however
// slow it is: one event per topic, which newer ones of the topic join. Not installed.
#pragma once

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <vector>

#include "network/watch/view_event.h"

namespace foretouch {

/// Limit on the bytes of contacts that wait for one viewer, not counting those of the newest
/// events. Beyond it the oldest of a topic are dropped, and the event reports how many
/// (contacts_left_out).
inline constexpr std::size_t kMaxBacklogBytes = std::size_t{1} << 20;

class ViewerBacklog {
 public:
  explicit ViewerBacklog(std::size_t maxBytes = kMaxBacklogBytes) : maxBytes_(maxBytes) {}

  /// `whole` is sentText(event): sent if nothing joins it.
  void add(const ViewEvent& event, const SharedText& whole);
  /// The next text, of the topic that has waited longest; none if nothing waits.
  [[nodiscard]] SharedText next();
  [[nodiscard]] bool isEmpty() const { return order_.empty(); }
  /// The bytes of waiting contacts, without those of the newest events.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Waiting {
    ViewEvent newest;
    SharedText whole;                  // of newest; none once an older one has joined it
    std::deque<ContactTexts> earlier;  // of the events that it replaced, oldest first
  };
  void join(Waiting& waiting, const ViewEvent& event);
  void keep(std::deque<ContactTexts>& earlier, const ContactTexts& contacts,
            std::uint64_t& numLeftOut);

  std::size_t maxBytes_;
  std::size_t bytes_ = 0;
  std::unordered_map<std::size_t, Waiting> waiting_;  // by topic
  std::deque<std::size_t> order_;                     // of its topics
};

}  // namespace foretouch
