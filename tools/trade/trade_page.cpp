#include "tools/trade/trade_page.h"

namespace foretouch::tools {

std::string tradePage(const MeasuredTrade&) {
  return "";
}

}  // namespace foretouch::tools
