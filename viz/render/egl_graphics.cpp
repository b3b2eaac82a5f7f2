#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

#include <string>

#include "common/errors.hpp"
#include "viz/render/graphics.hpp"

namespace softgrain {
namespace {

/// A window that draws into its own framebuffer in the context that is current.
class EglWindow : public vtkGenericOpenGLRenderWindow {
  public:
    static EglWindow* New();
    vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow);

    /// VTK 9.1 loads OpenGL through a GLEW that then asks for an X display, and gives up without one although
    /// every OpenGL function has been loaded by then. The context itself was checked when it was made.
    void OpenGLInitContext() override {
        const bool first = !this->Initialized;
        const int display = vtkObject::GetGlobalWarningDisplay();
        if (first) vtkObject::GlobalWarningDisplayOff();
        this->Superclass::OpenGLInitContext();
        vtkObject::SetGlobalWarningDisplay(display);
        this->Initialized = true;
        this->GlewInitValid = true;
    }

    /// Of shapes at the same depth the last one drawn is seen, as in VTK's own windows.
    void Start() override {
        this->Superclass::Start();
        this->GetState()->vtkglDepthFunc(GL_LEQUAL);
    }

  protected:
    EglWindow() = default;
};
vtkStandardNewMacro(EglWindow);

/// libEGL, loaded only when it is needed, so that a machine without it can still use Xvfb.
class EglLibrary {
  public:
    EglLibrary() : handle_(::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL)) {
        if (handle_ == nullptr) throw OutputError("EGL: libEGL.so.1 was not found");
    }
    /// The library stays loaded: drivers it has loaded do not survive its removal.
    template <typename Function>
    Function* function(const char* name) const {
        void* symbol = ::dlsym(handle_, name);
        if (symbol == nullptr) throw OutputError(fmt::format("EGL: libEGL has no {}", name));
        return reinterpret_cast<Function*>(symbol);
    }

  private:
    void* handle_;
};

class EglGraphics final : public Graphics {
  public:
    EglGraphics() {
        const auto proc_address = library_.function<decltype(eglGetProcAddress)>("eglGetProcAddress");
        const auto platform_display =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(proc_address("eglGetPlatformDisplayEXT"));
        if (platform_display == nullptr) throw OutputError("EGL: no platform displays");
        display_ = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || !initialize_(display_, nullptr, nullptr))
            throw OutputError("EGL: no display without a surface (libgl1-mesa-dri, libegl-mesa0)");
        make_context();
    }
    EglGraphics(const EglGraphics&) = delete;
    EglGraphics& operator=(const EglGraphics&) = delete;
    ~EglGraphics() override {
        make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        destroy_context_(display_, context_);
        terminate_(display_);
    }

    vtkSmartPointer<vtkRenderWindow> make_window(int width, int height) override {
        auto window = vtkSmartPointer<EglWindow>::New();
        window->SetOffScreenRendering(1);
        window->SetSize(width, height);
        window->SetReadyForRendering(true);
        window->SetIsCurrent(true);
        return window;
    }

  private:
    void make_context() {
        constexpr EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         2,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
        bind_api_(EGL_OPENGL_API);
        context_ = create_context_(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        const bool current =
            context_ != EGL_NO_CONTEXT && make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
        if (current) return;
        if (context_ != EGL_NO_CONTEXT) destroy_context_(display_, context_);
        terminate_(display_);
        throw OutputError("EGL: no OpenGL 3.2 context (libgl1-mesa-dri)");
    }

    EglLibrary library_;
    decltype(eglInitialize)* initialize_ = library_.function<decltype(eglInitialize)>("eglInitialize");
    decltype(eglTerminate)* terminate_ = library_.function<decltype(eglTerminate)>("eglTerminate");
    decltype(eglBindAPI)* bind_api_ = library_.function<decltype(eglBindAPI)>("eglBindAPI");
    decltype(eglCreateContext)* create_context_ =
        library_.function<decltype(eglCreateContext)>("eglCreateContext");
    decltype(eglDestroyContext)* destroy_context_ =
        library_.function<decltype(eglDestroyContext)>("eglDestroyContext");
    decltype(eglMakeCurrent)* make_current_ = library_.function<decltype(eglMakeCurrent)>("eglMakeCurrent");
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Graphics> open_egl_graphics() {
    return std::make_unique<EglGraphics>();
}

}  // namespace softgrain
