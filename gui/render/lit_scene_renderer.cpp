#include "gui/render/lit_scene_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/world/ray_scene.h"
#include "gui/render/camera_clip.h"
#include "gui/render/framebuffer.h"
#include "gui/render/ground_buffer.h"
#include "gui/render/lit_resolve.h"
#include "gui/render/shader.h"
#include "gui/render/solid_buffer.h"
#include "gui/render/sun_map.h"
#include "shader_text.h"

namespace palace {
namespace {

constexpr int kSamples = LitResolve::kSamples;
constexpr float kSkyGrey = 200.0F / 255;
constexpr double kTexel_m = 0.02;
constexpr double kFine_m = 0.005, kCoarse_m = 0.05;
/// The coarse ground below the fine one: what shows through gaps between blocks of two sizes.
constexpr float kUnderlay_m = 0.12F;

/// Whole levels in the red channel, with mipmaps.
GlTexture GreyTexture(int width, int height, const std::uint8_t* levels, GLint wrap) {
  GlTexture texture = GlTexture::Create();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, levels);
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  return texture;
}

Eigen::Vector3f Single(const Eigen::Vector3d& v) { return v.cast<float>(); }

/// The square itself, k = 0, or its neighbour that way: north = x * north + y.
std::pair<float, float> Mirror(int k, double low_m, double size_m) {
  if (k == 0) {
    return {1.0F, 0.0F};
  }
  return {-1.0F, static_cast<float>(2 * (k > 0 ? low_m + size_m : low_m))};
}

}  // namespace

struct LitSceneRenderer::Parts {
  struct Mover {
    SolidBuffer buffer;
    Eigen::Vector3d v_W;
  };
  World world;
  GroundSquare square;
  double texel_m = 0;  ///< of the light
  Eigen::Matrix4f sun_from_world;
  ShaderProgram ground_shader, ground_flag_shader, object_shader;
  ShaderProgram ground_depth_shader, object_depth_shader;
  LitResolve resolve;
  GlTexture lit, grain;
  GroundBuffer fine, coarse;
  SolidBuffer solids;
  std::vector<Mover> movers;
  SunMap still_map, moving_map;
  Framebuffer target;
  bool cull = true;
  double movers_mapped_s = std::numeric_limits<double>::quiet_NaN();  ///< the time of moving_map

  Status Build(const RayScene& scene);
  Status BuildShaders();
  void DrawSolidsInto(const Framebuffer& into, const Eigen::Matrix4f& clip,
                      const Eigen::Vector3d& p_W, double time_s);
  void DrawInto(const Framebuffer& into, const PinholeCamera& camera, const RigidTransform& X_WC,
                double time_s);
  void DrawUnlitInto(const Framebuffer& into, const PinholeCamera& camera,
                     const RigidTransform& X_WC, double time_s);
  void UseLight(const ShaderProgram& shader) const;
  GroundPlacing Place(const ShaderProgram& shader, int i, int j, float lower_m) const;
  void DrawGround(const ShaderProgram& shader, const Eigen::Matrix4f& clip,
                  const Eigen::Vector3d& p_W) const;
  void UseShadows(const ShaderProgram& shader) const;
  void MapMovers(double time_s);
  void View(const ShaderProgram& shader, const Eigen::Matrix4f& clip,
            const Eigen::Vector3d& p_W) const;
};

