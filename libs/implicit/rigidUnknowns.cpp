#include "implicit/rigidUnknowns.hpp"

#include <algorithm>

namespace corpuscle::implicit {

using bodies::Body;
using particles::RealArray;
using particles::setVector;
using particles::vectorAt;
using sph::RigidMotion;
using sph::Wrench;

namespace {

Mat3 cross(const Vec3& r) {  // cross(r) v = r x v
    Mat3 m;
    m << 0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0;
    return m;
}

Mat3 inertiaInSpace(const Body& body) {
    const Mat3 R = body.state.rotation();
    return R * body.solid.inertia.asDiagonal() * R.transpose();
}

void add(Wrench& sum, const Vec3& arm, const Vec3& force) {
    sum.force += force;
    sum.torque += arm.cross(force);
}

}  // namespace

template <class Real>
void RigidUnknowns<Real>::moveVelocities(double seconds) {
    for (Body& body : bodies()) {
        body.state.motion.linear += seconds * body.acceleration.linear;
        body.state.motion.angular += seconds * body.acceleration.angular;
    }
}

template <class Real>
void RigidUnknowns<Real>::stopAccelerating() {
    for (Body& body : bodies()) body.acceleration = {};
}

template <class Real>
void RigidUnknowns<Real>::depart(double seconds) {
    saved_.clear();
    for (Body& body : bodies()) {
        saved_.push_back(body.state);
        bodies::drive(body.state, seconds);
    }
    scene_.bodies->findMembers(*scene_.system);
    scene_.bodies->place(*scene_.system);
}

template <class Real>
void RigidUnknowns<Real>::takeBack() {
    for (std::size_t b = 0; b < saved_.size(); ++b) bodies()[b].state = saved_[b];
    scene_.bodies->findMembers(*scene_.system);  // lists may have been rebuilt since
    scene_.bodies->place(*scene_.system);
}

// L of a field that is 1 on particles of bodies and 0 elsewhere is, on these particles, the sum of l_ij over all
// others.
template <class Real>
void RigidUnknowns<Real>::prepare(const Reach&) {
    scene_.bodies->moved(*scene_.system, 0, true);
    findOthers();
    Field marks(width * scene_.store().size(), Real(0));
    for (const auto& m : members()) marks[width * static_cast<std::size_t>(m.particle)] = Real(1);
    operators_.applyViscosity(*scene_.system, marks);
    layer_.prepare();
    outward_.clear();
    for (const auto& m : members()) {
        const auto i = static_cast<std::size_t>(m.particle);
        outward_.push_back(std::clamp(-vectorAt(operators_.force(), i)[0] / operators_.viscousDiagonal(i), 0.0, 1.0));
    }
}

template <class Real>
void RigidUnknowns<Real>::findOthers() {
    particles::SharedParticles& shared = operators_.shared();
    constexpr std::size_t numbers = 5;  // body, counted from 1, arm, periods
    RealArray rows(numbers * shared.entries(), 0.0);
    periods_.clear();
    for (const auto& m : members()) {
        const auto i = static_cast<std::size_t>(m.particle);
        double* row = rows.data() + numbers * i;
        row[0] = m.group + 1;
        Vec3::Map(row + 1) = m.arm;
        row[4] = scene_.system->periodicity().periods(bodies()[static_cast<std::size_t>(m.group)].state.centre + m.arm,
                                                      scene_.store().position(i));
        periods_.push_back(row[4]);
    }
    shared.distribute(rows.data(), static_cast<int>(numbers));
    others_.clear();
    for (std::size_t e = shared.owned(); e < shared.entries(); ++e)
        if (const double* row = rows.data() + numbers * e; row[0] > 0)
            others_.push_back({e, static_cast<std::size_t>(row[0]) - 1, Vec3::Map(row + 1), row[4]});
}

template <class Real>
void RigidUnknowns<Real>::extrapolate(double h, Field& u) const {
    for (std::size_t b = 0; b < bodies().size(); ++b) {
        const RigidMotion guess = extrapolated(h, b);
        put(u, b, guess.linear, guess.angular);
    }
    spread(u, sph::FieldOf::velocities);
}

template <class Real>
RigidMotion RigidUnknowns<Real>::extrapolated(double h, std::size_t body) const {
    const RigidMotion &last = bodies()[body].state.motion, &rate = bodies()[body].acceleration;
    return {last.linear + h * rate.linear, last.angular + h * rate.angular};
}

template <class Real>
bool RigidUnknowns<Real>::areSomeFree() const {
    return std::any_of(bodies().begin(), bodies().end(), [](const auto& b) { return b.behaviour->yields(); });
}

template <class Real>
double RigidUnknowns<Real>::largestDifference(double h, const Field& u) const {
    double largest = 0;
    for (std::size_t b = 0; b < bodies().size(); ++b) {
        if (!isFree(b)) continue;
        const double radius = radiusOfSphere(bodies()[b].solid.volume);
        const RigidMotion found = motion(u, b), guess = extrapolated(h, b);
        largest =
            std::max(largest, (found.linear - guess.linear).norm() / radius + (found.angular - guess.angular).norm());
    }
    return largest;
}

template <class Real>
void RigidUnknowns<Real>::addLayer(const Field& u, sph::FieldOf of, Forces& force) {
    reaction_.assign(bodies().size(), {});
    layer_.addProduct(
        u, of, [&](std::size_t b) { return motion(u, b); }, force, reaction_);
}

// The power is that of the layer alone; as its A is symmetric, forces are evaluated for w and their power in v.
template <class Real>
double RigidUnknowns<Real>::slidingPower(const Field& v, const std::vector<double>& /*divergence*/, const Field& w) {
    Forces force(width * operators_.shared().entries(), 0.0);
    const std::vector<Wrench> atV = reaction_;
    addLayer(w, sph::FieldOf::velocities, force);
    double power = reactionPower(v);
    for (std::size_t i = 0; i < scene_.store().size(); ++i) power += vectorAt(v, i).dot(vectorAt(force, i));
    reaction_ = atV;
    return power;
}

template <class Real>
double RigidUnknowns<Real>::reactionPower(const Field& u) const {
    double power = 0;
    for (std::size_t b = 0; b < bodies().size(); ++b) {
        const RigidMotion now = motion(u, b);
        power += now.linear.dot(reaction_[b].force) + now.angular.dot(reaction_[b].torque);
    }
    return power;
}

template <class Real>
double RigidUnknowns<Real>::powerOfSlides(const RealArray& force) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < periods_.size(); ++k)
        sum += periods_[k] * vectorAt(force, static_cast<std::size_t>(members()[k].particle));
    return sum.dot(scene_.system->periodicity().slide());
}

