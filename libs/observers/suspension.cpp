// Observer `suspension`: the stress that cells add to the fluid, as a whole and cell by cell, and orientation and
// stretch of each cell. Files: suspension.csv, and <cell>.csv for each type of cell with a row for each of its cells.
//
// The mean stress of a volume V of fluid and cells, less that of the fluid of viscosity mu (Batchelor, J. Fluid Mech.
// 41:545, 1970; Pozrikidis, J. Fluid Mech. 297:123, 1995), with e the mean rate of strain:
//
//     sigma + p 1 - 2 mu e = 1/V [ sum over cells S + sum over contacts -x f^T ]
//     S = -sum_m x_m f_m^T + mu (lambda - 1) oint (u n^T + n u^T) dA
// symbol | meaning                                                                          | unit
// S      | stresslet of a cell                                                              | N m
// f_m    | force of the membrane, elastic and viscous, on the fluid at its node m           | N
// u, n   | velocity of the membrane, its normal outwards                                    | m/s
// x f^T  | of a contact of two membranes, or of a membrane and a wall: position, force      | N m
// V      | volume of fluid and cells: of the box, between its walls where it has some       | m^3
// Pressure is not included. With x along the flow, g along its gradient and v along the vorticity, the shear stress is
// sigma_xg, N1 = sigma_xx - sigma_gg and N2 = sigma_gg - sigma_vv. Between moving walls the shear stress is the same on
// every plane once the fluid's inertia has decayed, so that 1 + sigma_xg/(mu gammadot) is then the effective viscosity
// of `wallStress`, obtained in another way. Forces are those at the present positions; velocities of the implicit step
// are those at its midpoint.
//
// Where images slide, their work is a second route to the viscosity (docs/theory/conservation.md):
// relativeViscosity_images, a mean since the previous row.
//
// The axis of a cell is that of its largest moment of inertia, along which it is thinnest: for a red cell at rest, its
// axis of symmetry. Semi-axes are those of the ellipsoid with the moments of inertia of the enclosed volume. For an
// open cell, volume and moments are those with each hole closed by a fan over its rim.
//
// Numbers to compare with: a dilute suspension of nearly spherical drops or capsules of viscosity ratio lambda that
// hardly deform has the stresslet of rigid spheres, sigma_xg = 5/2 phi mu gammadot, if their membrane does not stretch.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/communicator.hpp"
#include "observers/cells.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

enum Number : std::size_t { place, velocity = 3, axis = 6, semiaxes = 9, elastic = 12, inside = 21, count = 30 };

Mat3 matrixAt(const std::vector<double>& numbers, std::size_t first) { return Mat3::Map(numbers.data() + first); }

Mat3 ofForces(const coupling::Cell& cell) {
    const std::vector<Vec3>& x = cell.membrane.position;
    std::vector<Vec3> force(x.size(), Vec3::Zero());
    cell.membrane.addElasticForces(x, force);
    if (cell.membrane.isViscous()) cell.membrane.addViscousForces(cell.membrane.velocity, force);
    Mat3 sum = Mat3::Zero();
    for (std::size_t m = 0; m < x.size(); ++m) sum -= (x[m] - x[0]) * force[m].transpose();
    return sum;
}

// oint (u n^T + n u^T) dA
Mat3 ofVelocities(const coupling::Cell& cell) {
    const membrane::Membrane& m = cell.membrane;
    Mat3 sum = Mat3::Zero();
    for (const int number : m.network().wholeTriangles()) {
        const Index3& t = m.network().triangles()[static_cast<std::size_t>(number)];
        const auto at = [&](const std::vector<Vec3>& all, int k) { return all[static_cast<std::size_t>(t[k])]; };
        const Vec3 area = 0.5 * (at(m.position, 1) - at(m.position, 0)).cross(at(m.position, 2) - at(m.position, 0));
        const Vec3 u = (at(m.velocity, 0) + at(m.velocity, 1) + at(m.velocity, 2)) / 3;
        sum += u * area.transpose() + area * u.transpose();
    }
    return sum;
}

