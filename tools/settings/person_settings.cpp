#include "tools/settings/person_settings.h"

#include "network/stream/person_stream.h"
#include "tools/microseconds.h"

namespace foretouch::tools {
namespace {

constexpr char kPersonGroup[] = "The person";
constexpr NumberRange kAheadRange{0.0, static_cast<double>(kMostAheadUs) / kUsPerS, "seconds", "s",
                                  true};

}  // namespace

BracketOptions bracketOptionsOf(const QueryOptions& query) {
  BracketOptions options;
  if (query.fidelity == Fidelity::Exact) options.surface = query.surface;
  options.self = query.self;
  options.ignored = query.ignored;
  return options;
}

void addPersonSettings(Settings& settings, PersonRequest& request) {
  settings
      .path("--bounds", "FILE", request.boundsPath,
            "Also what the person surely touched, perhaps, or not at all, within these bounds on "
            "how far they are from the motion between two poses (foretouch bounds), or "
            "preset:sara-shield, preset:optical, preset:markerless, preset:inertial-suit or "
            "preset:vr-trackers")
      .files("json")
      .in(kPersonGroup)
      .inConfig("person", "bounds");
  settings
      .word<MotionModel>("--between", "WORD", request.model,
                         {{"constant-rate", MotionModel::ConstantRate},
                          {"cubic", MotionModel::Cubic},
                          {"cubic-late", MotionModel::CubicLate}},
                         "The motion between two poses that the bounds are about; cubic-late needs "
                         "the pose after them")
      .in(kPersonGroup)
      .inConfig("person", "between");
  settings
      .seconds("--ahead", request.aheadUs, kAheadRange,
               "Look so far ahead of each pose: until when does each link touch nothing? 0: not")
      .in(kPersonGroup)
      .inConfig("person", "ahead_s")
      .needing("--bounds");
}

}  // namespace foretouch::tools
