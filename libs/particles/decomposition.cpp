#include "particles/decomposition.hpp"

#include <zoltan.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>

#include "core/communicator.hpp"
#include "core/error.hpp"

namespace corpuscle::particles {

namespace {

void require(int code, const char* what) {
    if (code != ZOLTAN_OK && code != ZOLTAN_WARN)
        throw Failure(ExitCode::numerics, std::string("dividing the box among ranks failed in Zoltan (") + what + ")");
}

int objectCount(void* data, int* error) {
    *error = ZOLTAN_OK;
    return static_cast<int>(static_cast<const ParticleStore*>(data)->size());
}
void objectList(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float*, int* error) {
    const auto& particles = *static_cast<const ParticleStore*>(data);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        global[i] = static_cast<ZOLTAN_ID_TYPE>(particles.id[i]);
        local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
    }
    *error = ZOLTAN_OK;
}
int dimension(void*, int* error) {
    *error = ZOLTAN_OK;
    return 3;
}
void coordinates(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* out, int* error) {
    const auto& particles = *static_cast<const ParticleStore*>(data);
    for (int k = 0; k < count; ++k) {
        const Vec3 p = particles.position(local[k]);
        std::copy(p.data(), p.data() + 3, out + 3 * k);
    }
    *error = ZOLTAN_OK;
}

}  // namespace

Decomposition::Decomposition(MPI_Comm comm, const Box& box) : comm_(comm), box_(box) {
    MPI_Comm_rank(comm, &rank_);
    MPI_Comm_size(comm, &size_);
    // Until the first balance: slices of equal thickness along the longest axis.
    Eigen::Index axis = 0;
    box.size().maxCoeff(&axis);
    bricks_.assign(static_cast<std::size_t>(size_), Brick{box.low, box.high});
    for (int r = 0; r < size_; ++r) {
        const double length = box.size()[axis];
        bricks_[static_cast<std::size_t>(r)].low[axis] = box.low[axis] + length * r / size_;
        bricks_[static_cast<std::size_t>(r)].high[axis] = box.low[axis] + length * (r + 1) / size_;
    }
    for (int r = 0; r + 1 < size_; ++r)
        bricks_[static_cast<std::size_t>(r)].high[axis] = bricks_[static_cast<std::size_t>(r) + 1].low[axis];
}

void Decomposition::balance(const ParticleStore& particles) {
    if (size_ == 1) return;
    float version = 0;
    require(Zoltan_Initialize(0, nullptr, &version), "initialisation");
    struct Destroy {
        void operator()(Zoltan_Struct* z) const { Zoltan_Destroy(&z); }
    };
    const std::unique_ptr<Zoltan_Struct, Destroy> zoltan(Zoltan_Create(comm_));
    // The debug level is set first: otherwise Zoltan would print each later setting on the standard output.
    for (auto [key, value] : {std::pair{"DEBUG_LEVEL", "0"},
                              {"LB_METHOD", "RCB"},
                              {"NUM_GID_ENTRIES", "1"},
                              {"NUM_LID_ENTRIES", "1"},
                              {"KEEP_CUTS", "1"},
                              {"RCB_RECTILINEAR_BLOCKS", "1"},
                              {"RETURN_LISTS", "NONE"},
                              {"OBJ_WEIGHT_DIM", "0"}})
        require(Zoltan_Set_Param(zoltan.get(), key, value), key);
    void* data = const_cast<ParticleStore*>(&particles);
    require(Zoltan_Set_Num_Obj_Fn(zoltan.get(), objectCount, data), "objects");
    require(Zoltan_Set_Obj_List_Fn(zoltan.get(), objectList, data), "objects");
    require(Zoltan_Set_Num_Geom_Fn(zoltan.get(), dimension, data), "coordinates");
    require(Zoltan_Set_Geom_Multi_Fn(zoltan.get(), coordinates, data), "coordinates");

    int changed = 0, globalEntries = 0, localEntries = 0, imports = 0, exports = 0;
    ZOLTAN_ID_PTR importGlobal = nullptr, importLocal = nullptr, exportGlobal = nullptr, exportLocal = nullptr;
    int *importRanks = nullptr, *importParts = nullptr, *exportRanks = nullptr, *exportParts = nullptr;
    require(Zoltan_LB_Partition(zoltan.get(), &changed, &globalEntries, &localEntries, &imports, &importGlobal,
                                &importLocal, &importRanks, &importParts, &exports, &exportGlobal, &exportLocal,
                                &exportRanks, &exportParts),
            "recursive coordinate bisection");
    for (int r = 0; r < size_; ++r) {
        int axes = 0;
        Brick& brick = bricks_[static_cast<std::size_t>(r)];
        require(Zoltan_RCB_Box(zoltan.get(), r, &axes, &brick.low[0], &brick.low[1], &brick.low[2], &brick.high[0],
                               &brick.high[1], &brick.high[2]),
                "bricks");
        brick.low = brick.low.cwiseMax(box_.low);
        brick.high = brick.high.cwiseMin(box_.high);
    }
}

