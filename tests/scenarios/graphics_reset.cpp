// Preloaded into the station: its graphics are lost while a file is there, the one that
// PALACE_TEST_GRAPHICS_LOST names. Nothing else takes a context away from a program in order.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include <GLFW/glfw3.h>

namespace {

constexpr unsigned kInnocentContextReset = 0x8254;  // GL_ARB_robustness

unsigned ResetStatus() {
  const char* file = std::getenv("PALACE_TEST_GRAPHICS_LOST");
  return file != nullptr && access(file, F_OK) == 0 ? kInnocentContextReset : 0;
}

}  // namespace

extern "C" int glfwGetWindowAttrib(GLFWwindow* window, int attribute) {
  static const auto next =
      reinterpret_cast<decltype(&glfwGetWindowAttrib)>(dlsym(RTLD_NEXT, "glfwGetWindowAttrib"));
  return attribute == GLFW_CONTEXT_ROBUSTNESS ? GLFW_LOSE_CONTEXT_ON_RESET
                                              : next(window, attribute);
}

extern "C" GLFWglproc glfwGetProcAddress(const char* name) {
  static const auto next =
      reinterpret_cast<decltype(&glfwGetProcAddress)>(dlsym(RTLD_NEXT, "glfwGetProcAddress"));
  return std::strstr(name, "GraphicsResetStatus") != nullptr
             ? reinterpret_cast<GLFWglproc>(&ResetStatus)
             : next(name);
}
