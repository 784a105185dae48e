#include "bench/trade/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tools/html_text.h"

namespace foretouch::tools {
namespace {

constexpr double kWidth = 1000.0, kHeight = 560.0;
constexpr double kLeft = 92.0, kRight = 210.0, kTop = 16.0, kBottom = 64.0;
constexpr double kLetter = 8.2, kLine = 16.0;  // of a label

/// One axis' values in pixels.
class Scale {
 public:
  Scale(const PlotAxis& axis, double from, double to) : axis_(axis), from_(from), to_(to) {
    if (axis.isReversed) std::swap(from_, to_);
  }

  void see(double value) {
    if (!fits(value)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  /// Margin around the values; a logarithmic axis ends at decades or halves of them.
  void settle() {
    if (!(low_ <= high_)) low_ = high_ = 1.0;
    if (axis_.isLog) {
      constexpr double kRoom = 1.4;
      low_ /= kRoom;
      high_ *= kRoom;
    } else {
      low_ = std::min(0.0, low_);
      high_ = high_ > low_ ? high_ + 0.06 * (high_ - low_) : low_ + 1.0;
    }
  }

  [[nodiscard]] bool fits(double value) const {
    return std::isfinite(value) && (!axis_.isLog || value > 0.0);
  }
  [[nodiscard]] double at(double value) const {
    const double share = axis_.isLog ? std::log(value / low_) / std::log(high_ / low_)
                                     : (value - low_) / (high_ - low_);
    return from_ + share * (to_ - from_);
  }
  [[nodiscard]] std::vector<double> ticks() const {
    return axis_.isLog ? logTicks() : plainTicks();
  }

 private:
  [[nodiscard]] std::vector<double> logTicks() const {
    std::vector<double> ticks;
    const bool isShort = high_ / low_ < 500.0;
    for (double decade = std::pow(10.0, std::floor(std::log10(low_))); decade <= high_;
         decade *= 10.0) {
      for (const double step : {1.0, 2.0, 5.0}) {
        const double tick = step * decade;
        if (tick >= low_ && tick <= high_ && (isShort || step == 1.0)) ticks.push_back(tick);
      }
    }
    return ticks;
  }
  [[nodiscard]] std::vector<double> plainTicks() const {
    std::vector<double> ticks;
    constexpr double kAbout = 5.0;
    const double rough = (high_ - low_) / kAbout;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = rough / decade < 2.0   ? 2.0 * decade
                        : rough / decade < 5.0 ? 5.0 * decade
                                               : 10.0 * decade;
    for (double tick = std::ceil(low_ / step) * step; tick <= high_; tick += step) {
      ticks.push_back(tick);
    }
    return ticks;
  }

  const PlotAxis& axis_;
  double from_, to_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

struct Rectangle {
  double left, top, right, bottom;
  [[nodiscard]] bool meets(const Rectangle& o) const {
    return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
  }
};

std::string tickText(const PlotAxis& axis, double tick) {
  return axis.tickText != nullptr ? inHtml(axis.tickText(tick)) : fmt::format("{:g}", tick);
}

/// Draws one plot.
class Drawing {
 public:
  explicit Drawing(const Plot& plot)
      : plot_(plot), x_(plot.x, kLeft, kWidth - kRight), y_(plot.y, kHeight - kBottom, kTop) {
    for (const PlotLine& line : plot.lines) {
      for (const PlotPoint& point : line.points) {
        if (!x_.fits(point.x) || !y_.fits(point.y)) continue;
        x_.see(point.x);
        y_.see(point.y);
      }
    }
    x_.settle();
    y_.settle();
  }

  std::string svg() {
    drawAxes();
    for (const PlotLine& line : plot_.lines) drawLine(line);
    for (const PlotLine& line : plot_.lines) name(line);
    return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", kWidth,
                       kHeight, inHtml(plot_.title)) +
           svg_ + "</svg>\n";
  }

 private:
  [[nodiscard]] std::vector<PlotPoint> shown(const PlotLine& line) const {
    std::vector<PlotPoint> points;
    for (const PlotPoint& point : line.points) {
      if (x_.fits(point.x) && y_.fits(point.y)) points.push_back(point);
    }
    return points;
  }

  void drawAxes() {
    const double left = kLeft, right = kWidth - kRight, top = kTop, bottom = kHeight - kBottom;
    for (const double tick : x_.ticks()) {
      const double x = x_.at(tick);
      svg_ += fmt::format(
          "<line class=\"grid\" x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
          x, top, bottom, bottom + 20.0, tickText(plot_.x, tick));
    }
    for (const double tick : y_.ticks()) {
      const double y = y_.at(tick);
      svg_ += fmt::format(
          "<line class=\"grid\" x1=\"{1}\" y1=\"{0:.1f}\" x2=\"{2}\" y2=\"{0:.1f}\"/>"
          "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
          y, left, right, left - 8.0, y + 5.0, tickText(plot_.y, tick));
    }
    svg_ += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                        left, top, right - left, bottom - top);
    svg_ +=
        fmt::format("<text class=\"axis\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                    0.5 * (left + right), kHeight - 16.0, inHtml(plot_.x.label));
    svg_ += fmt::format(
        "<text class=\"axis\" transform=\"translate(20 {:.1f}) rotate(-90)\" "
        "text-anchor=\"middle\">{}</text>\n",
        0.5 * (top + bottom), inHtml(plot_.y.label));
  }

  void drawLine(const PlotLine& line) {
    constexpr double kDot = 4.5;
    std::string path;
    for (const PlotPoint& point : shown(line)) {
      path += fmt::format("{:.1f},{:.1f} ", x_.at(point.x), y_.at(point.y));
    }
    svg_ +=
        fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n",
                    path, line.color, line.isThick ? 9 : 2,
                    line.isThick    ? " stroke-opacity=\"0.28\" stroke-linejoin=\"round\""
                    : line.isDashed ? " stroke-dasharray=\"6 4\""
                                    : "");
    if (line.isThick) return;
    for (const PlotPoint& point : shown(line)) {
      const double x = x_.at(point.x), y = y_.at(point.y);
      taken_.push_back({x - kDot, y - kDot, x + kDot, y + kDot});
      svg_ += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" "
          "stroke-width=\"2\"><title>{}</title></circle>\n",
          x, y, kDot, point.isHollow ? "white" : line.color, line.color, inHtml(point.note));
    }
  }

