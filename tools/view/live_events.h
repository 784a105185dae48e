// tools/view/live_events.h: a service's answers as the events that a page shows (docs/formats.md,
// "Live events"): steps from the feed, and once a second the status.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "assets/json_writer.h"
#include "middleware/scene/scene.h"
#include "network/watch/view_event.h"
#include "network/watch/view_feed.h"
#include "network/wire/messages.h"

namespace foretouch::tools {

/// The constant part of the world for events.
struct LiveWorld {
  std::vector<std::int32_t> avatarIds;   ///< In the feed's order.
  std::vector<std::string> objectNames;  ///< The scene's.
  std::function<std::size_t(TriangleId)> objectOf;
  std::int64_t startUtimeUs = 0;  ///< Times (s) count from here.
};

class LiveEvents final : public EventSource {
 public:
  /// `feed` outlives this; the collecting thread calls `status`.
  LiveEvents(ViewFeed& feed, LiveWorld world, std::function<StatusMessage()> status);

  void setViewers(std::size_t count) override;
  void collect(Time now, std::vector<ViewEvent>& events) override;
  void rest() override { feed_.sample(); }

 private:
  [[nodiscard]] ViewEvent statusEvent() const;
  [[nodiscard]] ViewEvent stepEvent(std::size_t avatar) const;
  [[nodiscard]] std::string stepFields(std::size_t avatar) const;
  void writePerson(JsonWriter& out) const;
  void write(const LinkContact& contact, const BatchedStep& step, JsonWriter& out) const;
  [[nodiscard]] double secondsOf(std::int64_t utimeUs) const;

  ViewFeed& feed_;
  LiveWorld world_;
  std::function<StatusMessage()> status_;
  StepBatch batch_;
  std::size_t numViewers_ = 0;
  Time nextStatus_;
};

}  // namespace foretouch::tools
