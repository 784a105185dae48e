// bench/trade/plot.h: plots as SVG, for pages that need nothing else. Lines over logarithmic or
// plain axes, each with its name beside it.
#pragma once

#include <string>
#include <vector>

namespace foretouch::tools {

struct PlotPoint {
  double x = 0.0, y = 0.0;
  bool isHollow = false;  ///< Drawn as a ring.
  std::string note;       ///< Shown on hover.
};

struct PlotLine {
  std::string name;   ///< Drawn beside it; empty: not.
  std::string color;  ///< Of CSS.
  bool isThick = false, isDashed = false;
  std::vector<PlotPoint> points;
  bool isNamedAtStart = false;  ///< Named beside its first point, not its last.
};

struct PlotAxis {
  std::string label;  ///< With its unit.
  bool isLog = true;
  bool isReversed = false;
  std::string (*tickText)(double) = nullptr;  ///< None: the number.
};

struct Plot {
  std::string title;     ///< What it shows, in a sentence.
  std::string subtitle;  ///< The machine, and how to read it.
  PlotAxis x, y;
  std::vector<PlotLine> lines;
};

/// A figure element with heading and SVG. Omits values that are not finite, or not above zero on a
/// logarithmic axis.
[[nodiscard]] std::string plotFigure(const Plot& plot);

}  // namespace foretouch::tools
