#include "gui/platform/offscreen_scene_camera.h"

#include <utility>

#include "gui/platform/egl_context.h"
#include "gui/render/lit_scene_renderer.h"
#include "gui/render/scene_renderer.h"

namespace palace {
namespace {

class OffscreenSceneCamera final : public SceneCamera {
 public:
  OffscreenSceneCamera(std::unique_ptr<EglContext> context, World scene)
      : context_(std::move(context)), scene_(std::move(scene)) {}

  ~OffscreenSceneCamera() override {
    const EglScope scope(*context_);
    renderer_.reset();
  }

  Result<ImageU8> Render(const PinholeCamera& camera, const RigidTransform& X_WC,
                         double time_s = 0) override {
    const EglScope scope(*context_);
    if (!scope.status()) {
      return scope.status().error();
    }
    if (renderer_ == nullptr) {
      const Status made = scene_.ground.material ? Make<LitSceneRenderer>() : Make<SceneRenderer>();
      if (!made) {
        return made.error();
      }
    }
    return renderer_->Render(camera, X_WC, time_s);
  }

 private:
  template <typename Renderer>
  Status Make() {
    Result<std::unique_ptr<Renderer>> created = Renderer::Create(scene_);
    if (!created) {
      return created.error();
    }
    renderer_ = std::move(created).value();
    return Ok();
  }
  std::unique_ptr<EglContext> context_;
  World scene_;
  std::unique_ptr<SceneCamera> renderer_;
};

}  // namespace

Result<std::unique_ptr<SceneCamera>> MakeOffscreenSceneCamera(const World& scene) {
  Result<std::unique_ptr<EglContext>> context = EglContext::Open();
  if (!context) {
    return context.error();
  }
  return std::unique_ptr<SceneCamera>(
      std::make_unique<OffscreenSceneCamera>(std::move(context).value(), scene));
}

}  // namespace palace
