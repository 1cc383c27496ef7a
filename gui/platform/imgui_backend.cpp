#include "gui/platform/imgui_backend.h"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include "gui/platform/offscreen.h"
#include "gui/platform/window.h"
#include "gui/render/gl.h"

namespace palace {

Result<std::unique_ptr<ImGuiBackend>> ImGuiBackend::ForWindow(Window& window, double ui_scale) {
  std::unique_ptr<ImGuiBackend> backend(new ImGuiBackend(&window, nullptr));
  if (const Status started = backend->Start(ui_scale); !started) {
    return started.error();
  }
  return backend;
}

Result<std::unique_ptr<ImGuiBackend>> ImGuiBackend::ForOffscreen(Offscreen& offscreen,
                                                                 double ui_scale) {
  std::unique_ptr<ImGuiBackend> backend(new ImGuiBackend(nullptr, &offscreen));
  if (const Status started = backend->Start(ui_scale); !started) {
    return started.error();
  }
  return backend;
}

Status ImGuiBackend::Start(double ui_scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  if (window_ != nullptr) {
    platform_started_ = ImGui_ImplGlfw_InitForOpenGL(window_->handle(), true);
    if (!platform_started_) {
      return UnavailableError("ImGui cannot attach to the window");
    }
  }
  renderer_started_ = ImGui_ImplOpenGL3_Init("#version 330 core");
  if (!renderer_started_) {
    return UnavailableError("ImGui finds no OpenGL; install libgl1-mesa-dri and libegl1");
  }
  ui_scale_ = ui_scale;
  fonts_ = LoadFonts(*io.Fonts, ui_scale);
  io.FontDefault = fonts_.body;
  return Ok();
}

ImGuiBackend::~ImGuiBackend() {
  if (renderer_started_) {
    ImGui_ImplOpenGL3_Shutdown();
  }
  if (platform_started_) {
    ImGui_ImplGlfw_Shutdown();
  }
  ImGui::DestroyContext();
}

void ImGuiBackend::SetUiScale(double ui_scale) {
  if (ui_scale == ui_scale_) {
    return;
  }
  ui_scale_ = ui_scale;
  ImGuiIO& io = ImGui::GetIO();
  fonts_ = LoadFonts(*io.Fonts, ui_scale);
  io.FontDefault = fonts_.body;
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void ImGuiBackend::BeginFrame(double delta_s, const std::function<void()>& feed) {
  ImGuiIO& io = ImGui::GetIO();
  ImGui_ImplOpenGL3_NewFrame();
  if (window_ != nullptr) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    io.DisplaySize = {static_cast<float>(offscreen_->width_px()),
                      static_cast<float>(offscreen_->height_px())};
    io.DisplayFramebufferScale = {1, 1};
  }
  if (delta_s > 0) {
    io.DeltaTime = static_cast<float>(delta_s);
  }
  if (feed) {
    feed();
  }
  ImGui::NewFrame();
}

void ImGuiBackend::EndFrame(std::uint32_t background, bool draw) {
  ImGui::Render();
  if (!draw) {
    return;
  }
  if (window_ != nullptr) {
    window_->BeginFrame();
  } else {
    offscreen_->BeginFrame();
  }
  glDisable(GL_SCISSOR_TEST);
  const ImVec4 clear = ImGui::ColorConvertU32ToFloat4(background);
  glClearColor(clear.x, clear.y, clear.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace palace
