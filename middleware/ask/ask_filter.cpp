#include "middleware/ask/ask_filter.h"

#include <algorithm>
#include <string>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

bool isOf(const AskPart& part, BodyId body, LinkId link, ObjectId object) {
  return part.body == body && (part.link == kEveryLink || part.link == link) &&
         (part.object == kEveryObject || part.object == object);
}

Result<Done> checkedPart(const WorldParts& world, const AskPart& part, const char* where) {
  if (part.body == kStillScene) return Done{};
  FORETOUCH_CHECK(checkedBody(world, part.body, where));
  const std::int32_t links = world.kindOf(part.body).skeleton.numJoints();
  if (part.link == kEveryLink || (part.link >= 0 && part.link < links)) return Done{};
  Error error = Error::at(part.link, ErrorCode::UnknownName,
                          "body " + std::to_string(part.body) + ": expected one of its " +
                              std::to_string(links) + " links, found " + std::to_string(part.link));
  error.file = where;
  return error;
}

}  // namespace

Result<Done> checkedBody(const WorldParts& world, BodyId body, const char* where) {
  if (body >= 0 && slotOf(body) < world.bodies.size()) return Done{};
  Error error = Error::at(body, ErrorCode::UnknownName,
                          "body " + std::to_string(body) + " is unknown; expected one of the " +
                              std::to_string(world.bodies.size()) + " that were added");
  error.file = where;
  return error;
}

bool AskFilter::mayTake(const WorldParts& world, BodyId body) const {
  if (body == kStillScene) {
    if (!whom_.asksStill) return false;
  } else {
    const auto group = static_cast<unsigned>(world.body(body).options.group);
    if ((whom_.groups >> group & 1U) == 0) return false;
  }
  const auto isWhole = [&](const AskPart& part) {
    return part.body == body && part.link == kEveryLink && part.object == kEveryObject;
  };
  if (std::any_of(whom_.without.begin(), whom_.without.end(), isWhole)) return false;
  return whom_.only.empty() || std::any_of(whom_.only.begin(), whom_.only.end(),
                                           [&](const AskPart& part) { return part.body == body; });
}

bool AskFilter::takes(BodyId body, LinkId link, ObjectId object) const {
  const auto is = [&](const AskPart& part) { return isOf(part, body, link, object); };
  return (whom_.only.empty() || std::any_of(whom_.only.begin(), whom_.only.end(), is)) &&
         std::none_of(whom_.without.begin(), whom_.without.end(), is);
}

Result<Done> checkedParts(const WorldParts& world, const AskWhom& whom) {
  for (const AskPart& part : whom.only) FORETOUCH_CHECK(checkedPart(world, part, "only"));
  for (const AskPart& part : whom.without) FORETOUCH_CHECK(checkedPart(world, part, "without"));
  return Done{};
}

}  // namespace foretouch::internal
