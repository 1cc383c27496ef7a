// A picture of each family by OpenGL, 640x480: what the live simulator draws. Heights as flown.
#include <string>

#include <benchmark/benchmark.h>

#include "engine/core/units.h"
#include "engine/world/families/families.h"
#include "gui/platform/egl_context.h"
#include "gui/render/lit_scene_renderer.h"

namespace palace {
namespace {

constexpr PinholeCamera kCamera{640, 480, 772, 772, 319.5, 239.5};

void DrawFamily(benchmark::State& state, const std::string& family, double height_m) {
  Result<std::unique_ptr<EglContext>> context = EglContext::Open();
  if (!context || !(*context)->MakeCurrent().ok()) {
    state.SkipWithError("no OpenGL");
    return;
  }
  const Result<World> world = MakeFamily(family, 2);
  auto renderer = LitSceneRenderer::Create(*world);
  if (!renderer) {
    state.SkipWithError(renderer.error().message.c_str());
    return;
  }
  const RigidTransform X_WC{CameraRotationFromTilt(Rad(-45)), {-height_m, 0, -height_m}};
  for (auto _ : state) {
    benchmark::DoNotOptimize((*renderer)->Render(kCamera, X_WC, 0));
  }
}

const bool kRegistered = [] {
  for (const std::string_view family : FamilyNames()) {
    for (const double height_m : {4.0, 12.0}) {
      const std::string name =
          "draw " + std::string(family) + "/" + std::to_string(static_cast<int>(height_m)) + " m";
      benchmark::RegisterBenchmark(name.c_str(), [family = std::string(family), height_m](
                                                     benchmark::State& state) {
        DrawFamily(state, family, height_m);
      })->Unit(benchmark::kMillisecond)->UseRealTime();
    }
  }
  return true;
}();

}  // namespace
}  // namespace palace
