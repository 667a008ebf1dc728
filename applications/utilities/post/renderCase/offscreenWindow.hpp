// A VTK window without any display: Mesa's surfaceless EGL with an OpenGL 3.2 core context.
//
// Debian builds VTK for X only, where a picture needs an X server. Here an EGL context of our own is made current and
// VTK draws into it. Needs libegl1, libegl-mesa0 and libgl1-mesa-dri (software rendering does); no xvfb, no rights, no
// device.
#pragma once
#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>

namespace corpuscle {

class OffscreenWindow {
  public:
    // Throws Failure(ExitCode::io) naming the packages when there is no context to be had.
    OffscreenWindow(int width, int height);
    ~OffscreenWindow();
    OffscreenWindow(const OffscreenWindow&) = delete;
    OffscreenWindow& operator=(const OffscreenWindow&) = delete;

    vtkRenderWindow* window();
    vtkSmartPointer<vtkImageData> render();  // RGB, 8 bits, rows from the bottom

  private:
    struct Context;
    std::unique_ptr<Context> context_;
};

}  // namespace corpuscle