Status LitSceneRenderer::Parts::BuildShaders() {
  constexpr std::string_view kVersion = "#version 330 core\n";
  const std::string_view moves =
      movers.empty() ? "const bool has_movers = false;\n" : "const bool has_movers = true;\n";
  const std::initializer_list<std::string_view> ground = {kVersion, moves, shader_text::sun_shadow,
                                                          shader_text::ground_light,
                                                          shader_text::lit_ground_fragment};
  const std::initializer_list<std::string_view> flag = {shader_text::ground_flag_fragment};
  const std::initializer_list<std::string_view> object = {kVersion, moves, shader_text::sun_shadow,
                                                          shader_text::lit_object_fragment};
  const std::initializer_list<std::string_view> depth = {shader_text::shadow_fragment};
  struct Wanted {
    const char* name;
    ShaderProgram* program;
    const char* vertex;
    std::initializer_list<std::string_view> fragment;
  };
  for (const Wanted& wanted :
       {Wanted{"lit ground", &ground_shader, shader_text::lit_ground_vertex, ground},
        Wanted{"ground flag", &ground_flag_shader, shader_text::lit_ground_vertex, flag},
        Wanted{"lit object", &object_shader, shader_text::lit_object_vertex, object},
        Wanted{"ground depth", &ground_depth_shader, shader_text::lit_ground_vertex, depth},
        Wanted{"object depth", &object_depth_shader, shader_text::lit_object_vertex, depth}}) {
    Result<ShaderProgram> built =
        ShaderProgram::Build(wanted.name, {wanted.vertex}, wanted.fragment);
    if (!built) {
      return built.error();
    }
    *wanted.program = std::move(built).value();
  }
  const double lowest_m = world.ground.relief ? world.ground.relief->lowest_m() : 0;
  return resolve.Build({kVersion, moves, shader_text::sun_shadow, shader_text::ground_light},
                       {texel_m,
                        {0, 0, static_cast<double>(kUnderlay_m) - lowest_m},
                        {-world.ground.rise_north, -world.ground.rise_east, -1}});
}

Status LitSceneRenderer::Parts::Build(const RayScene& scene) {
  const ImageU8 light = scene.ground().Texels();
  lit = GreyTexture(light.width(), light.height(), light.pixels().data(), GL_MIRRORED_REPEAT);
  grain = GreyTexture(SurfaceGrain::kTexels, SurfaceGrain::kTexels, scene.grain().texels().data(),
                      GL_REPEAT);
  world = scene.world();
  square = SquareOf(world.ground);
  texel_m = square.size_m / light.width();
  std::vector<Solid> standing;
  for (const Solid& solid : world.solids) {
    if (solid.v_WO.isZero()) {
      standing.push_back(solid);
    } else {
      movers.emplace_back().v_W = solid.v_WO;
      movers.back().buffer.Start(world, {solid});
    }
  }
  solids.Start(world, standing);
  fine.Start(MeshGround(world.ground, kFine_m));
  coarse.Start(MeshGround(world.ground, kCoarse_m));
  if (const Status built = BuildShaders(); !built) {
    return built;
  }
  // Of what may stand within the square; things are lower than 12 m.
  const double lift_m =
      std::abs(world.ground.rise_north) * (std::abs(square.north_m) + square.size_m) +
      std::abs(world.ground.rise_east) * (std::abs(square.east_m) + square.size_m);
  const double high_m = (world.ground.relief ? world.ground.relief->highest_m() : 0) + lift_m + 12;
  const double low_m = (world.ground.relief ? world.ground.relief->lowest_m() : 0) - lift_m - 1;
  sun_from_world =
      SunFromWorld(world.sun.Direction(), {square.north_m, square.east_m, -high_m},
                   {square.north_m + square.size_m, square.east_m + square.size_m, -low_m});
  for (SunMap* map : {&still_map, &moving_map}) {
    if (const Status created = map->Create(); !created) {
      return created;
    }
  }
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  still_map.Begin();
  View(ground_depth_shader, sun_from_world, Eigen::Vector3d::Zero());
  Place(ground_depth_shader, 0, 0, 0);
  fine.Draw();
  View(object_depth_shader, sun_from_world, Eigen::Vector3d::Zero());
  object_depth_shader.Set("moved_W", Single(Eigen::Vector3d::Zero()));
  solids.Draw();
  return Ok();
}

