#include "bench/crowds.h"

#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/settings/clip_settings.h"

namespace foretouch::tools {
namespace {

constexpr int kMaxAvatars = 1000, kMaxWorkers = 64;
constexpr double kMaxRateHz = 100'000.0;

Result<StreamCrowd> crowdFrom(const std::string& text) {
  const std::size_t cross = text.find('x');
  std::int64_t avatars = 0;
  double rateHz = 0.0;
  const bool isRead = cross != std::string::npos && readNumber(text.substr(0, cross), avatars) &&
                      readNumber(text.substr(cross + 1), rateHz);
  if (!isRead) {
    return Error::of(ErrorCode::Syntax,
                     "expected AVATARSxHZ,... as in 10x90,1x1000, found " + inQuotes(text));
  }
  if (avatars < 1 || avatars > kMaxAvatars || !(rateHz > 0.0 && rateHz <= kMaxRateHz)) {
    return Error::of(
        ErrorCode::OutOfRange,
        fmt::format("expected 1 to {} avatars and at most {} poses per second, found {}",
                    kMaxAvatars, kMaxRateHz, inQuotes(text)));
  }
  return StreamCrowd{static_cast<int>(avatars), rateHz};
}

}  // namespace

Setting& addCrowds(Settings& settings, const char* option, const char* value,
                   std::vector<StreamCrowd>& crowds, const char* help) {
  return settings.parsed(
      option, value,
      [&crowds](const std::string& text) -> Result<Done> {
        std::vector<StreamCrowd> all;
        for (const std::string& part : splitAtCommas(text)) {
          FORETOUCH_TRY(const auto crowd, crowdFrom(part));
          all.push_back(crowd);
        }
        crowds = std::move(all);
        return Done{};
      },
      [&crowds] {
        std::string text;
        for (const StreamCrowd& crowd : crowds) {
          text += fmt::format("{}{}x{}", text.empty() ? "" : ",", crowd.avatars, crowd.rateHz);
        }
        return text;
      },
      help);
}

void addWorkers(Settings& settings, int& workers) {
  settings.whole("--workers", "N", workers, 1, kMaxWorkers, "Threads of the service that answer");
}

void addDancerPlace(Settings& settings, Placement& place) {
  addPlaceSetting(settings, place, "Where the bundled dancer stands in the room");
}

}  // namespace foretouch::tools
