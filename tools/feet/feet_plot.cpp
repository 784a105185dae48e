#include "tools/feet/feet_plot.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "tools/feet/feet_text.h"
#include "tools/html_text.h"

namespace foretouch::tools {
namespace {

constexpr double kWidth = 1100.0, kLeft = 190.0, kRight = 20.0, kLane = 34.0, kTop = 12.0;
constexpr double kMapWidth = 1100.0, kMapLeast = 160.0, kMapMost = 520.0, kMapMargin = 70.0;
/// A lane's line for depth is this deep (m) where it reaches the lane's bottom.
constexpr double kDeepest = 0.05;
/// Samples drawn in a lane at most: more than pixels.
constexpr std::int64_t kMostDrawn = 2200;
/// Slides that have a number on the map, and a line below it.
constexpr std::size_t kNamed = 12;

constexpr char kPageHead[] = R"page(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Feet of {0}</title>
<meta name="viewport" content="width=device-width"><style>
body {{ font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 72em; padding: 0 1em;
color: #1c2430; background: #fff; --ink: #1c2430; --grid: #d5d9e0; --ok: #7fa8d9; --slide: #d9541e;
--hover: #9a7bd0; --under: #7a1f1f; --deep: #b3202c; }}
.wide {{ overflow-x: auto; }}
svg {{ width: 100%; min-width: 44em; height: auto; font: 13px system-ui, sans-serif; }}
svg text {{ fill: var(--ink); }} .grid {{ stroke: var(--grid); }}
.name {{ paint-order: stroke; stroke: #fff; stroke-width: 3px; }}
.deep {{ fill: none; stroke: var(--deep); stroke-width: 1.4; }}
.trace {{ fill: none; stroke: var(--slide); stroke-width: 2.2; }}
.path {{ fill: none; stroke: var(--grid); stroke-width: 1.2; }}
h1, p, li {{ overflow-wrap: anywhere; }}
pre {{ overflow-x: auto; font-size: 12px; line-height: 1.35; }}
.key span {{ display: inline-block; margin-right: 1.4em; }} .key i {{ display: inline-block;
width: 1.2em; height: .8em; margin-right: .4em; }}
@media (prefers-color-scheme: dark) {{ body {{ color: #e6e6e6; background: #16181c; --ink: #e6e6e6;
--grid: #444; --ok: #5a86bd; }} .name {{ stroke: #16181c; }} }}
</style></head><body><h1>Feet of {0}</h1>
)page";

constexpr char kKey[] =
    R"page(<p class="key"><span><i style="background:var(--ok)"></i>touches</span>
<span><i style="background:var(--slide)"></i>touches and slides</span>
<span><i style="background:var(--hover)"></i>hovers</span>
<span><i style="background:var(--under)"></i>below the ground</span>
<span><i style="background:var(--deep);height:2px;vertical-align:middle"></i>depth, 0 to 50 mm
downwards</span></p>
)page";

/// The file's name without its folders, as pages show it.
std::string shortName(const std::string& path) {
  return inHtml(path.substr(path.rfind('/') + 1));
}

const char* colourOf(const FootStance& stance) {
  if (stance.kind == StanceKind::Hovers) return "var(--hover)";
  if (stance.kind == StanceKind::Under) return "var(--under)";
  return stance.slide >= kSlides ? "var(--slide)" : "var(--ok)";
}

std::string titleOf(const FeetInputs& inputs, const FootStance& stance) {
  std::string text =
      fmt::format("{}: {} {:.3f} to {:.3f} s, frames {} to {}",
                  inputs.body.nameOf(inputs.body.parts[stance.part]), toString(stance.kind),
                  stance.fromS, stance.toS, stance.fromFrame, stance.toFrame);
  if (stance.kind == StanceKind::Hovers) {
    return text + fmt::format(", {:.1f} mm above", kFeetMm * stance.hover);
  }
  text += fmt::format(", slides {:.1f} mm", kFeetMm * stance.slide);
  if (stance.depth > 0.0) {
    text += fmt::format(", {:.1f} mm deep at {:.3f} s", kFeetMm * stance.depth, stance.depthAtS);
  }
  return text;
}

/// The lanes over time.
class Lanes {
 public:
  Lanes(const FeetInputs& inputs, const FeetAnswer& answer)
      : inputs_(inputs),
        answer_(answer),
        beginS_(inputs.timeOf(0)),
        endS_(inputs.timeOf(inputs.steps())) {}

  std::string svg() {
    const std::size_t parts = inputs_.body.parts.size();
    const double height = kTop + kLane * static_cast<double>(parts) + 40.0;
    addAxis(height - 36.0);
    for (std::size_t part = 0; part < parts; ++part) addLane(part);
    return fmt::format(
        "<div class=\"wide\"><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Parts of feet "
        "over time\">\n{}</svg></div>\n",
        kWidth, height, svg_);
  }

 private:
  [[nodiscard]] double x(double timeS) const {
    return kLeft + (kWidth - kLeft - kRight) * (timeS - beginS_) / (endS_ - beginS_);
  }
  void addAxis(double bottom);
  void addLane(std::size_t part);
  void addDepth(std::size_t part, double top);

  const FeetInputs& inputs_;
  const FeetAnswer& answer_;
  double beginS_, endS_;
  std::string svg_;
};

void Lanes::addAxis(double bottom) {
  const double span = endS_ - beginS_;
  double every = std::pow(10.0, std::floor(std::log10(span / 4.0)));
  if (span / every > 20.0) every *= 5.0;
  if (span / every > 10.0) every *= 2.0;
  for (double at = std::ceil(beginS_ / every) * every; at <= endS_; at += every) {
    svg_ += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2:.1f}\"/>"
        "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4:.6g} s</text>\n",
        x(at), kTop, bottom, bottom + 18.0, at);
  }
}

void Lanes::addLane(std::size_t part) {
  const double top = kTop + kLane * static_cast<double>(part);
  svg_ += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLeft - 10.0,
                      top + 0.6 * kLane, inHtml(inputs_.body.nameOf(inputs_.body.parts[part])));
  for (const FootStance& stance : answer_.stances) {
    if (stance.part != part) continue;
    svg_ += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"><title>{}"
        "</title></rect>\n",
        x(stance.fromS), top + 6.0, std::max(1.0, x(stance.toS) - x(stance.fromS)), kLane - 12.0,
        colourOf(stance), inHtml(titleOf(inputs_, stance)));
  }
  addDepth(part, top);
}

void Lanes::addDepth(std::size_t part, double top) {
  const std::int64_t every = 1 + inputs_.steps() / kMostDrawn;
  std::string points;
  bool isDeep = false;
  for (std::int64_t step = 0; step <= inputs_.steps(); step += every) {
    double depth = 0.0;  // the greatest of the depths that one point stands for
    for (std::int64_t i = step; i < std::min(step + every, inputs_.steps() + 1); ++i) {
      depth = std::max<double>(depth, answer_.sample(i, part, inputs_.body.parts.size()).depth);
    }
    isDeep = isDeep || depth > 0.0;
    points += fmt::format("{:.1f},{:.1f} ", x(inputs_.timeOf(step)),
                          top + 6.0 + (kLane - 12.0) * std::min(1.0, depth / kDeepest));
  }
  if (isDeep) svg_ += "<polyline class=\"deep\" points=\"" + points + "\"/>\n";
}

/// Stances with a slide to draw, the worst first.
std::vector<const FootStance*> slidesOf(const FeetAnswer& answer) {
  std::vector<const FootStance*> slides;
  for (const FootStance& stance : answer.stances) {
    if (stance.slide >= kSlides && stance.trace_W.size() > 1) slides.push_back(&stance);
  }
  std::stable_sort(slides.begin(), slides.end(),
                   [](const FootStance* a, const FootStance* b) { return a->slide > b->slide; });
  return slides;
}

/// Slides from above, each where it began and drawn longer than it is.
class SlideMap {
 public:
  SlideMap(const FeetInputs& inputs, std::vector<const FootStance*> slides)
      : inputs_(inputs), slides_(std::move(slides)) {
    for (const FootStance* slide : slides_) {
      for (const auto& p : slide->trace_W) box_.extend(flat(p));
    }
    // The longer way lies along the page.
    isTurned_ = box_.sizes().y() > box_.sizes().x();
    const Eigen::Vector2d size = box_.sizes().cwiseMax(0.2);
    const double wide = isTurned_ ? size.y() : size.x(), high = isTurned_ ? size.x() : size.y();
    scale_ = std::min((kMapWidth - 4.0 * kMapMargin) / wide, (kMapMost - 2.0 * kMapMargin) / high);
    height_ = std::max(kMapLeast, high * scale_ + 2.0 * kMapMargin);
    constexpr double kLongest = 100.0;  // in the page's units
    const double longest = slides_.front()->moved * scale_;
    while (longest > 0.0 && stretch_ * longest * 10.0 <= kLongest) stretch_ *= 10.0;
  }

  std::string svg() {
    for (const FootStance* const slide : slides_) add(*slide);
    for (std::size_t i = 0; i < std::min(kNamed, slides_.size()); ++i) addNumber(i);
    addScale();
    const std::string length = stretch_ > 1.0
                                   ? fmt::format("Drawn {:g} times as long as they are.", stretch_)
                                   : std::string("As long as they are.");
    return fmt::format(
        "<p>{} Numbered by length: point at one to see it in words.</p>\n<div class=\"wide\"><svg "
        "viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"Slides on the ground, from "
        "above\">\n{}</svg></div>\n<ol>{}</ol>\n",
        length, kMapWidth, height_, svg_, list_);
  }

 private:
  static Eigen::Vector2d flat(const Eigen::Vector3d& p) { return {p.x(), p.z()}; }
  [[nodiscard]] Eigen::Vector2d place(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d at = (p - box_.center()) * scale_;
    const Eigen::Vector2d turned = isTurned_ ? Eigen::Vector2d(at.y(), -at.x()) : at;
    return turned + 0.5 * Eigen::Vector2d(kMapWidth, height_);
  }
  void add(const FootStance& slide);
  void addNumber(std::size_t rank);
  void addScale();

  const FeetInputs& inputs_;
  std::vector<const FootStance*> slides_;
  Eigen::AlignedBox2d box_;
  bool isTurned_ = false;
  double scale_ = 1.0, height_ = 0.0, stretch_ = 1.0;
  std::vector<Eigen::Vector2d> numbers_;  ///< Where they stand.
  std::string svg_, list_;
};

void SlideMap::add(const FootStance& slide) {
  const Eigen::Vector2d from = flat(slide.trace_W.front());
  std::string points;
  for (const auto& p : slide.trace_W) {
    const Eigen::Vector2d at = place(from + stretch_ * (flat(p) - from));
    points += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
  }
  const Eigen::Vector2d at = place(from);
  svg_ += fmt::format(
      "<g><title>{}</title><polyline class=\"trace\" points=\"{}\"/><circle cx=\"{:.1f}\" "
      "cy=\"{:.1f}\" r=\"3\" fill=\"var(--slide)\"/></g>\n",
      inHtml(titleOf(inputs_, slide)), points, at.x(), at.y());
}

/// Adds the number beside the slide's begin, below those that stand there.
void SlideMap::addNumber(std::size_t rank) {
  const FootStance& slide = *slides_[rank];
  constexpr double kWide = 24.0, kHigh = 16.0;
  Eigen::Vector2d at = place(flat(slide.trace_W.front())) + Eigen::Vector2d(6.0, 4.0);
  const auto overlaps = [&](const Eigen::Vector2d& number) {
    return std::abs(number.x() - at.x()) < kWide && std::abs(number.y() - at.y()) < kHigh;
  };
  while (std::any_of(numbers_.begin(), numbers_.end(), overlaps)) at.y() += kHigh;
  numbers_.push_back(at);
  height_ = std::max(height_, at.y() + kMapMargin);
  const std::string title = inHtml(titleOf(inputs_, slide));
  svg_ += fmt::format(
      "<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\" font-weight=\"bold\">{}<title>{}</title>"
      "</text>\n",
      at.x(), at.y(), rank + 1, title);
  list_ += "<li>" + title + "</li>\n";
}

void SlideMap::addScale() {
  constexpr double kLeastLength = 50.0, kMostLength = 500.0;
  double metre = 1.0;
  while (metre * scale_ > kMostLength) metre *= 0.1;
  while (metre * scale_ < kLeastLength) metre *= 10.0;
  svg_ += fmt::format(
      "<line x1=\"20\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{1:.1f}\" stroke=\"currentColor\"/><text "
      "x=\"20\" y=\"{2:.1f}\">{3:g} m</text>\n",
      20.0 + metre * scale_, height_ - 10.0, height_ - 16.0, metre);
}

std::string mapOf(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::vector<const FootStance*> slides = slidesOf(answer);
  if (slides.empty())
    return fmt::format("<p>No part slides {:g} mm or more.</p>\n", kFeetMm * kSlides);
  return SlideMap(inputs, std::move(slides)).svg();
}

}  // namespace

std::string feetPage(const FeetInputs& inputs, const FeetAnswer& answer) {
  std::string page = fmt::format(kPageHead, shortName(inputs.request.motionPath));
  for (const std::string& sentence : feetSentences(inputs, answer)) {
    page += "<p>" + inHtml(sentence) + "</p>\n";
  }
  page += kKey + Lanes(inputs, answer).svg();
  page += "<h2>Slides on the ground, from above</h2>\n" + mapOf(inputs, answer);
  page += "<h2>In figures</h2>\n<pre>" + inHtml(feetTables(inputs, answer)) + "</pre>\n";
  return page + "</body></html>\n";
}

}  // namespace foretouch::tools
