// Ghosts: copies of other ranks' particles, and of own ones across periodic faces, that lie within reach of this rank's
// brick.
//
// One mechanism serves both: for every rank and every periodic image, the particles whose shifted position lies within
// reach of that rank's brick are sent to it. The plan is made when lists are built and used at every step; ghosts are
// kept sorted in columns. A message carries records (pairLoop.hpp): fields 0..2 are the position, which gets the
// image's shift. Velocities in records are those of the particle: who needs those of its image adds `slides`.
#pragma once
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "particles/decomposition.hpp"

namespace corpuscle::particles {

class Halo {
  public:
    // Who needs which of the n own particles at x, y, z. Collective.
    void plan(const double* x, const double* y, const double* z, int n, const Decomposition& decomposition,
              const Periodicity& periodicity, double reach);

    int ghostCount() const { return ghosts_; }

    // Fills records[owned .. owned + ghostCount) from records[0 .. owned), `fields` numbers each (double or float), in
    // two halves so that work on interior particles can go on between them. scale: what positions in records are, per
    // metre.
    template <class Real>
    void begin(Real* records, int owned, int fields, double scale);
    template <class Real>
    void finish(Real* records, int owned, int fields);
    void exchange(double* records, int owned, int fields) {
        begin(records, owned, fields, 1), finish(records, owned, fields);
    }
    // The same for the fields [first, last) of the records alone, which are no positions.
    struct Part {
        int first, last;
    };
    template <class Real>
    void begin(Real* records, int owned, int fields, Part part);
    template <class Real>
    void finish(Real* records, int owned, int fields, Part part);

    // Puts ghosts into a new order: the ghost that was number order[k] becomes number k.
    void reorder(const std::vector<int>& order);

    // The own particle of which each ghost is an image, -1 for those of other ranks.
    std::vector<int> imageOf() const;
    // A particle by the rank that has it, and its number there.
    struct Origin {
        int rank, particle;
        bool operator==(const Origin&) const = default;
        bool operator<(const Origin& other) const {
            return std::tie(rank, particle) < std::tie(other.rank, other.particle);
        }
    };
    // Of each ghost. Collective.
    std::vector<Origin> origins(int owned);
    // By how much each ghost is faster than its origin, in a box whose images slide [m/s]. Collective.
    std::vector<Vec3> slides(int owned);
    // Which other ranks have ghosts of own particles: these ranks and the own particles' numbers, in order and each
    // once.
    std::vector<Origin> copies() const;
    // Adds what images of own particles have gathered, `count` numbers a particle, to these particles; the images have
    // 0 then.
    void foldImages(double* sums, int owned, int count = 4) const;

    // Bytes sent to other ranks at each exchange of `fields` doubles.
    std::size_t bytesSent(int fields) const {
        return (sendIndex_.size() - selfCount_) * static_cast<std::size_t>(fields) * 8;
    }

  private:
    struct Message {
        int rank;
        int begin, end;  // of the send list, or of the received ghosts
    };
    template <class Real, class Pack>
    void post(Real* records, int owned, int fields, Part part, Pack&& pack);
    MPI_Comm comm_ = MPI_COMM_NULL;
    int ghosts_ = 0;
    std::size_t selfCount_ = 0;
    std::vector<int> sendIndex_;            // own particle of each entry
    std::vector<std::uint16_t> sendImage_;  // in which image it goes: number in images_
    std::vector<Periodicity::Image> images_;
    std::vector<Message> sends_, receives_;
    Message selfSend_{}, selfReceive_{};
    std::vector<int> slot_;  // ghost number of the k-th received ghost
    std::vector<std::byte> sendBuffer_, receiveBuffer_;
    std::vector<MPI_Request> requests_;
};

}  // namespace corpuscle::particles