  /// Names a line beside one of its points with room, preferring the last (or the first, by
  /// isNamedAtStart), and the right side to the left; else right of the plot.
  void name(const PlotLine& line) {
    std::vector<PlotPoint> points = shown(line);
    if (line.name.empty() || points.empty()) return;
    if (!line.isNamedAtStart) std::reverse(points.begin(), points.end());
    const double width = kLetter * static_cast<double>(line.name.size());
    for (const PlotPoint& point : points) {
      const double x = x_.at(point.x), y = y_.at(point.y);
      for (const double left : {x + 10.0, x - 10.0 - width}) {
        for (const double lines : {0.0, -1.0, 1.0, -2.0, 2.0}) {
          const double middle = y + lines * kLine;
          const Rectangle box{left, middle - 0.5 * kLine, left + width, middle + 0.5 * kLine};
          if (tryName(line, box, x, y)) return;
        }
      }
    }
    for (double y = y_.at(points.front().y); y > kTop; y -= kLine) {
      const double left = kWidth - kRight + 24.0;
      const Rectangle box{left, y - 0.5 * kLine, left + width, y + 0.5 * kLine};
      if (tryName(line, box, x_.at(points.front().x), y_.at(points.front().y))) return;
    }
  }

  bool tryName(const PlotLine& line, const Rectangle& box, double x, double y) {
    if (box.left < kLeft || box.right > kWidth || box.top < 0.0 || box.bottom > kHeight - kBottom) {
      return false;
    }
    for (const Rectangle& other : taken_) {
      if (box.meets(other)) return false;
    }
    taken_.push_back(box);
    const double middle = 0.5 * (box.top + box.bottom);
    const double end = box.left > x ? box.left - 2.0 : box.right + 2.0;
    if (std::abs(middle - y) > 1.0 || std::abs(end - x) > 12.0) {
      svg_ += fmt::format(
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
          "stroke-width=\"0.8\"/>\n",
          x, y, end, middle, line.color);
    }
    svg_ += fmt::format("<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n",
                        box.left, middle + 4.5, line.color, inHtml(line.name));
    return true;
  }

  const Plot& plot_;
  Scale x_, y_;
  std::string svg_;
  std::vector<Rectangle> taken_;
};

}  // namespace

std::string plotFigure(const Plot& plot) {
  return "<figure>\n<h2>" + inHtml(plot.title) + "</h2>\n<p>" + inHtml(plot.subtitle) + "</p>\n" +
         Drawing(plot).svg() + "</figure>\n";
}

}  // namespace foretouch::tools
