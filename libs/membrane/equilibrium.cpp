#include "membrane/equilibrium.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

constexpr double sufficientDecrease = 1e-4;
constexpr int halvings = 12, exactPause = 8;
constexpr double leastShift = 1e-10, firstShift = 1e-6, greatestExactShift = 0.1,
                 greatestShift = 1e6;  // relative to the mean diagonal

class Equilibrium {
  public:
    Equilibrium(Membrane& membrane, const Loads& loads, const EquilibriumOptions& options)
        : membrane_(membrane), loads_(loads), options_(options), nodes_(membrane.position.size()) {
        const auto check = [&](std::size_t size, const char* what) {
            if (size != 0 && size != nodes_) {
                throw Failure(ExitCode::invalidCase, std::string(what) + " are given for " + std::to_string(size) +
                                                         " nodes of a membrane that has " + std::to_string(nodes_));
            }
        };
        check(loads.force.size(), "loads");
        check(loads.held.size(), "held coordinates");
        if (loads.pressure != 0 && membrane.network().isOpen()) {
            throw Failure(ExitCode::invalidCase, "the membrane '" + membrane.name + "' is open: it bears no pressure");
        }
        number_.assign(3 * nodes_, -1);
        for (std::size_t k = 0; k < number_.size(); ++k) {
            if (loads.held.empty() || !loads.held[k / 3][k % 3]) {
                number_[k] = free_++;
            }
        }
        for (const Vec3& f : loads.force) {
            scale_ = std::max(scale_, f.cwiseAbs().maxCoeff());
        }
        scale_ = std::max(scale_, options.forceScale);
    }

    EquilibriumReport find() {
        EquilibriumReport report;
        double potential = work();
        if (!std::isfinite(potential)) {
            throw Failure(ExitCode::numerics, "the energy of the membrane '" + membrane_.name +
                                                  "' is not finite where its equilibrium is to be looked for");
        }
        double exactShift = leastShift, shift = firstShift;
        int nextExact = 0;
        for (; report.iterations <= options_.iterations; ++report.iterations) {
            const Eigen::VectorXd residual = force();
            report.residual = free_ > 0 ? residual.cwiseAbs().maxCoeff() : 0;
            report.converged = report.residual <= options_.tolerance * scale_;
            if (report.converged || report.iterations == options_.iterations) {
                break;
            }
            bool moved = false;
            if (report.iterations >= nextExact) {
                moved = descend(Definiteness::exact, exactShift, greatestExactShift, residual, potential);
                nextExact = moved ? 0 : report.iterations + exactPause;
            }
            moved = moved || descend(Definiteness::semiDefinite, shift, greatestShift, residual, potential);
            if (!moved) {
                break;
            }
        }
        report.potential = potential;
        membrane_.computeForces();
        return report;
    }

  private:
    // Pi. The reference point of the volume is the first node and moves with it, which does not matter for closed
    // surfaces.
    double work() const {
        double sum = membrane_.energy();
        for (std::size_t n = 0; n < loads_.force.size(); ++n) {
            sum -= loads_.force[n].dot(membrane_.position[n]);
        }
        for (const auto& term : loads_.terms) {
            sum += term->energy(membrane_.position);
        }
        return loads_.pressure != 0 ? sum - loads_.pressure * membrane_.volume() : sum;
    }

    // Free components of -dPi/dx.
    Eigen::VectorXd force() {
        membrane_.computeForces();
        std::vector<Vec3> total = membrane_.force;
        for (std::size_t n = 0; n < loads_.force.size(); ++n) {
            total[n] += loads_.force[n];
        }
        if (loads_.pressure != 0) {
            const std::vector<Vec3> gradient = volumeGradient(membrane_.position, membrane_.network().triangles());
            for (std::size_t n = 0; n < nodes_; ++n) {
                total[n] += loads_.pressure * gradient[n];
            }
        }
        for (const auto& term : loads_.terms) {
            term->addForces(membrane_.position, total);
        }
        Eigen::VectorXd result(free_);
        for (std::size_t k = 0; k < number_.size(); ++k) {
            if (number_[k] >= 0) {
                result[number_[k]] = total[k / 3][static_cast<int>(k % 3)];
            }
        }
        return result;
    }

