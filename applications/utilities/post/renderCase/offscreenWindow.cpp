#include "offscreenWindow.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRendererCollection.h>
#include <vtkWindowToImageFilter.h>

#include "core/error.hpp"

// Debian's GLEW, with which VTK loads OpenGL, requires GLX. This definition in the executable (which exports its
// symbols) replaces GLEW's own function and lets it proceed without GLX; the OpenGL functions come from libglvnd as
// before.
extern "C" unsigned glxewInit(void);
extern "C" unsigned glxewInit(void) { return 0; }

namespace corpuscle {

struct OffscreenWindow::Context {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    vtkSmartPointer<vtkGenericOpenGLRenderWindow> window;

    Context() {
        display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        require(display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr), "no display");
        require(eglBindAPI(EGL_OPENGL_API), "no desktop OpenGL");
        const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        require(eglChooseConfig(display, wanted, &config, 1, &count) && count == 1, "no configuration");
        const EGLint version[] = {
            EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
        require(context != EGL_NO_CONTEXT, "no OpenGL 3.2 context");
        require(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), "the context cannot be used");
    }

    ~Context() {
        if (window) window->Finalize();
        window = nullptr;
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }

    static void require(bool done, const char* what) {
        if (done) return;
        throw Failure(ExitCode::io, fmt::format("cannot draw without a display: EGL error 0x{:x} ({}). "
                                                "Install the packages libegl1, libegl-mesa0 and libgl1-mesa-dri.",
                                                eglGetError(), what));
    }
};

OffscreenWindow::OffscreenWindow(int width, int height) : context_(std::make_unique<Context>()) {
    context_->window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
    auto& window = *context_->window;
    window.SetReadyForRendering(true);
    window.SetOwnContext(false);
    window.SetIsCurrent(true);
    window.SetFrameBlitModeToNoBlit();
    window.SetMultiSamples(0);
    window.SetSize(width, height);
    window.OpenGLInit();
}

OffscreenWindow::~OffscreenWindow() = default;

vtkRenderWindow* OffscreenWindow::window() { return context_->window; }

vtkSmartPointer<vtkImageData> OffscreenWindow::render() {
    context_->window->Render();
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(context_->window);
    grab->SetInputBufferTypeToRGB();
    grab->ReadFrontBufferOff();
    grab->ShouldRerenderOff();
    grab->Update();
    return grab->GetOutput();
}

}  // namespace corpuscle
