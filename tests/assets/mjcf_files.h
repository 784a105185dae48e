// tests/assets/mjcf_files.h: MJCF made by the test, a fixture that imports it, and libmujoco's own
// answer about it.
#pragma once

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mujoco/mujoco.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {

inline std::string mujoco(const std::string& bodies, const std::string& before = "",
                          const std::string& after = "") {
  return "<mujoco>\n" + before + "<worldbody>\n" + bodies + "\n</worldbody>\n" + after +
         "</mujoco>\n";
}

/// With all digits.
inline std::string inText(double number) {
  std::array<char, 40> out{};
  std::snprintf(out.data(), out.size(), "%.17g", number);
  return out.data();
}
inline std::string inText(const Eigen::Vector3d& v) {
  return inText(v.x()) + " " + inText(v.y()) + " " + inText(v.z());
}

/// What libmujoco makes of a file by itself, without the importer.
class MujocoItself {
 public:
  explicit MujocoItself(const std::string& path) {
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML(path.c_str(), nullptr, error.data(), error.size()));
    if (model_ == nullptr) throw std::runtime_error(error.data());
    data_.reset(mj_makeData(model_.get()));
  }
  [[nodiscard]] const mjModel& model() const { return *model_; }
  [[nodiscard]] mjData& data() { return *data_; }
  /// Of data().qpos.
  void computeFrames() { mj_kinematics(model_.get(), data_.get()); }
  [[nodiscard]] int idOf(mjtObj type, const std::string& name) const {
    return mj_name2id(model_.get(), type, name.c_str());
  }
  [[nodiscard]] std::string nameOf(mjtObj type, int id) const {
    const char* name = mj_id2name(model_.get(), type, id);
    return name == nullptr ? "" : name;
  }

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

/// Where a link's frame is.
inline Affine frameOf(const Skeleton& skeleton, const Pose& pose, JointId link) {
  Affine frame;
  for (JointId j = link; j != kNoParent; j = skeleton.parent(j)) {
    const auto i = static_cast<std::size_t>(j);
    frame = Affine{pose.rotations[i].toRotationMatrix(), pose.translations[i]} * frame;
  }
  return frame;
}

class ImportMjcf : public testing::Test {
 protected:
  Result<ImportedRobot> read(const std::string& text) {
    RobotImportOptions options;
    options.reading = withModelImporter();
    path_ = folder_.write("robot.xml", text);
    return importRobot(path_, options);
  }
  Robot robotOf(const std::string& text) {
    auto result = read(text);
    if (!result.ok()) throw std::runtime_error(describe(result.error()));
    notes_ = result.value().notes;
    return std::move(result).value().made.robot;
  }
  /// As an avatar's, not a robot's.
  Model modelOf(const std::string& text, const ModelImportOptions& options = withModelImporter()) {
    path_ = folder_.write("robot.xml", text);
    auto result = importModel(path_, options);
    if (!result.ok()) {
      ADD_FAILURE() << describe(result.error());
      return {};
    }
    return std::move(result).value();
  }
  void expectRefusal(const std::string& text, const std::string& reason) {
    const auto result = read(text);
    EXPECT_FALSE(hasChildren());
    if (result.ok()) {
      ADD_FAILURE() << "imported; expected: " << reason;
      return;
    }
    const std::string message = describe(result.error());
    EXPECT_NE(message.find(reason), std::string::npos) << message;
    EXPECT_NE(message.find("robot.xml"), std::string::npos) << message;
  }
  void makeFolder(const std::string& name) { std::filesystem::create_directories(folder_ / name); }

  TempFolder folder_;
  std::string path_;
  std::vector<std::string> notes_;
};

}  // namespace foretouch::test
