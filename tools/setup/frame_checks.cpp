#include "tools/setup/frame_checks.h"

#include <fmt/format.h>

#include "tools/settings/frame_settings.h"
#include "tools/settings/plain_figures.h"
#include "tools/setup/body_offer.h"
#include "tools/setup/scene_offer.h"

namespace foretouch::tools {
namespace {

/// Nothing smaller (m) holds anything that is reported: contacts are reported within a millimetre.
constexpr double kSmallest = 0.01;

/// `size` (m), as it is read. `offer`: by what the numbers would have to be multiplied once more.
PlacementCheck unitCheck(const char* name, const char* option, const Offer<double>& offer,
                         const FileFrame& frame, double size) {
  const bool isTiny = size > 0.0 && size < kSmallest;
  const std::string unit = unitInWords(frame.metresPerUnit);
  const bool beginsWithIt = offer.reason.rfind(unit, 0) == 0;
  std::string text = beginsWithIt ? offer.reason : unit + ": " + offer.reason;
  if (isTiny) {
    text += fmt::format("; that is {} mm at most, and contacts are told within 1 mm",
                        plainFigures(1e3 * size));
  }
  const std::string tryThis =
      offer.value == 1.0
          ? ""
          : std::string(option) + " " + plainFigures(offer.value * frame.metresPerUnit);
  const bool isGood = offer.value == 1.0 && offer.isSure;
  return {name,
          isTiny   ? CheckState::Bad
          : isGood ? CheckState::Good
                   : CheckState::Doubt,
          text, tryThis};
}

}  // namespace

std::vector<PlacementCheck> sceneFrameChecks(const RawScene& raw, const FileFrame& frame) {
  const Offer<UpAxis> up = sceneUpAxisOf(raw);
  PlacementCheck axis{"scene's axis", CheckState::Good, up.reason, ""};
  // A file that says its axis is believed, unless its floors speak clearly against it.
  const bool isSaid = frame.declared.up && *frame.declared.up == frame.up;
  if (up.value == UpAxis::Z && (up.isSure || !isSaid)) {
    axis.state = CheckState::Doubt;
    axis.tryThis =
        std::string("--scene-up ") + wordOf(frame.up == UpAxis::Z ? UpAxis::Y : UpAxis::Z);
  } else if (!up.isSure && !isSaid) {
    axis.state = CheckState::Doubt;
  }
  const Eigen::AlignedBox3d box = boundsOf(raw);
  return {unitCheck("scene's unit", "--scene-scale", sceneUnitOf(raw), frame,
                    box.isEmpty() ? 0.0 : box.sizes().maxCoeff()),
          axis};
}

std::vector<PlacementCheck> clipFrameChecks(const Clip& clip, const FileFrame& frame,
                                            bool isUpright) {
  const Offer<UpAxis> up = upAxisOf(clip, isUpright);
  PlacementCheck axis{"body's axis", up.isSure ? CheckState::Good : CheckState::Doubt, up.reason,
                      ""};
  if (!isUpright && up.value != frame.up) {
    axis.state = CheckState::Doubt;
    axis.tryThis = std::string("--clip-up ") + wordOf(up.value);
  }
  const bool isInMetres = frame.declared.metresPerUnit.has_value();
  return {unitCheck("body's unit", "--clip-scale", unitOf(clip, isInMetres, frame.metresPerUnit),
                    frame, reachOf(clip)),
          axis};
}

}  // namespace foretouch::tools
