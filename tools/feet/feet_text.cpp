#include "tools/feet/feet_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/csv_cell.h"
#include "tools/feet/rest_runs.h"

namespace foretouch::tools {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
/// Rows on the terminal; the file has all.
constexpr std::size_t kMostRows = 20;

const RestingPart& partOf(const FeetInputs& inputs, const FootStance& stance) {
  return inputs.body.parts[stance.part];
}

const std::string& limbOf(const FeetInputs& inputs, const FootStance& stance) {
  return inputs.body.limbs[partOf(inputs, stance).limb].name;
}

std::string objectOf(const FeetInputs& inputs, const FootStance& stance) {
  if (stance.kind == StanceKind::Hovers) return "";
  return inputs.level.scene().objectNames()[slotOf(stance.object)];
}

/// What says when it begins, or ends: "proven", "pose", or that the clip does.
const char* saidBy(const FootStance& stance, bool isClips) {
  if (isClips) return "clip";
  return stance.kind == StanceKind::Hovers ? "pose" : "proven";
}

/// How bad it is (m).
double badness(const FootStance& stance) {
  return std::max({stance.slide, stance.depth, stance.hover});
}

/// Worst first; as they come where two are as bad.
std::vector<const FootStance*> worstOf(const FeetAnswer& answer) {
  std::vector<const FootStance*> worst;
  for (const FootStance& stance : answer.stances) worst.push_back(&stance);
  std::stable_sort(worst.begin(), worst.end(), [](const FootStance* x, const FootStance* y) {
    return badness(*x) > badness(*y);
  });
  return worst;
}

std::string head(const FeetInputs& inputs) {
  const FeetRequest& request = inputs.request;
  const auto& steps = inputs.played.steps;
  return fmt::format(
      "{} on {}: frames {} to {}, {:.4g} s to {:.4g} s, {:.5g} poses a second; a part touches "
      "within {:g} mm\n",
      request.motionPath, inputs.isPlain ? "a plain floor at y = 0" : request.scenePath,
      steps.frameOf(0), steps.frameOf(steps.count), inputs.timeOf(0), inputs.timeOf(steps.count),
      1.0 / inputs.stepS(), kFeetMm * request.tolerance);
}

std::string millimetres(double metres, bool isTold = true) {
  return isTold ? fmt::format("{:.1f}", kFeetMm * metres) : "-";
}

/// Of the column with the names of feet and hands.
std::size_t nameWidth(const FeetInputs& inputs) {
  std::size_t width = 12;
  for (const RestingLimb& limb : inputs.body.limbs) width = std::max(width, limb.name.size());
  return width;
}

std::string rowOf(const FeetInputs& inputs, const FootStance& stance) {
  const bool hovers = stance.kind == StanceKind::Hovers, touches = !hovers;
  return fmt::format("{:<{}} {:<5} {:<8}{:>8.3f}{:>9.3f}{:>7}-{:<7}{:>7}{:>8}{:>8}{:>9}{:>8}\n",
                     limbOf(inputs, stance), nameWidth(inputs),
                     toString(partOf(inputs, stance).part), toString(stance.kind), stance.fromS,
                     stance.toS, stance.fromFrame, stance.toFrame,
                     millimetres(stance.slide, touches), millimetres(stance.moved, touches),
                     millimetres(stance.depth, !hovers),
                     stance.depth > 0.0 ? fmt::format("{:.3f}", stance.depthAtS) : "-",
                     millimetres(stance.hover, hovers));
}

std::string table(const FeetInputs& inputs, const FeetAnswer& answer) {
  const std::vector<const FootStance*> worst = worstOf(answer);
  if (worst.empty()) return "\nNo part of a foot or hand touches or hovers: it is never there\n";
  std::string text =
      fmt::format("\n{:<{}} {:<5} {:<8}{:>8}{:>9}{:>7} {:<7}{:>7}{:>8}{:>8}{:>9}{:>8}\n",
                  "worst first", nameWidth(inputs), "part", "", "from s", "to s", "frames", "",
                  "slide", "moved", "deep", "at s", "above");
  for (std::size_t i = 0; i < std::min(worst.size(), kMostRows); ++i) {
    text += rowOf(inputs, *worst[i]);
  }
  if (worst.size() > kMostRows) {
    text += fmt::format("and {} more (--output has all)\n", worst.size() - kMostRows);
  }
  return text + "slide, moved, deep and above are millimetres\n";
}

/// Of one foot or hand.
struct LimbTotals {
  std::size_t touches = 0, slides = 0, sinks = 0;
  double slide = 0.0, hoverS = 0.0, underS = 0.0;
  const FootStance *worstSlide = nullptr, *deepest = nullptr;

