// List of all kernels. A new kernel needs a header and an entry in this list: a case can then choose it by its name,
// and it is built into every pair loop.
#pragma once
#include <stdexcept>
#include <type_traits>

#include "sph/lucy.hpp"
#include "sph/quintic.hpp"
#include "sph/wendlandC2.hpp"

namespace corpuscle::sph {

enum class KernelKind : int {};  // index into the list

template <class... Formula>
struct KernelList {
    // The result of f.operator()<Formula>() for this kernel.
    template <class F>
    static auto visit(KernelKind kind, F&& f) {
        using Result = std::common_type_t<decltype(f.template operator()<Formula>())...>;
        Result result{};
        int place = 0;
        const bool found =
            ((static_cast<int>(kind) == place++ && (result = f.template operator()<Formula>(), true)) || ...);
        if (!found) throw std::logic_error("there is no kernel of this number");
        return result;
    }
    // Calls f.operator()<Formula>(kind) for every kernel.
    template <class F>
    static void each(F&& f) {
        int place = 0;
        (f.template operator()<Formula>(static_cast<KernelKind>(place++)), ...);
    }
    template <class Wanted>
    static constexpr KernelKind kindOf() {
        static_assert((std::is_same_v<Wanted, Formula> || ...), "this kernel is not in the list");
        int place = 0;
        (void)((std::is_same_v<Wanted, Formula> || (++place, false)) || ...);
        return static_cast<KernelKind>(place);
    }
};

using Kernels = KernelList<Lucy, Quintic, WendlandC2>;

}  // namespace corpuscle::sph
