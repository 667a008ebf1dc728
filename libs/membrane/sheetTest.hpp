// Tests of a flat sheet in its plane: stretched along x, along both axes, or sheared. z is held, nothing wrinkles.
//
// protocol    | held                                                              | value of a stage
// uniaxial    | x of the two ends along x; their nodes slide along y              | stretch l of the length
// equibiaxial | x of these two ends, y of the other two; nodes slide along them   | stretch l of both lengths
// shear       | the whole border, at x + g y                                      | amount of shear g
// Read off: stretches of both lengths and the tension, the mean Cauchy tension of the sheet
//     T = 1/A sum_n r_n x_n^T       (symmetric; r_n what holds node n, A the area now)                     N/m
// of all laws together. A triangle law has W(l1, l2) per stress-free area, in pure stretch T_1 = dW/dl1/l2; uniaxial is
// T_2 = 0. Triangles of constant strain meet it on any mesh; networks of bonds have a border that they meet it but for.
// The sheet is a rectangle with sides along x and y (system/relax.yaml: sheet), or any flat border.
#pragma once
#include "core/settings.hpp"
#include "membrane/protocol.hpp"

namespace corpuscle::membrane {

class SheetTest : public Protocol {
  public:
    std::vector<double> values;  // stretches, or amounts of shear

    int stages() const override { return static_cast<int>(values.size()); }
    Loads apply(int stage, Membrane& membrane) const override;
    std::string describe(int stage) const override;
    std::vector<Column> columns() const override;
    std::vector<double> measure(int stage, const Membrane& membrane) const override;

  protected:
    double value(int stage) const { return values[static_cast<std::size_t>(stage)]; }
    // Of the stress-free places; `width` is the stretch along y at present.
    virtual Mat3 deformation(double value, double width) const = 0;
    struct Edges {
        bool alongX, alongY;  // the node lies on an end of the extent along x, along y
    };
    virtual std::array<bool, 3> held(const Edges& edges, bool onBorder) const = 0;
};

struct Uniaxial final : SheetTest {
    static const Schema<Uniaxial>& schema();

  private:
    Mat3 deformation(double value, double width) const override;
    std::array<bool, 3> held(const Edges& edges, bool onBorder) const override;
};

struct Equibiaxial final : SheetTest {
    static const Schema<Equibiaxial>& schema();

  private:
    Mat3 deformation(double value, double width) const override;
    std::array<bool, 3> held(const Edges& edges, bool onBorder) const override;
};

struct SheetShear final : SheetTest {
    static const Schema<SheetShear>& schema();

  private:
    Mat3 deformation(double value, double width) const override;
    std::array<bool, 3> held(const Edges& edges, bool onBorder) const override;
};

}  // namespace corpuscle::membrane
