#include "particles/sharedParticles.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/communicator.hpp"

namespace corpuscle::particles {

namespace {

using Origin = Halo::Origin;
constexpr int tag = 1;

}  // namespace

void SharedParticles::plan(ParticleSystem& system) {
    comm_ = system.comm(), rank_ = system.decomposition().rank();
    owned_ = static_cast<std::size_t>(system.owned());
    const std::vector<Origin> origins = system.halo().origins(system.owned());
    std::vector<Origin> others;
    std::copy_if(origins.begin(), origins.end(), std::back_inserter(others),
                 [&](const Origin& o) { return o.rank != rank_; });
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    others_ = others.size();
    entry_.resize(origins.size()), ghostOf_.assign(others_, -1);
    for (std::size_t g = 0; g < origins.size(); ++g) {
        if (origins[g].rank == rank_) {
            entry_[g] = static_cast<std::size_t>(origins[g].particle);
            continue;
        }
        const auto k =
            static_cast<std::size_t>(std::lower_bound(others.begin(), others.end(), origins[g]) - others.begin());
        entry_[g] = owned_ + k;
        if (ghostOf_[k] < 0) ghostOf_[k] = static_cast<int>(g);
    }
    findMessages(system, others, system.halo().copies());
    sortBlocks(system);
}

void SharedParticles::findMessages(const ParticleSystem& system, const std::vector<Origin>& others,
                                   const std::vector<Origin>& copies) {
    // For a particle that three ranks or more know, its owner tells each of the others who else knows it, as pairs of
    // particle and rank.
    std::vector<Origin> byParticle = copies;
    std::stable_sort(byParticle.begin(), byParticle.end(),
                     [](const Origin& a, const Origin& b) { return a.particle < b.particle; });
    std::vector<std::vector<int>> news(static_cast<std::size_t>(system.decomposition().size()));
    for (auto first = byParticle.begin(), last = first; first != byParticle.end(); first = last) {
        last = std::find_if(first, byParticle.end(), [&](const Origin& c) { return c.particle != first->particle; });
        for (auto to = first; to != last; ++to)
            for (auto other = first; other != last; ++other) {
                std::vector<int>& pairs = news[static_cast<std::size_t>(to->rank)];
                if (to != other) pairs.insert(pairs.end(), {other->particle, other->rank});
            }
    }

    using Element =
        std::tuple<int, Origin, std::size_t>;  // other rank; origin, by which both sides sort the message; entry
    std::vector<Element> elements;
    elements.reserve(copies.size() + others.size());
    for (const Origin& c : copies)
        elements.emplace_back(c.rank, Origin{rank_, c.particle}, static_cast<std::size_t>(c.particle));
    for (std::size_t k = 0; k < others.size(); ++k) elements.emplace_back(others[k].rank, others[k], owned_ + k);
    const std::vector<std::vector<int>> heard = Communicator(comm_).exchange(news);
    for (std::size_t owner = 0; owner < heard.size(); ++owner)
        for (std::size_t k = 0; k < heard[owner].size(); k += 2) {
            const Origin origin{static_cast<int>(owner), heard[owner][k]};
            const auto place = std::lower_bound(others.begin(), others.end(), origin) - others.begin();
            elements.emplace_back(heard[owner][k + 1], origin, owned_ + static_cast<std::size_t>(place));
        }
    std::sort(elements.begin(), elements.end());

    index_.clear(), messages_.clear(), shared_.clear();
    index_.reserve(elements.size());
    for (const auto& [rank, origin, entry] : elements) {
        if (messages_.empty() || messages_.back().rank != rank)
            messages_.push_back({rank, index_.size(), index_.size()});
        index_.push_back(entry);
        messages_.back().end = index_.size();
    }
    shared_ = index_;
    std::sort(shared_.begin(), shared_.end());
    shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
}

void SharedParticles::sortBlocks(const ParticleSystem& system) {
    const PairList& list = system.list();
    const PairView view = list.view();
    std::vector<char> isShared(entries(), 0);
    for (const std::size_t e : shared_) isShared[e] = 1;
    const auto reaches = [&](int block) {
        const int first = block * list.lanes(), last = std::min(view.owned, first + list.lanes());
        for (int i = first; i < last; ++i)
            if (isShared[static_cast<std::size_t>(i)]) return true;
        return std::any_of(view.j + view.begin(block), view.j + view.end(block), [&](int j) {
            return isShared[j < view.owned ? static_cast<std::size_t>(j) : entry(j - view.owned)] != 0;
        });
    };
    for (Blocks* blocks : {&reaching_, &rest_}) blocks->away.clear(), blocks->atWall.clear();
    for (int group = 0; group < PairList::groups; ++group)
        for (const int b : list.blocks(static_cast<PairList::Group>(group))) {
            Blocks& blocks = !shared_.empty() && reaches(b) ? reaching_ : rest_;
            (PairList::isAtWall(static_cast<PairList::Group>(group)) ? blocks.atWall : blocks.away).push_back(b);
        }
}

template <class Real>
void SharedParticles::beginSum(const Real* values, Numbers numbers) {
    const auto width = static_cast<std::size_t>(numbers.width), count = static_cast<std::size_t>(numbers.count);
    send_.resize(count * index_.size()), receive_.resize(count * index_.size());
    requests_.resize(2 * messages_.size());
    for (std::size_t m = 0; m < messages_.size(); ++m) {
        const auto& [rank, begin, end] = messages_[m];
        const int length = static_cast<int>(count * (end - begin));
        MPI_Irecv(receive_.data() + count * begin, length, MPI_DOUBLE, rank, tag, comm_, &requests_[2 * m]);
        for (std::size_t k = begin; k < end; ++k)
            for (std::size_t c = 0; c < count; ++c)
                send_[count * k + c] = static_cast<double>(values[width * index_[k] + c]);
        MPI_Isend(send_.data() + count * begin, length, MPI_DOUBLE, rank, tag, comm_, &requests_[2 * m + 1]);
    }
}

template <class Real>
void SharedParticles::finishSum(Real* values, Numbers numbers) {
    const auto width = static_cast<std::size_t>(numbers.width), count = static_cast<std::size_t>(numbers.count);
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    requests_.clear();
    mine_.resize(count * shared_.size());
    for (std::size_t k = 0; k < shared_.size(); ++k)
        for (std::size_t c = 0; c < count; ++c)
            mine_[count * k + c] = static_cast<double>(std::exchange(values[width * shared_[k] + c], Real(0)));
    const auto add = [&](const std::vector<std::size_t>& at, std::size_t begin, std::size_t end, const double* part) {
        for (std::size_t k = begin; k < end; ++k)
            for (std::size_t c = 0; c < count; ++c) values[width * at[k] + c] += static_cast<Real>(part[count * k + c]);
    };
    auto message = messages_.begin();
    for (; message != messages_.end() && message->rank < rank_; ++message)
        add(index_, message->begin, message->end, receive_.data());
    add(shared_, 0, shared_.size(), mine_.data());
    for (; message != messages_.end(); ++message) add(index_, message->begin, message->end, receive_.data());
}

template <class Real>
void SharedParticles::distribute(Real* values, int width) {
    const auto numbers = static_cast<std::size_t>(width);
    std::fill(values + numbers * owned_, values + numbers * entries(), Real(0));
    beginSum(values, {width, width});
    finishSum(values, {width, width});
}

template void SharedParticles::beginSum(const double*, Numbers);
template void SharedParticles::beginSum(const float*, Numbers);
template void SharedParticles::finishSum(double*, Numbers);
template void SharedParticles::finishSum(float*, Numbers);
template void SharedParticles::distribute(double*, int);
template void SharedParticles::distribute(float*, int);

}  // namespace corpuscle::particles
