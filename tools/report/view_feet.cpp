#include "tools/report/view_feet.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/feet/foot_touches.h"
#include "tools/feet/stances.h"

namespace foretouch::tools {
namespace {

RawScene rawOf(const Scene& scene) {
  RawScene raw;
  raw.objectNames = scene.objectNames();
  const auto triangles = static_cast<TriangleId>(scene.audit().triangles);
  for (TriangleId triangle = 0; triangle < triangles; ++triangle) {
    raw.triangles.push_back(scene.triangle(triangle));
    raw.objectOf.push_back(scene.object(triangle));
  }
  return raw;
}

Result<FeetInputs> feetInputsOf(const ReplayInputs& inputs, RestingBody body, std::int64_t steps) {
  FORETOUCH_TRY(auto level, Level::build(rawOf(inputs.scene)));
  FeetRequest request;
  static_cast<ClipRequest&>(request) = inputs.request;
  static_cast<WorldRequest&>(request) = inputs.request;
  StepSelection kept = inputs.steps;
  Clip clip = inputs.clip;
  if (inputs.curve) {  // feet rest at the clip's own poses
    kept = inputs.curve->given;
    steps /= inputs.curve->pieces;
    clip.frameTimeS = inputs.curve->frameTimeS;
    clip.framesPerRow = 1;
  }
  kept.count = std::min(kept.count, steps);
  PlayedClip played{inputs.avatar, std::move(clip),  inputs.match,
                    kept,          inputs.isUpright, inputs.clipFrame};
  FeetInputs feet{
      std::move(request), std::move(played), std::move(body), std::move(level), false, 0, 0, {}};
  return feet;
}

ViewStance stanceOf(const FootTouch& touch, const RestingBody& body) {
  const auto wordOf = [&](const FootStance& stance) {
    return std::string(toString(body.parts[stance.part].part));
  };
  const bool isUnder = touch.deepest->kind == StanceKind::Under;
  ViewStance shown;
  shown.kind = isUnder ? "under" : "touches";
  shown.beginS = touch.fromS;
  shown.endS = touch.toS;
  shown.beganBefore = touch.beganBefore;
  shown.goesOn = touch.goesOn;
  shown.slide = touch.slide;
  shown.slides = wordOf(*touch.worstSlide);
  shown.depth = touch.depth;
  shown.deepest = wordOf(*touch.deepest);
  shown.depthAtS = touch.deepest->depthAtS;
  if (touch.slide >= kSlides) shown.trace_W = touch.worstSlide->trace_W;
  return shown;
}

ViewStance stanceOf(const FootStance& hovering) {
  ViewStance shown;
  shown.kind = toString(hovering.kind);
  shown.beginS = hovering.fromS;
  shown.endS = hovering.toS;
  shown.beganBefore = hovering.beganBefore;
  shown.goesOn = hovering.goesOn;
  shown.hover = hovering.hover;
  return shown;
}

std::vector<ViewFoot> feetOf(const FeetInputs& inputs, const FeetAnswer& answer) {
  const RestingBody& body = inputs.body;
  std::vector<ViewFoot> feet(body.limbs.size());
  for (const FootTouch& touch : footTouchesOf(inputs, answer)) {
    feet[touch.limb].stances.push_back(stanceOf(touch, body));
  }
  for (const FootStance& stance : answer.stances) {
    if (stance.kind != StanceKind::Hovers) continue;
    feet[body.parts[stance.part].limb].stances.push_back(stanceOf(stance));
  }
  std::vector<ViewFoot> shown;
  for (std::size_t limb = 0; limb < feet.size(); ++limb) {
    if (body.limbs[limb].isHand) continue;  // they touch, and rest on nothing
    ViewFoot& foot = feet[limb];
    foot.link = body.limbs[limb].ankle;
    std::stable_sort(foot.stances.begin(), foot.stances.end(),
                     [](const ViewStance& x, const ViewStance& y) { return x.beginS < y.beginS; });
    shown.push_back(std::move(foot));
  }
  return shown;
}

}  // namespace

void addFeet(const ReplayInputs& inputs, std::int64_t steps, ViewDocument& document) {
  auto body = restingBodyOf(inputs.avatar);
  if (!body.ok() || steps < 1) return;
  const auto asked = [&]() -> Result<Done> {
    FORETOUCH_TRY(const auto feet, feetInputsOf(inputs, std::move(body).value(), steps));
    FORETOUCH_TRY(const auto answer, stancesOf(feet, [](std::int64_t) { return true; }));
    document.feet = feetOf(feet, answer);
    return Done{};
  }();
  if (!asked.ok()) {
    document.notes.push_back("How the feet rest is not shown: " + describe(asked.error()));
  }
}

}  // namespace foretouch::tools
