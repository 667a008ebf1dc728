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
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "core/error.hpp"
#include "io/publish.hpp"
#include "io/vtkMessages.hpp"

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

// 32-bit cells: a piece never has 2^31 points, and its connectivity is half as large.
vtkSmartPointer<vtkCellArray> makeCells(const PolyData& data, Cells kind) {
    const auto perCell = kind == Cells::triangles ? 3 : 1;
    const auto count = kind == Cells::triangles ? data.triangles.size() : data.points.size();
    vtkNew<vtkTypeInt32Array> offsets, corners;
    offsets->SetNumberOfTuples(static_cast<vtkIdType>(count) + 1);
    corners->SetNumberOfTuples(static_cast<vtkIdType>(count) * perCell);
    for (vtkIdType i = 0; i <= static_cast<vtkIdType>(count); ++i) offsets->SetValue(i, static_cast<int>(i) * perCell);
    if (kind == Cells::vertices) {
        std::iota(corners->GetPointer(0), corners->GetPointer(0) + count, 0);
    } else {
        const auto pointCount = static_cast<int>(data.points.size());
        for (std::size_t i = 0; i < count; ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const int p = data.triangles[i][corner];
                if (p < 0 || p >= pointCount) {
                    throw std::invalid_argument(fmt::format("triangle {} names point {} of {}", i, p, pointCount));
                }
                corners->SetValue(static_cast<vtkIdType>(3 * i) + corner, p);
            }
        }
    }
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->SetData(offsets, corners);
    return cells;
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
    writeVtp(path, data, data.triangles.empty() ? Cells::vertices : Cells::triangles, {});
}

void writeVtp(const std::filesystem::path& path, const PolyData& data, Cells cells,
              const std::map<std::string, double>& field) {
    vtkNew<vtkPolyData> poly;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetData(view(data.points.empty() ? nullptr : data.points[0].data(), data.points.size(), 3));
    poly->SetPoints(points);
    if (cells == Cells::triangles) {
        poly->SetPolys(makeCells(data, cells));
    } else {
        poly->SetVerts(makeCells(data, cells));
    }
    addArrays(poly->GetPointData(), data.point, data.points.size(), "points");
    addArrays(poly->GetCellData(), data.cell, data.triangles.size(), "triangles");
    auto allFields = data.field;
    for (const auto& [name, value] : field) allFields[name] = value;
    for (const auto& [name, value] : allFields) {
        vtkNew<vtkDoubleArray> number;
        number->SetName(name.c_str());
        number->InsertNextValue(value);
        poly->GetFieldData()->AddArray(number);
    }
    for (const auto& [name, value] : data.texts) {
        vtkNew<vtkStringArray> text;
        text->SetName(name.c_str());
        text->InsertNextValue(value);
        poly->GetFieldData()->AddArray(text);
    }

    const auto temporary = temporaryName(path);
    VtkMessages messages;
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(temporary.c_str());
    writer->SetInputData(poly);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToLZ4();
    writer->SetHeaderTypeToUInt64();
    if (writer->Write() != 1 || writer->GetErrorCode() != 0 || messages.any()) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw Failure(ExitCode::io, fmt::format("cannot write {}: {}", path.string(),
                                                messages.any() ? messages.first() : "no space left or no permission"));
    }
    publish(temporary, path, Sync::none);
}

}  // namespace corpuscle::io
