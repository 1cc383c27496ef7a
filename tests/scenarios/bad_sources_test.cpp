// Logs, pictures and cameras that are missing, cut short or something else.
#include "tests/scenarios/bad_input.h"

namespace palace {
namespace {

INSTANTIATE_TEST_SUITE_P(
    Logs, BadInputs,
    testing::Values(
        BadInput{"Missing", true, H({"--replay", "no.lcm"}), 1, {"no.lcm", "check the name"}},
        BadInput{"Text", true, H({"--replay", "text.lcm"}), 1, {"text.lcm", "choose another"}},
        BadInput{"Empty", true, H({"--replay", "empty.lcm"}), 1, {"empty.lcm", "choose another"}},
        BadInput{"Folder", true, H({"--replay", "folder"}), 1, {"folder", "name the log"}},
        BadInput{"Device", true, H({"--replay", "/dev/zero"}), 1, {"/dev/zero"}},
        BadInput{"InfoMissing", false, {"log", "info", "no.lcm"}, 1, {"no.lcm", "check the name"}},
        BadInput{"InfoText", false, {"log", "info", "text.lcm"}, 1, {"text.lcm", "another file"}},
        BadInput{"VerifyFolder", false, {"log", "verify", "folder"}, 1, {"folder", "name the log"}},
        BadInput{"ExportEmpty",
                 false,
                 {"log", "export", "empty.lcm", "--out", "out"},
                 1,
                 {"empty.lcm", "choose another"}}),
    NameOfRow);

INSTANTIATE_TEST_SUITE_P(
    Pictures, BadInputs,
    testing::Values(
        BadInput{"NoRig", true, H({"--images", "no.toml"}), 1, {"no.toml", "check the name"}},
        BadInput{"RigFolder", true, H({"--images", "folder"}), 1, {"folder", "is a folder"}},
        BadInput{"MissingKey",
                 true,
                 H({"--images", "missing.toml"}),
                 1,
                 {"missing.toml:1", "left.fx_px is missing", "add it to [left]"}},
        BadInput{"NegativeWidth",
                 true,
                 H({"--images", "negative.toml"}),
                 1,
                 {"negative.toml:2", "left.width = -64", "32 .. 8192"}},
        BadInput{"SurveyIsNaN",
                 true,
                 H({"--images", "surveyed.toml"}),
                 1,
                 {"poses_nan.csv:2", "down = nan"}},
        BadInput{"NotANumber",
                 true,
                 H({"--images", "nan.toml"}),
                 1,
                 {"nan.toml:16", "rig.baseline_m = nan", "metres"}},
        BadInput{"UnknownKey",
                 true,
                 H({"--images", "unknown.toml"}),
                 1,
                 {"unknown.toml:18", "mount.colour", "known here"}},
        BadInput{"Syntax", true, H({"--images", "syntax.toml"}), 1, {"syntax.toml:17", "expected"}},
        BadInput{"SizesDiffer",
                 true,
                 H({"--images", "size.toml"}),
                 1,
                 {"r.png", "64 x 48", "64 x 96", "same size"}},
        BadInput{"SizeOfRig",
                 true,
                 H({"--images", "both_sizes.toml"}),
                 1,
                 {"large.png", "64 x 96", "64 x 48", "correct width and height"}},
        BadInput{
            "CutShort", true, H({"--images", "cut.toml"}), 1, {"cut.png", "cut short", "again"}},
        BadInput{"NoMatch", true, H({"--images", "none.toml"}), 1, {"none.toml", "q*.png"}}),
    NameOfRow);

/// `palace --headless --cameras` of one of the rigs.
std::vector<std::string> C(const std::string& name) {
  return H({"--cameras", "cameras_" + name + ".toml"});
}

INSTANTIATE_TEST_SUITE_P(
    Cameras, BadInputs,
    testing::Values(
        BadInput{"NoCameraRig", true, C("nowhere"), 1, {"cameras_nowhere.toml", "check the name"}},
        BadInput{"NoCaptureTable",
                 true,
                 H({"--cameras", "good.toml"}),
                 1,
                 {"good.toml", "[capture] is missing", "left and right"}},
        BadInput{"NoFilm", true, C("no_film"), 1, {"missing.avi", "check the name"}},
        BadInput{"TextAsFilm", true, C("text"), 1, {"text.avi", "text, no video"}},
        BadInput{"EmptyFilm", true, C("empty"), 1, {"empty.avi", "is empty", "record it again"}},
        BadInput{"NoiseAsFilm", true, C("noise"), 1, {"noise.avi", "no video", "convert it"}},
        BadInput{"FolderAsFilm", true, C("folder"), 1, {"folder", "no file"}},
        BadInput{
            "SizeOfFilm", true, C("film_size"), 1, {"film.avi", "32 x 24", "64 x 48", "calibrate"}},
        BadInput{"NoCamera", true, C("no_device"), 1, {"/dev/video253", "v4l2-ctl"}},
        BadInput{"StreamRefused", true, C("refused"), 1, {"http://127.0.0.1:9/a", "network"}},
        BadInput{"SchemeOfStream", true, C("scheme"), 1, {"capture.left", "ftp://", "rtsp"}},
        BadInput{"FilmAndCamera", true, C("mixed"), 1, {"/dev/video253", "film.avi", "clocks"}},
        BadInput{"OneCameraTwice", true, C("one"), 1, {"capture.right = 253", "side_by_side"}}),
    NameOfRow);

}  // namespace
}  // namespace palace
