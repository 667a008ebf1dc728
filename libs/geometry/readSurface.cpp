#include "geometry/readSurface.hpp"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace corpuscle::geometry {
namespace {

struct Soup {
    std::vector<Vec3> points;
    std::vector<std::vector<int>> polygons;
};

Soup readVtp(const std::string& file) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    Soup soup;
    vtkPolyData* data = reader->GetOutput();
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) soup.points.emplace_back(data->GetPoint(i));
    for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
        vtkCell* cell = data->GetCell(c);
        if (cell->GetCellDimension() != 2) continue;
        auto& polygon = soup.polygons.emplace_back();
        for (int n = 0; n < cell->GetNumberOfPoints(); ++n) polygon.push_back(static_cast<int>(cell->GetPointId(n)));
    }
    return soup;
}

Soup readByCgal(const std::string& file) {
    using Point = CGAL::Simple_cartesian<double>::Point_3;
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> polygons;
    Soup soup;
    if (!CGAL::IO::read_polygon_soup(file, points, polygons)) return soup;
    for (const Point& p : points) soup.points.emplace_back(p.x(), p.y(), p.z());
    for (const auto& polygon : polygons) soup.polygons.emplace_back(polygon.begin(), polygon.end());
    return soup;
}

}  // namespace

TriangleMesh readSurface(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::vector<std::string> known{".stl", ".off", ".ply", ".vtp"};
    if (std::find(known.begin(), known.end(), ending) == known.end())
        throw Failure(ExitCode::io, fmt::format("{}: a surface is read from .stl, .off, .ply or .vtp, not from '{}'",
                                                file.string(), ending));
    if (!std::filesystem::is_regular_file(file))
        throw Failure(ExitCode::io,
                      fmt::format("{}: there is no such file (paths are relative to the case)", file.string()));
    const Soup soup = ending == ".vtp" ? readVtp(file.string()) : readByCgal(file.string());
    if (soup.polygons.empty())
        throw Failure(ExitCode::io, fmt::format("{}: no triangles could be read from it", file.string()));

    TriangleMesh mesh;
    std::map<std::array<double, 3>, int> places;
    std::vector<int> number;
    for (const Vec3& x : soup.points) {
        const auto [place, isNew] = places.try_emplace({x.x(), x.y(), x.z()}, static_cast<int>(mesh.nodes.size()));
        if (isNew) mesh.nodes.push_back(x);
        number.push_back(place->second);
    }
    for (const std::vector<int>& polygon : soup.polygons)
        for (std::size_t n = 2; n < polygon.size(); ++n)
            mesh.triangles.push_back({number[polygon[0]], number[polygon[n - 1]], number[polygon[n]]});
    if (mesh.volume() < 0) mesh.flip();
    return mesh;
}

}  // namespace corpuscle::geometry
