// palacectl camera as a person uses it: files in, numbers out, exit codes and messages.
#include "tests/scenarios/camera_command.h"

#include <cmath>

#include "engine/camera/alignment.h"
#include "engine/camera/cahvor.h"
#include "tests/camera/camera_file_texts.h"
#include "tests/camera/reference_vectors.h"

namespace palace {
namespace {

TEST_F(CameraCommand, ProjectsAndBackProjectsEachOther) {
  WriteFile("points.csv", "X,Y,Z\n# a comment\n10,-3,12.5\n\n -1 , 0, -1\n1.5e1;2;17\n");
  const ProcessResult projected =
      Run({"project", "--model", "a.cahvor", "--points", "points.csv", "--out", "pixels.csv"});
  ASSERT_EQ(projected.exit_code, 0) << projected.err;
  EXPECT_EQ(projected.out, "");
  const auto pixels = Lines(Read("pixels.csv"));
  ASSERT_EQ(pixels.size(), 3U);
  EXPECT_EQ(pixels[1], "invalid") << "behind the camera";
  const CameraModel model = Model("a.cahvor");
  double x = 0, y = 0;
  ASSERT_EQ(std::sscanf(pixels[0].c_str(), "%lf,%lf", &x, &y), 2);
  EXPECT_EQ(Eigen::Vector2d(x, y), ProjectCamera(model, {10, -3, 12.5}).value())
      << "17 digits tell the double";
  const ProcessResult rays = Run({"backproject", "--model", "a.cahvor", "--pixels", "pixels.csv"});
  EXPECT_EQ(rays.exit_code, 1) << "'invalid' is no pixel";
  WriteFile("back.csv", pixels[0] + "\n");
  const ProcessResult ray = Run({"backproject", "--model", "a.cahvor", "--pixels", "back.csv"});
  ASSERT_EQ(ray.exit_code, 0) << ray.err;
  const auto lines = Lines(ray.out);
  ASSERT_EQ(lines.size(), 1U);
  Eigen::Vector3d o, r;
  ASSERT_EQ(std::sscanf(lines[0].c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &o.x(), &o.y(), &o.z(), &r.x(),
                        &r.y(), &r.z()),
            6);
  EXPECT_LT((Eigen::Vector3d(10, -3, 12.5) - o).normalized().cross(r).norm(), 1e-12);
  std::string barrel = kCahvorText;
  barrel.replace(barrel.find("-0.21 0.09"), 10, "-0.21 0");
  WriteFile("barrel.cahvor", barrel);
  WriteFile("far.csv", "1e6,0\n320,240\n");
  const ProcessResult far = Run({"backproject", "--model", "barrel.cahvor", "--pixels", "far.csv"});
  ASSERT_EQ(far.exit_code, 0) << far.err;
  EXPECT_EQ(Lines(far.out).front(), "invalid") << "beyond the distortion";
  EXPECT_EQ(Lines(far.out).size(), 2U);
}

TEST_F(CameraCommand, ReferenceVectorsComeOutOfTheProgram) {
  const auto vectors = ReadVectors("camera_models.json");
  if (!vectors) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  for (const nlohmann::json& entry : vectors->at("models")) {
    SCOPED_TRACE(entry.at("id").get<std::string>());
    WriteFile("m.txt", CameraToText(JplModelFrom(entry), CameraFormat::kJplText).value());
    std::string points;
    for (const auto& row : entry.at("project")) {
      points += row.at("P").dump().substr(1);
      points.back() = '\n';
    }
    WriteFile("p.csv", points);
    const ProcessResult result = Run({"project", "--model", "m.txt", "--points", "p.csv"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto lines = Lines(result.out);
    ASSERT_EQ(lines.size(), entry.at("project").size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      double x = 0, y = 0;
      ASSERT_EQ(std::sscanf(lines[i].c_str(), "%lf,%lf", &x, &y), 2) << lines[i];
      EXPECT_NEAR(x, entry.at("project")[i].at("px")[0].get<double>(), 1e-9);
      EXPECT_NEAR(y, entry.at("project")[i].at("px")[1].get<double>(), 1e-9);
    }
  }
}

TEST_F(CameraCommand, ConvertsAndTellsTheResidual) {
  struct Row {
    std::vector<std::string> arguments;
    const char* out;
    const char* family;
    CameraFormat format;
    const char* said;
  };
  const Row rows[] = {
      {{"--model", "a.yml", "--to", "opencv8", "--out", "b.xml"},
       "b.xml",
       "OpenCV 8",
       CameraFormat::kOpenCvXml,
       "residual  rms"},
      {{"--model", "a.yml", "--to", "ros", "--out", "b.yaml"},
       "b.yaml",
       "OpenCV 5",
       CameraFormat::kRosYaml,
       "ROS camera_info"},
      {{"--model", "a.yml", "--out", "b.cahvor"},
       "b.cahvor",
       "CAHVOR",
       CameraFormat::kJplText,
       "residual  rms"},
      {{"--model", "a.cpcc", "--size", "576x384", "--to", "cahvor", "--out", "c.cahvor"},
       "c.cahvor",
       "CAHVOR",
       CameraFormat::kJplText,
       "mm in the source, m in the new file"},
      {{"--model", "a.xml", "--camera", "right", "--to", "cahv", "--out", "d.cahv"},
       "d.cahv",
       "CAHV",
       CameraFormat::kJplText,
       "kept by JPL's rule, not fitted"},
      {{"--model", "a.cahvore", "--to", "fisheye", "--out", "t.yml"},
       "t.yml",
       "fisheye (equidistant)",
       CameraFormat::kOpenCvYaml,
       "no substitute for the old one in stereo"},
      {{"--model", "a.vic", "--to", "pinhole", "--out", "e.yml"},
       "e.yml",
       "pinhole",
       CameraFormat::kOpenCvYaml,
       "row shear of"},
      {{"--model", "a.cameramodel", "--to", "fisheye", "--out", "f.yml"},
       "f.yml",
       "fisheye (equidistant)",
       CameraFormat::kOpenCvYaml,
       "entrance pupil"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.out);
    std::vector<std::string> arguments = row.arguments;
    arguments.insert(arguments.begin(), "convert");
    const ProcessResult result = Run(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find(row.said), std::string::npos) << result.out;
    EXPECT_EQ(FamilyOf(Model(row.out)), row.family);
    EXPECT_EQ(CameraFormatOf(Read(row.out), row.out).value(), row.format);
  }
  double rms = NAN, max = NAN;
  const ProcessResult result =
      Run({"convert", "--model", "a.yml", "--to", "opencv8", "--out", "g.yml"});
  ASSERT_EQ(std::sscanf(result.out.c_str() + result.out.find("rms "), "rms %lf px, max %lf px",
                        &rms, &max),
            2);
  EXPECT_LT(max, 1e-9) << "exact";
}

TEST_F(CameraCommand, InfoTellsTheCameraWithUnits) {
  const ProcessResult cahvor = Run({"info", "--model", "a.cahvor"});
  ASSERT_EQ(cahvor.exit_code, 0) << cahvor.err;
  for (const char* part :
       {"family            CAHVOR", "size              640 x 480 px", "hs 7", "deg (row shear",
        "horizontal", "deg, edge to edge", "top left", "axis, unit        0.6, 0, 0.8"}) {
    EXPECT_NE(cahvor.out.find(part), std::string::npos) << part << "\n" << cahvor.out;
  }
  const ProcessResult tsai = Run({"info", "--model", "a.cpcc"});
  ASSERT_EQ(tsai.exit_code, 0) << tsai.err;
  EXPECT_NE(tsai.out.find("unit of length    mm"), std::string::npos) << tsai.out;
  EXPECT_NE(tsai.out.find("f                 69.974574 mm"), std::string::npos) << tsai.out;
  EXPECT_NE(tsai.out.find("not told by the file; give --size"), std::string::npos) << tsai.out;
}

TEST_F(CameraCommand, AlignWritesThePairAndChecksTheRows) {
  const auto vectors = ReadVectors("stereo_alignment.json");
  if (!vectors) {
    GTEST_SKIP() << NoReferenceData("cahvor_vectors");
  }
  const auto write = [&](const char* id, const char* name, bool linear) {
    CahvorModel model = CahvorFrom(vectors->at("models").at(id));
    if (linear) {
      model.O = model.A;
      model.R.setZero();
    }
    WriteFile(name, CahvorToText(model));
  };
  write("cahvor_640_landing_left", "l.cahvor", false);
  write("cahvor_640_landing_right", "r.cahvor", false);
  write("cahvor_640_landing_left", "l.cahv", true);
  write("cahvor_640_landing_right", "r.cahv", true);
  for (const nlohmann::json& entry : vectors->at("stereo_alignment")) {
    SCOPED_TRACE(entry.at("id").get<std::string>());
    const bool linear = !entry.contains("minfov");
    std::vector<std::string> arguments = {"align",
                                          "--left",
                                          linear ? "l.cahv" : "l.cahvor",
                                          "--right",
                                          linear ? "r.cahv" : "r.cahvor",
                                          "--out",
                                          "aligned"};
    if (!linear) {
      arguments.insert(arguments.end(), {"--form", "older", "--field",
                                         entry.at("minfov") == 0 ? "covering" : "inside"});
    }
    const ProcessResult result = Run(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto left = std::get<CahvorModel>(Model("aligned/left.cahv").lens);
    EXPECT_LT((left.H - Vector3From(entry.at("H"))).norm(), 1e-7);
    EXPECT_LT((left.V - Vector3From(entry.at("V"))).norm(), 1e-7);
    EXPECT_NE(result.out.find("baseline      1.056085224 m"), std::string::npos) << result.out;
    double rows = NAN;
    ASSERT_EQ(
        std::sscanf(result.out.c_str() + result.out.find("row error"), "row error max %lf", &rows),
        1);
    EXPECT_LT(rows, 1e-9);
  }
  const ProcessResult intrinsics = Run(
      {"align", "--left", "a.yml", "--right", "a.yml", "--baseline", "0.5", "--out", "parallel"});
  ASSERT_EQ(intrinsics.exit_code, 0) << intrinsics.err;
  EXPECT_NE(intrinsics.out.find("baseline      0.500000000 m"), std::string::npos);
}

TEST_F(CameraCommand, APairOfCahvFilesIsToldThatItsFieldIsNotKept) {
  const CahvorModel left = std::get<CahvorModel>(Model("a.vic").lens);
  CahvorModel right = left;
  right.C.y() += 1;
  WriteFile("l.cahv", CahvorToText(left));
  WriteFile("r.cahv", CahvorToText(right));
  const std::vector<std::string> arguments = {"align",  "--left", "l.cahv", "--right",
                                              "r.cahv", "--out",  "o"};
  std::vector<std::string> with_field = arguments;
  with_field.insert(with_field.end(), {"--field", "inside"});
  const ProcessResult plain = Run(arguments);
  const ProcessResult field = Run(with_field);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  ASSERT_EQ(field.exit_code, 0) << field.err;
  EXPECT_NE(plain.out.find("field         the average"), std::string::npos) << plain.out;
  EXPECT_NE(field.out.find("--field inside is not used"), std::string::npos) << field.out;
}

TEST_F(CameraCommand, InfoWarnsOfPixelsWithoutARayAndPrintsNoNegativeZero) {
  const auto info = [&](const char* C, const char* R) {
    WriteFile("m.cahvor", Replaced(Replaced(kCahvorText, "0.0004 -0.21 0.09", R), "0 -0.528 0", C));
    return Run({"info", "--model", "m.cahvor"});
  };
  const ProcessResult wild = info("-0 -0 -0", "0 -20 0");
  ASSERT_EQ(wild.exit_code, 0) << wild.err;
  EXPECT_NE(wild.out.find("% of the picture has no ray"), std::string::npos) << wild.out;
  EXPECT_NE(wild.out.find("centre            0, 0, 0 m"), std::string::npos) << wild.out;
  EXPECT_NE(info("0 0 0", "0 50 9000").out.find("corners are moved outwards by"),
            std::string::npos);
  EXPECT_EQ(info("-0 -0 -0", "-0 0 0").out.find("warning"), std::string::npos);
  for (const char* name : {"m.cahvor", "a.vic", "a.yml", "a.yaml"}) {
    const ProcessResult result = Run({"info", "--model", name});
    for (const char* zero : {"-0,", "-0 ", "-0\n", "-0.000000 ", "-0.0000,", "-0.0000)"}) {
      EXPECT_EQ(result.out.find(zero), std::string::npos) << zero << "\n" << result.out;
    }
  }
}

TEST_F(CameraCommand, HelpNamesTheFormats) {
  const ProcessResult help = Run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* part : {"project", "backproject", "convert", "info", "align", ".cpcc", "ROS"}) {
    EXPECT_NE(help.out.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace palace
