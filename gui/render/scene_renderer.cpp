#include "gui/render/scene_renderer.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/world/world_mesh.h"
#include "gui/render/camera_clip.h"
#include "gui/render/framebuffer.h"
#include "gui/render/gl_handle.h"
#include "gui/render/mesh_buffer.h"
#include "gui/render/noise_texture.h"
#include "gui/render/shader.h"
#include "shader_text.h"

namespace palace {
namespace {

constexpr int kSamples = 4;
constexpr float kGroundReach_m = 200;
constexpr float kAmbient = 0.50F;
constexpr float kSun = 0.70F;
constexpr float kSkyGrey = 0.78F;
constexpr float kGrain = 26;                  ///< standard deviation of a tile, grey levels of 255
constexpr double kNoFineFootprint_m = 0.009;  ///< as in shaders/surface.glsl
constexpr float kZero = 128;  ///< grey level that means "no change"; the shader subtracts it

std::uint8_t Level(float value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(kZero + value), 0L, 255L));
}

void Repeat(GLint min_filter) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, min_filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
}

GlTexture TileTexture(int size, int channels, const std::vector<std::uint8_t>& pixels) {
  GlTexture texture = GlTexture::Create();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  constexpr GLint kInternal[] = {0, GL_R8, GL_RG8};
  constexpr GLenum kFormat[] = {0, GL_RED, GL_RG};
  glTexImage2D(GL_TEXTURE_2D, 0, kInternal[channels], size, size, 0, kFormat[channels],
               GL_UNSIGNED_BYTE, pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  Repeat(GL_LINEAR_MIPMAP_LINEAR);
  return texture;
}

GlTexture GrainTile(int size, const std::vector<float>& weights, RandomStream random) {
  const ImageF noise = TileableNoise(size, weights, random);
  std::vector<std::uint8_t> pixels(noise.pixels().size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = Level(kGrain * noise.pixels()[i]);
  }
  return TileTexture(size, 1, pixels);
}

GlTexture CoarseTile(std::uint64_t seed) {
  constexpr int kSize = 2048;
  RandomStream grain_random(seed, "ground grain"), marks_random(seed, "ground marks");
  const ImageF grain =
      TileableNoise(kSize, {0.45F, 0.5F, 0.6F, 0.8F, 0.95F, 1.0F, 1.25F}, grain_random);
  const ImageF marks = AsphaltMarks(kSize, 40.96 / kSize, marks_random);
  std::vector<std::uint8_t> pixels(2 * grain.pixels().size());
  for (std::size_t i = 0; i < grain.pixels().size(); ++i) {
    pixels[2 * i] = Level(kGrain * grain.pixels()[i]);
    pixels[2 * i + 1] = Level(127 * marks.pixels()[i]);
  }
  return TileTexture(kSize, 2, pixels);
}

/// In floating point: filtered in 8 bits, the bend would tear the finer tiles by a millimetre a
/// step.
GlTexture BendTile(std::uint64_t seed) {
  constexpr int kSize = 64;
  constexpr float kDeviation = 45 / 255.0F;
  std::vector<float> values(3 * kSize * kSize);
  constexpr std::array<const char*, 3> kNames = {"bend north", "bend east", "slow grey"};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    RandomStream random(seed, kNames[channel]);
    const ImageF noise = TileableNoise(kSize, {1.0F, 0.8F, 0.35F, 0.0F}, random);
    for (std::size_t i = 0; i < noise.pixels().size(); ++i) {
      values[3 * i + channel] = kDeviation * noise.pixels()[i];
    }
  }
  GlTexture texture = GlTexture::Create();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, kSize, kSize, 0, GL_RGB, GL_FLOAT, values.data());
  Repeat(GL_LINEAR);
  return texture;
}

/// Takes positions in W where `clip_from_world` takes positions relative to the camera.
Eigen::Matrix4f FromAbsolute(const Eigen::Matrix4f& clip_from_world, const Eigen::Vector3d& p_WC) {
  Eigen::Matrix4f clip_from_absolute = clip_from_world;
  clip_from_absolute.col(3) -= clip_from_world.leftCols<3>() * p_WC.cast<float>();
  return clip_from_absolute;
}

}  // namespace

struct SceneRenderer::Parts {
  World scene;
  SceneLook look;
  Eigen::Vector3d normal_W;
  Eigen::Vector3d sun_W;
  ShaderProgram ground_shader, near_ground_shader, object_shader, shadow_shader;
  GlTexture coarse, medium, fine, bend;
  MeshBuffer objects, shadows, ground;
  Framebuffer target;

  void MakeMeshes();
  void BindTiles(const ShaderProgram& shader) const;
  void DrawObjects(const Eigen::Matrix4f& clip_from_world, const Eigen::Vector3d& p_WC) const;
  void DrawGround(const PinholeCamera& camera, const RigidTransform& X_WC) const;
  void MarkShadows(const Eigen::Matrix4f& clip_from_world, const Eigen::Vector3d& p_WC) const;
  void DarkenShadows(const Eigen::Matrix4f& clip_from_world, const Eigen::Vector3d& p_WC) const;
};

