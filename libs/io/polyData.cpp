#include "io/polyData.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "core/error.hpp"
#include "io/dataChecksum.hpp"
#include "io/publish.hpp"
#include "io/vtkMessages.hpp"
#include "io/vtpWriter.hpp"

namespace corpuscle::io {
namespace {

template <class T>
const T& findArray(const Arrays& arrays, const std::map<std::string, T>& wanted, const std::string& name,
                   const char* type) {
    if (const auto found = wanted.find(name); found != wanted.end()) return found->second;
    const std::string where = arrays.where.empty() ? "array" : arrays.where;
    const char* is = arrays.scalars.contains(name)    ? "holds one floating-point number each"
                     : arrays.vectors.contains(name)  ? "holds vectors"
                     : arrays.integers.contains(name) ? "holds integers"
                                                      : nullptr;
    if (is) throw Failure(ExitCode::io, fmt::format("{} '{}' {}; {} are needed.", where, name, is, type));
    if (const auto other = arrays.others.find(name); other != arrays.others.end()) {
        throw Failure(ExitCode::io, fmt::format("{} '{}' {}; {} are needed.", where, name, other->second, type));
    }
    const auto names = arrays.names();
    throw Failure(ExitCode::io, fmt::format("{} '{}' ({}) is missing; there {}: {}.{}", where, name, type,
                                            names.size() == 1 ? "is" : "are", names.empty() ? "none" : joinWords(names),
                                            didYouMean(name, names)));
}

// VTK views of our memory: the writer only reads, so nothing is copied.
vtkSmartPointer<vtkDoubleArray> view(const double* values, std::size_t rows, int components) {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetNumberOfComponents(components);
    if (rows > 0) array->SetArray(const_cast<double*>(values), static_cast<vtkIdType>(rows) * components, 1);
    return array;
}

vtkSmartPointer<vtkTypeInt64Array> copy(const std::vector<std::int64_t>& values) {
    auto array = vtkSmartPointer<vtkTypeInt64Array>::New();
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    if (!values.empty()) std::memcpy(array->GetPointer(0), values.data(), values.size() * sizeof(std::int64_t));
    return array;
}

void checkLength(const std::string& name, std::size_t length, std::size_t expected, const char* of) {
    if (length == expected) return;
    throw std::invalid_argument(fmt::format("array '{}' has {} entries for {} {}", name, length, expected, of));
}

void addArrays(vtkFieldData* target, const Arrays& arrays, std::size_t count, const char* of) {
    auto add = [&](const std::string& name, std::size_t length, vtkDataArray* array) {
        checkLength(name, length, count, of);
        array->SetName(name.c_str());
        target->AddArray(array);
    };
    for (const auto& [name, values] : arrays.scalars) add(name, values.size(), view(values.data(), values.size(), 1));
    for (const auto& [name, values] : arrays.vectors) {
        add(name, values.size(), view(values.empty() ? nullptr : values[0].data(), values.size(), 3));
    }
    for (const auto& [name, values] : arrays.integers) add(name, values.size(), copy(values));
}

std::size_t cellCount(const PolyData& data, Cells kind) {
    return kind == Cells::triangles ? data.triangles.size() : kind == Cells::lines ? data.lines.size() : 0;
}

// 32-bit cells: a piece never has 2^31 points, and the connectivity takes half the space. cornersOf(i): the points of
// cell i.
template <class F>
vtkSmartPointer<vtkCellArray> makeCells(std::size_t count, std::size_t pointCount, F&& cornersOf) {
    vtkNew<vtkTypeInt32Array> offsets, corners;
    offsets->SetNumberOfTuples(static_cast<vtkIdType>(count) + 1);
    offsets->SetValue(0, 0);
    for (std::size_t i = 0; i < count; ++i) {
        for (const int p : cornersOf(i)) {
            if (p < 0 || p >= static_cast<int>(pointCount)) {
                throw std::invalid_argument(fmt::format("cell {} names point {} of {}", i, p, pointCount));
            }
            corners->InsertNextValue(p);
        }
        offsets->SetValue(static_cast<vtkIdType>(i) + 1, static_cast<int>(corners->GetNumberOfTuples()));
    }
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->SetData(offsets, corners);
    return cells;
}

void addCells(vtkPolyData& poly, const PolyData& data, Cells kind) {
    const std::size_t points = data.points.size();
    if (!data.triangles.empty() && !data.lines.empty()) {
        throw std::invalid_argument("triangles and lines in one file");
    }
    switch (kind) {
        case Cells::vertices:
            return poly.SetVerts(
                makeCells(points, points, [](std::size_t i) { return std::array{static_cast<int>(i)}; }));
        case Cells::triangles:
            return poly.SetPolys(makeCells(data.triangles.size(), points,
                                           [&](std::size_t i) -> const Index3& { return data.triangles[i]; }));
        case Cells::lines:
            return poly.SetLines(makeCells(data.lines.size(), points,
                                           [&](std::size_t i) -> const std::vector<int>& { return data.lines[i]; }));
    }
}

}  // namespace

const std::vector<double>& Arrays::scalar(const std::string& name) const {
    return findArray(*this, scalars, name, "floating-point numbers");
}
const std::vector<Vec3>& Arrays::vector(const std::string& name) const {
    return findArray(*this, vectors, name, "vectors");
}
const std::vector<std::int64_t>& Arrays::integer(const std::string& name) const {
    return findArray(*this, integers, name, "integers");
}

std::vector<std::string> Arrays::names() const {
    std::vector<std::string> names;
    for (const auto& item : scalars) names.push_back(item.first);
    for (const auto& item : vectors) names.push_back(item.first);
    for (const auto& item : integers) names.push_back(item.first);
    for (const auto& item : others) names.push_back(item.first);
    std::sort(names.begin(), names.end());
    return names;
}

void writeVtp(const std::filesystem::path& path, const PolyData& data) {
    const Cells cells = !data.lines.empty()       ? Cells::lines
                        : !data.triangles.empty() ? Cells::triangles
                                                  : Cells::vertices;
    writeVtp(path, data, cells, {});
}

void writeVtp(const std::filesystem::path& path, const PolyData& data, Cells cells,
              const std::map<std::string, double>& field) {
    vtkNew<vtkPolyData> poly;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetData(view(data.points.empty() ? nullptr : data.points[0].data(), data.points.size(), 3));
    poly->SetPoints(points);
    addCells(*poly, data, cells);
    addArrays(poly->GetPointData(), data.point, data.points.size(), "points");
    addArrays(poly->GetCellData(), data.cell, cellCount(data, cells), cells == Cells::lines ? "lines" : "triangles");
    auto allFields = data.field;
    for (const auto& [name, value] : field) allFields[name] = value;
    for (const auto& [name, value] : allFields) {
        vtkNew<vtkDoubleArray> number;
        number->SetName(name.c_str());
        number->InsertNextValue(value);
        poly->GetFieldData()->AddArray(number);
    }
    auto texts = data.texts;
    if (!texts.empty()) texts[checksumText] = dataChecksum(data, allFields);
    for (const auto& [name, value] : texts) {
        vtkNew<vtkStringArray> text;
        text->SetName(name.c_str());
        text->InsertNextValue(value);
        poly->GetFieldData()->AddArray(text);
    }

    const auto temporary = temporaryName(path);
    VtkMessages messages;
    const auto writer = makeVtpWriter();
    writer->SetFileName(temporary.c_str());
    writer->SetInputData(poly);
    if (writer->Write() != 1 || writer->GetErrorCode() != 0 || messages.any()) throw notWritten(path, temporary);
    publish(temporary, path, Sync::none);
}

}  // namespace corpuscle::io
