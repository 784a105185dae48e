#include "tools/settings/channel_names.h"

#include <algorithm>
#include <cstdlib>

#include "assets/text_file.h"
#include "network/wire/messages.h"
#include "network/wire/wire.h"
#include "network/wire/world_messages.h"

namespace foretouch::tools {

Result<ChannelNames> channelNames(const std::string& suffix) {
  const ChannelNames names{
      kSkeletonChannel + suffix, kPoseChannel + suffix,   kContactsChannel + suffix,
      kSolidChannel + suffix,    kPersonChannel + suffix, kStatusChannel + suffix,
      kSpeakerChannel + suffix,  kBodyChannel + suffix,   kRigidPoseChannel + suffix,
      kEventsChannel + suffix,   kPushesChannel + suffix};
  const bool isPrintable =
      std::all_of(suffix.begin(), suffix.end(), [](char c) { return c > ' ' && c <= '~'; });
  const std::size_t longest =
      std::max({names.skeleton.size(), names.pose.size(), names.contacts.size(), names.solid.size(),
                names.status.size()});
  if (isPrintable && longest <= kMaxChannelBytes) return names;
  return Error::in("--suffix", ErrorCode::OutOfRange,
                   "expected printable ASCII without spaces, at most " +
                       std::to_string(kMaxChannelBytes - (longest - suffix.size())) +
                       " bytes of it, found " + inQuotes(suffix));
}

std::string urlOrDefault(const std::string& given) {
  if (!given.empty()) return given;
  const char* const fromEnvironment = std::getenv("LCM_DEFAULT_URL");
  return fromEnvironment != nullptr && *fromEnvironment != '\0' ? fromEnvironment : kDefaultUrl;
}

}  // namespace foretouch::tools
