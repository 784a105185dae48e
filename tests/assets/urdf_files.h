// tests/assets/urdf_files.h: URDF made by the test, and a fixture that imports it.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"

namespace foretouch::test {

inline std::string robot(const std::string& content) {
  return "<?xml version=\"1.0\"?><robot name=\"r\">" + content + "</robot>";
}

inline std::string linkWith(const std::string& geometry, const std::string& name = "a",
                            const std::string& origin = "") {
  return "<link name=\"" + name + "\"><collision>" + origin + "<geometry>" + geometry +
         "</geometry></collision></link>";
}

inline std::string joint(const std::string& type, const std::string& parent,
                         const std::string& child, const std::string& more = "") {
  return "<joint name=\"to_" + child + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + more + "</joint>";
}

inline const std::string kSphere = "<sphere radius=\"0.1\"/>";

inline bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

class ImportUrdf : public testing::Test {
 protected:
  Model imported(const std::string& content,
                 const ModelImportOptions& options = withModelImporter()) {
    auto result = importModel(folder_.write("robot.urdf", robot(content)), options);
    if (!result.ok()) {
      ADD_FAILURE() << describe(result.error());
      return {};
    }
    return std::move(result).value();
  }
  Error failureOf(const std::string& text) {
    const auto result = importModel(folder_.write("robot.urdf", text), withModelImporter());
    if (result.ok()) {
      ADD_FAILURE() << "imported: " << text;
      return {};
    }
    EXPECT_FALSE(hasChildren());
    return result.error();
  }
  void expectRefused(const std::string& content, const std::string& reason) {
    const Error error = failureOf(robot(content));
    EXPECT_EQ(error.code, ErrorCode::ImportFailed) << error.message;
    EXPECT_NE(error.message.find(reason), std::string::npos) << error.message;
  }
  void makeFolder(const std::string& name) { std::filesystem::create_directories(folder_ / name); }

  TempFolder folder_;
};

}  // namespace foretouch::test
