// A VTK window without a display, through Mesa's surfaceless EGL with an OpenGL 3.2 core context.
//
// Debian builds VTK for X only, so that rendering would need an X server. Here VTK draws into an EGL context that this
// class makes current. It needs libegl1, libegl-mesa0 and libgl1-mesa-dri (software rendering is sufficient), but
// neither xvfb nor special rights nor a device.
#pragma once
#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>

namespace corpuscle {

class OffscreenWindow {
  public:
    // Throws Failure(ExitCode::io) that names the required packages if no context can be created.
    OffscreenWindow(int width, int height);
    ~OffscreenWindow();
    OffscreenWindow(const OffscreenWindow&) = delete;
    OffscreenWindow& operator=(const OffscreenWindow&) = delete;

    vtkRenderWindow* window();
    vtkSmartPointer<vtkImageData> render();  // RGB, 8 bits each, rows from bottom to top

  private:
    struct Context;
    std::unique_ptr<Context> context_;
};

}  // namespace corpuscle
