#include "tools/settings/clip_settings.h"

#include <functional>
#include <limits>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "tools/settings/frame_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

Result<Placement> placementFrom(const std::string& text) {
  const std::vector<std::string> parts = splitAtCommas(text);
  double numbers[4] = {0.0, 0.0, 0.0, 0.0};
  bool isLegal = parts.size() == 3 || parts.size() == 4;
  for (std::size_t i = 0; isLegal && i < parts.size(); ++i) {
    isLegal = readNumber(parts[i], numbers[i]);
  }
  Placement placement;
  placement.origin = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  placement.yawDeg = numbers[3];
  if (isLegal && placement.origin.cwiseAbs().maxCoeff() <= kMaxCoordinate) return placement;
  return Error::of(ErrorCode::OutOfRange,
                   "expected x,y,z or x,y,z,yaw: finite metres within 1e7, and degrees, found " +
                       inQuotes(text));
}

Setting& addPlaceSetting(Settings& settings, Placement& place, const char* help) {
  Setting& setting = settings.parsed(
      "--place", "X,Y,Z[,YAW]",
      [&place](const std::string& text) -> Result<Done> {
        FORETOUCH_TRY(const auto parsed, placementFrom(text));
        place.origin = parsed.origin;
        place.yawDeg = parsed.yawDeg;
        return Done{};
      },
      [&place] {
        return fmt::format("{},{},{},{}", place.origin.x(), place.origin.y(), place.origin.z(),
                           place.yawDeg);
      },
      help);
  setting.json = [&place] {
    return fmt::format("[{},{},{},{}]", numberText(place.origin.x()), numberText(place.origin.y()),
                       numberText(place.origin.z()), numberText(place.yawDeg));
  };
  setting.told = [&place] {
    return fmt::format("{}, {}, {} m, turned by {} degrees", place.origin.x(), place.origin.y(),
                       place.origin.z(), place.yawDeg);
  };
  return setting;
}

Result<ClipInstant> clipInstantFrom(const std::string& text) {
  const auto isLegal = [](double number) { return number >= 0.0 && number <= 1e12; };
  std::int64_t frame = 0;
  if (!text.empty() && text.back() == 'f' && readNumber(text.substr(0, text.size() - 1), frame) &&
      isLegal(static_cast<double>(frame))) {
    return ClipInstant{static_cast<double>(frame), true};
  }
  double seconds = 0.0;
  if (readNumber(text, seconds) && isLegal(seconds)) return ClipInstant{seconds, false};
  return Error::of(
      ErrorCode::OutOfRange,
      "expected seconds of the clip, or a frame from 0 as 300f, found " + inQuotes(text));
}

namespace {

std::string textOf(const std::optional<ClipInstant>& instant) {
  if (!instant) return "";
  return tidyNumber(instant->number) + (instant->isFrame ? "f" : "");
}

void addInstant(Settings& settings, const char* option, const char* key,
                std::optional<ClipInstant>& place, const char* help) {
  Setting& setting = settings.parsed(
      option, "S|Nf",
      [&place](const std::string& text) -> Result<Done> {
        FORETOUCH_TRY(place, clipInstantFrom(text));
        return Done{};
      },
      [&place] { return textOf(place); }, help);
  setting.in(kInputGroup).inConfig("clip", key).inHeader(key).inReport(key).namedIf([&place] {
    return place.has_value();
  });
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ",") + text;
  return all;
}

void addColumns(Settings& settings, JointTableOptions& table) {
  settings
      .parsed(
          "--columns", "NAMES",
          [&table](const std::string& text) -> Result<Done> {
            table.columns = splitAtCommas(text);
            return Done{};
          },
          [&table] { return joined(table.columns); },
          "Columns of a robot's table without a header: their names, or a layout: lafan1-g1, "
          "bones-seed-g1")
      .in(kInputGroup)
      .inConfig("clip", "columns")
      .inHeader("columns")
      .inReport("columns")
      .namedIf([&table] { return !table.columns.empty(); });
}

/// Reported, and in a first line, only if it `isGiven`.
void tellIfGiven(Setting& setting, const char* key, const char* row,
                 const std::function<bool()>& isGiven) {
  setting.told = [isGiven, told = setting.told] { return isGiven() ? told() : std::string(); };
  setting.inConfig("clip", key).inHeader(key).inReport(row).namedIf(isGiven);
}

void addQuaternionOrder(Settings& settings, JointTableOptions& table) {
  Setting& order = settings.word<std::optional<QuaternionOrder>>(
      "--quaternion", "ORDER", table.quaternion,
      {{"xyzw", QuaternionOrder::Xyzw}, {"wxyz", QuaternionOrder::Wxyz}},
      "Order of the root's quaternion in an npz, unless the array's name says it");
  const auto shown = [&table]() -> std::string {
    if (!table.quaternion) return kAsFileSays;
    return *table.quaternion == QuaternionOrder::Xyzw ? "xyzw" : "wxyz";
  };
  order.shown = order.told = shown;
  order.json = [shown] { return jsonString(shown()); };
  tellIfGiven(order.in(kUnitsGroup), "quaternion", "quaternions",
              [&table] { return table.quaternion.has_value(); });
}