// Writes row(body, P^T of the forces) for free bodies, and 0 for other bodies and for particles of bodies.
template <class Real>
template <class Row>
void RigidUnknowns<Real>::putRows(const RealArray& force, Field& rows, Row&& row) const {
    const std::vector<Wrench> sums = gather(force);
    for (std::size_t b = 0; b < sums.size(); ++b) {
        const Wrench found = isFree(b) ? row(b, sums[b]) : Wrench{};
        put(rows, b, found.force, found.torque);
    }
    for (const auto& m : members())
        std::fill_n(rows.data() + width * static_cast<std::size_t>(m.particle), width, Real(0));
    for (const OtherMember& m : others_) std::fill_n(rows.data() + width * m.entry, width, Real(0));
}

template <class Real>
void RigidUnknowns<Real>::putForces(const RealArray& force, Field& rows) const {
    putRows(force, rows, [](std::size_t, const Wrench& sum) { return sum; });
}

template <class Real>
void RigidUnknowns<Real>::putProduct(double c1, const Field& u, const RealArray& force, Field& product) const {
    putRows(force, product, [&](std::size_t b, const Wrench& sum) {
        Wrench row{-sum.force - reaction_[b].force, -sum.torque - reaction_[b].torque};
        if (!isRoot()) return row;
        const RigidMotion z = motion(u, b);
        row.force += c1 * bodies()[b].solid.mass * z.linear;
        row.torque += c1 * inertiaInSpace(bodies()[b]) * z.angular;
        return row;
    });
}

