// Ghosts: copies of other ranks' particles, and periodic images of this rank's own, that lie within reach of this
// rank's brick.
//
// One mechanism serves both kinds of ghosts: for every rank and every periodic image, the particles whose shifted
// position lies within reach of that rank's brick are sent to that rank. The plan is made when lists are built and used
// at every step; ghosts are kept sorted in columns. A message carries records (pairLoop.hpp): fields 0..2 are the
// position, to which the image's shift is added. Velocities in the records of ghosts are those of the original
// particles: where images slide, code that needs the velocity of the image adds `slides`.
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
    // Finds which ranks need which of the n own particles at x, y, z. Collective.
    void plan(const double* x, const double* y, const double* z, int n, const Decomposition& decomposition,
              const Periodicity& periodicity, double reach);

    int ghostCount() const { return ghosts_; }

    // Fills records[owned .. owned + ghostCount) from the owning ranks' records[0 .. owned), `fields` numbers each
    // (double or float), in two halves so that interior particles can be processed between them. scale: unit of
    // positions in records, as (position in a record)/(position in metres).
    template <class Real>
    void begin(Real* records, int owned, int fields, double scale);
    template <class Real>
    void finish(Real* records, int owned, int fields);
    void exchange(double* records, int owned, int fields) {
        begin(records, owned, fields, 1), finish(records, owned, fields);
    }
    // The same for only the fields [first, last) of the records, which must not contain the position.
    struct Part {
        int first, last;
    };
    template <class Real>
    void begin(Real* records, int owned, int fields, Part part);
    template <class Real>
    void finish(Real* records, int owned, int fields, Part part);

    // Puts ghosts into a new order: the ghost that was number order[k] becomes number k.
    void reorder(const std::vector<int>& order);

    // For each ghost, the own particle that it is an image of, or -1 if its particle belongs to another rank.
    std::vector<int> imageOf() const;
    // Identifies a particle by the rank that owns it and its number on that rank.
    struct Origin {
        int rank, particle;
        bool operator==(const Origin&) const = default;
        bool operator<(const Origin& other) const {
            return std::tie(rank, particle) < std::tie(other.rank, other.particle);
        }
    };
    // The particle that each ghost is a copy of. Collective.
    std::vector<Origin> origins(int owned);
    // Velocity of each ghost less that of its origin, in a box whose images slide [m/s]. Collective.
    std::vector<Vec3> slides(int owned);
    // Own particles that are ghosts on other ranks: pairs of (other rank, number of the own particle here), sorted and
    // without duplicates.
    std::vector<Origin> copies() const;
    // Adds the sums at images of own particles, `count` numbers a particle, to the sums of the particles; the sums at
    // images are 0 afterwards.
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
    std::vector<std::uint16_t> sendImage_;  // periodic image as which each entry is sent: index into images_
    std::vector<Periodicity::Image> images_;
    std::vector<Message> sends_, receives_;
    Message selfSend_{}, selfReceive_{};
    std::vector<int> slot_;  // ghost number of the k-th received ghost
    std::vector<std::byte> sendBuffer_, receiveBuffer_;
    std::vector<MPI_Request> requests_;
};

}  // namespace corpuscle::particles
