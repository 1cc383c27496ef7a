// One good file of each format that cameras are read from.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palace {

struct CameraText {
  const char* name;  ///< file name
  std::string text;
};

inline const std::string kCahvorText =
    "# a comment\n"
    "Model = CAHVOR = perspective, distortion\n"
    "Dimensions = 640 480\n"
    "C = 0 -0.528 0\n"
    "A = 0.6 0 0.8\n"
    "H = 225.6 770 228   # pixels\n"
    "V = -372 9 718\n"
    "O = 0.6 0 0.8\n"
    "R = 0.0004 -0.21 0.09\n"
    "S =\n"
    " 1.0e-3 2.0e-3\n"
    " 2.0e-3 1.0e-3\n"
    "Hs    = 770\n"
    "Theta = -1.5708 (-90.0 deg)\n"
    "S internal =\n"
    " 1 0 0\n";

inline const std::string kCahvoreText =
    "Model = CAHVORE3,0.37 = general\n"
    "Dimensions = 1024 1024\n"
    "C = 0.606185 -0.043367 -0.234891\n"
    "A = 0.7120130091490112 0.037316000479491955 0.7011740090097355\n"
    "H = 353.341 474.873 350.82\n"
    "V = 44.0102 16.904 683.916\n"
    "O = 0.7129531497037792 0.038186008018184246 0.7001711470198524\n"
    "R = 3e-06 -0.013032 -0.00754\n"
    "E = 0.000942 0.00228 0.001613\n";

inline const std::string kPdsText =
    "PDS_VERSION_ID = PDS3\n"
    "/* a label */\n"
    "OBJECT = IMAGE\n"
    "  LINES = 1024\n"
    "  LINE_SAMPLES = 1024\n"
    "END_OBJECT = IMAGE\n"
    "GROUP = ROVER_COORDINATE_SYSTEM\n"
    "  MODEL_TYPE = NONE\n"
    "END_GROUP = ROVER_COORDINATE_SYSTEM\n"
    "GROUP = GEOMETRIC_CAMERA_MODEL\n"
    "  NOTE = \"text with = and (brackets\n"
    "     over two lines\"\n"
    "  MODEL_TYPE = CAHVORE\n"
    "  MODEL_COMPONENT_ID = (\"C\",\"A\",\"H\",\"V\",\n"
    "     \"O\",\"R\",\"E\",\"T\",\"P\")\n"
    "  MODEL_COMPONENT_1 = (0.606185 <m>, -0.043367 <m>,\n"
    "     -0.234891 <m>)\n"
    "  MODEL_COMPONENT_2 = (0.712013,0.037316,0.701174)\n"
    "  MODEL_COMPONENT_3 = (353.341,474.873,350.82)\n"
    "  MODEL_COMPONENT_4 = (44.0102,16.904,683.916)\n"
    "  MODEL_COMPONENT_5 = (0.712953,0.038186,0.700171)\n"
    "  MODEL_COMPONENT_6 = (3e-06,-0.013032,-0.00754)\n"
    "  MODEL_COMPONENT_7 = (0.000942,0.00228,0.001613)\n"
    "  MODEL_COMPONENT_8 = 3.0\n"
    "  MODEL_COMPONENT_9 = 0.37\n"
    "END_GROUP = GEOMETRIC_CAMERA_MODEL\n"
    "END\n"
    "MODEL_COMPONENT_1 = \"picture bytes\"\n";

inline const std::string kVicarText =
    "LBLSIZE=1024 FORMAT='HALF' NL=480 NS=640 PROPERTY='IDENTIFICATION' X='a'  "
    "PROPERTY='GEOMETRIC_CAMERA_MODEL' MODEL_TYPE='CAHV' MODEL_COMPONENT_1=(0.0,-0.528,0.0) "
    "MODEL_COMPONENT_2=(0.6,0.0,0.8) MODEL_COMPONENT_3=(225.6,770.0,228.0) "
    "MODEL_COMPONENT_4=(-372.0,9.0,718.0) TASK='LABEL' USER='x'";

inline const std::string kWillsonText =
    "576\n576\n0.023\n0.023\n0.023\n0.023\n262.41093943\n212.45332863\n1.0001750178\n"
    "69.974574039\n-6.0670974902e-04\n-100.26886446\n-85.3232895\n1999.7624626\n"
    "0.52348816339\n0.017487254462\n0.035000288833\n0\n0\n";

inline const std::string kOpenCvYamlText =
    "%YAML:1.0\n---\n"
    "calibration_time: \"Sun 01 Jan 2023\"\n"
    "image_width: 640\nimage_height: 480\n"
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 5.3591573396163199e+02, 0., 3.4228315473308373e+02, 0.,\n"
    "       5.3591573396163199e+02, 2.3557082909788173e+02, 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
    "   data: [ -2.6637260909660682e-01, -3.8588898922304653e-02,\n"
    "       1.7831947042852964e-03, -2.8122100441115472e-04,\n"
    "       2.3839153080878486e-01 ]\n";

