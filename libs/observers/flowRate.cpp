// Observer `flowRate`: the flow along x between walls at rest, its drive and its resistance; one file, flowRate.csv.
//
//     Q = 1/L sum_i V_i u_i      over all particles but those of walls, L the length of the box: the mean over all
//                                cross-sections. The sum is accurate although particles fill the cross-section only
//                                to a part of a spacing, since u vanishes at the wall.
//     pressure drop = rho F L    F the body force per mass
//     apparent viscosity = k rho F/Q    k the conductance of the walls (boundary/wallShape), where it is known
//     tube haematocrit = volume of the cells/volume of the fluid and the cells
//     discharge haematocrit = flow rate of the cells/Q,   of one cell 1/L oint x (u.n) dA
// The forces that drive the fluid and those on the walls balance once the flow is steady: `imbalance` is their
// difference over the drive. Bodies that are held take a part of the drive.
//
// Numbers to compare with: a Newtonian fluid has the apparent viscosity of the fluid (Poiseuille). In a round tube of
// diameter D in um blood of discharge haematocrit 0.45 has, in vitro, the apparent viscosity
// 220 exp(-1.3 D) + 3.2 - 2.44 exp(-0.06 D^0.645) of that of plasma (Pries, Neuhaus, Gaehtgens, Am. J. Physiol.
// 263:H1770, 1992).
#include <limits>

#include "core/communicator.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

using coupling::Scene;

double ratio(double a, double b) { return b == 0 ? std::numeric_limits<double>::quiet_NaN() : a / b; }

// Volume of a cell, and the integral of the velocity along x over it.
void findTransport(const coupling::Cell& cell, double* out) {
    const geometry::TriangleMesh surface = closedSurface(cell);
    out[0] = surface.volume();
    if (cell.membrane.network().brokenTriangles() > 0) {  // what flows through its holes is not known
        out[1] = std::numeric_limits<double>::quiet_NaN();
        return;
    }
    const Vec3 origin = cell.membrane.position.front();
    double flux = 0, transport = 0;  // of u.n and of x (u.n), by the three nodes of each triangle
    for (const Index3& t : surface.triangles) {
        Vec3 x[3], u[3];
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = cell.membrane.position[static_cast<std::size_t>(t[k])] - origin;
            u[k] = cell.membrane.velocity[static_cast<std::size_t>(t[k])];
        }
        const Vec3 normal = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
        const Vec3 sum = u[0] + u[1] + u[2];
        flux += sum.dot(normal) / 3;
        // Of two linear functions, exactly: (sum x sum u + sum x u)/12.
        double products = (x[0][0] + x[1][0] + x[2][0]) * sum.dot(normal);
        for (std::size_t k = 0; k < 3; ++k) products += x[k][0] * u[k].dot(normal);
        transport += products / 12;
    }
    // The surface keeps its volume, so that the flux is an error, of a field that is the same everywhere.
    const double middle = surface.centroid()[0] - origin[0];
    out[1] = transport - middle * flux;
}

class FlowRateObservation : public Observation {
  public:
    using Observation::Observation;

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const particles::ParticleStore& s = scene.store();
        std::vector<double> sums{0, 0};  // drive, force on walls
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.kindOf(i) == particles::Kind::wall) continue;
            sums[0] += scene.mass(i) * scene.model().bodyForce[0];
        }
        for (const Vec3& force : scene.forces->wallForces()) sums[1] += force[0];
        sums = Communicator(scene.system->comm()).sum(std::move(sums));
        double area = 0;
        for (const boundary::Wall& wall : scene.flow.walls) area += wall.surface->area();
        const double length = scene.fluidBox.size()[0], section = scene.flow.section;
        const double rate = coupling::flowRate(scene), drive = scene.model().density * scene.model().bodyForce[0];
        std::vector<double> row{rate, rate / section, drive * length, sums[1] / area, 1 - ratio(sums[1], sums[0])};
        if (scene.flow.conductance) {
            const double viscosity = ratio(*scene.flow.conductance * drive, rate);
            row.insert(row.end(), {viscosity, viscosity / scene.model().viscosity});
        }
        if (scene.cells.count() > 0) {
            double volume = 0, transport = 0;
            for (const std::vector<double>& cell : ofEachCell(scene, 2, findTransport))
                volume += cell[0], transport += cell[1];
            row.insert(row.end(), {volume / (section * length), ratio(transport, rate * length)});
        }
        return {{0, std::move(row)}};
    }
    bool leavesGaps() const override { return true; }  // nothing flows yet
};

struct FlowRateObserver : Observer {
    static const Schema<FlowRateObserver>& schema() {
        static const Schema<FlowRateObserver> s =
            Schema<FlowRateObserver>("flowRate", "flow rate along x, pressure drop, apparent viscosity, haematocrit")
                .include<ObserverSettings>();
        return s;
    }
    std::string whyNot(const Subject& subject) const override {
        if (subject.channel) return {};
        return "this observer needs a flow along x between walls at rest; remove it, or choose 'type: poiseuille' in "
               "constant/flow.yaml";
    }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> columns{
            {"flowRate", "m3_s", "flow rate along x, mean over all cross-sections"},
            {"meanVelocity", "m_s", "flow rate over the mean cross-section"},
            {"pressureDrop", "Pa", "density times body force times the length of the box"},
            {"wallStress", "Pa", "force on the walls along x over their area"},
            {"imbalance", "",
             "1 - force on the walls/force that drives the fluid; 0 in a steady flow without bodies that are held"}};
        if (parts.conductance) {
            columns.push_back({"apparentViscosity", "Pas", "that of a Newtonian fluid of this flow rate"});
            columns.push_back({"relativeViscosity", "", "apparent viscosity over that of the fluid outside the cells"});
        }
        if (!parts.cells.empty()) {
            columns.push_back({"haematocrit_tube", "", "volume of the cells over that between the walls"});
            columns.push_back({"haematocrit_discharge", "", "flow rate of the cells over that of the whole"});
        }
        return {{"flowRate", columns}};
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<FlowRateObservation>(tables(SceneParts::of(scene)));
    }
};

CORPUSCLE_REGISTER(Observer, FlowRateObserver, "flowRate",
                   "flow rate along x, pressure drop, apparent viscosity, haematocrit");

}  // namespace
}  // namespace corpuscle::observers
