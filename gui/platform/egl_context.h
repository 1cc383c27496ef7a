// EglContext: an OpenGL 3.3 core context without any window or display: on a graphics card where
// EGL lists one, else surfaceless, in software at worst.
#pragma once

#include <memory>

#include "engine/core/result.h"

namespace palace {

/// A card first; LIBGL_ALWAYS_SOFTWARE=1 draws in software where a card is there too. Not current
/// on any thread after Open.
class EglContext {
 public:
  /// kUnavailable, with the packages to install, when the machine has no EGL or no OpenGL driver.
  static Result<std::unique_ptr<EglContext>> Open();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Binds the context to the calling thread; it must not be current on another.
  Status MakeCurrent();
  /// Leaves the calling thread without a context.
  void Release();
  bool IsCurrent() const;

 private:
  EglContext(void* display, void* context) : display_(display), context_(context) {}
  void* display_ = nullptr;
  void* context_ = nullptr;
};

/// Makes a context current for one block and gives the thread back what it had before.
class EglScope {
 public:
  explicit EglScope(EglContext& context);
  ~EglScope();
  EglScope(const EglScope&) = delete;
  EglScope& operator=(const EglScope&) = delete;
  const Status& status() const { return status_; }

 private:
  void* display_ = nullptr;  ///< of the context that was current before
  void* context_ = nullptr;
  void* draw_ = nullptr;
  void* read_ = nullptr;
  EglContext& ours_;
  Status status_;
};

}  // namespace palace