void LitSceneRenderer::Parts::View(const ShaderProgram& shader, const Eigen::Matrix4f& clip,
                                   const Eigen::Vector3d& p_W) const {
  shader.Use();
  shader.Set("clip_from_world", clip);
  shader.Set("camera_W", Single(p_W));
}

GroundPlacing LitSceneRenderer::Parts::Place(const ShaderProgram& shader, int i, int j,
                                             float lower_m) const {
  const auto [north, north_off] = Mirror(i, square.north_m, square.size_m);
  const auto [east, east_off] = Mirror(j, square.east_m, square.size_m);
  const GroundPlacing placing{
      {north, north_off, east, east_off},
      {static_cast<float>(world.ground.rise_north), static_cast<float>(world.ground.rise_east)},
      lower_m};
  shader.Set("mirror", placing.mirror);
  shader.Set("rise", placing.rise);
  shader.Set("lower_m", placing.lower_m);
  return placing;
}

void LitSceneRenderer::Parts::DrawGround(const ShaderProgram& shader, const Eigen::Matrix4f& clip,
                                         const Eigen::Vector3d& p_W) const {
  const auto draw = [&](const GroundBuffer& mesh, const GroundPlacing& placing) {
    mesh.DrawNearFirst(placing, p_W, cull ? &clip : nullptr);
  };
  draw(fine, Place(shader, 0, 0, 0));
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const bool middle = i == 0 && j == 0;
      if (!middle || world.ground.relief) {
        draw(coarse, Place(shader, i, j, middle ? kUnderlay_m : 0.0F));
      }
    }
  }
}

void LitSceneRenderer::Parts::MapMovers(double time_s) {
  if (movers.empty() || time_s == movers_mapped_s) {  // for the other camera of the pair
    return;
  }
  movers_mapped_s = time_s;
  moving_map.Begin();
  View(object_depth_shader, sun_from_world, Eigen::Vector3d::Zero());
  for (const Mover& mover : movers) {
    object_depth_shader.Set("moved_W", Single(time_s * mover.v_W));
    mover.buffer.Draw();
  }
}

void LitSceneRenderer::Parts::UseShadows(const ShaderProgram& shader) const {
  const std::array<std::pair<const char*, GLuint>, 2> maps = {
      {{"still_map", still_map.texture()}, {"moving_map", moving_map.texture()}}};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    glActiveTexture(GL_TEXTURE1 + static_cast<GLenum>(i));
    glBindTexture(GL_TEXTURE_2D, maps[i].second);
    shader.Set(maps[i].first, static_cast<int>(i) + 1);
  }
  glActiveTexture(GL_TEXTURE0);
  shader.Set("sun_from_world", sun_from_world);
}

LitSceneRenderer::LitSceneRenderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LitSceneRenderer::~LitSceneRenderer() = default;

Result<std::unique_ptr<LitSceneRenderer>> LitSceneRenderer::Create(const World& world) {
  return Create(RayScene(world, kTexel_m));
}

Result<std::unique_ptr<LitSceneRenderer>> LitSceneRenderer::Create(const RayScene& scene) {
  auto parts = std::make_unique<Parts>();
  if (const Status built = parts->Build(scene); !built) {
    return built.error();
  }
  return std::unique_ptr<LitSceneRenderer>(new LitSceneRenderer(std::move(parts)));
}

void LitSceneRenderer::Cull(bool on) { parts_->cull = on; }

void LitSceneRenderer::DrawInto(const Framebuffer& target, const PinholeCamera& camera,
                                const RigidTransform& X_WC, double time_s) {
  parts_->DrawInto(target, camera, X_WC, time_s);
}