// Mean power of sliding images since the last output.
class ImagePower {
  public:
    explicit ImagePower(const Scene& scene) : work_(workOf(scene)) {}
    double since(const Scene& scene, double time) {  // [W]; nan if no time has passed. Collective
        const double work = workOf(scene),
                     power = time > time_ ? (work - work_) / (time - time_) : std::numeric_limits<double>::quiet_NaN();
        work_ = work, time_ = time;
        return power;
    }
    std::vector<double> state() const { return {work_, time_}; }
    void setState(std::span<const double> saved) { work_ = saved[0], time_ = saved[1]; }

  private:
    static double workOf(const Scene& scene) {
        return Communicator(scene.system->comm()).sum(scene.budget.total[sph::Budget::ofImages]);
    }
    double work_ = 0, time_ = std::numeric_limits<double>::quiet_NaN();  // before the first output
};

class SuspensionObservation : public Observation {
  public:
    SuspensionObservation(std::vector<Table> tables, const Scene& scene) : Observation(std::move(tables)) {
        if (SceneParts::of(scene).slidingImages) images_.emplace(scene);
    }

    bool leavesGaps() const override { return true; }  // rows of a cell without whole triangles
    std::vector<Row> observe(const Scene& scene, const Time& time) override {
        const double mu = scene.model().viscosity;
        double volume = 0;  // of cells
        const auto numbers = ofEachCell(scene, count + 1, [&](const coupling::Cell& cell, double* out) {
            const double more = mu * (scene.cells.types()[cell.type].viscosityRatio - 1);
            findShape(scene, cell, out);
            Mat3::Map(out + elastic) = ofForces(cell);
            Mat3::Map(out + inside) = more == 0 ? Mat3::Zero() : Mat3(more * ofVelocities(cell));
        });
        Mat3 membranes = Mat3::Zero(), interiors = Mat3::Zero();
        for (const std::vector<double>& cell : numbers) {
            membranes += matrixAt(cell, elastic), interiors += matrixAt(cell, inside);
            volume += std::isfinite(cell[count]) ? cell[count] : 0;
        }
        const Mat3 contact = scene.contacts ? scene.contacts->stresslet(scene.cells, *scene.system) : Mat3::Zero();
        const int g = scene.flow.gradient, v = 3 - g;
        const auto all = [&](int a, int b) { return (membranes + interiors + contact)(a, b) / scene.fluidVolume; };
        const auto shear = [&](const Mat3& m) { return 0.5 * (m(0, g) + m(g, 0)) / scene.fluidVolume; };
        std::vector<double> row{volume / scene.fluidVolume, shear(membranes),     shear(interiors), shear(contact),
                                all(0, 0) - all(g, g),      all(g, g) - all(v, v)};
        if (const double rate = scene.flow.shearRate; rate != 0)
            row.push_back(1 + (row[1] + row[2] + row[3]) / (mu * rate));
        if (const double rate = scene.flow.shearRate; images_)
            row.push_back(images_->since(scene, time.t) / (mu * rate * rate * scene.fluidVolume));

        std::vector<Row> rows{{0, std::move(row)}};
        std::vector<std::vector<double>> ofCells;
        for (const std::vector<double>& cell : numbers) {
            const Mat3 stresslet = matrixAt(cell, elastic) + matrixAt(cell, inside);
            std::vector<double>& own = ofCells.emplace_back(cell.begin(), cell.begin() + elastic);
            own.insert(own.end(), {0.5 * (stresslet(0, g) + stresslet(g, 0)), stresslet(0, 0) - stresslet(g, g),
                                   stresslet(g, g) - stresslet(v, v)});
        }
        for (Row& one : rowsByType(scene, 1, ofCells)) rows.push_back(std::move(one));
        return rows;
    }
    std::vector<double> state() const override { return images_ ? images_->state() : std::vector<double>{}; }

  protected:
    void setState(std::span<const double> saved) override {
        if (images_) images_->setState(saved);
    }

