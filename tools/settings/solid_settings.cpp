#include "tools/settings/solid_settings.h"

#include <fmt/format.h>

namespace foretouch::tools {
namespace {

// As SolidAvatar::build() takes them.
constexpr NumberRange kSkinRange{1e-5, 0.1, "metres", "m"};
constexpr NumberRange kCatchUpRange{1e-3, 1e3, "metres per second", "m/s"};
constexpr std::int64_t kMostAround = 100'000;

/// Part of a solid avatar only.
Setting& ofSolid(Setting& setting) {
  return setting.in(kSolidGroup).needing("--solid");
}

/// A report names it only where there is a solid avatar.
void tellOnlyIf(const SolidRequest& request, Setting& setting) {
  setting.told = [&request, told = setting.told] {
    return request.isAsked ? told() : std::string();
  };
}

}  // namespace

void addSolidSettings(Settings& settings, SolidRequest& request) {
  SolidOptions& options = request.options;
  settings
      .flag("--solid", request.isAsked,
            "Show an avatar that passes through nothing: it follows the tracked one as closely as "
            "surfaces let it (docs/formats.md, Shown poses)")
      .in(kSolidGroup)
      .inConfig("solid", "show");
  Setting& skin = ofSolid(settings.number("--solid-skin", "M", options.skin, kSkinRange,
                                          "Gap (m) that it keeps to surfaces where it can"))
                      .inConfig("solid", "skin")
                      .inReport("gap to surfaces");
  tellOnlyIf(request, skin);
  Setting& catchUp =
      ofSolid(settings.number("--catch-up", "M/S", options.catchUp, kCatchUpRange,
                              "How much faster (m/s) than the tracked pose it may move until it "
                              "is there again"))
          .inConfig("solid", "catch_up")
          .inReport("catches up by");
  tellOnlyIf(request, catchUp);
  Setting& floor =
      ofSolid(settings.word<FloorPolicy>("--floor", "lift|hold", options.floor,
                                         {{toString(FloorPolicy::Lift), FloorPolicy::Lift},
                                          {toString(FloorPolicy::Hold), FloorPolicy::Hold}},
                                         "Tracked feet below the floor: lift the whole body, or "
                                         "hold the feet as by any surface"))
          .inConfig("solid", "floor")
          .inReport("feet below the floor");
  tellOnlyIf(request, floor);
  Setting& snap =
      ofSolid(settings.flag("--snap", options.maySnap,
                            "It may appear at the tracked pose where it cannot get there, after "
                            "notice (state snapped)"))
          .inConfig("solid", "snap")
          .inReport("may snap");
  snap.told = [&request] { return request.isAsked && request.options.maySnap ? "yes" : ""; };
  Setting& around =
      ofSolid(settings.whole("--around", "N", options.aroundPerTick, 0, kMostAround,
                             "Motions that a tick may try on the search for a way around; 0: "
                             "no search"))
          .inConfig("solid", "around")
          .inReport("way around");
  around.told = [&request] {
    return request.isAsked ? fmt::format("{} motions a tick at most", request.options.aroundPerTick)
                           : "";
  };
}

}  // namespace foretouch::tools
