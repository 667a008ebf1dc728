#include "sph/rigidGroups.hpp"

namespace corpuscle::sph {

void RigidGroups::spread(const std::vector<RigidMotion>& motions, double* u, double* v, double* w) const {
    for (const Member& m : members) {
        const Vec3 velocity = motions[static_cast<std::size_t>(m.group)].at(m.arm);
        u[m.particle] = velocity[0], v[m.particle] = velocity[1], w[m.particle] = velocity[2];
    }
}

std::vector<Wrench> RigidGroups::gather(const std::vector<RigidMotion>& motions, const double* ax, const double* ay,
                                        const double* az, const double* mass, MPI_Comm comm) const {
    static_assert(sizeof(Wrench) == 6 * sizeof(double));
    std::vector<Wrench> sums(motions.size());
    for (const Member& m : members) {
        const Vec3 force = mass[m.particle] * Vec3(ax[m.particle], ay[m.particle], az[m.particle]);
        Wrench& sum = sums[static_cast<std::size_t>(m.group)];
        sum.force += force;
        sum.torque += m.surfaceArm.cross(force);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(6 * sums.size()), MPI_DOUBLE, MPI_SUM, comm);
    for (std::size_t g = 0; g < sums.size(); ++g) sums[g].torque -= rotationalDrag[g] * motions[g].angular;
    return sums;
}

}  // namespace corpuscle::sph
