#include "tools/feet/feet_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/csv_cell.h"
#include "tools/feet/foot_touches.h"
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

/// The word for what shows its begin, or end: "proven", "pose", or "clip" if the clip does.
const char* saidBy(const FootStance& stance, bool isClips) {
  if (isClips) return "clip";
  return stance.kind == StanceKind::Hovers ? "pose" : "proven";
}

/// How bad it is (m). What slides or sinks in comes before all that hovers: a heel that is carried
/// low through a step hovers, too.
double badness(const FootStance& stance) {
  constexpr double kBeforeHovers = 1e3;
  const double fault = std::max(stance.slide, stance.depth);
  return fault >= kSlides ? kBeforeHovers + fault : std::max(fault, stance.hover);
}

/// Worst first; equally bad ones stay in their order.
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

/// The width of the column with the names of feet and hands.
std::size_t nameWidth(const FeetInputs& inputs) {
  std::size_t width = 20;
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
                  "stances, worst first", nameWidth(inputs), "part", "", "from s", "to s", "frames",
                  "", "slide", "moved", "deep", "at s", "above");
  for (std::size_t i = 0; i < std::min(worst.size(), kMostRows); ++i) {
    text += rowOf(inputs, *worst[i]);
  }
  if (worst.size() > kMostRows) {
    text += fmt::format("and {} more (--output has all)\n", worst.size() - kMostRows);
  }
  return text + "slide, moved, deep and above are millimetres\n";
}

/// The totals of one foot or hand, by its touches.
struct LimbTotals {
  std::size_t touches = 0, slides = 0, sinks = 0;
  double hoverS = 0.0, underS = 0.0;
  const FootStance *worstSlide = nullptr, *deepest = nullptr;

  void add(const FootTouch& touch) {
    ++touches;
    slides += touch.slide >= kSlides ? 1 : 0;
    sinks += touch.depth >= kSinks ? 1 : 0;
    if (worstSlide == nullptr || touch.slide > worstSlide->slide) worstSlide = touch.worstSlide;
    if (deepest == nullptr || touch.depth > deepest->depth) deepest = touch.deepest;
  }
  void add(const FootStance& stance) {
    if (stance.kind == StanceKind::Hovers) hoverS += stance.durationS();
    underS += stance.underS;
  }
};

std::vector<LimbTotals> totalsOf(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::vector<LimbTotals> totals(inputs.body.limbs.size());
  for (const FootStance& stance : answer.stances) totals[partOf(inputs, stance).limb].add(stance);
  for (const FootTouch& touch : footTouchesOf(inputs, answer)) totals[touch.limb].add(touch);
  return totals;
}

std::string slidesInWords(const FeetInputs& inputs, const LimbTotals& of) {
  if (of.slides == 0) return fmt::format("none slides {:g} mm", kFeetMm * kSlides);
  return fmt::format("{} {} {:g} mm or more, the worst {:.1f} mm ({} from frame {}, {:.2f} s)",
                     of.slides, of.slides == 1 ? "slides" : "slide", kFeetMm * kSlides,
                     kFeetMm * of.worstSlide->slide, toString(partOf(inputs, *of.worstSlide).part),
                     of.worstSlide->fromFrame, of.worstSlide->fromS);
}

std::string sinksInWords(const FeetInputs& inputs, const LimbTotals& of) {
  if (of.sinks == 0) return fmt::format("none sinks in {:g} mm", kFeetMm * kSinks);
  return fmt::format("{} {} in {:g} mm or more, the deepest {:.1f} mm ({} at frame {}, {:.2f} s)",
                     of.sinks, of.sinks == 1 ? "sinks" : "sink", kFeetMm * kSinks,
                     kFeetMm * of.deepest->depth, toString(partOf(inputs, *of.deepest).part),
                     std::llround(of.deepest->depthAtS / inputs.played.clip.frameTimeS),
                     of.deepest->depthAtS);
}

