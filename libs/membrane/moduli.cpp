#include "membrane/moduli.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <limits>
#include <numbers>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

// M_0, M_2, M_4 of the header, and the moduli that are the same in all directions.
struct Moments {
    double m0 = 0;
    std::complex<double> m2, m4;
    SurfaceModuli isotropic;

    double shear() const { return m0 / 8 + isotropic.shear; }
    double area() const { return m0 / 4 + isotropic.area; }
    double shearAnisotropy() const { return (shear() - std::abs(m4) / 8) / (shear() + std::abs(m4) / 8); }
    double axialAnisotropy() const {
        constexpr int directions = 180;
        double least = std::numeric_limits<double>::max(), greatest = 0;
        for (int k = 0; k < directions; ++k) {
            const auto turn = std::polar(1.0, -2 * std::numbers::pi * k / directions);  // e^(-2 i psi)
            const double c = shear() + area() + (m2 * turn).real() / 2 + (m4 * turn * turn).real() / 8;
            least = std::min(least, c);
            greatest = std::max(greatest, c);
        }
        return least / greatest;
    }
};

Moments momentsAround(const Network& network, const BondLaw& law, int centre, const std::vector<int>& neighbours) {
    const auto& x = network.stressFree();
    const Index3& corner = network.triangles()[centre];
    const Vec3 e1 = (x[corner[1]] - x[corner[0]]).normalized();
    const Vec3 e2 = areaVector(x, corner).normalized().cross(e1);
    Moments sum;
    double area = 0;
    for (const int t : neighbours) {
        area += network.restAreas()[t];
        for (const int number : network.triangleBonds(t)) {
            const Bond& bond = network.allBonds()[number];
            const Vec3 r = x[bond.node[1]] - x[bond.node[0]];
            const double weight =
                0.5 * law.weight(network, bond) * law.stiffness(bond.rest, bond.rest) * bond.rest * bond.rest;
            const double angle = std::atan2(r.dot(e2), r.dot(e1));
            sum.m0 += weight;
            sum.m2 += std::polar(weight, 2 * angle);
            sum.m4 += std::polar(weight, 4 * angle);
        }
    }
    sum.m0 /= area;
    sum.m2 /= area;
    sum.m4 /= area;
    return sum;
}

}  // namespace

NetworkModuli measureModuli(const Network& network, const MembraneSettings& laws) {
    NetworkModuli result;
    if (laws.bonds) {
        result.closedForm += laws.bonds->hexagonalModuli(network.meanBondLength());
    }
    const SurfaceModuli isotropic = laws.triangles ? laws.triangles->moduli() : SurfaceModuli{};
    result.closedForm += isotropic;
    if (network.wholeTriangles().empty()) {
        return result;
    }
    std::vector<std::vector<int>> trianglesOfNode(network.nodeCount());
    for (const int t : network.wholeTriangles()) {
        for (const int node : network.triangles()[t]) {
            trianglesOfNode[node].push_back(t);
        }
    }
    double area = 0, mean = 0, square = 0, dilation = 0, shear = 0, axial = 0;
    result.lowest = std::numeric_limits<double>::max();
    for (const int t : network.wholeTriangles()) {
        std::vector<int> neighbours;
        for (const int node : network.triangles()[t]) {
            neighbours.insert(neighbours.end(), trianglesOfNode[node].begin(), trianglesOfNode[node].end());
        }
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());

        Moments moments;
        if (laws.bonds) {
            moments = momentsAround(network, *laws.bonds, t, neighbours);
        }
        moments.isotropic = isotropic;
        const double a = network.restAreas()[t], local = moments.shear();
        const double shearRatio = moments.shearAnisotropy(), axialRatio = moments.axialAnisotropy();
        area += a;
        mean += a * local;
        square += a * local * local;
        dilation += a * moments.area();
        shear += a * shearRatio;
        axial += a * axialRatio;
        result.lowest = std::min(result.lowest, local);
        result.highest = std::max(result.highest, local);
        result.worstShearAnisotropy = std::min(result.worstShearAnisotropy, shearRatio);
        result.worstAxialAnisotropy = std::min(result.worstAxialAnisotropy, axialRatio);
    }
    mean /= area;
    result.shear = mean;
    result.area = dilation / area;
    result.deviation = std::sqrt(std::max(0.0, square / area - mean * mean)) / mean;
    result.shearAnisotropy = shear / area;
    result.axialAnisotropy = axial / area;
    return result;
}

std::string describe(const NetworkModuli& m) {
    return fmt::format(
        "moduli of the network (affine, an upper bound)   closed form\n"
        "  Gs {:.4g} N/m ({:.4f} of closed form)           {:.4g} N/m\n"
        "  Ks {:.4g} N/m ({:.4f} of closed form)           {:.4g} N/m\n"
        "  over the surface: Gs {:.4g} to {:.4g} N/m, standard deviation {:.2f} %\n"
        "  least/greatest over directions: shear {:.3f} (worst {:.3f}), axial {:.3f} (worst {:.3f})\n",
        m.shear, m.shear / m.closedForm.shear, m.closedForm.shear, m.area, m.area / m.closedForm.area,
        m.closedForm.area, m.lowest, m.highest, 100 * m.deviation, m.shearAnisotropy, m.worstShearAnisotropy,
        m.axialAnisotropy, m.worstAxialAnisotropy);
}

std::string describeConstants(const MembraneSettings& laws, double edge) {
    std::string text;
    if (laws.bonds) {
        text += fmt::format("bonds {}: {}{} (at rest length {:.4g} m)\n", laws.bonds.name, laws.bonds->constants(edge),
                            laws.bonds->scaled ? ", scaled by area" : "", edge);
    }
    if (laws.triangles) {
        text += fmt::format("triangles {}: {}\n", laws.triangles.name, laws.triangles->constants());
    }
    if (laws.viscosity) {
        text += fmt::format("viscosity: shear {:.4g} N s/m, dilatation {:.4g} N s/m\n", laws.viscosity->shear,
                            laws.viscosity->dilatation);
    }
    if (laws.stressFree) {
        text += fmt::format("stress-free shape: {}\n", *laws.stressFree);
    }
    const SurfaceModuli moduli = laws.moduli(edge);
    return text + fmt::format("closed form: Gs {:.4g} N/m, Ks {:.4g} N/m\n", moduli.shear, moduli.area);
}

}  // namespace corpuscle::membrane
