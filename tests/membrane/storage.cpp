// operator new and delete that store the size in front of each block. Over-aligned blocks use the library's operators
// and are not counted.
#include "storage.hpp"

#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t front = alignof(std::max_align_t);
std::size_t stored = 0;

}  // namespace

std::size_t corpuscle::membrane::testing::storedBytes() { return stored; }

// With a sanitizer the library's form does not call the one below, and its blocks would have no size in front.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    void* const block = std::malloc(front + bytes);
    if (block == nullptr) {
        return nullptr;
    }
    *static_cast<std::size_t*>(block) = bytes;
    stored += bytes;
    return static_cast<char*>(block) + front;
}

void* operator new(std::size_t bytes) {
    void* const block = operator new(bytes, std::nothrow);
    if (block == nullptr) {
        throw std::bad_alloc();
    }
    return block;
}

void operator delete(void* place) noexcept {
    if (place != nullptr) {
        void* const block = static_cast<char*>(place) - front;
        stored -= *static_cast<const std::size_t*>(block);
        std::free(block);
    }
}

void operator delete(void* place, std::size_t) noexcept { operator delete(place); }