void LitSceneRenderer::Parts::DrawSolidsInto(const Framebuffer& into, const Eigen::Matrix4f& clip,
                                             const Eigen::Vector3d& p_W, double time_s) {
  into.Begin(kSkyGrey);
  MapMovers(time_s);
  into.Bind();
  View(object_shader, clip, p_W);
  UseShadows(object_shader);
  glBindTexture(GL_TEXTURE_2D, grain.name());
  object_shader.Set("grain", 0);
  object_shader.Set("grain_size_m",
                    static_cast<float>(SurfaceGrain::kTexels * SurfaceGrain::kTexel_m));
  object_shader.Set("grain_contrast", static_cast<float>(SurfaceGrain::kContrast));
  object_shader.Set("sun_W", Single(world.sun.Direction()));
  object_shader.Set("direct", static_cast<float>(world.sun.direct));
  object_shader.Set("diffuse", static_cast<float>(world.sun.diffuse));
  const auto draw = [&](const SolidBuffer& drawn, const Eigen::Vector3d& moved_W) {
    object_shader.Set("moved_W", Single(moved_W));
    drawn.DrawNearFirst(moved_W, p_W, cull ? &clip : nullptr);
  };
  draw(solids, Eigen::Vector3d::Zero());
  for (const Mover& mover : movers) {
    draw(mover.buffer, time_s * mover.v_W);
  }
}

void LitSceneRenderer::Parts::UseLight(const ShaderProgram& shader) const {
  UseShadows(shader);
  glBindTexture(GL_TEXTURE_2D, lit.name());
  shader.Set("lit", 0);
  shader.Set("square",
             Eigen::Vector3f(static_cast<float>(square.north_m), static_cast<float>(square.east_m),
                             static_cast<float>(square.size_m)));
  shader.Set("shade",
             static_cast<float>(world.sun.diffuse / LightOn(world.sun, world.ground.Normal(),
                                                            /*lit=*/true)));
}

void LitSceneRenderer::Parts::DrawInto(const Framebuffer& into, const PinholeCamera& camera,
                                       const RigidTransform& X_WC, double time_s) {
  const Eigen::Matrix4f clip = ClipFromRelative(camera, X_WC);
  DrawSolidsInto(into, clip, X_WC.p, time_s);
  View(ground_shader, clip, X_WC.p);
  UseLight(ground_shader);
  DrawGround(ground_shader, clip, X_WC.p);
}

void LitSceneRenderer::Parts::DrawUnlitInto(const Framebuffer& into, const PinholeCamera& camera,
                                            const RigidTransform& X_WC, double time_s) {
  const Eigen::Matrix4f clip = ClipFromRelative(camera, X_WC);
  DrawSolidsInto(into, clip, X_WC.p, time_s);
  View(ground_flag_shader, clip, X_WC.p);
  DrawGround(ground_flag_shader, clip, X_WC.p);
}

Result<ImageU8> LitSceneRenderer::Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                                         double time_s) {
  Framebuffer& target = parts_->target;
  if (const Status sized = target.Resize(camera.width, camera.height, PixelKind::kGrey, kSamples);
      !sized) {
    return sized.error();
  }
  if (target.sample_at().size() == kSamples) {
    parts_->DrawUnlitInto(target, camera, X_WC, time_s);
    for (const ShaderProgram& program : parts_->resolve.programs()) {
      program.Use();
      parts_->UseLight(program);
    }
    parts_->resolve.Draw(target, camera, X_WC);
  } else {  // a driver of fewer
    parts_->DrawInto(target, camera, X_WC, time_s);
    target.Resolve();
  }
  return target.ReadGrey();
}

Result<ImageF> LitSceneRenderer::Depth(const PinholeCamera& camera, const RigidTransform& X_WC,
                                       double time_s) {
  if (const Status sized = parts_->target.Resize(camera.width, camera.height, PixelKind::kGrey,
                                                 /*samples=*/1);
      !sized) {
    return sized.error();
  }
  parts_->DrawUnlitInto(parts_->target, camera, X_WC, time_s);
  ImageF depth = parts_->target.ReadDepth();
  for (float& d : depth.pixels()) {
    d = d < 1 ? static_cast<float>(DepthOfWindow(d)) : std::numeric_limits<float>::infinity();
  }
  return depth;
}

}  // namespace palace