void Decomposition::restore(const std::vector<double>& bricks) {
    for (std::size_t r = 0; r < bricks_.size(); ++r)
        for (int k = 0; k < 3; ++k) {
            bricks_[r].low[k] = bricks[6 * r + static_cast<std::size_t>(k)];
            bricks_[r].high[k] = bricks[6 * r + 3 + static_cast<std::size_t>(k)];
        }
}

std::vector<double> Decomposition::state() const {
    std::vector<double> all;
    for (const Brick& brick : bricks_) {
        all.insert(all.end(), brick.low.data(), brick.low.data() + 3);
        all.insert(all.end(), brick.high.data(), brick.high.data() + 3);
    }
    return all;
}

bool Decomposition::holds(int rank, const Vec3& p) const {
    const Brick& brick = bricks_[static_cast<std::size_t>(rank)];
    for (int k = 0; k < 3; ++k) {
        const bool aboveLow = p[k] >= brick.low[k] || brick.low[k] <= box_.low[k];
        const bool belowHigh = p[k] < brick.high[k] || brick.high[k] >= box_.high[k];
        if (!aboveLow || !belowHigh) return false;
    }
    return true;
}

int Decomposition::owner(const Vec3& p) const {
    if (holds(rank_, p)) return rank_;
    for (int r = 0; r < size_; ++r)
        if (holds(r, p)) return r;
    throw Failure(ExitCode::numerics, "a particle is lost: its position (" + std::to_string(p[0]) + ", " +
                                          std::to_string(p[1]) + ", " + std::to_string(p[2]) +
                                          ") m belongs to no rank; the run has diverged");
}

double Decomposition::imbalance(std::size_t owned) const {
    const auto n = static_cast<double>(owned);
    double most = 0, sum = 0;
    MPI_Allreduce(&n, &most, 1, MPI_DOUBLE, MPI_MAX, comm_);
    MPI_Allreduce(&n, &sum, 1, MPI_DOUBLE, MPI_SUM, comm_);
    return sum > 0 ? most * size_ / sum : 1;
}

void migrate(ParticleStore& particles, const Decomposition& decomposition) {
    if (decomposition.size() == 1) return;
    std::vector<std::vector<double>> leaving(static_cast<std::size_t>(decomposition.size()));
    std::vector<int> staying;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const int to = decomposition.owner(particles.position(i));
        if (to == decomposition.rank())
            staying.push_back(static_cast<int>(i));
        else
            particles.forEachField(
                [&, &numbers = leaving[static_cast<std::size_t>(to)]](std::string_view, const auto& array) {
                    numbers.push_back(std::bit_cast<double>(array[i]));
                });
    }
    const std::vector<std::vector<double>> arriving = Communicator(decomposition.comm()).exchange(leaving);

    std::size_t numbers = 0, fields = 0, place = staying.size();
    for (const std::vector<double>& part : arriving) numbers += part.size();
    if (staying.size() == particles.size() && numbers == 0) return;
    particles.forEachField([&](std::string_view, const auto&) { ++fields; });
    particles.reorder(staying);
    particles.resize(staying.size() + numbers / fields);
    for (const std::vector<double>& part : arriving)
        for (auto in = part.begin(); in != part.end(); ++place)
            particles.forEachField([&](std::string_view, auto& array) {
                array[place] = std::bit_cast<typename std::remove_reference_t<decltype(array)>::value_type>(*in++);
            });
}

}  // namespace corpuscle::particles