template <class Real>
void RigidUnknowns<Real>::putResidual(double c1, double c2, const Field& u, const RealArray& force, Field& residual) {
    const sph::FluidModel& model = scene_.model();
    gyroscopic_.resize(bodies().size());
    putRows(force, residual, [&](std::size_t b, const Wrench& sum) {
        Wrench row{sum.force + reaction_[b].force, sum.torque + reaction_[b].torque};
        if (!isRoot()) return row;
        const Body& body = bodies()[b];
        const RigidMotion guess = motion(u, b), &last = body.state.motion, &rate = body.acceleration;
        const Mat3 I = inertiaInSpace(body);
        row.force += body.solid.mass * (c2 * rate.linear - c1 * (guess.linear - last.linear)) +
                     model.density * body.solid.volume * model.bodyForce;
        gyroscopic_[b] = guess.angular.cross(I * guess.angular);
        row.torque += I * (c2 * rate.angular - c1 * (guess.angular - last.angular)) - gyroscopic_[b];
        return row;
    });
}

template <class Real>
std::vector<Wrench> RigidUnknowns<Real>::gather(const RealArray& force) const {
    std::vector<Wrench> sums(bodies().size());
    for (const auto& m : members())
        add(sums[static_cast<std::size_t>(m.group)], m.arm, vectorAt(force, static_cast<std::size_t>(m.particle)));
    return sums;
}

template <class Real>
auto RigidUnknowns<Real>::square(const Vec3& arm) -> Matrix6 {
    const Mat3 r = cross(arm);
    Matrix6 m;
    m << Mat3::Identity(), -r, r, -r * r;
    return m;
}

template <class Real>
auto RigidUnknowns<Real>::continuationBlocks() const -> std::vector<Matrix6> {
    std::vector<Matrix6> blocks(bodies().size(), Matrix6::Zero());
    layer_.forEachResistance([&](std::size_t b, const Vec3& arm, double k) { blocks[b] += k * square(arm); });
    return blocks;
}

template <class Real>
void RigidUnknowns<Real>::invert(double c1, std::vector<Matrix6>& blocks) {
    MPI_Allreduce(MPI_IN_PLACE, blocks.data(), static_cast<int>(36 * blocks.size()), MPI_DOUBLE, MPI_SUM,
                  scene_.system->comm());
    inertia_.clear(), particles_.clear();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Body& body = bodies()[b];
        blocks[b].template topLeftCorner<3, 3>() += c1 * body.solid.mass * Mat3::Identity();
        blocks[b].template bottomRightCorner<3, 3>() +=
            c1 * inertiaInSpace(body) + 2 * body.viscosity * body.solid.volume * Mat3::Identity();
        inertia_.emplace_back(blocks[b]);
        Matrix6 sum = Matrix6::Zero();
        for (const bodies::BodyParticle& p : body.particles) sum += square(body.state.orientation * p.place);
        particles_.emplace_back(sum);
    }
}

template <class Real>
auto RigidUnknowns<Real>::distribute(const Field& r) -> const Field& {
    residual_.clear();
    for (std::size_t b = 0; b < bodies().size(); ++b) {
        const RigidMotion part = motion(r, b);
        residual_.push_back({part.linear, part.angular});
    }
    addUp(residual_);
    if (!onGrid_) return r;
    shared_ = r;
    for (std::size_t b = 0; b < bodies().size(); ++b) {
        Vector6 f;
        f << residual_[b].force, residual_[b].torque;
        f = particles_[b].solve(f);
        put(shared_, b, f.template head<3>(), f.template tail<3>());
    }
    spread(shared_, sph::FieldOf::changes);
    return shared_;
}

template <class Real>
void RigidUnknowns<Real>::project(Field& z) {
    std::vector<Wrench> sums(bodies().size());
    if (onGrid_) {
        for (const auto& m : members())
            add(sums[static_cast<std::size_t>(m.group)], m.arm, vectorAt(z, static_cast<std::size_t>(m.particle)));
        addUp(sums);
    }
    for (std::size_t b = 0; b < sums.size(); ++b) {
        Vector6 found = Vector6::Zero(), r, f;
        if (isFree(b)) {
            f << sums[b].force, sums[b].torque;
            r << residual_[b].force, residual_[b].torque;
            found = particles_[b].solve(f) + inertia_[b].solve(r);
        }
        put(z, b, found.template head<3>(), found.template tail<3>());
    }
    spread(z, sph::FieldOf::changes);
}

