// tests/tools/glb/glb_reader.h: reads a GLB and checks it against glTF 2.0; shares no code with the
// writer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace foretouch::test {

class GlbReader {
 public:
  /// Fails the test if container or JSON are wrong.
  explicit GlbReader(const std::string& bytes);

  [[nodiscard]] const nlohmann::json& root() const { return root_; }
  /// The numbers of an accessor of floats, row by row.
  [[nodiscard]] std::vector<float> floats(std::size_t accessor) const;
  [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t accessor) const;

  /// Everything else: views and accessors in bounds and aligned, stated minima and maxima right,
  /// all floats finite, indices within their vertices, unit normals, references that exist, nodes
  /// that form trees, animations whose keys are of one length and whose times ascend.
  void check() const;

  /// The one node of this name; fails the test if there is none, or two.
  [[nodiscard]] std::size_t node(const std::string& name) const;
  /// The parent of every node; -1: none.
  [[nodiscard]] std::vector<int> parents() const;

 private:
  [[nodiscard]] const char* startOf(std::size_t accessor, std::size_t rowBytes) const;
  void checkViews() const;
  void checkAccessors() const;
  void checkMeshes() const;
  void checkNodes() const;
  void checkAnimations() const;

  nlohmann::json root_;
  std::string binary_;
};

/// Numbers per row of an accessor, by its type.
[[nodiscard]] std::size_t widthOf(const nlohmann::json& accessor);

}  // namespace foretouch::test
