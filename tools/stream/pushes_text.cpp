#include "tools/stream/pushes_text.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "network/wire/world_message_fields.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"

namespace foretouch::tools {
namespace {

/// Beyond this many avatars, forgets the known ones.
constexpr std::size_t kMostPushedAvatars = 4096;
constexpr double kMillimetres = 1e3;

std::string textOf(const ToldCrush& told) {
  const SolidCrush& crush = told.crush;
  if (crush.isOver) return fmt::format("body {} crushes it no longer", crush.body);
  return fmt::format("body {} crushes {} ({:.2g} mm)", crush.body, inQuotes(told.linkName),
                     kMillimetres * crush.depth);
}

}  // namespace

void writePushes(const PushesMessage& message, JsonWriter& out) {
  writeFields(message, out, wire::kPushesKey, wire::kPushes);
  writeRows("contacts", message.contacts, out, wire::kPush);
  writeFields(message, out, wire::kPushesLeftOut);
  writeRows("crushes", message.crushes, out, wire::kCrush);
  writeFields(message, out, wire::kCrushesLeftOut, wire::kPushesStamps);
}

std::string pushesLine(const PushesMessage& message) {
  return objectLine("pushes", [&](JsonWriter& out) { writePushes(message, out); });
}

std::string pushesText(const PushesMessage& message) {
  constexpr std::size_t kShown = 4;
  std::vector<std::string> said;
  for (const ToldCrush& told : message.crushes) said.push_back(textOf(told));
  // The hardest push of each pair.
  std::map<std::pair<std::int32_t, LinkId>, const ToldPush*> hardest;
  for (const ToldPush& told : message.contacts) {
    const ToldPush*& most = hardest[{told.contact.body, told.contact.link}];
    if (most == nullptr || told.contact.push > most->contact.push) most = &told;
  }
  for (const auto& [pair, told] : hardest) {
    said.push_back(fmt::format("body {} presses {} ({:.2g} mm)", pair.first,
                               inQuotes(told->linkName), kMillimetres * told->contact.push));
  }
  std::string text = fmt::format("avatar {}, pose {}: ", message.avatar, message.sequence);
  if (said.empty()) text += "nothing that moves presses it";
  for (std::size_t i = 0; i < said.size() && i < kShown; ++i)
    text += (i == 0 ? "" : "; ") + said[i];
  if (said.size() > kShown) text += fmt::format("; and {} more", said.size() - kShown);
  return text + "\n";
}

bool PushesNews::isNews(const PushesMessage& message) {
  if (last_.size() >= kMostPushedAvatars && last_.count(message.avatar) == 0) last_.clear();
  Last now;
  for (const ToldPush& told : message.contacts) {
    now.pressing.insert({told.contact.body, told.contact.link});
  }
  for (const ToldCrush& told : message.crushes) {
    if (!told.crush.isOver) now.crushing.insert({told.crush.body, told.crush.link});
  }
  Last& last = last_[message.avatar];
  const bool isNews = now.pressing != last.pressing || now.crushing != last.crushing;
  last = std::move(now);
  return isNews;
}

}  // namespace foretouch::tools
