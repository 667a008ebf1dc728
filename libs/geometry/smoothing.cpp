#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/surfaceAlgorithms.hpp"

namespace corpuscle::geometry {
namespace {

int place(const Index3& t, int value) { return t[0] == value ? 0 : t[1] == value ? 1 : 2; }

// A closed triangulation with the neighbour across each side: side s of triangle t runs from node s to node s+1.
class FlipMesh {
  public:
    explicit FlipMesh(TriangleMesh& mesh)
        : mesh_(mesh), across_(mesh.triangles.size()), valence_(mesh.nodes.size(), 0) {
        for (const MeshEdge& e : mesh.edges()) {
            across_[e.left][side(e.left, e.a, e.b)] = e.right;
            across_[e.right][side(e.right, e.b, e.a)] = e.left;
            ++valence_[e.a];
            ++valence_[e.b];
        }
    }

    // Flips edges whose opposite angles add up to more than pi, until none is left (bounded).
    void makeDelaunay() {
        flipAll([this](int a, int b, int c, int d) {
            const auto& x = mesh_.nodes;
            return cornerAngle(x[c], x[a], x[b]) + cornerAngle(x[d], x[b], x[a]) > std::numbers::pi + 1e-9;
        });
    }

    // Flips edges where that brings the numbers of edges at the four nodes nearer to 6 (in the sum of squares).
    void evenValences() {
        flipAll(
            [this](int a, int b, int c, int d) { return valence_[a] + valence_[b] - valence_[c] - valence_[d] > 2; });
    }

  private:
    // Edge a-b, with c and d opposite to it.
    template <class Better>
    void flipAll(const Better& better) {
        for (int sweep = 0; sweep < 10; ++sweep) {
            int flips = 0;
            for (int t = 0; t < static_cast<int>(across_.size()); ++t)
                for (int s = 0; s < 3; ++s) flips += flipIf(better, t, s);
            if (flips == 0) return;
        }
    }

    int side(int t, int from, int to) const {
        const Index3& n = mesh_.triangles[t];
        for (int s = 0; s < 3; ++s)
            if (n[s] == from && n[(s + 1) % 3] == to) return s;
        return 0;
    }

    bool joined(int a, int b, int start) const {  // is there an edge a-b? turns around a from triangle `start`
        int t = start;
        do {
            const int s = place(mesh_.triangles[t], a);
            if (mesh_.triangles[t][(s + 1) % 3] == b || mesh_.triangles[t][(s + 2) % 3] == b) return true;
            t = across_[t][s];
        } while (t != start);
        return false;
    }

    template <class Better>
    bool flipIf(const Better& better, int t, int s) {
        const int u = across_[t][s];
        if (u < t) return false;  // each edge once
        Index3& T = mesh_.triangles[t];
        Index3& U = mesh_.triangles[u];
        const int a = T[s], b = T[(s + 1) % 3], c = T[(s + 2) % 3];
        const int su = side(u, b, a), d = U[(su + 2) % 3];
        if (valence_[a] <= 4 || valence_[b] <= 4 || !better(a, b, c, d) || joined(c, d, t)) return false;
        // The two new triangles must face the same way as the old ones: no fold over a sharply bent edge.
        const Vec3 old = normal(a, b, c) + normal(b, a, d), first = normal(c, d, b), second = normal(d, c, a);
        if (!(first.dot(old) > 0 && second.dot(old) > 0 && first.normalized().dot(second.normalized()) > 0.5))
            return false;

        const int bc = across_[t][(s + 1) % 3], ca = across_[t][(s + 2) % 3];
        const int ad = across_[u][(su + 1) % 3], db = across_[u][(su + 2) % 3];
        T = {c, d, b};
        U = {d, c, a};
        across_[t] = {u, db, bc};
        across_[u] = {t, ca, ad};
        across_[db][side(db, b, d)] = t;
        across_[ca][side(ca, a, c)] = u;
        --valence_[a], --valence_[b], ++valence_[c], ++valence_[d];
        return true;
    }

    Vec3 normal(int i, int j, int k) const {
        return (mesh_.nodes[j] - mesh_.nodes[i]).cross(mesh_.nodes[k] - mesh_.nodes[i]);
    }

    TriangleMesh& mesh_;
    std::vector<Index3> across_;
    std::vector<int> valence_;
};

}  // namespace

TriangleMesh refineOnce(const TriangleMesh& mesh, const Projection& project) {
    TriangleMesh fine;
    fine.nodes = mesh.nodes;
    const std::vector<MeshEdge> edges = mesh.edges();
    std::vector<Index3> middle(mesh.triangles.size());  // node in the middle of side s of each triangle
    for (const MeshEdge& e : edges) {
        const int node = static_cast<int>(fine.nodes.size());
        fine.nodes.push_back(project((mesh.nodes[e.a] + mesh.nodes[e.b]) / 2));
        middle[e.left][place(mesh.triangles[e.left], e.a)] = node;
        middle[e.right][place(mesh.triangles[e.right], e.b)] = node;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = mesh.triangles[t];
        const auto& [ij, jk, ki] = middle[t];
        fine.triangles.insert(fine.triangles.end(), {{i, ij, ki}, {ij, j, jk}, {ki, jk, k}, {ij, jk, ki}});
    }
    return fine;
}

void smooth(TriangleMesh& mesh, int rounds, const Projection& project) {
    FlipMesh flips(mesh);
    std::vector<Vec3> sum(mesh.nodes.size());
    std::vector<int> count(mesh.nodes.size());
    flips.evenValences();
    for (int round = 0; round < rounds; ++round) {
        if (round >= rounds / 2) flips.makeDelaunay();  // before that, the nodes settle around their new neighbours
        std::fill(sum.begin(), sum.end(), Vec3::Zero());
        std::fill(count.begin(), count.end(), 0);
        for (const Index3& t : mesh.triangles)
            for (int s = 0; s < 3; ++s) {  // each neighbour is seen once as the next node around a closed fan
                sum[t[s]] += mesh.nodes[t[(s + 1) % 3]];
                ++count[t[s]];
            }
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            const Vec3 mean = sum[n] / count[n];
            mesh.nodes[n] = project(mesh.nodes[n] + 0.7 * (mean - mesh.nodes[n]));
        }
    }
    flips.makeDelaunay();
}

double smallestAngle(const TriangleMesh& mesh) {
    double least = std::numbers::pi;
    for (const Index3& t : mesh.triangles)
        for (int s = 0; s < 3; ++s)
            least =
                std::min(least, cornerAngle(mesh.nodes[t[s]], mesh.nodes[t[(s + 1) % 3]], mesh.nodes[t[(s + 2) % 3]]));
    return least * 180 / std::numbers::pi;
}

double meanEdge(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Index3& t : mesh.triangles)
        for (int s = 0; s < 3; ++s) sum += (mesh.nodes[t[s]] - mesh.nodes[t[(s + 1) % 3]]).norm();
    return sum / (3 * static_cast<double>(mesh.triangles.size()));  // each edge twice, 3/2 edges per triangle
}

}  // namespace corpuscle::geometry
