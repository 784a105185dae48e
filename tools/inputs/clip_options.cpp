#include "tools/inputs/clip_options.h"

#include <CLI/CLI.hpp>

#include "tools/arguments.h"

namespace foretouch::tools {

void addClipOptions(CLI::App& command, ClipTexts& texts) {
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command.add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--scale", texts.scale, "S", "Metres per unit of the clip: 0.01 for centimetres");
  option("--motion-up", texts.motionUp, "y|z", "Which axis of the clip points up");
  option("--place", texts.place, "X,Y,Z[,YAW]",
         "Where the clip's origin stands in the scene: metres, and degrees about +Y");
  option("--map", texts.map, "FILE", R"(Joint names that differ: {"avatar joint": "clip joint"})");
  option("--animation", texts.animation, "NAME",
         "Which animation of a model: its name, or its number from 0; the first if not given");
  option("--robot", texts.robot, "URDF", "The robot that joint positions are about");
  command
      .add_option("--package", texts.packages, "Folder of the robot's packages; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

Result<Placement> placementOf(const ClipTexts& texts) {
  const auto up = parseUpAxis("--motion-up", texts.motionUp);
  if (!up.ok()) return up.error();
  auto placement = parsePlacement("--place", texts.place);
  if (placement.ok()) placement.value().motionUpZ = up.value() == UpAxis::Z;
  return placement;
}

Result<double> scaleOf(const ClipTexts& texts) {
  return parsePositive("--scale", texts.scale);
}

Result<std::optional<double>> rateOf(const ClipTexts& texts) {
  if (texts.rate == "all") return std::optional<double>();
  const auto rate = parsePositive("--rate", texts.rate);
  if (!rate.ok()) return rate.error();
  return std::optional<double>(rate.value());
}

}  // namespace foretouch::tools