  void add(const FootStance& stance) {
    if (stance.kind == StanceKind::Hovers) hoverS += stance.durationS();
    underS += stance.underS;
    if (deepest == nullptr || stance.depth > deepest->depth) deepest = &stance;
    sinks += stance.depth >= kSinks ? 1 : 0;
    if (stance.kind == StanceKind::Hovers) return;
    ++touches;
    slides += stance.slide >= kSlides ? 1 : 0;
    slide += stance.slide;
    if (worstSlide == nullptr || stance.slide > worstSlide->slide) worstSlide = &stance;
  }
};

std::vector<LimbTotals> totalsOf(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::vector<LimbTotals> totals(inputs.body.limbs.size());
  for (const FootStance& stance : answer.stances) totals[partOf(inputs, stance).limb].add(stance);
  return totals;
}

std::string sentenceOf(const FeetInputs& inputs, std::size_t limb, const LimbTotals& of) {
  std::string text = inputs.body.limbs[limb].name + ": ";
  if (of.touches == 0) {
    text += "touches nothing";
  } else {
    text += fmt::format("{} {}; ", of.touches, of.touches == 1 ? "touch" : "touches");
    text += of.slides == 0
                ? fmt::format("none slides {:g} mm", kFeetMm * kSlides)
                : fmt::format("{} {} {:g} mm or more, the worst {:.1f} mm ({} at {:.2f} s)",
                              of.slides, of.slides == 1 ? "slides" : "slide", kFeetMm * kSlides,
                              kFeetMm * of.worstSlide->slide,
                              toString(partOf(inputs, *of.worstSlide).part), of.worstSlide->fromS);
  }
  if (of.sinks > 0) {
    text +=
        fmt::format("; {} {} in {:g} mm or more, the deepest {:.1f} mm (frame {})", of.sinks,
                    of.sinks == 1 ? "sinks" : "sink", kFeetMm * kSinks, kFeetMm * of.deepest->depth,
                    std::llround(of.deepest->depthAtS / inputs.played.clip.frameTimeS));
  }
  if (of.hoverS > 0.0) text += fmt::format("; hovers for {:.2f} s", of.hoverS);
  if (of.underS > 0.0) text += fmt::format("; parts are below the ground for {:.2f} s", of.underS);
  return text + "\n";
}

std::string sentences(const FeetInputs& inputs, const FeetAnswer& answer) {
  const std::vector<LimbTotals> totals = totalsOf(inputs, answer);
  std::string text = "\n";
  for (std::size_t limb = 0; limb < totals.size(); ++limb) {
    const bool isIdle = inputs.body.limbs[limb].isHand && totals[limb].touches == 0;
    if (!isIdle) text += sentenceOf(inputs, limb, totals[limb]);
  }
  return text;
}

std::string fieldText(const FieldMetrics& field) {
  return fmt::format(
      "\nas papers count, by poses: skating ratio {:.4f} (guided-motion-diffusion), penetration "
      "mean {:.1f} mm, greatest {:.1f} mm, floating mean {:.1f} mm\n",
      field.skatingRatio, kFeetMm * field.meanPenetration, kFeetMm * field.mostPenetration,
      kFeetMm * field.meanFloating);
}

std::string curveText(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::string raised = fmt::format("\n{:<22}", "if raised by, mm"),
              touches = fmt::format("{:<22}", "touches of feet"),
              seconds = fmt::format("{:<22}", "seconds of touch");
  for (const Sensitivity& at : sensitivityOf(inputs, answer)) {
    raised += fmt::format("{:>7.0f}", kFeetMm * at.raise);
    touches += fmt::format("{:>7}", at.touches);
    seconds += fmt::format("{:>7.2f}", at.touchS);
  }
  return raised + "\n" + touches + "\n" + seconds + "\n";
}

void writeFit(const FeetInputs& inputs, JsonWriter& out) {
  const FloorFit& fit = *inputs.fit;
  out.key("ground_fit");
  out.beginObject();
  out.field("raised_by", inputs.fitShift);
  out.field("tilt_deg", kDegrees * fit.tilt);
  out.field("uncertainty", fit.uncertainty);
  out.field("spread", fit.spread);
  out.field("rests", fit.rests);
  out.field("rests_on_floor", fit.onFloor);
  out.endObject();
}

void writeLimb(const FeetInputs& inputs, std::size_t limb, const LimbTotals& of, JsonWriter& out) {
  out.beginObject();
  out.field("name", inputs.body.limbs[limb].name);
  out.field("touches", of.touches);
  out.field("slides", of.slides);
  out.field("worst_slide", of.worstSlide == nullptr ? 0.0 : of.worstSlide->slide);
  out.field("sinks", of.sinks);
  out.field("deepest", of.deepest == nullptr ? 0.0 : of.deepest->depth);
  out.field("hovers_s", of.hoverS);
  out.field("under_s", of.underS);
  out.endObject();
}

}  // namespace