inline const std::string kOpenCvXmlText =
    "<?xml version=\"1.0\"?>\n<opencv_storage>\n<!-- stereo -->\n"
    "<imageSize>\n  640 480</imageSize>\n"
    "<M1 type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n"
    "  <data>\n    534. 0. 335. 0. 534. 240. 0. 0. 1.</data></M1>\n"
    "<D1 type_id=\"opencv-matrix\">\n  <rows>1</rows>\n  <cols>5</cols>\n  <dt>d</dt>\n"
    "  <data>\n    -0.29 0.1 0. 0. 0.</data></D1>\n"
    "<M2 type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n"
    "  <data>\n    536. 0. 334. 0. 536. 242. 0. 0. 1.</data></M2>\n"
    "<D2 type_id=\"opencv-matrix\">\n  <rows>1</rows>\n  <cols>5</cols>\n  <dt>d</dt>\n"
    "  <data>\n    -0.28 0.1 0. 0. 0.</data></D2>\n"
    "<R type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n"
    "  <data>\n    1. 0. 0. 0. 1. 0. 0. 0. 1.</data></R>\n"
    "<T type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>1</cols>\n  <dt>d</dt>\n"
    "  <data>\n    -3.3 0.04 0.001</data></T>\n"
    "</opencv_storage>\n";

inline const std::string kRosText =
    "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo/right\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [500.0, 0.0, 320.5, 0.0, 501.0, 240.5, 0.0, "
    "0.0, 1.0]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.2, 0.05, 0.001, -0.001, 0]\n"
    "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
    "projection_matrix:\n  rows: 3\n  cols: 4\n"
    "  data: [480.0, 0.0, 320.0, -57.6, 0.0, 480.0, 240.0, 0.0,\n    0.0, 0.0, 1.0, 0.0]\n";

inline const std::string kMrcalText =
    " # f {\n{\n    'lensmodel':  \"LENSMODEL_CAHVORE_linearity=0.34\",\n"
    "    # extrinsics are rt_fromref\n"
    "    b'extrinsics': [ 0.1, 1, 0.2, 33, 4.4, -55.3E-3, ],\n"
    "    'intrinsics': (700, 710, 320, 240, 0.01, 0.02, 0.001, 0.02, 0.003, 1e-3, 0, 0 ),\n"
    "    'optimization_inputs': b'~~ {[ #',\n"
    "    'imagersize': [640, 480],\n}\n";

/// The left camera of the EuRoC data sets, in the layout of its file.
inline const std::string kEurocText =
    "# General sensor definitions.\nsensor_type: camera\ncomment: VI-Sensor cam0 (MT9M034)\n\n"
    "T_BS:\n  cols: 4\n  rows: 4\n"
    "  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,\n"
    "         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,\n"
    "        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,\n"
    "         0.0, 0.0, 0.0, 1.0]\n"
    "rate_hz: 20\nresolution: [752, 480]\ncamera_model: pinhole\n"
    "intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv\n"
    "distortion_model: radial-tangential\n"
    "distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]\n";

/// Long rows of a matrix go on in the next line, as PyYAML writes them.
inline const std::string kKalibrText =
    "cam0:\n  cam_overlaps: [1]\n  camera_model: pinhole\n"
    "  distortion_coeffs: [-0.2834, 0.0739, 0.00019, 1.76e-05]\n  distortion_model: radtan\n"
    "  intrinsics: [461.6, 460.3, 363.0, 248.1]\n  resolution: [752, 480]\n"
    "  rostopic: /cam0/image_raw\n"
    "cam1:\n  T_cn_cnm1:\n"
    "  - [0.9999971853038866, 0.0023160844433331, 0.0005247918332000,\n    -0.11]\n"
    "  - [-0.0023229380218, 0.9998990446, 0.0140187127,\n    0.0004]\n"
    "  - [-0.0004922700286, -0.0140198951, 0.9999015899, -0.0008]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n"
    "  cam_overlaps: [0]\n  camera_model: pinhole\n"
    "  distortion_coeffs:\n  - -0.013\n  - 0.021\n  - -0.022\n  - 0.0092\n"
    "  distortion_model: equidistant\n"
    "  intrinsics: [460.2, 458.6, 378.5, 254.9]\n  resolution: [752, 480]\n"
    "  rostopic: /cam1/image_raw\n";

/// The format of each is told by its content; the names are what people call such files.
inline std::vector<CameraText> GoodCameraTexts() {
  return {{"a.cahvor", kCahvorText}, {"a.cahvore", kCahvoreText}, {"a.lbl", kPdsText},
          {"a.vic", kVicarText},     {"a.cpcc", kWillsonText},    {"a.yml", kOpenCvYamlText},
          {"a.xml", kOpenCvXmlText}, {"a.yaml", kRosText},        {"a.cameramodel", kMrcalText},
          {"e.yaml", kEurocText},    {"k.yaml", kKalibrText}};
}

/// `text` with the first `from` exchanged.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

}  // namespace palace