void SceneRenderer::Parts::MakeMeshes() {
  const std::vector<MeshVertex> solids = SolidTriangles(scene, look.ground_grey);
  constexpr std::size_t kStride = sizeof(MeshVertex);
  objects.Start(solids.data(), solids.size() * kStride, solids.size());
  objects.Attribute(0, 3, kStride, 0);
  objects.Attribute(1, 3, kStride, 3 * sizeof(float));
  objects.Attribute(2, 2, kStride, 6 * sizeof(float));
  objects.Attribute(3, 1, kStride, 8 * sizeof(float));

  if (look.shadows) {
    const std::vector<Eigen::Vector3f> cast = ShadowTriangles(scene, solids);
    shadows.Start(cast.data(), cast.size() * sizeof(Eigen::Vector3f), cast.size());
    shadows.Attribute(0, 3, sizeof(Eigen::Vector3f), 0);
  }
  std::vector<Eigen::Vector3f> plane;
  constexpr float r = kGroundReach_m;
  for (const auto& [n, e] : std::array<std::pair<float, float>, 6>{
           {{-r, -r}, {r, -r}, {r, r}, {-r, -r}, {r, r}, {-r, r}}}) {
    plane.emplace_back(n, e, -static_cast<float>(scene.ground.Height(n, e)));
  }
  ground.Start(plane.data(), plane.size() * sizeof(Eigen::Vector3f), plane.size());
  ground.Attribute(0, 3, sizeof(Eigen::Vector3f), 0);
}

void SceneRenderer::Parts::BindTiles(const ShaderProgram& shader) const {
  const std::array<std::pair<const char*, GLuint>, 4> tiles = {{{"coarse_tile", coarse.name()},
                                                                {"medium_tile", medium.name()},
                                                                {"fine_tile", fine.name()},
                                                                {"bend_tile", bend.name()}}};
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    glBindTexture(GL_TEXTURE_2D, tiles[i].second);
    shader.Set(tiles[i].first, static_cast<int>(i));
  }
  glActiveTexture(GL_TEXTURE0);
  shader.Set("contrast", look.contrast);
}

void SceneRenderer::Parts::DrawObjects(const Eigen::Matrix4f& clip_from_world,
                                       const Eigen::Vector3d& p_WC) const {
  object_shader.Use();
  BindTiles(object_shader);
  object_shader.Set("clip_from_world", clip_from_world);
  object_shader.Set("camera_W", Eigen::Vector3f(p_WC.cast<float>()));
  object_shader.Set("sun_W", Eigen::Vector3f(sun_W.cast<float>()));
  object_shader.Set("ambient", kAmbient);
  object_shader.Set("sun", kSun);
  objects.Draw();
}

/// Before the ground is drawn only the solids have depth: what passes here is shadow on bare
/// ground.
void SceneRenderer::Parts::MarkShadows(const Eigen::Matrix4f& clip_from_world,
                                       const Eigen::Vector3d& p_WC) const {
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 0xFF);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDepthMask(GL_FALSE);
  shadow_shader.Use();
  shadow_shader.Set("clip_from_world", FromAbsolute(clip_from_world, p_WC));
  shadows.Draw();
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDisable(GL_STENCIL_TEST);
}

void SceneRenderer::Parts::DrawGround(const PinholeCamera& camera,
                                      const RigidTransform& X_WC) const {
  // Camera ray of GL's window coordinate (x, y), which is pixel (x - 0.5, y - 0.5).
  Eigen::Matrix3d ray_C_from_pixel = Eigen::Matrix3d::Identity();
  ray_C_from_pixel.row(0) << 1 / camera.fx_px, 0, -(camera.cx_px + 0.5) / camera.fx_px;
  ray_C_from_pixel.row(1) << 0, 1 / camera.fy_px, -(camera.cy_px + 0.5) / camera.fy_px;
  Eigen::Matrix4d world_from_camera = Eigen::Matrix4d::Identity();
  world_from_camera.topLeftCorner<3, 3>() = X_WC.R;
  world_from_camera.topRightCorner<3, 1>() = X_WC.p;
  const Eigen::Matrix4d clip = ClipFromCamera(camera) * world_from_camera.inverse();
  const double height_m = X_WC.p.dot(normal_W);
  const bool near = height_m < kNoFineFootprint_m * std::max(camera.fx_px, camera.fy_px);
  const ShaderProgram& shader = near ? near_ground_shader : ground_shader;
  shader.Use();
  BindTiles(shader);
  shader.Set("clip_from_world", Eigen::Matrix4f(clip.cast<float>()));
  shader.Set("ray_W_from_pixel", Eigen::Matrix3f((X_WC.R * ray_C_from_pixel).cast<float>()));
  shader.Set("camera_north_east", Eigen::Vector2f(X_WC.p.head<2>().cast<float>()));
  shader.Set("normal_W", Eigen::Vector3f(normal_W.cast<float>()));
  shader.Set("plane_distance", static_cast<float>(-normal_W.dot(X_WC.p)));
  shader.Set("ground_grey", look.ground_grey);
  shader.Set("light", static_cast<float>(kAmbient + kSun * std::max(0.0, normal_W.dot(sun_W))));
  shader.Set("markings", scene.ground.runway_markings ? 1.0F : 0.0F);
  ground.Draw();
}

