#include "tools/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "tools/console.h"

namespace foretouch::tools {

std::string progressLine(const std::string& label, std::int64_t done, std::int64_t total,
                         double elapsedS) {
  constexpr int kCells = 30;
  const double share =
      total > 0 ? std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0)
                : 1.0;
  const int filled = static_cast<int>(share * kCells);
  std::string line = fmt::format("{} [{:#>{}}{:->{}}] {:3.0f} % {}/{}", label, "", filled, "",
                                 kCells - filled, 100.0 * share, done, total);
  if (share > 0.0 && share < 1.0) {
    const auto leftS = static_cast<std::int64_t>(elapsedS * (1.0 - share) / share + 0.5);
    line += fmt::format(", {}:{:02} left", leftS / 60, leftS % 60);
  }
  return line;
}

ProgressBar::ProgressBar(std::string label, std::int64_t total)
    : label_(std::move(label)),
      total_(total),
      visible_(!isQuiet() && ::isatty(STDERR_FILENO) == 1) {}

void ProgressBar::advanceTo(std::int64_t done) {
  constexpr auto kBetweenDraws = std::chrono::milliseconds(100);
  if (!visible_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kBetweenDraws;
  drawn_ = true;
  const double elapsedS = std::chrono::duration<double>(now - start_).count();
  const std::string line = "\r" + progressLine(label_, done, total_, elapsedS) + "\x1b[K";
  static_cast<void>(std::fwrite(line.data(), 1, line.size(), stderr));
}

ProgressBar::~ProgressBar() {
  if (drawn_) static_cast<void>(std::fputs("\r\x1b[K", stderr));
}

}  // namespace foretouch::tools
