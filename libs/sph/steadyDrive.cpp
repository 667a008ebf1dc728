// `steady`: f = 1, the drive of a case that names none.
#include "sph/drive.hpp"

namespace corpuscle::sph {

namespace {

struct SteadyDrive : Drive {
    static const Schema<SteadyDrive>& schema() {
        static const Schema<SteadyDrive> s = Schema<SteadyDrive>("steady", "a drive that does not change");
        return s;
    }
    double factor(double /*t*/) const override { return 1; }
    double largest() const override { return 1; }
};

CORPUSCLE_REGISTER(Drive, SteadyDrive, "steady", "does not change");

}  // namespace

}  // namespace corpuscle::sph