std::string fitText(const FeetInputs& inputs) {
  if (!inputs.fit) return "";
  const FloorFit& fit = *inputs.fit;
  const double shift = kFeetMm * inputs.fitShift;
  const Eigen::Vector3d& origin = inputs.request.placement.origin;
  std::string text = fmt::format(
      "ground fitted: {} by {:.1f} mm +- {:.1f} mm (95 %), as {} of {} rests of feet show, which "
      "differ by {:.1f} mm",
      shift < 0.0 ? "lowered" : "raised", std::abs(shift), kFeetMm * fit.uncertainty, fit.onFloor,
      fit.rests, kFeetMm * fit.spread);
  text += fit.tilt * kDegrees < 0.05
              ? std::string("; its floor is level")
              : fmt::format("; its floor was tilted by {:.2f} degrees, and is level now",
                            kDegrees * fit.tilt);
  return text + fmt::format(". The height alone: --place {:.4g},{:.4f},{:.4g},{:g}\n", origin.x(),
                            origin.y() + inputs.fitShift, origin.z(),
                            inputs.request.placement.yawDeg);
}

std::string feetText(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::string text = head(inputs) + fitText(inputs) + table(inputs, answer) +
                     sentences(inputs, answer) + curveText(inputs, answer) +
                     fieldText(answer.field);
  if (answer.unresolvedS > 0.0) {
    text += fmt::format("for {:.3f} s nothing is claimed: contacts could not be resolved\n",
                        answer.unresolvedS);
  }
  return text;
}

std::string feetCsv(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::string text =
      "limb,part,kind,object,from_s,to_s,from_frame,to_frame,begin,end,slide_mm,moved_mm,depth_mm,"
      "depth_s,least_way_mm,hover_mm\n";
  const auto told = [](bool isTold, double value) {
    return isTold ? fmt::format("{:.4f}", value) : std::string();
  };
  for (const FootStance& stance : answer.stances) {
    const bool hovers = stance.kind == StanceKind::Hovers, touches = !hovers;
    text += fmt::format(
        "{},{},{},{},{:.6f},{:.6f},{},{},{},{},{},{},{},{},{},{}\n",
        csvCell(limbOf(inputs, stance)), toString(partOf(inputs, stance).part),
        toString(stance.kind), csvCell(objectOf(inputs, stance)), stance.fromS, stance.toS,
        stance.fromFrame, stance.toFrame, saidBy(stance, stance.beganBefore),
        saidBy(stance, stance.goesOn), told(touches, kFeetMm * stance.slide),
        told(touches, kFeetMm * stance.moved), told(!hovers, kFeetMm * stance.depth),
        told(stance.depth > 0.0, stance.depthAtS), told(touches, kFeetMm * stance.leastWay),
        told(hovers, kFeetMm * stance.hover));
  }
  return text;
}

std::string feetJson(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("motion", inputs.request.motionPath);
  out.field("scene", inputs.request.scenePath);
  out.field("poses", inputs.steps() + 1);
  out.field("tolerance", inputs.request.tolerance);
  if (inputs.fit) writeFit(inputs, out);
  const std::vector<LimbTotals> totals = totalsOf(inputs, answer);
  out.key("limbs");
  out.beginArray();
  for (std::size_t limb = 0; limb < totals.size(); ++limb) {
    writeLimb(inputs, limb, totals[limb], out);
  }
  out.endArray();
  out.list("sensitivity", sensitivityOf(inputs, answer), [&](const Sensitivity& at) {
    out.beginObject();
    out.field("raise", at.raise);
    out.field("touches", at.touches);
    out.field("touch_s", at.touchS);
    out.endObject();
  });
  out.field("skating_ratio", answer.field.skatingRatio);
  out.field("mean_penetration", answer.field.meanPenetration);
  out.field("greatest_penetration", answer.field.mostPenetration);
  out.field("mean_floating", answer.field.meanFloating);
  out.field("unresolved_s", answer.unresolvedS);
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
