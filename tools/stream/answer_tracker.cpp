#include "tools/stream/answer_tracker.h"

#include <cstddef>

#include <fmt/format.h>

namespace foretouch::tools {
namespace {

/// Bounds the memory: beyond this many avatars, forgets the known ones.
constexpr std::size_t kMaxAvatars = 4096;

}  // namespace

std::optional<std::string> AnswerTracker::take(const ContactsMessage& message) {
  if (last_.size() >= kMaxAvatars && last_.count(message.avatar) == 0) last_.clear();
  const auto [place, isNew] = last_.try_emplace(message.avatar);
  const Last before = place->second;
  place->second = {message.session, message.sequenceTo};
  const bool follows = !isNew && message.kind != StepKind::First &&
                       before.session == message.session && before.sequence < message.sequenceFrom;
  if (!follows) return std::nullopt;
  ++gaps_;
  return fmt::format(
      "avatar {}: answers are missing: to pose {}, and to those after pose {} before it, if they "
      "were answered",
      message.avatar, message.sequenceFrom, before.sequence);
}

}  // namespace foretouch::tools
