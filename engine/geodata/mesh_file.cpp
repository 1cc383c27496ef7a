#include "engine/geodata/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "engine/core/files.h"
#include "engine/geodata/ply_file.h"
#include "engine/geodata/text_lines.h"

namespace palace {
namespace {

using Eigen::Vector3d;

constexpr double kFarthest = 1e6;  // of a vertex, in the file's unit
constexpr std::size_t kMostVertices = 3 * kMostTriangles;

Error TooLarge(const std::string& where) {
  return InvalidError(where + "the mesh has more than " + std::to_string(kMostTriangles) +
                      " triangles, the limit, which take 400 MB; thin it out, e.g. with MeshLab");
}

bool IsPlace(const Vector3d& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthest; }

/// A polygon as a fan; false when the mesh would be too large.
bool AddFan(const std::vector<std::uint32_t>& corners, MeshFile& mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const MeshFile::Corners triangle = {corners[0], corners[i - 1], corners[i]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      continue;
    }
    if (mesh.triangles.size() == kMostTriangles) {
      return false;
    }
    mesh.triangles.push_back(triangle);
  }
  return true;
}

/// OBJ, line by line.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::ifstream& file) : path_(path), file_(file) {}

  Result<MeshFile> Read() {
    for (std::string line; std::getline(file_, line);) {
      if (++line_ == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) {
        line.erase(0, 3);
      }
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first == std::string::npos) {
        continue;
      }
      const bool vertex = line.compare(first, 2, "v ") == 0 || line.compare(first, 2, "v\t") == 0;
      const bool face = line.compare(first, 2, "f ") == 0 || line.compare(first, 2, "f\t") == 0;
      const Status read = vertex ? ReadVertex(line.substr(first + 2))
                          : face ? ReadFace(line.substr(first + 2))
                                 : Ok();
      if (!read) {
        return read.error();
      }
    }
    return std::move(mesh_);
  }

 private:
  Error Here(const std::string& what) const { return InvalidError(Where() + what); }
  std::string Where() const { return path_.string() + ":" + std::to_string(line_) + ": "; }

  Status ReadVertex(const std::string& words) {
    // "1,5" is no number here, and no two.
    if (words.find(',') < words.find('#') || ParseNumbers(words, 3, numbers_) < 3) {
      return Here("a vertex needs x y z, found " + QuotedLine(words));
    }
    const Vector3d p(numbers_[0], numbers_[1], numbers_[2]);
    if (!IsPlace(p)) {
      return Here("a vertex beyond +-1000000, or no number: " + QuotedLine(words));
    }
    if (mesh_.vertices.size() == kMostVertices) {
      return TooLarge(Where());
    }
    mesh_.vertices.push_back(p);
    return Ok();
  }

  /// "3 4/1 -1//2": vertex, texture and normal of each corner; below 0 counts from the newest.
  Status ReadFace(const std::string& words) {
    corners_.clear();
    const char* at = words.c_str();
    while (true) {
      at += std::strspn(at, " \t\r");
      if (*at == '\0' || *at == '#') {
        break;
      }
      char* end = nullptr;
      const long long index = std::strtoll(at, &end, 10);
      const auto count = static_cast<long long>(mesh_.vertices.size());
      const long long place = index < 0 ? count + index : index - 1;
      const bool is_index = end != at && std::strchr("/ \t\r#", *end) != nullptr;  // or the end
      if (!is_index) {
        return Here("a corner is no whole number: " + QuotedLine(words));
      }
      if (index == 0 || place < 0 || place >= count) {
        return Here("a face names no vertex of the " + std::to_string(count) +
                    " before it: " + QuotedLine(words));
      }
      corners_.push_back(static_cast<std::uint32_t>(place));
      at = end + std::strcspn(end, " \t\r");
      if (corners_.size() > PlyRows::kLongestList) {
        return Here("a face of more than " + std::to_string(PlyRows::kLongestList) + " corners");
      }
    }
    if (corners_.size() < 3) {
      return Here("a face needs three vertices, found " + QuotedLine(words));
    }
    return AddFan(corners_, mesh_) ? Ok() : Status(TooLarge(Where()));
  }

  const std::filesystem::path& path_;
  std::ifstream& file_;
  std::size_t line_ = 0;
  MeshFile mesh_;
  std::vector<double> numbers_;
  std::vector<std::uint32_t> corners_;
};

class PlyMeshReader {
 public:
  PlyMeshReader(const std::filesystem::path& path, std::ifstream& file)
      : path_(path), file_(file) {}

