#include "network/watch/viewer_backlog.h"

#include <utility>

namespace foretouch {

void ViewerBacklog::add(const ViewEvent& event, const SharedText& whole) {
  const auto known = waiting_.find(event.topic);
  if (known != waiting_.end()) return join(known->second, event);
  waiting_.emplace(event.topic, Waiting{event, whole, {}});
  order_.push_back(event.topic);
}

void ViewerBacklog::join(Waiting& waiting, const ViewEvent& event) {
  const std::uint64_t steps = waiting.newest.steps + event.steps;
  std::uint64_t numLeftOut = waiting.newest.numLeftOut + event.numLeftOut;
  keep(waiting.earlier, waiting.newest.contacts, numLeftOut);
  waiting.newest = event;
  waiting.newest.steps = steps;
  waiting.newest.numLeftOut = numLeftOut;
  waiting.whole.reset();
}

void ViewerBacklog::keep(std::deque<ContactTexts>& earlier, const ContactTexts& contacts,
                         std::uint64_t& numLeftOut) {
  if (contacts.count == 0) return;
  earlier.push_back(contacts);
  bytes_ += contacts.text->size();
  while (bytes_ > maxBytes_ && !earlier.empty()) {
    bytes_ -= earlier.front().text->size();
    numLeftOut += earlier.front().count;
    earlier.pop_front();
  }
}

SharedText ViewerBacklog::next() {
  if (order_.empty()) return nullptr;
  const auto first = waiting_.find(order_.front());
  Waiting waiting = std::move(first->second);
  waiting_.erase(first);
  order_.pop_front();
  if (waiting.whole) return waiting.whole;
  for (const ContactTexts& contacts : waiting.earlier) bytes_ -= contacts.text->size();
  return std::make_shared<const std::string>(
      sentText(waiting.newest, {waiting.earlier.begin(), waiting.earlier.end()}));
}

}  // namespace foretouch