    void assemble(Definiteness definiteness) {
        AssembledStiffness stiffness(nodes_);
        membrane_.addStiffness(definiteness, stiffness);
        if (loads_.pressure != 0) {
            addVolumeCurvature(membrane_.network(), membrane_.position, -loads_.pressure, Definiteness::exact,
                               stiffness);
        }
        for (const auto& term : loads_.terms) {
            term->addStiffness(membrane_.position, definiteness, stiffness);
        }
        const Eigen::SparseMatrix<double> all = stiffness.sparse();
        std::vector<Eigen::Triplet<double>> entries;
        for (Eigen::Index column = 0; column < all.outerSize(); ++column) {
            for (Eigen::SparseMatrix<double>::InnerIterator entry(all, column); entry; ++entry) {
                const int i = number_[static_cast<std::size_t>(entry.row())];
                const int j = number_[static_cast<std::size_t>(entry.col())];
                if (i >= 0 && j >= 0) {
                    entries.emplace_back(i, j, entry.value());
                }
            }
        }
        matrix_.resize(free_, free_);
        matrix_.setFromTriplets(entries.begin(), entries.end());
        diagonal_ = matrix_.diagonal().cwiseAbs().mean();
        rankOne_.resize(free_, static_cast<Eigen::Index>(stiffness.rankOne().size()));
        Eigen::Index column = 0;
        for (const auto& part : stiffness.rankOne()) {
            for (std::size_t k = 0; k < number_.size(); ++k) {
                if (number_[k] >= 0) {
                    rankOne_(number_[k], column) = std::sqrt(part.factor) * part.vector[static_cast<Eigen::Index>(k)];
                }
            }
            ++column;
        }
        solver_.analyzePattern(matrix_);
    }

    // (K + R R^T + s I)^-1 r by Woodbury; empty where K + s I is not positive definite.
    std::optional<Eigen::VectorXd> solve(double shift, const Eigen::VectorXd& residual) {
        solver_.setShift(shift * diagonal_);
        solver_.factorize(matrix_);
        if (solver_.info() != Eigen::Success || !(solver_.vectorD().minCoeff() > 0)) {
            return std::nullopt;
        }
        Eigen::VectorXd step = solver_.solve(residual);
        if (rankOne_.cols() > 0) {
            const Eigen::MatrixXd solved = solver_.solve(rankOne_);
            const Eigen::MatrixXd small =
                Eigen::MatrixXd::Identity(rankOne_.cols(), rankOne_.cols()) + rankOne_.transpose() * solved;
            step -= solved * small.ldlt().solve(rankOne_.transpose() * step);
        }
        return step;
    }

    // Makes a step with the smallest shift, from the given one upwards, that makes the matrix positive definite and Pi
    // fall; the next call starts lower.
    bool descend(Definiteness definiteness, double& shift, double greatest, const Eigen::VectorXd& residual,
                 double& potential) {
        assemble(definiteness);
        for (; shift <= greatest; shift = std::max(16 * shift, firstShift)) {
            if (const auto step = solve(shift, residual); step && tryStep(*step, residual, potential)) {
                shift = shift > firstShift ? shift / 4 : leastShift;
                return true;
            }
        }
        shift = greatest;
        return false;
    }

    bool tryStep(const Eigen::VectorXd& step, const Eigen::VectorXd& residual, double& potential) {
        const std::vector<Vec3> start = membrane_.position;
        const double slope = residual.dot(step), rounding = 1e-13 * std::abs(potential);
        if (!(slope > 0)) {
            return false;
        }
        double length = std::min(1.0, loads_.longestStep / step.cwiseAbs().maxCoeff());
        for (int k = 0; k < halvings; ++k, length /= 2) {
            for (std::size_t c = 0; c < number_.size(); ++c) {
                const int axis = static_cast<int>(c % 3);
                if (number_[c] >= 0) {
                    membrane_.position[c / 3][axis] = start[c / 3][axis] + length * step[number_[c]];
                }
            }
            const double now = work();
            if (now <= potential - sufficientDecrease * length * slope + rounding) {
                potential = now;
                return true;
            }
        }
        membrane_.position = start;
        return false;
    }

    Membrane& membrane_;
    const Loads& loads_;
    EquilibriumOptions options_;
    std::size_t nodes_;
    std::vector<int> number_;  // number of each coordinate among the free ones; -1: held
    int free_ = 0;
    double scale_ = 0, diagonal_ = 0;
    Eigen::SparseMatrix<double> matrix_;
    Eigen::MatrixXd rankOne_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace

EquilibriumReport findEquilibrium(Membrane& membrane, const Loads& loads, const EquilibriumOptions& options) {
    return Equilibrium(membrane, loads, options).find();
}

}  // namespace corpuscle::membrane
