// palacectl camera where a person errs or the disk is full: one message with the remedy.
#include <filesystem>

#include "tests/scenarios/camera_command.h"

namespace palace {
namespace {

struct BadRow {
  const char* what;
  std::vector<std::string> arguments;
  int exit_code;
  const char* said;
};

TEST_F(CameraCommand, MistakesAreNamedWithTheRemedy) {
  WriteFile("words.csv", "X,Y,Z\n1,2,3\nfoo,2,3\n");
  WriteFile("two.csv", "1,2\n");
  WriteFile("nan.csv", "1,2,3\nnan,2,3\n");
  WriteFile("cut.cahvor", kCahvorText.substr(0, 120));
  WriteFile("cut.yml", kOpenCvYamlText.substr(0, kOpenCvYamlText.rfind('[') + 1));
  WriteFile("left.cahvor", Replaced(kCahvorText, "C = 0 -0.528 0", "C = 0 -1.528 0"));
  const BadRow rows[] = {
      {"no verb", {}, 2, "subcommand"},
      {"no model", {"info"}, 2, "--model"},
      {"missing file", {"info", "--model", "none.cahv"}, 1, "none.cahv: no such file"},
      {"a folder", {"info", "--model", "."}, 1, ".: is a folder"},
      {"its own input",
       {"convert", "--model", "a.cahvor", "--to", "cahvor", "--out", "a.cahvor"},
       2,
       "would overwrite a.cahvor, which is read"},
      {"its own points",
       {"project", "--model", "a.cahvor", "--points", "two.csv", "--out", "two.csv"},
       2,
       "would overwrite two.csv, which is read"},
      {"a folder of points", {"project", "--model", "a.cahvor", "--points", "."}, 1, "is a folder"},
      {"a model from stdin", {"info", "--model", "-"}, 2, "only points and pixels may come"},
      {"a device", {"info", "--model", "/dev/null"}, 1, "/dev/null: is no file on disk"},
      {"no such verb",
       {"foo"},
       2,
       "palacectl camera: there is no command 'foo'; choose one of project, backproject, convert, "
       "info, align"},
      {"no such command", {"inof", "--mode", "a.yml"}, 2, "camera: there is no command 'inof'"},
      {"no such option", {"info", "--mode", "a.yml"}, 2, "camera info has no option --mode"},
      {"no option", {"info", "a.yml"}, 2, "with 'a.yml'; files and values follow an option"},
      {"side of one",
       {"info", "--model", "a.yml", "--camera", "right"},
       2,
       "--camera right: a.yml holds one camera"},
      {"cut",
       {"info", "--model", "cut.yml"},
       1,
       "cut.yml:16: distortion_coefficients.data = [: the file ends in this value"},
      {"a baseline behind",
       {"align", "--left", "a.yml", "--right", "a.yml", "--baseline", "-1", "--out", "o"},
       2,
       "--baseline: -1 is not within 0.001 to 1000"},
      {"exchanged",
       {"align", "--left", "a.cahvor", "--right", "left.cahvor", "--out", "o"},
       1,
       "a.cahvor, left.cahvor: the right camera stands to the left of the left one, every "
       "disparity would be negative; exchange --left and --right"},
      {"damaged", {"info", "--model", "cut.cahvor"}, 1, "cut.cahvor"},
      {"words",
       {"project", "--model", "a.cahvor", "--points", "words.csv"},
       1,
       "words.csv:3: 'foo,2,3' is not X,Y,Z"},
      {"two numbers",
       {"project", "--model", "a.cahvor", "--points", "two.csv"},
       1,
       "two.csv:1: '1,2' is not X,Y,Z"},
      {"nan", {"project", "--model", "a.cahvor", "--points", "nan.csv"}, 1, "nan.csv:2"},
      {"no points",
       {"project", "--model", "a.cahvor", "--points", "none.csv"},
       1,
       "none.csv: no such file"},
      {"unwritable",
       {"project", "--model", "a.cahvor", "--points", "-", "--out", "no/o.csv"},
       1,
       "cannot write no/o.csv"},
      {"size", {"info", "--model", "a.cpcc", "--size", "640"}, 2, "--size 640"},
      {"another size", {"info", "--model", "a.cahvor", "--size", "64x48"}, 1, "640 x 480"},
      {"no such family",
       {"convert", "--model", "a.yml", "--to", "lens", "--out", "b"},
       2,
       "--to lens: choose cahv"},
      {"too wide",
       {"convert", "--model", "a.cahvore", "--to", "opencv8", "--out", "b"},
       1,
       "92 degrees off the axis, beyond the range of opencv8"},
      {"no size", {"convert", "--model", "a.cpcc", "--to", "cahvor", "--out", "b"}, 1, "--size"},
      {"pair of two", {"info", "--model", "a.xml"}, 1, "--camera left or right"},
      {"no baseline",
       {"align", "--left", "a.yml", "--right", "a.yml", "--out", "o"},
       1,
       "--baseline"},
      {"one pose",
       {"align", "--left", "a.cahvor", "--right", "a.yml", "--out", "o"},
       1,
       "a.yml: tells no pose"},
      {"one place",
       {"align", "--left", "a.cahvor", "--right", "a.cahvor", "--out", "o"},
       1,
       "needs a baseline"},
  };
  for (const BadRow& row : rows) {
    SCOPED_TRACE(row.what);
    const ProcessResult result = Run(row.arguments);
    EXPECT_EQ(result.exit_code, row.exit_code) << result.err;
    EXPECT_NE(result.err.find(row.said), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

TEST_F(CameraCommand, AFullDiskBehindStdoutIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) {
    GTEST_SKIP() << "runs where there is a /dev/full";
  }
  WriteFile("points.csv", "10,-3,12.5\n");
  for (const char* verb : {"project --points points.csv", "info"}) {
    SCOPED_TRACE(verb);
    ProcessOptions shell = Palacectl({});
    shell.command = {"/bin/sh", "-c",
                     std::string("exec '") + PALACECTL_PROGRAM + "' camera " + verb +
                         " --model a.cahvor > /dev/full"};
    const ProcessResult result = RunProcess(shell, kLimit_s);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find("stdout cannot be written"), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace palace
