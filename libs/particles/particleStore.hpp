// The particles that a rank owns: double state in structure of arrays, no padding, sorted in columns (columns.hpp).
//
// What is uniform in a scene is not stored: mass and viscosity arrays exist only where they vary, side only where there
// are cells, node only where there are membranes, member only where there are rigid bodies, solute only where the fluid
// carries one. Code that reorders, sends or saves particles uses forEachField, so that a new field only has to be
// listed in `visit`.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::particles {

// 64-byte aligned storage for vector loads. Large arrays begin at staggered cache lines: the system would place them
// all at the same offset within a page, and in a loop over a dozen arrays they would then compete for the same few
// cache lines.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&) {}
    T* allocate(std::size_t n) {
        constexpr std::size_t line = 64, lines = 4096 / line, large = 65536;
        static std::size_t next = 0;
        const std::size_t skipped = line * (1 + (n * sizeof(T) < large ? 0 : next++ * 5 % lines));
        char* const whole = static_cast<char*>(::operator new(n * sizeof(T) + skipped, std::align_val_t(line)));
        std::memcpy(whole + skipped - sizeof whole, &whole, sizeof whole);  // start of the allocation, for deallocate
        return reinterpret_cast<T*>(whole + skipped);
    }
    void deallocate(T* p, std::size_t) {
        char* whole = nullptr;
        std::memcpy(&whole, reinterpret_cast<char*>(p) - sizeof whole, sizeof whole);
        ::operator delete(whole, std::align_val_t(64));
    }
    bool operator==(const AlignedAllocator&) const { return true; }
};
template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;
using RealArray = AlignedVector<double>;
using IntegerArray = AlignedVector<std::int64_t>;

enum class Kind : std::int64_t { fluid = 0, membrane = 1, wall = 2, body = 3 };

// Particles that act on the fluid but do not move as fluid. Two of them do not act on each other, unless the lists are
// made to hold pairs within bodies (ParticleSystem::pairWithinBodies).
constexpr bool isBoundary(Kind kind) { return kind == Kind::wall || kind == Kind::body; }

class ParticleStore {
  public:
    struct Optional {
        bool mass = false, viscosity = false, side = false, node = false, member = false, solute = false;
        bool operator==(const Optional&) const = default;
    };

    RealArray x, y, z;                 // position [m]
    RealArray u, v, w;                 // velocity [m/s]
    RealArray density;                 // [kg/m^3]
    RealArray fx, fy, fz;              // acceleration from the last force evaluation [m/s^2]
    RealArray densityRate;             // [kg/(m^3 s)]
    RealArray xBuilt, yBuilt, zBuilt;  // position at the last list build [m]
    RealArray mass;                    // [kg], where it varies
    RealArray viscosity;               // dynamic viscosity [Pa s], where it varies
    RealArray solute;                  // mass of a solute that the particle carries [kg], where there is one
    IntegerArray id;                   // unique, stable
    IntegerArray kind;                 // Kind
    IntegerArray side;                 // 0 outside, n inside cell n
    IntegerArray node;                 // global number of the membrane node that is this particle, -1 for others
    IntegerArray member;               // number among the particles of all rigid bodies, -1 for others

    ParticleStore() = default;
    explicit ParticleStore(Optional fields) : optional_(fields) {}

    std::size_t size() const { return x.size(); }
    const Optional& optional() const { return optional_; }
    void resize(std::size_t n) {
        forEachField([n](std::string_view, auto& array) { array.resize(n); });
    }
    Vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    Vec3 velocity(std::size_t i) const { return {u[i], v[i], w[i]}; }
    void setPosition(std::size_t i, const Vec3& p) { x[i] = p[0], y[i] = p[1], z[i] = p[2]; }
    void setVelocity(std::size_t i, const Vec3& p) { u[i] = p[0], v[i] = p[1], w[i] = p[2]; }
    Kind kindOf(std::size_t i) const { return static_cast<Kind>(kind[i]); }

    // f(name, array&) for every array that exists: first the reals, then the integers.
    template <class F>
    void forEachField(F&& f) {
        visit(*this, f);
    }
    template <class F>
    void forEachField(F&& f) const {
        visit(*this, f);
    }

    // New order: particle i becomes the old particle order[i]; order may be shorter than size().
    void reorder(const std::vector<int>& order);

    std::size_t bytesPerParticle() const;

  private:
    template <class Self, class F>
    static void visit(Self& s, F&& f) {
        f("x", s.x), f("y", s.y), f("z", s.z);
        f("u", s.u), f("v", s.v), f("w", s.w);
        f("density", s.density);
        f("fx", s.fx), f("fy", s.fy), f("fz", s.fz), f("densityRate", s.densityRate);
        f("xBuilt", s.xBuilt), f("yBuilt", s.yBuilt), f("zBuilt", s.zBuilt);
        if (s.optional_.mass) f("mass", s.mass);
        if (s.optional_.viscosity) f("viscosity", s.viscosity);
        if (s.optional_.solute) f("solute", s.solute);
        f("id", s.id), f("kind", s.kind);
        if (s.optional_.side) f("side", s.side);
        if (s.optional_.node) f("node", s.node);
        if (s.optional_.member) f("member", s.member);
    }
    Optional optional_;
    RealArray spareReals_;  // memory for reorder, swapped with each array in turn
    IntegerArray spareIntegers_;
};

}  // namespace corpuscle::particles
