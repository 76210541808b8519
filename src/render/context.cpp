#include "render/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <stdexcept>
#include <variant>

#include "render/renderer.h"

namespace bookspin {
namespace {

// RTLD_NODELETE: the renderer leaves thread-exit handlers behind, so it must stay.
void* open_first(std::initializer_list<const char*> names) {
  std::string reasons;
  for (const char* name : names) {
    if (void* const library = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) return library;
    reasons = dlerror();
  }
  throw std::runtime_error(fmt::format("dlopen: {}", reasons));
}

template <typename Function>
void load_symbol(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(fmt::format("dlsym: {}", dlerror()));
}

// OSMesa's interface, as far as it is used. Its header is not: Mesa has dropped it, and its last ones need the GL/gl.h
// that glad stands in for.
namespace osmesa {
constexpr int format = 0x22, rgba = 0x1908, profile = 0x33, core_profile = 0x34, major_version = 0x36,
              minor_version = 0x37;
using Context = struct osmesa_context*;
using CreateContextAttribs = Context (*)(const int* attributes, Context shared);
using MakeCurrent = GLboolean (*)(Context context, void* buffer, GLenum type, GLsizei width, GLsizei height);
using DestroyContext = void (*)(Context context);
using GetProcAddress = GLADapiproc (*)(const char* name);
}  // namespace osmesa

// Draws into a buffer of the caller's; our frames go to frame buffer objects, so a stub serves.
class OsmesaContext {
 public:
  OsmesaContext() {
    void* const library = open_first({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
    osmesa::CreateContextAttribs create = nullptr;
    load_symbol(library, "OSMesaCreateContextAttribs", create);
    load_symbol(library, "OSMesaMakeCurrent", make_current_);
    load_symbol(library, "OSMesaDestroyContext", destroy_);
    load_symbol(library, "OSMesaGetProcAddress", load);
    constexpr std::array attributes{osmesa::format,
                                    osmesa::rgba,
                                    osmesa::profile,
                                    osmesa::core_profile,
                                    osmesa::major_version,
                                    3,
                                    osmesa::minor_version,
                                    3,
                                    0};
    context_ = create(attributes.data(), nullptr);
    if (context_ == nullptr) throw std::runtime_error("OSMesaCreateContextAttribs: no OpenGL 3.3 core context");
  }
  ~OsmesaContext() { destroy_(context_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  void make_current() {
    if (make_current_(context_, surface_.data(), GL_UNSIGNED_BYTE, GLsizei{surface_side}, GLsizei{surface_side}) ==
        GL_FALSE) {
      throw std::runtime_error("OSMesaMakeCurrent: failed");
    }
  }

  osmesa::GetProcAddress load = nullptr;
  static constexpr const char* name = "OSMesa";

 private:
  static constexpr std::size_t surface_side = 16;
  std::array<unsigned char, 4 * surface_side * surface_side> surface_{};
  osmesa::MakeCurrent make_current_ = nullptr;
  osmesa::DestroyContext destroy_ = nullptr;
  osmesa::Context context_ = nullptr;
};

class EglContext {
 public:
  EglContext() {
    void* const library = open_first({"libEGL.so.1", "libEGL.so"});
    load_symbol(library, "eglGetProcAddress", load);
    load_symbol(library, "eglGetError", get_error_);
    load_symbol(library, "eglBindAPI", bind_api_);
    load_symbol(library, "eglMakeCurrent", make_current_);
    load_symbol(library, "eglDestroyContext", destroy_);
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglChooseConfig) choose_config = nullptr;
    decltype(&eglCreateContext) create = nullptr;
    load_symbol(library, "eglInitialize", initialize);
    load_symbol(library, "eglChooseConfig", choose_config);
    load_symbol(library, "eglCreateContext", create);
    const auto get_platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(load("eglGetPlatformDisplayEXT"));
    if (get_platform_display == nullptr) throw std::runtime_error("eglGetPlatformDisplayEXT: not there");

    // All contexts of the process share the display, which is therefore never terminated.
    display_ = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    check(display_ != EGL_NO_DISPLAY, "eglGetPlatformDisplayEXT (surfaceless)");
    check(initialize(display_, nullptr, nullptr), "eglInitialize");
    check(bind_api_(EGL_OPENGL_API), "eglBindAPI");
    constexpr std::array config_attributes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                           EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    check(choose_config(display_, config_attributes.data(), &config, 1, &configs) && configs == 1, "eglChooseConfig");
    constexpr std::array context_attributes{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = create(display_, config, EGL_NO_CONTEXT, context_attributes.data());
    check(context_ != EGL_NO_CONTEXT, "eglCreateContext");
  }
  ~EglContext() {
    make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    destroy_(display_, context_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void make_current() { check(make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_), "eglMakeCurrent"); }

  decltype(&eglGetProcAddress) load = nullptr;
  static constexpr const char* name = "EGL";

 private:
  void check(bool good, const char* operation) const {
    if (!good) throw std::runtime_error(fmt::format("{}: EGL error {:#x}", operation, get_error_()));
  }

  decltype(&eglGetError) get_error_ = nullptr;
  decltype(&eglBindAPI) bind_api_ = nullptr;
  decltype(&eglMakeCurrent) make_current_ = nullptr;
  decltype(&eglDestroyContext) destroy_ = nullptr;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

// Mesa reads these once, and setenv must not run beside another thread's getenv: once a process, before any context.
void set_up_mesa() {
  static std::once_flag once;
  std::call_once(once, [] {
    setenv("LP_NUM_THREADS", "0", 0);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
    // What another program, or another setting, has left in that cache was seen to be drawn with: wrong pictures.
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    setenv("EGL_LOG_LEVEL", "fatal", 0);  // what fails is said by whoever asked
  });
}

// Mesa's own start-up is guarded only in part, so contexts come and go one at a time.
std::mutex& creation_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

struct Context::Library {
  std::variant<std::monostate, OsmesaContext, EglContext> context;
};

Context::Context(ContextKind kind) : library_(std::make_unique<Library>()) {
  set_up_mesa();
  const std::scoped_lock lock(creation_mutex());
  std::string reasons;
  const auto create = [&]<typename Kind>(std::in_place_type_t<Kind>) {
    try {
      auto& context = library_->context.emplace<Kind>();
      context.make_current();
      if (gladLoadGLContext(&gl_, context.load) == 0) throw std::runtime_error("OpenGL 3.3 entry points missing");
      const auto* const renderer = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
      const auto* const version = reinterpret_cast<const char*>(gl_.GetString(GL_VERSION));
      description_ = fmt::format("{}, {}, OpenGL {}", Kind::name, renderer, version);
      return true;
    } catch (const std::runtime_error& error) {
      library_->context.emplace<std::monostate>();
      reasons += fmt::format("\n  {}: {}", Kind::name, error.what());
      return false;
    }
  };
  if (kind != ContextKind::egl && create(std::in_place_type<OsmesaContext>)) return;
  if (kind != ContextKind::osmesa && create(std::in_place_type<EglContext>)) return;
  throw std::runtime_error(
      "no off-screen OpenGL context (packages of Debian: libosmesa6, or libegl1 with libgl1-mesa-dri):" + reasons);
}

Context::~Context() {
  const std::scoped_lock lock(creation_mutex());
  library_.reset();
}

std::string describe_opengl(ContextKind kind) {
  return Context(kind).description();
}

void Context::make_current() {
  if (auto* const osmesa = std::get_if<OsmesaContext>(&library_->context)) osmesa->make_current();
  if (auto* const egl = std::get_if<EglContext>(&library_->context)) egl->make_current();
}

}  // namespace bookspin
