#include <utility>

#include "articulated/try.h"
#include "assets/import/model_import.h"

namespace foretouch {

Result<ImportedRobot> importRobot(const std::string& path, const RobotImportOptions& options) {
  ModelImportOptions reading = options.reading;
  reading.isRobot = true;
  FORETOUCH_TRY(auto model, importModel(path, reading));
  FORETOUCH_TRY(auto made, inFile(robotFromModel(model, options.making), path));
  return ImportedRobot{std::move(made), std::move(model.notes)};
}

}  // namespace foretouch
