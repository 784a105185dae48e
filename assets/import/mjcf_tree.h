// assets/import/mjcf_tree.h: the elements of an MJCF file with what it includes in their places. In
// foretouch-import only. Not installed.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/import/model.h"

namespace foretouch::internal {

struct MjcfElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<MjcfElement> children;
  std::size_t file = 0;  ///< Index of MjcfTree::files.
  int line = 0;

  /// Null if the element has no such attribute.
  [[nodiscard]] const std::string* find(std::string_view attribute) const;
  void set(const std::string& attribute, std::string value);
  void drop(std::string_view attribute);
};

struct MjcfTree {
  MjcfElement root;
  std::vector<std::string> files;  ///< The model, then what it includes, as it names them.
};

/// "line 7: ", or for what the model includes "'arm.xml' line 7: ".
[[nodiscard]] std::string placeIn(const std::vector<std::string>& files, std::size_t file,
                                  int line);

/// Throws Failure (assets/import/failure.h) with the place for what is not well-formed, has no
/// <mujoco>, is nested too deeply, included twice, missing, or not among those that may be read.
[[nodiscard]] MjcfTree readMjcfTree(const ModelQuestion& question);

/// The file `reference` of an element, in `folder` unless its path is absolute: its place. Throws
/// Failure if there is none, or if it must not be read.
[[nodiscard]] std::string findMjcfFile(const ModelQuestion& question, const MjcfTree& tree,
                                       const MjcfElement& element, const std::string& folder,
                                       const std::string& reference);

}  // namespace foretouch::internal
