// WorldViews: the pictures of the Simulate workspace: two cameras as the simulator drew them, and
// the true world from outside.
//
// They must not take the flight's time where a processor draws: a picture is drawn anew only when
// something moved; the small ones, at the size of their panels and without smooth edges, take
// turns, one a frame; where a drawing takes longer than 60 ms the main one loses its smooth edges,
// then half its width and height; and after each the window rests from them four times as long.
#pragma once

#include <array>
#include <future>
#include <memory>
#include <string>

#include "engine/model/snapshot.h"
#include "engine/world/ray_scene.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/render/framebuffer.h"
#include "gui/render/orbit_camera.h"
#include "gui/render/texture.h"
#include "gui/render/world_view_renderer.h"

namespace palace {

/// Where the eye of an outside view is; exactly the rig's cameras are no outside views.
struct WorldEyePose {
  PinholeCamera eye;
  RigidTransform X_WE;
};
/// Chase: behind and above; bird's eye and above: so far that vehicle and seen ground are inside.
/// `free` is turned by hand.
WorldEyePose EyePoseOf(WorldEye eye, const World& world, const RigidTransform& X_WB,
                       const ViewFrustum& frustum, double rotor_diameter_m, OrbitCamera& free,
                       int width_px, int height_px);

/// Needs one GL context current for every call and for the destructor.
class WorldViews {
 public:
  WorldViews(World world, VehicleBody body) : world_(std::move(world)), body_(body) {}
  /// Brings the views of the layout up to date. `all`: every one of them, however long it takes,
  /// for a picture of the window.
  void Update(const EngineSnapshot& snapshot, const SimulateLayout& layout, const Style& style,
              const SimulateState& state, OrbitCamera& free, std::uint64_t moves, bool all);
  /// GL name of the texture; 0 before it is drawn.
  GLuint texture(WorldEye eye) const;
  /// Why the outside views are not there yet; empty: they are, or were never asked for.
  const std::string& waits_for() const { return waits_for_; }

 private:
  /// What a view was drawn for.
  struct Key {
    std::uint64_t sequence = 0, moves = 0;
    int width = 0, height = 0;
    int samples = 0;
    friend bool operator==(const Key&, const Key&) = default;
  };
  bool Prepare(bool wait);
  bool Draw(const EngineSnapshot& snapshot, WorldEye eye, const Rect& rect, const Key& key,
            double ui_scale, OrbitCamera& free);

  World world_;
  VehicleBody body_;
  std::future<std::unique_ptr<RayScene>> light_;  ///< worked out beside, seconds for large grounds
  std::unique_ptr<WorldViewRenderer> renderer_;
  std::string waits_for_;
  std::array<Framebuffer, kWorldEyes> targets_;
  std::array<Key, kWorldEyes> drawn_{};
  std::array<Texture, 2> cameras_;
  std::shared_ptr<const StereoFrame> frame_;
  ViewFrustum frustum_;
  std::uint64_t frustum_of_ = 0;  ///< snapshot
  std::size_t turn_ = 1;          ///< of the small views
  int plainness_ = 0;             ///< of the main view: 0 smooth, 1 plain, 2 at half size too
  double rested_at_s_ = 0;        ///< monotonic; before it nothing more is drawn
};

}  // namespace palace
