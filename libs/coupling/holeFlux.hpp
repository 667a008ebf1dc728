// Flux of the fluid through the holes of torn membranes: for each sheet (volumeProjection.hpp)
//
//     H v = sum over the caps of its holes of int v.dA = sum_p A_p.sum_j w_pj v_j
//     w_pj = V_j W(|q|) (c0 + c.q),   q = (x_j - x_p)/R,   sum_j w_pj = 1,   sum_j w_pj q = 0
// symbol   | meaning                                                                                    | unit
// cap      | the triangles between the mean point of a rim and its edges, with normals out of the cell  |
// x_p, A_p | points of a cap at most a spacing apart, and the area vectors of its pieces around them    | m, m^2
// V_j, W   | volumes of the particles; Wendland's C2 function (nodeBasis.hpp)                           | m^3
// R        | 2 dx, as for nodes                                                                         | m
// The flux of a linear velocity field is exact. Moving least squares of first order: Lancaster and Salkauskas, Math.
// Comp. 37 (1981) 141. Where particles are on one side of a point only, so that sum_j |w_pj| might exceed 4, the
// weights are mixed with those of the plain mean (shareOfMean in nodeBasis.hpp); points without particles add nothing.
//
// A rank has the weights of its own particles, and of ghosts after `placeOthers`; sums are completed among the holders
// of the cell (holderSums.hpp). A rank that holds no torn cell sends and computes nothing.
#pragma once
#include "coupling/holderSums.hpp"
#include "coupling/nodeFluidMap.hpp"
#include "coupling/volumeProjection.hpp"

namespace corpuscle::coupling {

class HoleFlux {
  public:
    static constexpr double radiusInSpacings = NodeFluidMap::radiusInSpacings;

    explicit HoleFlux(double spacing) : spacing_(spacing), radius_(radiusInSpacings * spacing) {}

    // Computes the weights at the present positions; lists must be up to date. volume: of each particle [m^3].
    // Collective among the holders of torn cells.
    void place(const Cells& cells, const std::vector<TornSheet>& sheets, const particles::ParticleSystem& system,
               const std::vector<double>& volume);
    // Weights of ghosts, to be called right after `place`. ghosts: as NodeFluidMap::placeOthers needs them.
    void placeOthers(const particles::ParticleSystem& system, const particles::SharedParticles& shared,
                     const GhostRecords& ghosts);

    bool exist() const { return sheets_ > 0; }  // whether this rank holds a torn sheet
    // H v of each sheet, v of four numbers per particle [m^3/s]. Collective among holders.
    template <class Real>
    std::vector<double> of(const Real* v);
    // flux += H of the slide velocities of images, if images of the box slide.
    void addSlides(std::vector<double>& flux) const {
        for (std::size_t k = 0; k < slides_.size(); ++k) flux[k] += slides_[k];
    }
    // force_j += (H^T p)_j, of four numbers per particle, for pressures p of the sheets [Pa]: for own particles; for
    // ghosts, into their entries.
    void spread(const std::vector<double>& pressures, particles::RealArray& force) const {
        spreadBy(own_, pressures, force);
    }
    void spreadToOthers(const std::vector<double>& pressures, particles::RealArray& force) const {
        spreadBy(others_, pressures, force);
    }

    // Particles with weights; an index may occur more than once.
    template <class F>
    void forTouched(F&& f) const {
        for (const Entry& e : own_) f(e.particle);
    }
    template <class F>
    void forTouchedOthers(F&& f) const {  // entries of ghosts
        for (const Entry& e : others_) f(e.particle);
    }

  private:
    struct Point {
        std::size_t sheet;
        Vec3 x, area;
        double constant = 0;  // c0, c
        Vec3 slope = Vec3::Zero();
    };
    struct Near {  // a particle within R of a point
        int particle;
        double weight;  // V W
        Vec3 q;
    };
    struct Entry {
        std::size_t sheet;
        int particle;
        Vec3 area;  // sum_p w_pj A_p [m^2]
    };
    void findPoints(const Cells& cells, const std::vector<TornSheet>& sheets);
    void addCap(std::size_t sheet, const std::vector<Vec3>& x, const std::vector<int>& rim);
    void findNear(const particles::ParticleSystem& system, const std::vector<double>& volume);
    void findWeights(const Cells& cells, MPI_Comm comm);
    void findSlides(const particles::ParticleSystem& system);
    static double weightOf(const Near& near, const Point& point) {
        return near.weight * (point.constant + point.slope.dot(near.q));
    }
    void spreadBy(const std::vector<Entry>& entries, const std::vector<double>& pressures,
                  particles::RealArray& force) const;

    double spacing_, radius_;
    std::size_t sheets_ = 0;
    std::vector<std::size_t> sheetsOfCell_, pointsOfCell_;  // their numbers, of each held cell
    std::vector<Point> points_;                             // ordered by sheets
    std::vector<std::size_t> firstNear_;                    // first entry of each point in near_, and their number
    std::vector<Near> near_;                                // own particles
    std::vector<Entry> own_, others_;
    std::vector<double> slides_;  // of each sheet; empty if images of the box do not slide
    HolderSums atPoints_, ofSheets_;
};

}  // namespace corpuscle::coupling
