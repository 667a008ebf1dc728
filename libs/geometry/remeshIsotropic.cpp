#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/surfaceAlgorithms.hpp"

namespace corpuscle::geometry {
namespace {
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

struct Projector {
    const Surface* surface;
    const Projection* project;
    Kernel::Point_3 operator()(Surface::Vertex_index v) const {
        const Kernel::Point_3& p = surface->point(v);
        const Vec3 x = (*project)(Vec3(p.x(), p.y(), p.z()));
        return {x.x(), x.y(), x.z()};
    }
};
}  // namespace

TriangleMesh remeshIsotropic(const TriangleMesh& mesh, double edge, int iterations, const Projection& project) {
    Surface surface;
    for (const Vec3& x : mesh.nodes) surface.add_vertex({x.x(), x.y(), x.z()});
    for (const auto& [i, j, k] : mesh.triangles)
        surface.add_face(Surface::Vertex_index(i), Surface::Vertex_index(j), Surface::Vertex_index(k));

    namespace pmp = CGAL::Polygon_mesh_processing;
    try {
        pmp::isotropic_remeshing(
            surface.faces(), edge, surface,
            pmp::parameters::number_of_iterations(iterations).projection_functor(Projector{&surface, &project}));
    } catch (const CGAL::Failure_exception&) {  // a collapse has laid two sheets on one another
        return {};
    }
    surface.collect_garbage();

    TriangleMesh result;
    for (const auto v : surface.vertices()) {
        const Kernel::Point_3& p = surface.point(v);
        result.nodes.push_back(project(Vec3(p.x(), p.y(), p.z())));
    }
    for (const auto f : surface.faces()) {
        Index3 t{};
        int s = 0;
        for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface))
            t[s++] = static_cast<int>(v.idx());
        result.triangles.push_back(t);
    }
    return result;
}

}  // namespace corpuscle::geometry
