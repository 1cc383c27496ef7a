// Triangle meshes: triangles come out as they stand in the file, and what is no mesh is named.
#include "engine/geodata/mesh_file.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"
#include "tests/support/survey_files.h"

namespace palace {
namespace {

using ::testing::HasSubstr;
using Corners = MeshFile::Corners;

constexpr const char* kTetrahedron = R"(# four corners
o tetrahedron
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
f 1 3 2
f 1/1 2/1 4/1
f 1//2 4//2 3//2
f -3 -2 -1
)";

class MeshFiles : public testing::Test {
 protected:
  ~MeshFiles() override {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Result<MeshFile> Read(const std::string& bytes) {
    std::ofstream(path_, std::ios::binary) << bytes;
    return ReadMeshFile(path_);
  }
  const std::filesystem::path path_ = OwnPath(".obj");
};

TEST_F(MeshFiles, AnObjFileInEverySpelling) {
  const auto mesh = Read(kTetrahedron);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->vertices.size(), 4U);
  EXPECT_EQ(mesh->triangles, (std::vector<Corners>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
  EXPECT_EQ(FindOpenEdges(*mesh).count, 0U);
}

TEST_F(MeshFiles, AByteOrderMarkTakesNoVertex) {
  const auto plain = Read(kTetrahedron), marked = Read("\xEF\xBB\xBF" + std::string(kTetrahedron));
  ASSERT_TRUE(plain && marked);
  EXPECT_EQ(marked->vertices, plain->vertices);
  EXPECT_EQ(marked->triangles, plain->triangles);
}

TEST_F(MeshFiles, APolygonIsAFan) {
  const auto mesh = Read("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n");
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->triangles, (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST_F(MeshFiles, PlyBothWaysAndWithOtherElements) {
  const std::string header =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element material 1\nproperty uchar red\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string text =
      "ply\nformat ascii 1.0\n" + header + "0 0 0\n1 0 0\n0 1 0.5\n200\n3 0 1 2\n";
  const std::string bytes = "ply\nformat binary_little_endian 1.0\n" + header +
                            BytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0.5F}) + "\xC8" + "\x03" +
                            BytesOf<std::int32_t>({0, 1, 2});
  for (const std::string& file : {text, bytes}) {
    const auto mesh = Read(file);
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    ASSERT_EQ(mesh->vertices.size(), 3U);
    EXPECT_EQ(mesh->vertices[2], Eigen::Vector3d(0, 1, 0.5));
    EXPECT_EQ(mesh->triangles, (std::vector<Corners>{{0, 1, 2}}));
  }
}

TEST_F(MeshFiles, AnElementWithoutPropertiesCostsNothingHoweverManyRowsItClaims) {
  const auto mesh = Read(
      "ply\nformat binary_little_endian 1.0\nelement nothing 9000000000000000000\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
      BytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0.5F}) + "\x03" + BytesOf<std::int32_t>({0, 1, 2}));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->triangles, (std::vector<Corners>{{0, 1, 2}}));
}

TEST_F(MeshFiles, AnOpenMeshSaysWhere) {
  std::string open = kTetrahedron;
  open.resize(open.rfind("f -3"));
  const auto mesh = Read(open);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const OpenEdges edges = FindOpenEdges(*mesh);
  EXPECT_EQ(edges.count, 3U);
  EXPECT_NE(edges.first_from, edges.first_to);
}

TEST_F(MeshFiles, VerticesOfOnePlaceCountAsOne) {
  // Every face with corners of its own, as many programs write them.
  const auto mesh = Read(
      "v 0 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 0 1\nf 4 5 6\n"
      "v 0 0 0\nv 0 0 1\nv 0 1 0\nf 7 8 9\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 10 11 12\n");
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(FindOpenEdges(*mesh).count, 0U);
}

TEST_F(MeshFiles, WhatIsNoMeshIsNamed) {
  const std::string ply = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const struct {
    const char* what;
    std::string file;
    const char* message;
  } table[] = {
      {"empty", "", "has no triangles"},
      {"a cloud", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "has no triangles"},
      {"decimal commas", "v 1,5 1 1\n", ".obj:1: a vertex needs x y z, found \"1,5 1 1\""},
      {"half a vertex", "v 0 0 0\nf 1.7 1 1\n", ".obj:2: a corner is no whole number"},
      {"a corner with a tail", "v 0 0 0\nf 1 1abc 1\n", ".obj:2: a corner is no whole number"},
      {"words", "v 0 0 zero\n", ".obj:1: a vertex needs x y z, found \"0 0 zero\""},
      {"far away", "v 0 0 2e6\n", ".obj:1: a vertex beyond +-1000000"},
      {"not a number", "v 0 nan 0\n", ".obj:1: a vertex beyond +-1000000"},
      {"two corners", "v 0 0 0\nv 1 0 0\nf 1 2\n", ".obj:3: a face needs three vertices"},
      {"index too high", "v 0 0 0\nf 1 2 3\n", ".obj:2: a face names no vertex of the 1"},
      {"index 0", "v 0 0 0\nf 0 1 1\n", ".obj:2: a face names no vertex"},
      {"before the first", "v 0 0 0\nf -1 -2 -3\n", ".obj:2: a face names no vertex"},
      {"a picture", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), "has no triangles"},
      {"a PLY of points", ply + "element vertex 1\n" + xyz + "end_header\n0 0 0\n",
       "has no triangles"},
      {"a PLY cut off", ply + "element vertex 3\n" + xyz + faces + "0 0 0\n1 0 0\n",
       "vertex 3 of 3"},
      {"a PLY that names no vertex",
       ply + "element vertex 3\n" + xyz + faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       "face 1 names no vertex of the 3"},
      {"a PLY that claims too much", ply + "element vertex 999999999999\n" + xyz + faces,
       "more than 2000000 triangles, the limit, which take 400 MB"},
      {"a PLY without lists",
       ply + "element vertex 0\n" + xyz + "element face 1\nproperty int a\nend_header\n0\n",
       "list of vertex_indices"},
  };
  for (const auto& row : table) {
    const auto mesh = Read(row.file);
    ASSERT_FALSE(mesh.ok()) << row.what;
    EXPECT_THAT(mesh.error().message, HasSubstr(row.message)) << row.what;
    EXPECT_THAT(mesh.error().message, HasSubstr(path_.string())) << row.what;
  }
  EXPECT_THAT(ReadMeshFile(path_.parent_path()).error().message, HasSubstr("is a folder"));
  EXPECT_THAT(ReadMeshFile("/nowhere.obj").error().message, HasSubstr("no such file"));
  EXPECT_THAT(ReadMeshFile("/dev/zero").error().message, HasSubstr("is no file on disk"));
}

TEST_F(MeshFiles, AHugeMeshIsRefusedAtTheLimit) {
  std::string file = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::string many;
  for (int i = 0; i < 1000; ++i) {
    many += "f 1 2 3\n";
  }
  for (int i = 0; i < 2001; ++i) {
    file += many;
  }
  const auto mesh = Read(file);
  ASSERT_FALSE(mesh.ok());
  EXPECT_THAT(mesh.error().message, HasSubstr(":2000004: the mesh has more than 2000000"));
}

}  // namespace
}  // namespace palace
