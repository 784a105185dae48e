// tools/stream/told_events.h: what a service reports about a moving world, as lines: of JSON, as
// those of an events file (docs/formats.md, "Events of a world"), or for people. Bodies are named
// by the world's file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "network/wire/world_messages.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

class ToldEvents {
 public:
  explicit ToldEvents(LoadedWorld world);

  /// Takes the shape of a body whose number is not in the file.
  void take(const BodyMessage& message);

  struct Lines {
    std::string json;  ///< The first ones begin with the header.
    std::string text;
    std::optional<std::string>
        missing;  ///< A sentence, if messages before this one did not arrive.
  };
  [[nodiscard]] Lines take(const EventsMessage& message);
  /// The last line: how many events of each kind there were.
  [[nodiscard]] std::string summary() const;

 private:
  using LinkOfBody = std::pair<BodyId, LinkId>;
  [[nodiscard]] std::string headerFrom(std::int64_t fromUs);
  [[nodiscard]] bool isOfFile(BodyNumber number) const;
  [[nodiscard]] BodyId otherOf(BodyNumber number);
  [[nodiscard]] BodyId bodyOf(BodyNumber number);
  [[nodiscard]] ContactSide sideOf(const ContactSide& told);
  [[nodiscard]] bool hasObject(BodyId body, ObjectId object) const;
  [[nodiscard]] std::string nameOf(BodyId body, LinkId link) const;
  [[nodiscard]] std::string textOf(const ToldEvent& told, const WorldEvent& event) const;
  void tellUnknown(const UnknownPart& part, std::string& json);
  void tellNews(const std::set<LinkOfBody>& unknown, std::string& text);

  LoadedWorld world_;
  std::size_t numOfFile_, numShapes_;    // bodies of the file, without triggers and with them
  LoadedBody unheard_;                   // a shape of one link
  std::map<BodyNumber, BodyId> others_;  // whose numbers are not the file's
  std::optional<std::int64_t> timeline_, sequence_;
  std::int64_t fromUs_ = 0, toUs_ = 0;  ///< Of the last message's window.
  bool hadMore_ = false;                ///< It has more than that message.
  std::set<LinkOfBody> unknown_;        // at the end of the last window
  std::int64_t counts_[kNumEventKinds] = {};
};

}  // namespace foretouch::tools