  Result<MeshFile> Read() {
    const Result<PlyHeader> header = ReadPlyHeader(path_, file_);
    if (!header) {
      return header.error();
    }
    for (const PlyElement& element : header->elements) {
      const Status read = element.name == "vertex" ? ReadVertices(element, header->binary)
                          : element.name == "face"
                              ? ReadFaces(element, header->binary)
                              : PassOver(path_, file_, header->binary, element);
      if (!read) {
        return read.error();
      }
    }
    if (const Status end = CheckPlyEnd(path_, file_, *header); !end) {
      return end.error();
    }
    return std::move(mesh_);
  }

 private:
  Error Here(const std::string& what) const { return InvalidError(path_.string() + ": " + what); }

  Status ReadVertices(const PlyElement& element, bool binary) {
    const std::size_t x = element.IndexOf("x"), y = element.IndexOf("y"), z = element.IndexOf("z");
    if (std::max({x, y, z}) == element.properties.size()) {
      return Here("needs vertex properties x, y, z");
    }
    if (element.count > kMostVertices) {
      return TooLarge(path_.string() + ": ");
    }
    PlyRows rows(path_, file_, binary, element, "vertex");
    for (std::size_t n = 0; n < element.count; ++n) {
      if (const Status read = rows.Next(); !read) {
        return read;
      }
      const Vector3d p(rows.Value(x), rows.Value(y), rows.Value(z));
      if (!IsPlace(p)) {
        return Here("vertex " + std::to_string(n + 1) + " lies beyond +-1000000, or is no number");
      }
      mesh_.vertices.push_back(p);
    }
    return Ok();
  }

  Status ReadFaces(const PlyElement& element, bool binary) {
    const std::size_t list =
        std::min(element.IndexOf("vertex_indices"), element.IndexOf("vertex_index"));
    if (list == element.properties.size() || element.properties[list].count_type.empty()) {
      return Here("needs a face property list of vertex_indices");
    }
    PlyRows rows(path_, file_, binary, element, "face");
    std::vector<std::uint32_t> corners;
    for (std::size_t n = 0; n < element.count; ++n) {
      if (const Status read = rows.Next(); !read) {
        return read;
      }
      corners.clear();
      for (const double index : rows.List(list)) {
        if (!(index >= 0 && index < static_cast<double>(mesh_.vertices.size()))) {
          return Here("face " + std::to_string(n + 1) + " names no vertex of the " +
                      std::to_string(mesh_.vertices.size()) + " before it");
        }
        corners.push_back(static_cast<std::uint32_t>(index));
      }
      if (!AddFan(corners, mesh_)) {
        return TooLarge(path_.string() + ": ");
      }
    }
    return Ok();
  }

  const std::filesystem::path& path_;
  std::ifstream& file_;
  MeshFile mesh_;
};

}  // namespace

Result<MeshFile> ReadMeshFile(const std::filesystem::path& path) {
  if (const Status regular = CheckRegularFile(path); !regular) {
    return regular.error();
  }
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open()) {
    return UnavailableError(path.string() + ": cannot be read; check its permissions");
  }
  char start[4] = {};
  file.read(start, 3);
  file.clear();
  file.seekg(0);
  const bool ply = std::strcmp(start, "ply") == 0;
  Result<MeshFile> mesh = ply ? PlyMeshReader(path, file).Read() : ObjReader(path, file).Read();
  if (mesh && mesh->triangles.empty()) {
    return InvalidError(path.string() +
                        ": has no triangles; a mesh is an OBJ file of v and f lines"
                        " or a PLY file with faces");
  }
  return mesh;
}

OpenEdges FindOpenEdges(const MeshFile& mesh) {
  // Vertices of one place have one number.
  const auto less = [](const Vector3d& a, const Vector3d& b) {
    return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
  };
  std::map<Vector3d, std::uint32_t, decltype(less)> places(less);
  std::vector<std::uint32_t> place_of;
  place_of.reserve(mesh.vertices.size());
  for (const Vector3d& vertex : mesh.vertices) {
    place_of.push_back(
        places.try_emplace(vertex, static_cast<std::uint32_t>(places.size())).first->second);
  }
  struct Edge {
    std::uint32_t low, high;  ///< places
    std::uint32_t from, to;   ///< vertices
    bool Same(const Edge& other) const { return low == other.low && high == other.high; }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const MeshFile::Corners& corners : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
      const auto [low, high] = std::minmax(place_of[from], place_of[to]);
      if (low != high) {
        edges.push_back({low, high, from, to});
      }
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high) < std::tie(b.low, b.high);
  });
  OpenEdges open;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool shared = (i > 0 && edges[i].Same(edges[i - 1])) ||
                        (i + 1 < edges.size() && edges[i].Same(edges[i + 1]));
    if (!shared && open.count++ == 0) {
      open.first_from = mesh.vertices[edges[i].from];
      open.first_to = mesh.vertices[edges[i].to];
    }
  }
  return open;
}

}  // namespace palace
