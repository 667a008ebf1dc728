// All walls of a scene. A WallShape gives their positions, the flow their velocities.
#pragma once
#include <vector>

#include "boundary/wall.hpp"

namespace corpuscle::boundary {

class Walls {
  public:
    // Adds a wall at rest, with the next number.
    void add(std::string name, std::shared_ptr<const Surface> surface);
    void setVelocity(int number, const Vec3& velocity) {
        walls_.at(static_cast<std::size_t>(number)).velocity = velocity;
    }

    bool exist() const { return !walls_.empty(); }
    std::size_t count() const { return walls_.size(); }
    const Wall& operator[](std::size_t number) const { return walls_[number]; }
    auto begin() const { return walls_.begin(); }
    auto end() const { return walls_.end(); }

    // The wall nearest to x; of several at the same distance, the first. There must be a wall.
    const Wall& nearest(const Vec3& x) const;
    // Distance from the nearest wall [m]; infinite without walls.
    double distance(const Vec3& x) const;
    // The same for many points.
    void findDistances(const Points& points, std::vector<double>& distance) const;

  private:
    std::vector<Wall> walls_;
};

}  // namespace corpuscle::boundary
