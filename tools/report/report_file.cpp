#include "tools/report/report_file.h"

#include "assets/text_file.h"
#include "tools/progress.h"
#include "tools/report/view_writer.h"
#include "tools/report/viewer_page.h"

namespace foretouch::tools {
namespace {

constexpr int kPercent = 100;

}  // namespace

Result<Done> writeReport(const std::string& path, const InterruptGuard& guard,
                         const DocumentMaker& make) {
  ProgressBar bar("report", kPercent);
  const auto document = make([&](std::int64_t done, std::int64_t total) {
    if (total > 0) bar.advanceTo(kPercent * done / total);
    return !guard.requested();
  });
  if (!document.ok()) return document.error();
  if (guard.requested()) return Done{};
  auto file = PendingFile::create(path);
  if (!file.ok()) return file.error();
  const PageParts page = viewerPageParts();
  file.value().write(std::string(page.before));
  writeView(document.value(), [&file](const std::string& piece) { file.value().write(piece); });
  file.value().write(std::string(page.after));
  return file.value().commit();
}

}  // namespace foretouch::tools
