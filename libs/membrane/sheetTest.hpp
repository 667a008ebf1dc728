// Tests of a flat sheet in its plane: stretched along x, along both axes, or sheared. z is held, so that the sheet
// cannot wrinkle.
//
// protocol    | held                                                              | value of a stage
// uniaxial    | x of the two ends along x; their nodes slide along y              | stretch l of the length
// equibiaxial | x of these two ends, y of the other two; nodes slide along them   | stretch l of both lengths
// shear       | the whole border, at x + g y                                      | amount of shear g
// Measured: stretches of both lengths and the tension, that is, the mean Cauchy tension of the sheet
//     T = 1/A sum_n r_n x_n^T       (symmetric part; r_n: force that holds node n, A: present area)        N/m
// of all laws together. A triangle law with the energy W(l1, l2) per stress-free area has T_1 = dW/dl1/l2 in pure
// stretch; the uniaxial test has T_2 = 0. Triangles of constant strain satisfy this on any mesh, networks of bonds
// except near their border.
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
    // Deformation of the stress-free positions; `width` is the present stretch along y.
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
