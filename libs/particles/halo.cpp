#include "particles/halo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace corpuscle::particles {

namespace {

struct Bounds {
    Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
    void include(const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
};

double gapSquared(const Vec3& lowA, const Vec3& highA, const Vec3& lowB, const Vec3& highB) {
    return (lowA - highB).cwiseMax(lowB - highA).cwiseMax(0.0).squaredNorm();
}

}  // namespace

void Halo::plan(const double* x, const double* y, const double* z, int n, const Decomposition& decomposition,
                const Periodicity& periodicity, double reach) {
    comm_ = decomposition.comm();
    const int size = decomposition.size(), self = decomposition.rank();
    const auto position = [&](int i) { return Vec3(x[i], y[i], z[i]); };
    constexpr int group = 64;  // consecutive particles, which are close together, are first tested as a group by bounds
    std::vector<Bounds> bounds(static_cast<std::size_t>((n + group - 1) / group));
    Bounds all;
    for (int i = 0; i < n; ++i) bounds[static_cast<std::size_t>(i / group)].include(position(i));
    for (const Bounds& b : bounds)
        if (b.low[0] <= b.high[0]) all.include(b.low), all.include(b.high);

    int images[3];
    for (int k = 0; k < 3; ++k)
        images[k] = periodicity.isAlong(k) ? static_cast<int>(std::ceil(reach / periodicity.lengths()[k])) : 0;
    if (periodicity.slides())  // per period across the faces, images are offset by at most half a period along them
        for (int k = 0; k < 3; ++k) {
            if (!periodicity.isAlong(k) || k == periodicity.slidingAxis()) continue;
            const double length = periodicity.lengths()[k], off = 0.5 * images[periodicity.slidingAxis()] * length;
            images[k] = static_cast<int>(std::ceil((reach + off) / length));
        }

    images_.clear(), sendIndex_.clear(), sendImage_.clear(), sends_.clear(), receives_.clear();
    std::vector<int> sendCounts(static_cast<std::size_t>(size), 0), receiveCounts(static_cast<std::size_t>(size), 0);
    for (int a = -images[0]; a <= images[0]; ++a)
        for (int b = -images[1]; b <= images[1]; ++b)
            for (int c = -images[2]; c <= images[2]; ++c) images_.push_back(periodicity.image({a, b, c}));
    if (images_.size() > std::numeric_limits<std::uint16_t>::max())
        throw std::logic_error("the box is far too small for the reach of the halo");
    const auto number = [&](const Index3& n) {  // index into images_
        return static_cast<std::uint16_t>(
            ((n[0] + images[0]) * (2 * images[1] + 1) + n[1] + images[1]) * (2 * images[2] + 1) + n[2] + images[2]);
    };
    const double reach2 = reach * reach;
    for (int r = 0; r < size; ++r) {
        const int begin = static_cast<int>(sendIndex_.size());
        const Brick& brick = decomposition.brick(r);
        for (int a = -images[0]; a <= images[0]; ++a)
            for (int b = -images[1]; b <= images[1]; ++b)
                for (int c = -images[2]; c <= images[2]; ++c) {
                    if (r == self && a == 0 && b == 0 && c == 0) continue;
                    const Vec3 shift = periodicity.image({a, b, c}).shift;
                    const Vec3 low = brick.low - shift, high = brick.high - shift;
                    if (n == 0 || gapSquared(all.low, all.high, low, high) >= reach2) continue;
                    for (std::size_t g = 0; g < bounds.size(); ++g) {
                        if (gapSquared(bounds[g].low, bounds[g].high, low, high) >= reach2) continue;
                        const int last = std::min(n, static_cast<int>(g + 1) * group);
                        for (int i = static_cast<int>(g) * group; i < last; ++i)
                            if (distanceSquared(position(i), low, high) < reach2) {
                                sendIndex_.push_back(i);
                                sendImage_.push_back(number({a, b, c}));
                            }
                    }
                }
        const int end = static_cast<int>(sendIndex_.size());
        sendCounts[static_cast<std::size_t>(r)] = end - begin;
        if (r == self)
            selfSend_ = {r, begin, end};
        else if (end > begin)
            sends_.push_back({r, begin, end});
    }
    MPI_Alltoall(sendCounts.data(), 1, MPI_INT, receiveCounts.data(), 1, MPI_INT, comm_);
    ghosts_ = 0;
    for (int r = 0; r < size; ++r) {
        const int count = receiveCounts[static_cast<std::size_t>(r)];
        if (r == self)
            selfReceive_ = {r, ghosts_, ghosts_ + count};
        else if (count > 0)
            receives_.push_back({r, ghosts_, ghosts_ + count});
        ghosts_ += count;
    }
    selfCount_ = static_cast<std::size_t>(selfSend_.end - selfSend_.begin);
    slot_.resize(static_cast<std::size_t>(ghosts_));
    std::iota(slot_.begin(), slot_.end(), 0);
}

// pack(k, to) writes entry k of the send list to `to`, in the form in which the receiver needs it.
template <class Real, class Pack>
void Halo::post(Real* records, int owned, int fields, Part part, Pack&& pack) {
    const auto width = static_cast<std::size_t>(part.last - part.first), bytes = width * sizeof(Real);
    sendBuffer_.resize(sendIndex_.size() * bytes);
    receiveBuffer_.resize(static_cast<std::size_t>(ghosts_) * bytes);
    requests_.clear();
    const MPI_Datatype type = sizeof(Real) == sizeof(double) ? MPI_DOUBLE : MPI_FLOAT;
    const auto count = [&](const Message& m) { return (m.end - m.begin) * static_cast<int>(width); };
    for (const Message& m : receives_) {
        requests_.emplace_back();
        MPI_Irecv(receiveBuffer_.data() + static_cast<std::size_t>(m.begin) * bytes, count(m), type, m.rank, 0, comm_,
                  &requests_.back());
    }
    for (const Message& m : sends_) {
        Real* buffer = reinterpret_cast<Real*>(sendBuffer_.data());
        for (int k = m.begin; k < m.end; ++k) pack(k, buffer + static_cast<std::size_t>(k) * width);
        requests_.emplace_back();
        MPI_Isend(buffer + static_cast<std::size_t>(m.begin) * width, count(m), type, m.rank, 0, comm_,
                  &requests_.back());
    }
    const auto record = static_cast<std::size_t>(fields), first = static_cast<std::size_t>(part.first);
    for (int k = 0; k < selfSend_.end - selfSend_.begin; ++k)
        pack(selfSend_.begin + k,
             records + static_cast<std::size_t>(owned + slot_[selfReceive_.begin + k]) * record + first);
}

template <class Real>
void Halo::begin(Real* records, int owned, int fields, double scale) {
    post(records, owned, fields, {0, fields}, [&](int k, Real* to) {
        const Real* from = records + static_cast<std::size_t>(sendIndex_[k]) * static_cast<std::size_t>(fields);
        std::copy_n(from, fields, to);
        for (std::size_t f = 0; f < 3; ++f)
            to[f] = static_cast<Real>(static_cast<double>(to[f]) +
                                      scale * images_[sendImage_[k]].shift[static_cast<int>(f)]);
    });
}

template <class Real>
void Halo::begin(Real* records, int owned, int fields, Part part) {
    post(records, owned, fields, part, [&](int k, Real* to) {
        const Real* from = records + static_cast<std::size_t>(sendIndex_[k]) * static_cast<std::size_t>(fields);
        std::copy(from + part.first, from + part.last, to);
    });
}

template <class Real>
void Halo::finish(Real* records, int owned, int fields) {
    finish(records, owned, fields, {0, fields});
}

template <class Real>
void Halo::finish(Real* records, int owned, int fields, Part part) {
    const auto width = static_cast<std::size_t>(part.last - part.first);
    const auto record = static_cast<std::size_t>(fields), first = static_cast<std::size_t>(part.first);
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    for (const Message& m : receives_)
        for (int k = m.begin; k < m.end; ++k) {
            const Real* from =
                reinterpret_cast<const Real*>(receiveBuffer_.data()) + static_cast<std::size_t>(k) * width;
            std::copy(from, from + width, records + static_cast<std::size_t>(owned + slot_[k]) * record + first);
        }
    requests_.clear();
}

template void Halo::begin(double*, int, int, double);
template void Halo::begin(float*, int, int, double);
template void Halo::begin(double*, int, int, Part);
template void Halo::begin(float*, int, int, Part);
template void Halo::finish(double*, int, int);
template void Halo::finish(float*, int, int);
template void Halo::finish(double*, int, int, Part);
template void Halo::finish(float*, int, int, Part);

std::vector<int> Halo::imageOf() const {
    std::vector<int> own(static_cast<std::size_t>(ghosts_), -1);
    for (int k = 0; k < selfSend_.end - selfSend_.begin; ++k)
        own[slot_[selfReceive_.begin + k]] = sendIndex_[selfSend_.begin + k];
    return own;
}

std::vector<Halo::Origin> Halo::origins(int owned) {
    const auto n = static_cast<std::size_t>(owned);
    std::vector<double> numbers(n + static_cast<std::size_t>(ghosts_));
    std::iota(numbers.begin(), numbers.begin() + owned, 0.0);
    begin(numbers.data(), owned, 1, Part{0, 1});
    finish(numbers.data(), owned, 1, Part{0, 1});
    std::vector<Origin> found(static_cast<std::size_t>(ghosts_));
    const auto take = [&](const Message& m) {
        for (int k = m.begin; k < m.end; ++k)
            found[slot_[k]] = {m.rank, static_cast<int>(numbers[n + static_cast<std::size_t>(slot_[k])])};
    };
    for (const Message& m : receives_) take(m);
    take(selfReceive_);
    return found;
}

std::vector<Vec3> Halo::slides(int owned) {
    constexpr int fields = 3;
    std::vector<double> records(fields * (static_cast<std::size_t>(owned) + static_cast<std::size_t>(ghosts_)));
    post(records.data(), owned, fields, Part{0, fields},
         [&](int k, double* to) { Vec3::Map(to) = images_[sendImage_[k]].slide; });
    finish(records.data(), owned, fields, Part{0, fields});
    std::vector<Vec3> found(static_cast<std::size_t>(ghosts_));
    for (std::size_t g = 0; g < found.size(); ++g)
        found[g] = Vec3::Map(records.data() + fields * (static_cast<std::size_t>(owned) + g));
    return found;
}

std::vector<Halo::Origin> Halo::copies() const {
    std::vector<Origin> all;
    for (const Message& m : sends_)
        for (int k = m.begin; k < m.end; ++k) all.push_back({m.rank, sendIndex_[k]});
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

void Halo::foldImages(double* sums, int owned, int count) const {
    const auto width = static_cast<std::size_t>(count);
    for (int k = 0; k < selfSend_.end - selfSend_.begin; ++k) {
        double* from = sums + width * static_cast<std::size_t>(owned + slot_[selfReceive_.begin + k]);
        double* to = sums + width * static_cast<std::size_t>(sendIndex_[selfSend_.begin + k]);
        for (std::size_t s = 0; s < width; ++s) to[s] += std::exchange(from[s], 0.0);
    }
}

void Halo::reorder(const std::vector<int>& order) {
    std::vector<int> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
    for (int& s : slot_) s = place[static_cast<std::size_t>(s)];
}

}  // namespace corpuscle::particles