void SceneRenderer::Parts::DarkenShadows(const Eigen::Matrix4f& clip_from_world,
                                         const Eigen::Vector3d& p_WC) const {
  const float lit = static_cast<float>(kAmbient + kSun * std::max(0.0, normal_W.dot(sun_W)));
  const float share = kAmbient / lit;
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, 1, 0xFF);
  glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);  // each sample once, however many triangles
  glEnable(GL_BLEND);
  glBlendColor(share, share, share, share);
  glBlendFunc(GL_ZERO, GL_CONSTANT_COLOR);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_FALSE);
  shadow_shader.Use();
  shadow_shader.Set("clip_from_world", FromAbsolute(clip_from_world, p_WC));
  shadows.Draw();
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
  glDisable(GL_STENCIL_TEST);
}

SceneRenderer::SceneRenderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SceneRenderer::~SceneRenderer() = default;

Result<std::unique_ptr<SceneRenderer>> SceneRenderer::Create(const World& scene,
                                                             const SceneLook& look) {
  auto parts = std::make_unique<Parts>();
  parts->scene = scene;
  parts->look = look;
  parts->normal_W = scene.ground.Normal();
  parts->sun_W = scene.sun.Direction();
  struct Wanted {
    const char* name;
    ShaderProgram* program;
    const char* vertex;
    std::initializer_list<std::string_view> fragment;
  };
  constexpr std::string_view kVersion = "#version 330 core\n";
  constexpr std::string_view kWithFine = "#define WITH_FINE_TILE\n";
  const std::initializer_list<std::string_view> ground = {kVersion, shader_text::surface,
                                                          shader_text::ground_fragment};
  const std::initializer_list<std::string_view> near_ground = {
      kVersion, kWithFine, shader_text::surface, shader_text::ground_fragment};
  const std::initializer_list<std::string_view> object = {kVersion, kWithFine, shader_text::surface,
                                                          shader_text::object_fragment};
  const std::initializer_list<std::string_view> shadow = {shader_text::shadow_fragment};
  for (const Wanted& wanted :
       {Wanted{"ground", &parts->ground_shader, shader_text::ground_vertex, ground},
        Wanted{"near ground", &parts->near_ground_shader, shader_text::ground_vertex, near_ground},
        Wanted{"object", &parts->object_shader, shader_text::object_vertex, object},
        Wanted{"shadow", &parts->shadow_shader, shader_text::ground_vertex, shadow}}) {
    Result<ShaderProgram> built =
        ShaderProgram::Build(wanted.name, {wanted.vertex}, wanted.fragment);
    if (!built) {
      return built.error();
    }
    *wanted.program = std::move(built).value();
  }
  const std::uint64_t seed = scene.ground.texture_seed;
  const std::vector<float> weights = {0.5F, 1.0F, 1.0F, 1.2F};
  parts->coarse = CoarseTile(seed);
  parts->medium = GrainTile(1024, weights, RandomStream(seed, "medium grain"));
  parts->fine = GrainTile(1024, weights, RandomStream(seed, "fine grain"));
  parts->bend = BendTile(seed);
  parts->MakeMeshes();
  return std::unique_ptr<SceneRenderer>(new SceneRenderer(std::move(parts)));
}

Result<ImageU8> SceneRenderer::Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                                      double /*time_s*/) {
  Parts& parts = *parts_;
  const Status sized = parts.target.Resize(camera.width, camera.height, PixelKind::kGrey, kSamples);
  if (!sized) {
    return sized.error();
  }
  DrawInto(parts.target, camera, X_WC);
  parts.target.Resolve();
  return parts.target.ReadGrey();
}

void SceneRenderer::DrawInto(const Framebuffer& target, const PinholeCamera& camera,
                             const RigidTransform& X_WC) {
  const Parts& parts = *parts_;
  const Eigen::Matrix4f clip_from_world = ClipFromRelative(camera, X_WC);

  target.Begin(kSkyGrey);
  parts.DrawObjects(clip_from_world, X_WC.p);
  const bool shaded = parts.shadows.count > 0;
  if (shaded) {
    parts.MarkShadows(clip_from_world, X_WC.p);
  }
  parts.DrawGround(camera, X_WC);
  if (shaded) {
    parts.DarkenShadows(clip_from_world, X_WC.p);
  }
}

}  // namespace palace
