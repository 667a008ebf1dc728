// The resting shape, without any load. The nodes are first displaced at random, once, so that a symmetric start does
// not hide a shape of lower energy.
//
// symbol | meaning                                              | unit
// shake  | largest displacement of a node along each axis       | m
// seed   | seed of the random numbers                           | -
// Measured: extents along the three axes and the reduced volume V/(4 pi/3 R^3), R^2 = A/(4 pi): 1 for a sphere, 0.64
// for a red cell.
#pragma once
#include "core/settings.hpp"
#include "membrane/protocol.hpp"

namespace corpuscle::membrane {

struct Resting : Protocol {
    double shake = 0;
    long seed = 1;

    int stages() const override { return 1; }
    Loads apply(int stage, Membrane& membrane) const override;
    std::string describe(int stage) const override;
    std::vector<Column> columns() const override;
    std::vector<double> measure(int stage, const Membrane& membrane) const override;
    static const Schema<Resting>& schema();
};

}  // namespace corpuscle::membrane