  private:
    std::optional<ImagePower> images_;
    static void findShape(const Scene& scene, const coupling::Cell& cell, double* out) {
        const geometry::TriangleMesh surface = closedSurface(cell);
        const double volume = surface.volume();
        Vec3 mean = Vec3::Zero();
        for (const Vec3& u : cell.membrane.velocity) mean += u;
        Vec3 x = surface.centroid(), u = mean / static_cast<double>(cell.membrane.velocity.size());
        scene.system->periodicity().wrap(x, u);
        Vec3::Map(out + place) = x, Vec3::Map(out + velocity) = u;
        const Eigen::SelfAdjointEigenSolver<Mat3> principal(surface.inertia());
        const Vec3& I = principal.eigenvalues();  // ascending: the first is that about the longest axis
        Vec3 n = principal.eigenvectors().col(2);
        if (n[scene.flow.gradient] < 0) n = -n;
        Vec3::Map(out + axis) = n;
        for (int k = 0; k < 3; ++k)  // of an ellipsoid: I_a = V (b^2 + c^2)/5
            out[semiaxes + static_cast<std::size_t>(k)] = std::sqrt(2.5 * (I.sum() - 2 * I[k]) / volume);
        out[count] = volume;
    }
};

struct SuspensionObserver : Observer {
    static const Schema<SuspensionObserver>& schema() {
        static const Schema<SuspensionObserver> s =
            Schema<SuspensionObserver>("suspension", "stress of the cells; place, axis and stresslet of each")
                .include<ObserverSettings>();
        return s;
    }
    std::string whyNot(const Subject& subject) const override { return needsCells(subject); }
    bool wantsBudget(bool slidingImages) const override { return slidingImages; }
    std::vector<Table> tables(const SceneParts& parts) const override {
        std::vector<io::Column> whole{
            {"haematocrit", "", "volume of the cells over that of fluid and cells together"},
            {"shearStress_membranes", "Pa", "shear stress, along the flow and its gradient, by forces of membranes"},
            {"shearStress_interiors", "Pa", "the same, by insides that are more or less viscous"},
            {"shearStress_contact", "Pa", "the same, by contact"},
            {"N1", "Pa", "first normal stress difference of all of these, along the flow less along its gradient"},
            {"N2", "Pa", "second one, along the gradient less along the vorticity"}};
        if (parts.shear)
            whole.push_back({"relativeViscosity", "", "1 + the sum of the three shear stresses over mu gammadot"});
        if (parts.slidingImages)
            whole.push_back({"relativeViscosity_images", "",
                             "by the work of sliding images since the row before, over mu gammadot^2 V and the time"});
        std::vector<io::Column> each;
        addVector(each, "centroid", "m", "coordinate of the centroid of the enclosed volume, in the box");
        addVector(each, "velocity", "m_s", "component of the mean velocity of the nodes");
        addVector(each, "axis", "", "component of the axis in which the cell is thinnest, pointing along the gradient");
        each.push_back({"semiaxis_longest", "m", "of the ellipsoid with the cell's moments of inertia"});
        each.push_back({"semiaxis_middle", "m", "of the same"});
        each.push_back({"semiaxis_shortest", "m", "of the same, along the axis"});
        each.push_back(
            {"stresslet_shear", "J", "what the cell adds to the shear stress, times the volume, but for contact"});
        each.push_back({"stresslet_N1", "J", "the same of the first normal stress difference"});
        each.push_back({"stresslet_N2", "J", "the same of the second one"});
        std::vector<Table> all{{"suspension", whole}};
        for (const std::string& type : parts.cells) all.push_back({type, cellTable(each)});
        return all;
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<SuspensionObservation>(tables(SceneParts::of(scene)), scene);
    }
};

CORPUSCLE_REGISTER(Observer, SuspensionObserver, "suspension",
                   "stress of the cells; place, axis and stresslet of each");

}  // namespace
}  // namespace corpuscle::observers
