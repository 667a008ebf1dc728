// Text, lines and colour bars drawn over the panels, in pixels from the bottom left.
#pragma once
#include <vtkRenderer.h>

#include <array>
#include <string>
#include <vector>

#include "field.hpp"

namespace corpuscle {

enum class Align { left, centre, right };

// A rectangle of the picture that holds a text, a bar or a panel; these must not overlap.
struct Place {
    std::string what;
    double x, y, width, height;  // pixels, from the bottom left
};

class Overlay {
  public:
    // scale: window pixels per pixel of the finished picture.
    Overlay(vtkRenderer* renderer, int scale) : renderer_(renderer), scale_(scale) {}

    static double widthOf(const std::string& words, double height);

    void text(const std::string& words, double x, double y, double height,
              Align align = Align::left);  // y: middle of the line
    void rectangle(double x, double y, double width, double height, const Colour& colour);
    void line(double x0, double y0, double x1, double y1, double width, const Colour& colour);
    void arrow(double x, double y, double length, double headLength, const Colour& colour);  // to the right
    // A vertical bar with its title above, and numbers or names of kinds beside it. The whole occupies `height` upwards
    // from y.
    void colourBar(double x, double y, double height, const Scale& scale, const std::vector<std::string>& title,
                   double textHeight);
    static double barWidthOf(const Scale& scale, const std::vector<std::string>& title, double textHeight);

    const std::vector<Place>& places() const { return places_; }

  private:
    void polygon(const std::vector<std::array<double, 2>>& corners, const Colour& colour);

    vtkRenderer* renderer_;
    int scale_;
    std::vector<Place> places_;
};

// 1, 2 or 5 times a power of ten, not above `limit`.
double roundBelow(double limit);

}  // namespace corpuscle
