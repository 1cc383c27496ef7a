// What a run reads: --resume must tell an edited file, also one that another file names.
#include "engine/experiments/run_inputs.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

class RunInputs : public testing::Test {
 protected:
  RunInputs() { std::filesystem::create_directories(folder_ / "meshes"); }
  ~RunInputs() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string Of(const std::string& scenario) const {
    CLI::App app;
    std::string value;
    app.add_option("--scenario", value);
    app.parse("--scenario " + scenario);
    return InputsOf(app);
  }

  const std::filesystem::path folder_ = OwnPath("");
};

TEST_F(RunInputs, MeshesAndModelsOfAWorldFileAreAmongThem) {
  Write("yard.toml",
        "name = \"yard\"\n[relief]\nfile = \"dem.tif\"\n[[mesh]]\nfile = \"meshes/rock.obj\"\n"
        "at = [1, 2]\n[[mesh]]\nfile = \"meshes/none.obj\"\n");
  Write("dem.tif", "heights");
  Write("meshes/rock.obj", "v 0 0 0\n");
  const std::string world = (folder_ / "yard.toml").string();
  const std::string first = Of(world);
  EXPECT_EQ(first.rfind(" files ", 0), 0u) << first;
  EXPECT_EQ(Of(world), first);
  Write("meshes/rock.obj", "v 0 0 1\n");
  const std::string other_mesh = Of(world);
  EXPECT_NE(other_mesh, first);
  Write("dem.tif", "others");
  EXPECT_NE(Of(world), other_mesh);
  Write("dem.tif", "heights");
  Write("meshes/rock.obj", "v 0 0 0\n");
  EXPECT_EQ(Of(world), first);
  Write("meshes/none.obj", "v 0 0 0\n");  // there now
  EXPECT_NE(Of(world), first);
}

TEST_F(RunInputs, NamesThatAreNoFilesAreNone) {
  EXPECT_EQ(Of("runway"), "");
  Write("broken.toml", "[[mesh\n");
  EXPECT_NE(Of((folder_ / "broken.toml").string()), "");
}

}  // namespace
}  // namespace palace