std::string sentenceOf(const FeetInputs& inputs, std::size_t limb, const LimbTotals& of) {
  std::string text = inputs.body.limbs[limb].name + ": ";
  if (of.touches == 0) {
    text += "touches nothing";
  } else {
    text += fmt::format("{} {}; {}; {}", of.touches, of.touches == 1 ? "touch" : "touches",
                        slidesInWords(inputs, of), sinksInWords(inputs, of));
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

/// Writes metres, seconds and shares: measured in floats, which have no more digits.
void writeShort(const char* name, double value, JsonWriter& out) {
  constexpr double kDigits = 1e7;
  out.field(name, std::round(value * kDigits) / kDigits);
}

void writeLimb(const FeetInputs& inputs, std::size_t limb, const LimbTotals& of, JsonWriter& out) {
  out.beginObject();
  out.field("name", inputs.body.limbs[limb].name);
  out.field("touches", of.touches);
  out.field("slides", of.slides);
  writeShort("worst_slide", of.worstSlide == nullptr ? 0.0 : of.worstSlide->slide, out);
  out.field("sinks", of.sinks);
  writeShort("deepest", of.deepest == nullptr ? 0.0 : of.deepest->depth, out);
  writeShort("hovers_s", of.hoverS, out);
  writeShort("under_s", of.underS, out);
  out.endObject();
}

/// Writes the totals of all feet together, without hands.
void writeFeet(const FeetInputs& inputs, const std::vector<LimbTotals>& totals, JsonWriter& out) {
  std::size_t touches = 0, slides = 0, sinks = 0;
  double worstSlide = 0.0, deepest = 0.0;
  for (std::size_t limb = 0; limb < totals.size(); ++limb) {
    if (inputs.body.limbs[limb].isHand) continue;
    const LimbTotals& of = totals[limb];
    touches += of.touches;
    slides += of.slides;
    sinks += of.sinks;
    if (of.worstSlide != nullptr) worstSlide = std::max(worstSlide, of.worstSlide->slide);
    if (of.deepest != nullptr) deepest = std::max(deepest, of.deepest->depth);
  }
  out.field("touches", touches);
  out.field("slides", slides);
  writeShort("worst_slide", worstSlide, out);
  out.field("sinks", sinks);
  writeShort("deepest", deepest, out);
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
  return text + fmt::format(". The height alone: --place {},{:.4f},{},{}\n", origin.x(),
                            origin.y() + inputs.fitShift, origin.z(),
                            inputs.request.placement.yawDeg);
}

std::vector<std::string> feetSentences(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::istringstream text(sentences(inputs, answer) + fitText(inputs) + head(inputs));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

std::string feetTables(const FeetInputs& inputs, const FeetAnswer& answer) {
  return table(inputs, answer) + curveText(inputs, answer) + fieldText(answer.field);
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

void writeFit(const FeetInputs& inputs, JsonWriter& out) {
  if (!inputs.fit) return;
  const FloorFit& fit = *inputs.fit;
  out.key("ground_fit");
  out.beginObject();
  writeShort("raised_by", inputs.fitShift, out);
  writeShort("tilt_deg", kDegrees * fit.tilt, out);
  writeShort("uncertainty", fit.uncertainty, out);
  writeShort("spread", fit.spread, out);
  out.field("point", fit.center_W);
  out.field("normal", fit.normal_W);
  out.field("rests", fit.rests);
  out.field("rests_on_floor", fit.onFloor);
  out.endObject();
}

std::string feetJson(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("motion", inputs.request.motionPath);
  out.field("scene", inputs.request.scenePath);
  out.field("poses", inputs.steps() + 1);
  out.field("tolerance", inputs.request.tolerance);
  writeFit(inputs, out);
  const std::vector<LimbTotals> totals = totalsOf(inputs, answer);
  writeFeet(inputs, totals, out);
  out.key("limbs");
  out.beginArray();
  for (std::size_t limb = 0; limb < totals.size(); ++limb) {
    writeLimb(inputs, limb, totals[limb], out);
  }
  out.endArray();
  out.list("sensitivity", sensitivityOf(inputs, answer), [&](const Sensitivity& at) {
    out.beginObject();
    writeShort("raise", at.raise, out);
    out.field("touches", at.touches);
    writeShort("touch_s", at.touchS, out);
    out.endObject();
  });
  writeShort("skating_ratio", answer.field.skatingRatio, out);
  writeShort("mean_penetration", answer.field.meanPenetration, out);
  writeShort("greatest_penetration", answer.field.mostPenetration, out);
  writeShort("mean_floating", answer.field.meanFloating, out);
  writeShort("unresolved_s", answer.unresolvedS, out);
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
