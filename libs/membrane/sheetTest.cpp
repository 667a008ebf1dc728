#include "membrane/sheetTest.hpp"

#include <Eigen/Geometry>

#include "core/registry.hpp"
#include "core/units.hpp"

namespace corpuscle::membrane {

namespace {

Eigen::AlignedBox3d boxOf(const std::vector<Vec3>& x) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : x) {
        box.extend(p);
    }
    return box;
}

// Mean Cauchy tension. In equilibrium, the force that holds a node is minus its membrane force.
Mat3 meanTension(const Membrane& membrane) {
    Mat3 sum = Mat3::Zero();
    for (std::size_t n = 0; n < membrane.position.size(); ++n) {
        sum -= membrane.force[n] * membrane.position[n].transpose();
    }
    return (sum + sum.transpose()) / (2 * membrane.area());
}

template <class Test>
Schema<Test> stretching(const char* name, const char* text) {
    return Schema<Test>(name, text)
        .quantities("stretches", &Test::values, unit::none, "length over stress-free length, one stage each",
                    {.range = positive})
        .check([](const Test& p, const Node& node, Problems& problems) {
            if (p.values.empty()) {
                problems.add(node.mark, node.path, "found no stage; 'stretches' needs at least one value");
            }
        });
}

}  // namespace

Loads SheetTest::apply(int stage, Membrane& membrane) const {
    const std::vector<Vec3>& rest = membrane.network().stressFree();
    const Eigen::AlignedBox3d box = boxOf(rest), now = boxOf(membrane.position);
    const double near = 1e-6 * box.sizes().maxCoeff();
    if (!membrane.network().isOpen() || box.sizes()[2] > near) {
        throw Failure(ExitCode::invalidCase,
                      "this protocol is for a flat sheet, and '" + membrane.name +
                          "' is none; give 'sheet' in place of 'cell' in system/relax.yaml, or another protocol");
    }
    const Mat3 map = deformation(value(stage), now.sizes()[1] / box.sizes()[1]);
    const std::vector<char> border = borderNodes(membrane.network());
    Loads loads;
    for (std::size_t n = 0; n < rest.size(); ++n) {
        const auto atEnd = [&](int axis) {
            return rest[n][axis] < box.min()[axis] + near || rest[n][axis] > box.max()[axis] - near;
        };
        loads.held.push_back(held({atEnd(0), atEnd(1)}, border[n] != 0));
        membrane.position[n] = map * rest[n];
    }
    return loads;
}

std::string SheetTest::describe(int stage) const { return formatQuantity(value(stage), unit::none); }

std::vector<Protocol::Column> SheetTest::columns() const {
    return {{"applied", "", "value of the stage: stretch, or amount of shear"},
            {"stretchX", "", "length along x over that of the stress-free sheet"},
            {"stretchY", "", "length along y over that of the stress-free sheet"},
            {"tensionXX", "N_m", "mean Cauchy tension of the sheet, component xx"},
            {"tensionYY", "N_m", "mean Cauchy tension of the sheet, component yy"},
            {"tensionXY", "N_m", "mean Cauchy tension of the sheet, component xy"}};
}

std::vector<double> SheetTest::measure(int stage, const Membrane& membrane) const {
    const Vec3 rest = boxOf(membrane.network().stressFree()).sizes(), now = boxOf(membrane.position).sizes();
    const Mat3 tension = meanTension(membrane);
    return {value(stage), now[0] / rest[0], now[1] / rest[1], tension(0, 0), tension(1, 1), tension(0, 1)};
}

const Schema<Uniaxial>& Uniaxial::schema() {
    static const Schema<Uniaxial> s = stretching<Uniaxial>("uniaxial", "a flat sheet stretched along x, free along y");
    return s;
}
Mat3 Uniaxial::deformation(double value, double width) const { return Vec3(value, width, 0).asDiagonal(); }
std::array<bool, 3> Uniaxial::held(const Edges& edges, bool) const { return {edges.alongX, false, true}; }

const Schema<Equibiaxial>& Equibiaxial::schema() {
    static const Schema<Equibiaxial> s =
        stretching<Equibiaxial>("equibiaxial", "a flat sheet stretched alike along x and y");
    return s;
}
Mat3 Equibiaxial::deformation(double value, double) const { return Vec3(value, value, 0).asDiagonal(); }
std::array<bool, 3> Equibiaxial::held(const Edges& edges, bool) const { return {edges.alongX, edges.alongY, true}; }

const Schema<SheetShear>& SheetShear::schema() {
    static const Schema<SheetShear> s =
        Schema<SheetShear>("shear", "a flat sheet in simple shear, its border held")
            .quantities("amounts", &SheetShear::values, unit::none,
                        "displacement along x over distance along y, one stage each")
            .check([](const SheetShear& p, const Node& node, Problems& problems) {
                if (p.values.empty()) {
                    problems.add(node.mark, node.path, "found no stage; 'amounts' needs at least one value");
                }
            });
    return s;
}
Mat3 SheetShear::deformation(double value, double) const {
    Mat3 map = Vec3(1, 1, 0).asDiagonal();
    map(0, 1) = value;
    return map;
}
std::array<bool, 3> SheetShear::held(const Edges&, bool onBorder) const { return {onBorder, onBorder, true}; }

CORPUSCLE_REGISTER(Protocol, Uniaxial, "uniaxial", "a flat sheet stretched along x, free along y");
CORPUSCLE_REGISTER(Protocol, Equibiaxial, "equibiaxial", "a flat sheet stretched alike along x and y");
CORPUSCLE_REGISTER(Protocol, SheetShear, "shear", "a flat sheet in simple shear");

}  // namespace corpuscle::membrane
