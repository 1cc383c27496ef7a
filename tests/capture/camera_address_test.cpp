// What an address means, and what is said of one that cannot be a camera.
#include "engine/capture/camera_address.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/capture/film.h"

namespace palace {
namespace {

TEST(CameraAddress, Kinds) {
  struct Row {
    const char* text;
    CameraKind kind;
    const char* address;
  };
  const Row rows[] = {
      {"0", CameraKind::kDevice, "/dev/video0"},
      {"12", CameraKind::kDevice, "/dev/video12"},
      {"/dev/video2", CameraKind::kDevice, "/dev/video2"},
      {"/dev/v4l/by-id/usb-x", CameraKind::kDevice, "/dev/v4l/by-id/usb-x"},
      {"rtsp://10.0.0.7/1", CameraKind::kStream, "rtsp://10.0.0.7/1"},
      {"http://cam:8080/video", CameraKind::kStream, "http://cam:8080/video"},
      {"films/left.avi", CameraKind::kFile, "/rig/films/left.avi"},
      {"../left.avi", CameraKind::kFile, "/left.avi"},
      {"/films/left.avi", CameraKind::kFile, "/films/left.avi"},
      {"0.avi", CameraKind::kFile, "/rig/0.avi"},
      {"concat:a|b", CameraKind::kFile, "/rig/concat:a|b"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.text);
    const auto request = ParseCameraAddress(row.text, "/rig");
    ASSERT_TRUE(request.ok()) << request.error().message;
    EXPECT_EQ(request->kind, row.kind);
    EXPECT_EQ(request->address, row.address);
  }
  for (const char* refused : {"ftp://host/x", "file:///etc/passwd", "radio://1", "://x"}) {
    EXPECT_FALSE(ParseCameraAddress(refused, "/rig").ok()) << refused;
  }
}

TEST(CameraAddress, NamesHidePasswords) {
  const auto name = [](const char* text) { return NameOf(*ParseCameraAddress(text, "/rig")); };
  EXPECT_EQ(name("rtsp://pilot:secret@10.0.0.7:554/1"), "rtsp://10.0.0.7:554/1");
  EXPECT_EQ(name("rtsp://pilot:se@cret@10.0.0.7/1"), "rtsp://10.0.0.7/1");
  EXPECT_EQ(name("http://10.0.0.7/a@b"), "http://10.0.0.7/a@b");
  EXPECT_EQ(name("rtsp://10.0.0.7"), "rtsp://10.0.0.7");
  EXPECT_EQ(name("3"), "/dev/video3");
}

using CameraFiles = film::FilmTest;

TEST_F(CameraFiles, WhatCannotBeACameraIsSaid) {
  std::ofstream(folder_ / "notes.avi") << "Nothing to see here.\nOnly words, öäü.\n";
  std::ofstream(folder_ / "empty.avi");
  std::filesystem::create_directory(folder_ / "folder.avi");
  film::Write(folder_ / "good.avi");
  struct Row {
    CameraKind kind;
    std::string address;
    const char* said;
  };
  const Row rows[] = {
      {CameraKind::kFile, folder_ / "none.avi", "no such video file"},
      {CameraKind::kFile, folder_ / "notes.avi", "this is text"},
      {CameraKind::kFile, folder_ / "empty.avi", "the file is empty"},
      {CameraKind::kFile, folder_ / "folder.avi", "this is no file"},
      {CameraKind::kFile, "/dev/zero", "this is no file"},
      {CameraKind::kDevice, "/dev/video253", "no such camera"},
      {CameraKind::kDevice, "/dev", "no camera device"},
      {CameraKind::kFile, folder_ / "good.avi", ""},
      {CameraKind::kStream, "rtsp://10.0.0.7/1", ""},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.address);
    const Status status = CheckCameraAddress({row.kind, row.address});
    EXPECT_EQ(status.ok(), row.said[0] == '\0');
    if (!status) {
      EXPECT_NE(status.error().message.find(row.said), std::string::npos) << status.error().message;
      EXPECT_NE(status.error().message.find(row.address), std::string::npos);
    }
  }
}

TEST_F(CameraFiles, WithoutPermissionTheRemedyIsNamed) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "runs as an ordinary user; root may read everything";
  }
  film::Write(folder_ / "secret.avi");
  std::filesystem::permissions(folder_ / "secret.avi", std::filesystem::perms::none);
  const Status status = CheckCameraAddress({CameraKind::kFile, folder_ / "secret.avi"});
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("permissions"), std::string::npos);
}

}  // namespace
}  // namespace palace