template <class Real>
void RigidUnknowns<Real>::findWrenches(const RealArray& force) {
    std::vector<Wrench> sums = gather(force);
    for (std::size_t b = 0; b < sums.size(); ++b)
        sums[b].force += reaction_[b].force, sums[b].torque += reaction_[b].torque;
    addUp(sums);
    for (std::size_t b = 0; b < sums.size(); ++b) {
        Body& body = bodies()[b];
        body.wrench = sums[b];
        body.wrench.force += scene_.model().density * body.solid.volume * scene_.model().bodyForce;
    }
}

template <class Real>
double RigidUnknowns<Real>::addRates(double c1, double c2, const Field& u, sph::Budget::Values& rates) const {
    for (std::size_t b = 0; b < bodies().size(); ++b) {
        const Body& body = bodies()[b];
        const RigidMotion now = motion(u, b), &last = body.state.motion, &rate = body.acceleration;
        if (!isRoot()) continue;
        scene_.bodies->addRates(*scene_.system, body, now, rates);
        if (!isFree(b)) continue;
        const Vec3 force = body.solid.mass * (c1 * (now.linear - last.linear) - c2 * rate.linear),
                   torque = inertiaInSpace(body) * (c1 * (now.angular - last.angular) - c2 * rate.angular);
        rates[sph::Budget::kinetic] += now.linear.dot(force) + now.angular.dot(torque);
        rates[sph::Budget::ofSolver] +=
            now.linear.dot(body.wrench.force - force) + now.angular.dot(body.wrench.torque - torque - gyroscopic_[b]);
    }
    return reactionPower(u);
}

template <class Real>
void RigidUnknowns<Real>::arrive(double dt, double h, const Field& u) {
    for (std::size_t b = 0; b < bodies().size(); ++b) {
        Body& body = bodies()[b];
        const RigidMotion last = saved_[b].motion, found = isFree(b) ? motion(u, b) : last;
        body.state = saved_[b];
        body.state.motion = found;
        bodies::drive(body.state, dt);
        body.acceleration = {(found.linear - last.linear) / h, (found.angular - last.angular) / h};
    }
    scene_.bodies->place(*scene_.system);
}

template <class Real>
RigidMotion RigidUnknowns<Real>::motion(const Field& u, std::size_t body) const {
    const Real* a = u.data() + behind() + perBody * body;
    return {Vec3(a[0], a[1], a[2]), Vec3(a[4], a[5], a[6])};
}

template <class Real>
void RigidUnknowns<Real>::put(Field& f, std::size_t body, const Vec3& linear, const Vec3& angular) const {
    Real* a = f.data() + behind() + perBody * body;
    for (int k = 0; k < 3; ++k) a[k] = static_cast<Real>(linear[k]), a[4 + k] = static_cast<Real>(angular[k]);
    a[3] = a[7] = Real(0);
}

template <class Real>
void RigidUnknowns<Real>::spread(Field& u, sph::FieldOf of) const {
    const Vec3 slide = of == sph::FieldOf::velocities ? scene_.system->periodicity().slide() : Vec3(0, 0, 0);
    std::vector<RigidMotion> motions;
    for (std::size_t b = 0; b < bodies().size(); ++b) motions.push_back(motion(u, b));
    const auto set = [&](std::size_t entry, std::size_t group, const Vec3& arm, double periods) {
        setVector(u, entry, motions[group].at(arm) + periods * slide);
    };
    for (std::size_t k = 0; k < members().size(); ++k)
        set(static_cast<std::size_t>(members()[k].particle), static_cast<std::size_t>(members()[k].group),
            members()[k].arm, periods_[k]);
    for (const OtherMember& m : others_) set(m.entry, m.group, m.arm, m.periods);
}

template <class Real>
void RigidUnknowns<Real>::addUp(std::vector<Wrench>& wrenches) const {
    static_assert(sizeof(Wrench) == 6 * sizeof(double));
    MPI_Allreduce(MPI_IN_PLACE, wrenches.data(), static_cast<int>(6 * wrenches.size()), MPI_DOUBLE, MPI_SUM,
                  scene_.system->comm());
}

template class RigidUnknowns<double>;
template class RigidUnknowns<float>;

}  // namespace corpuscle::implicit
