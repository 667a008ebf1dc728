// Words, lines and colour bars drawn over the panels, in pixels from the bottom left.
#pragma once
#include <vtkLookupTable.h>
#include <vtkRenderer.h>

#include <string>

#include "colourMap.hpp"

namespace corpuscle {

enum class Align { left, centre, right };

class Overlay {
  public:
    // scale: pixels of the window for each pixel of the finished picture.
    Overlay(vtkRenderer* renderer, int scale) : renderer_(renderer), scale_(scale) {}

    void text(const std::string& words, double x, double y, double height,
              Align align = Align::left);  // y: middle of the line
    void rectangle(double x, double y, double width, double height, const Colour& colour);
    // Upright, with its title above and three or five numbers beside it.
    void colourBar(double x, double y, double width, double height, vtkLookupTable* colours, double perUnit,
                   const std::string& title, double textHeight);

  private:
    vtkRenderer* renderer_;
    int scale_;
};

// 1, 2 or 5 times a power of ten, not above `limit`.
double roundBelow(double limit);

}  // namespace corpuscle
