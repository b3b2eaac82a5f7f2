#pragma once
// Off-screen graphics on a machine that may have no display.
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>

namespace softgrain {

/// A source of windows that nobody sees. It must outlive its windows.
class Graphics {
  public:
    virtual ~Graphics() = default;
    /// An off-screen window of this size [pixels].
    virtual vtkSmartPointer<vtkRenderWindow> make_window(int width, int height) = 0;
};

/// EGL without a surface: needs libEGL and a Mesa driver, no server. Throws OutputError.
std::unique_ptr<Graphics> open_egl_graphics();

/// An Xvfb server of our own, ended with the object. Throws OutputError.
std::unique_ptr<Graphics> open_xvfb_graphics();

/// EGL, else Xvfb; SOFTGRAIN_RENDER=egl or xvfb asks for one of them. Throws OutputError if none works.
std::unique_ptr<Graphics> open_graphics();

}  // namespace softgrain
