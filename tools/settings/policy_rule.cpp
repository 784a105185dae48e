#include "tools/settings/policy_rule.h"

#include "assets/json_writer.h"

namespace foretouch::tools {

std::string policiesJson(const std::vector<PolicyRule>& rules) {
  std::string text;
  JsonWriter out(text);
  out.beginArray();
  for (const PolicyRule& rule : rules) {
    out.beginObject();
    if (!rule.links.empty()) out.field("links", rule.links);
    if (!rule.objects.empty()) out.field("objects", rule.objects);
    if (rule.tolerance) out.field("tolerance", *rule.tolerance);
    if (rule.fidelity) out.field("fidelity", toString(*rule.fidelity));
    if (rule.ignore) out.field("ignore", *rule.ignore);
    out.endObject();
  }
  out.endArray();
  return text;
}

}  // namespace foretouch::tools
