#include "assets/file_frame.h"

#include <array>
#include <cstdio>

namespace foretouch {
namespace {

std::string shortest(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", number);
  return text.data();
}

std::string applied(const DeclaredFrame& declared, const FileFrame& frame) {
  const bool unit = !declared.metresPerUnit || *declared.metresPerUnit == frame.metresPerUnit;
  const bool axis = !declared.up || *declared.up == frame.up;
  const bool saysBoth = declared.metresPerUnit && declared.up;
  if (unit && axis) return saysBoth ? "both applied" : "applied";
  if (!saysBoth || (!unit && !axis)) return "read otherwise, as asked";
  return unit ? "the unit applied, the axis read otherwise, as asked"
              : "the axis applied, the unit read otherwise, as asked";
}

}  // namespace

std::string describe(const FileFrame& frame) {
  const DeclaredFrame& declared = frame.declared;
  if (declared.isOfFormat || (!declared.metresPerUnit && !declared.up)) return "";
  std::string text = "says ";
  if (declared.metresPerUnit) text += shortest(*declared.metresPerUnit) + " m per unit";
  if (declared.metresPerUnit && declared.up) text += " and ";
  if (declared.up) text += *declared.up == UpAxis::Z ? "Z up" : "Y up";
  return text + "; " + applied(declared, frame);
}

namespace internal {

FrameChange settleFrame(std::optional<double> metresPerUnit, std::optional<UpAxis> up,
                        FileFrame& frame) {
  const double unit = metresPerUnit.value_or(frame.declared.metresPerUnit.value_or(1.0));
  const UpAxis axis = up.value_or(frame.declared.up.value_or(UpAxis::Y));
  FrameChange change;
  // The same unit leaves the numbers as they are, to the last digit.
  if (unit != frame.metresPerUnit) change.scale = unit / frame.metresPerUnit;
  if (axis != frame.up) {
    using Turn = FrameChange::Turn;
    change.turn = axis == UpAxis::Z ? Turn::FromZUp : Turn::BackToZUp;
  }
  frame.metresPerUnit = unit;
  frame.up = axis;
  frame.isUnitAsked = metresPerUnit.has_value();
  frame.isUpAsked = up.has_value();
  return change;
}

}  // namespace internal
}  // namespace foretouch
