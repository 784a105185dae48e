#include "tools/settings/policy_rule.h"

#include "tools/json_text.h"

namespace foretouch::tools {

std::string policiesJson(const std::vector<PolicyRule>& rules) {
  std::string text = "[";
  for (const PolicyRule& rule : rules) {
    std::string fields;
    if (!rule.links.empty()) fields += ",\"links\":" + jsonList(rule.links);
    if (!rule.objects.empty()) fields += ",\"objects\":" + jsonList(rule.objects);
    if (rule.tolerance) fields += ",\"tolerance\":" + numberText(*rule.tolerance);
    if (rule.fidelity) fields += std::string(",\"fidelity\":\"") + toString(*rule.fidelity) + '"';
    if (rule.ignore) fields += *rule.ignore ? ",\"ignore\":true" : ",\"ignore\":false";
    if (text.size() > 1) text += ',';
    text += '{' + fields.substr(1) + '}';
  }
  return text + ']';
}

}  // namespace foretouch::tools
