// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/gl/egl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <utility>

namespace hooke::render {

struct EglContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string device;

  ~Impl() {
    if (display == EGL_NO_DISPLAY) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    // The display stays open: EGL has one display a platform, and another context of this process may use it.
  }
};

namespace {

Unexpected no_gl(const std::string& why) {
  return fail(Error::Kind::bad_input, "OpenGL",
              why +
                  "; pictures need EGL and OpenGL 3.3 (Debian: libegl1, libgl1, and libgl1-mesa-dri where there is no "
                  "graphics card)");
}

// libepoxy ends the program where a library is missing, so check first.
const char* missing_library() {
  for (const char* name : {"libEGL.so.1", "libGL.so.1"}) {
    void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) return name;
    // Left open, because it is used next.
  }
  return nullptr;
}

EGLDisplay initialized(EGLDisplay display) {
  return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) ? display : EGL_NO_DISPLAY;
}

EGLDisplay open_display() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
      EGLDeviceEXT devices[8];
      EGLint count = 0;
      eglQueryDevicesEXT(8, devices, &count);
      for (EGLint i = 0; i < count; ++i) {
        const EGLDisplay display = initialized(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
        if (display != EGL_NO_DISPLAY) return display;
      }
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
      const EGLDisplay display = initialized(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
      if (display != EGL_NO_DISPLAY) return display;
    }
  }
  return initialized(eglGetDisplay(EGL_DEFAULT_DISPLAY));
}

}  // namespace

Expected<EglContext> EglContext::create() {
  if (const char* missing = missing_library()) return no_gl(std::string(missing) + " can't be loaded");
  auto impl = std::make_unique<Impl>();
  impl->display = open_display();
  if (impl->display == EGL_NO_DISPLAY) return no_gl("EGL has no display that works");
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(impl->display, wanted, &config, 1, &count);
  const EGLint version[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  impl->context = eglCreateContext(impl->display, count > 0 ? config : nullptr, EGL_NO_CONTEXT, version);
  if (impl->context == EGL_NO_CONTEXT) return no_gl("the driver has no OpenGL 3.3");
  if (!eglMakeCurrent(impl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl->context)) {
    return no_gl("the driver can't draw without a window");
  }
  impl->device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return EglContext(std::move(impl));
}

EglContext::EglContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EglContext::~EglContext() = default;
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;

void EglContext::make_current() const {
  eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context);
}
const std::string& EglContext::device() const { return impl_->device; }

}  // namespace hooke::render
