// tools/report/view_writer.h: a view document as JSON text (docs/formats.md, "View documents").
#pragma once

#include <functional>
#include <string>

#include "tools/report/view_document.h"

namespace foretouch::tools {

/// Takes the text piece by piece.
using TextSink = std::function<void(const std::string& piece)>;

/// Pure: the same document gives the same bytes. The text has no "<", so that nothing in it can end
/// the page's element that holds it. Memory: O(1) beside the document.
void writeView(const ViewDocument& document, const TextSink& sink);

}  // namespace foretouch::tools
