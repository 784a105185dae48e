#include "assets/import/gltf_uses.h"

#include <cstdint>
#include <string_view>

#include <nlohmann/json.hpp>

#include "articulated/quoted.h"

namespace foretouch::internal {
namespace {

using nlohmann::json;

bool begins(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

/// Empty if any type will do.
std::string_view typeOfAttribute(std::string_view name) {
  if (name == "POSITION" || name == "NORMAL") return "VEC3";
  if (name == "TANGENT" || begins(name, "JOINTS_") || begins(name, "WEIGHTS_")) return "VEC4";
  return begins(name, "TEXCOORD_") ? "VEC2" : "";
}

std::string_view typeOfPath(const json& path) {
  if (path == "rotation") return "VEC4";
  return path == "weights" ? "SCALAR" : "VEC3";
}

class Uses {
 public:
  Uses(const json& document, Faults& faults) : document_(document), faults_(faults) {}

  void check() {
    forEach(document_, "meshes", "", [&](const json& mesh, const std::string& place) {
      forEach(mesh, "primitives", place + ".",
              [&](const json& part, const std::string& at) { checkPrimitive(part, at); });
    });
    forEach(document_, "skins", "", [&](const json& skin, const std::string& place) {
      checkUse(skin, "inverseBindMatrices", place, "MAT4");
    });
    forEach(document_, "animations", "", [&](const json& animation, const std::string& place) {
      checkAnimation(animation, place);
    });
  }

 private:
  template <typename Take>
  void forEach(const json& holder, const char* list, const std::string& lead, const Take& take) {
    const auto found = holder.find(list);
    if (found == holder.end() || !found->is_array()) return;
    for (std::size_t i = 0; i < found->size() && !faults_.isFull(); ++i) {
      take((*found)[i], lead + list + "[" + std::to_string(i) + "]");
    }
  }

  void checkPrimitive(const json& part, const std::string& place) {
    for (const auto& [name, accessor] : part["attributes"].items()) {
      checkType(accessor, place + ".attributes." + inQuotes(name), typeOfAttribute(name));
    }
    checkUse(part, "indices", place, "SCALAR");
    if (!part["attributes"].contains("POSITION")) {
      faults_.add(place + ".attributes.POSITION", "expected this key, found none");
    } else {
      checkCorners(part, place);
    }
  }

  /// Points and lines need fewer, and have no surface.
  void checkCorners(const json& part, const std::string& place) {
    constexpr std::uint64_t kTriangles = 4;
    const bool isIndexed = part.contains("indices");
    const json& number = isIndexed ? part["indices"] : part["attributes"]["POSITION"];
    const json& accessor = document_["accessors"][number.get<std::size_t>()];
    const auto corners = accessor["count"].get<std::uint64_t>();
    if (part.value("mode", kTriangles) < kTriangles || corners >= 3) return;
    faults_.add(place,
                "expected at least 3 corners of triangles, found " + std::to_string(corners));
  }

  void checkAnimation(const json& animation, const std::string& place) {
    forEach(animation, "channels", place + ".", [&](const json& channel, const std::string&) {
      const auto index = channel["sampler"].get<std::size_t>();
      const json& sampler = animation["samplers"][index];
      const std::string at = place + ".samplers[" + std::to_string(index) + "]";
      checkUse(sampler, "input", at, "SCALAR");
      checkUse(sampler, "output", at, typeOfPath(channel["target"]["path"]));
    });
  }

  void checkUse(const json& user, const char* key, const std::string& place,
                std::string_view type) {
    const auto found = user.find(key);
    if (found != user.end()) checkType(*found, place + "." + key, type);
  }

  void checkType(const json& number, const std::string& place, std::string_view type) {
    const auto index = number.get<std::size_t>();
    const json& accessor = document_["accessors"][index];
    const std::string named = "accessors[" + std::to_string(index) + "]";
    if (!type.empty() && accessor["type"] != type) {
      faults_.add(place, "expected an accessor of type " + std::string(type) + ", found " + named +
                             " of type " + accessor["type"].get<std::string>());
    } else if (!accessor.contains("bufferView") && !accessor.contains("sparse")) {
      faults_.add(named + ".bufferView",
                  "expected this key, as " + place + " takes its elements, found none");
    }
  }

  const json& document_;
  Faults& faults_;
};

}  // namespace

void checkUses(const json& document, Faults& faults) {
  Uses(document, faults).check();
}

}  // namespace foretouch::internal
