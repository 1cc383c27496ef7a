// What the scenarios of palacectl camera share: a folder of good camera files, and the verb.
#pragma once

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/camera/files/camera_files.h"
#include "tests/camera/camera_file_texts.h"
#include "tests/scenarios/scenario.h"

namespace palace {

class CameraCommand : public Scenario {
 protected:
  static constexpr double kLimit_s = 30;

  CameraCommand() {
    for (const CameraText& file : GoodCameraTexts()) {
      WriteFile(file.name, file.text);
    }
  }
  ProcessResult Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "camera");
    return RunProcess(Palacectl(std::move(arguments)), kLimit_s);
  }
  static std::vector<std::string> Lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      lines.push_back(line);
    }
    return lines;
  }
  std::string Read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  CameraModel Model(const std::string& name) const {
    const auto model = ReadCameraFile(folder_ / name);
    EXPECT_TRUE(model.ok()) << model.error().message;
    return model.ok() ? *model : CameraModel{};
  }
};

}  // namespace palace