/// What a robot's table does not say itself.
void addTableSettings(Settings& settings, JointTableOptions& table) {
  addColumns(settings, table);
  Setting& rate = settings.number("--row-rate", "HZ", table.rateHz, kAboveZero, "",
                                  "Rows per second of a robot's table without times");
  rate.shown = [&table] { return table.rateHz ? numberText(*table.rateHz) : kAsFileSays; };
  tellIfGiven(rate.in(kInputGroup), "row_rate", "rows per second",
              [&table] { return table.rateHz.has_value(); });
  addQuaternionOrder(settings, table);
  Setting& angles = settings.word<bool>("--angles", "UNIT", table.isInDegrees,
                                        {{"radians", false}, {"degrees", true}},
                                        "Unit of the angles of a robot's table");
  tellIfGiven(angles.in(kUnitsGroup), "angles", "angles", [&table] { return table.isInDegrees; });
  Setting& scale =
      addUnit(settings, "--table-scale", table.metresPerUnit,
              "Metres per unit of the lengths of a robot's table: 0.01 for centimetres");
  tellIfGiven(scale.in(kUnitsGroup), "table_scale", "table's unit",
              [&table] { return table.metresPerUnit.has_value(); });
}

void addSourceSettings(Settings& settings, ClipRequest& request) {
  settings
      .text("--animation", "NAME", request.animation,
            "Which animation of a model: its name, or its number from 0; the first if not given")
      .in(kInputGroup)
      .inConfig("clip", "animation")
      .inHeader("animation")
      .inReport("animation")
      .namedIf([&request] { return !request.animation.empty(); });
  settings.path("--robot", "URDF", request.robotPath, "The robot that joint positions are about")
      .files("urdf")
      .in(kInputGroup)
      .inConfig("clip", "robot")
      .inHeader("robot")
      .inReport("robot")
      .namedIf([&request] { return !request.robotPath.empty(); });
  settings
      .path("--skeleton", "FILE", request.skeletonPath,
            "What a motion is about: the ASF of an AMC, or the body model (npz) of one of SMPL")
      .files("asf npz")
      .in(kInputGroup)
      .inConfig("clip", "skeleton")
      .inHeader("skeleton")
      .inReport("skeleton")
      .namedIf([&request] { return !request.skeletonPath.empty(); });
  addTableSettings(settings, request.table);
  settings
      .path("--map", "FILE", request.mapPath,
            R"(Joint names that differ: {"avatar joint": "clip joint"})")
      .in(kInputGroup)
      .files("json")
      .inConfig("clip", "map")
      .inReport("joint map");
  settings
      .list("--package", "DIR", request.packagePaths,
            "Folder of the robot's packages; may be repeated")
      .in(kInputGroup)
      .inConfig("clip", "packages")
      .isPath = true;
}

}  // namespace

Setting& addMotionSetting(Settings& settings, ClipRequest& request, const char* option,
                          const char* value, const char* help) {
  return settings.path(option, value, request.motionPath, help)
      .files(kClipEndings)
      .in(kInputGroup)
      .inConfig("clip", "file")
      .inHeader("motion")
      .inReport("motion");
}

Setting& addAvatarSetting(Settings& settings, ClipRequest& request) {
  return settings.path("--avatar", "FILE", request.avatarPath, "Avatar file (see foretouch avatar)")
      .files("json")
      .in(kInputGroup)
      .inConfig("avatar", "file")
      .inReport("avatar");
}

Setting& addRateSetting(Settings& settings, ClipRequest& request, const char* help) {
  return settings.number("--rate", "HZ", request.rateHz, kAboveZero, "all", help)
      .in(kInputGroup)
      .inConfig("clip", "rate")
      .inHeader("rate");
}

void addClipReadingSettings(Settings& settings, ClipRequest& request) {
  addUnit(settings, "--clip-scale", request.motionScale,
          "Metres per unit of the clip: 0.01 for centimetres")
      .formerly("--scale")
      .in(kUnitsGroup)
      .inConfig("clip", "scale")
      .inHeader("scale")
      .inReport("motion's unit");
  Setting& up =
      addUpAxis(settings, "--clip-up", request.motionUp, "Which axis of the clip points up")
          .formerly("--motion-up")
          .in(kUnitsGroup)
          .inConfig("clip", "up")
          .inHeader("motion_up")
          .inReport("motion's up axis");
  up.take = [&request, take = up.take](const GivenValue& given) -> Result<Done> {
    FORETOUCH_CHECK(take(given));
    request.placement.motionUpZ = request.motionUp == UpAxis::Z;
    return Done{};
  };
  addSourceSettings(settings, request);
}

void addCutSettings(Settings& settings, ClipRequest& request) {
  addInstant(settings, "--from", "from", request.cut.from,
             "Where to begin in the clip: seconds, or a frame from 0 (300f)");
  addInstant(settings, "--to", "to", request.cut.to,
             "Where to end in the clip: seconds, or a frame from 0 (300f)");
  addSkipTPose(settings, request);
}

Setting& addSkipTPose(Settings& settings, ClipRequest& request) {
  return settings
      .flag("--skip-t-pose", request.cut.skipsTPose,
            "Leave out the T-pose that the clip begins with")
      .in(kInputGroup)
      .inConfig("clip", "skip_t_pose")
      .inHeader("skip_t_pose")
      .inReport("T-pose left out")
      .namedIf([&request] { return request.cut.skipsTPose; });
}

void addClipSettings(Settings& settings, ClipRequest& request) {
  addClipReadingSettings(settings, request);
  addPlaceSetting(settings, request.placement,
                  "Where the clip's origin stands in the scene: metres, and degrees about +Y")
      .in(kUnitsGroup)
      .inConfig("clip", "place")
      .inHeader("place")
      .inReport("placed at");
}

}  // namespace foretouch::tools
