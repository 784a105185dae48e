// assets/import/gltf_data.h: the numbers of a glTF file: buffers, views of them, and accessors,
// each checked where it is used, so that what is not read may be anything. In foretouch-import
// only. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "assets/import/gltf_elements.h"
#include "assets/import/gltf_file.h"

namespace foretouch::internal {

/// The elements of an accessor, one after the other.
struct GltfNumbers {
  std::size_t width = 1;  ///< Numbers per element.
  std::vector<double> values;

  [[nodiscard]] std::size_t count() const { return values.size() / width; }
  [[nodiscard]] const double* element(std::size_t i) const { return values.data() + i * width; }
};

/// "accessors[3]", or "accessors[3].sparse".
[[nodiscard]] std::string placeIn(const char* list, std::size_t i, const char* key = nullptr);

/// Everything throws Failure, with the place of what does not fit.
class GltfData {
 public:
  explicit GltfData(GltfFile file) : file_(std::move(file)) {}

  [[nodiscard]] const nlohmann::json& document() const { return file_.document; }

  /// The numbers of an accessor of a known type ("VEC3"), as `user`, the place that names it, needs
  /// them. An accessor without a view is zeros.
  [[nodiscard]] GltfNumbers numbers(std::size_t accessor, std::string_view type,
                                    const std::string& user);
  /// Only the layout, for an accessor whose numbers are elsewhere (Draco).
  [[nodiscard]] ElementLayout layoutOf(std::size_t accessor, std::string_view type,
                                       const std::string& user) const;
  /// The view's bytes, decompressed (EXT_meshopt_compression). Valid as long as this is.
  [[nodiscard]] std::string_view bytesOfView(std::size_t view);

 private:
  [[nodiscard]] const nlohmann::json& at(const char* list, std::size_t i) const {
    return file_.document[list][i];
  }
  [[nodiscard]] std::string_view bytesOfBuffer(std::size_t buffer);
  [[nodiscard]] std::string read(const std::string& uri, std::size_t buffer) const;
  [[nodiscard]] std::string_view checkedBytes(const nlohmann::json& of, const std::string& place);
  [[nodiscard]] std::string decompressed(const nlohmann::json& compression,
                                         const std::string& place);
  void appendDense(std::size_t accessor, const ElementLayout& layout, std::uint64_t count,
                   std::vector<double>& numbers);
  void overwriteSparse(std::size_t accessor, const ElementLayout& layout, GltfNumbers& numbers);

  GltfFile file_;
  std::map<std::size_t, std::string> buffers_, views_;  ///< What is not in the file as such.
};

}  // namespace foretouch::internal
