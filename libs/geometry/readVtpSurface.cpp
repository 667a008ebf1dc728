#include <fmt/format.h>

#include "core/error.hpp"
#include "geometry/surfaceFile.hpp"
#include "io/vtpFile.hpp"

namespace corpuscle::geometry {

// Polygons and triangle strips of all pieces; points and lines are ignored.
PolygonSoup readVtpSurface(std::string_view bytes) {
    if (bytes.find("</VTKFile>", bytes.size() < 64 ? 0 : bytes.size() - 64) == std::string_view::npos)
        throw SurfaceFault(fmt::format(
            "the file is cut off or no VTK XML file ({} bytes, without its closing </VTKFile>)", bytes.size()));
    io::VtpFile file;
    try {
        file = io::parseVtp(bytes, "");
    } catch (const Failure& failure) {
        const std::string text = failure.what();  // ": what is wrong."
        throw SurfaceFault(text.substr(2, text.size() - 3));
    }
    PolygonSoup soup;
    for (const io::VtpPiece& piece : file.pieces) {
        const int first = static_cast<int>(soup.points.size());
        for (std::size_t i = 0; i < piece.points.size(); ++i) {
            if (!piece.points[i].allFinite())
                throw SurfaceFault(fmt::format("point {} has a coordinate that is not a finite number", i));
            soup.points.push_back(piece.points[i]);
        }
        for (std::size_t i = 0; i < piece.polygons.count(); ++i) {
            auto& polygon = soup.polygons.emplace_back(piece.polygons.cell(i));
            if (polygon.size() < 3)
                throw SurfaceFault(fmt::format("polygon {} has {} corners; at least 3 are needed", i, polygon.size()));
            for (int& p : polygon) p += first;
        }
        for (std::size_t i = 0; i < piece.strips.count(); ++i) {
            const std::vector<int> strip = piece.strips.cell(i);
            for (std::size_t k = 2; k < strip.size(); ++k) {
                const std::size_t odd = k % 2;  // every second triangle of a strip runs the other way round
                soup.polygons.push_back({strip[k - 2 + odd] + first, strip[k - 1 - odd] + first, strip[k] + first});
            }
        }
    }
    return soup;
}

}  // namespace corpuscle::geometry
