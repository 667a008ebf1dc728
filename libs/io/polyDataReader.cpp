#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <cstring>
#include <fstream>
#include <new>

#include "core/error.hpp"
#include "io/polyData.hpp"
#include "io/vtkMessages.hpp"

namespace corpuscle::io {
namespace {

// Rows of doubles, whatever the width in the file.
void copyDoubles(vtkDataArray& array, double* target) {
    const auto rows = array.GetNumberOfTuples();
    const int components = array.GetNumberOfComponents();
    if (rows == 0) return;
    if (array.GetDataType() == VTK_DOUBLE) {
        std::memcpy(target, array.GetVoidPointer(0), sizeof(double) * static_cast<std::size_t>(rows) * components);
    } else {
        for (vtkIdType i = 0; i < rows; ++i) array.GetTuple(i, target + i * components);
    }
}

std::vector<Vec3> toVectors(vtkDataArray& array) {
    std::vector<Vec3> values(static_cast<std::size_t>(array.GetNumberOfTuples()));
    if (!values.empty()) copyDoubles(array, values[0].data());
    return values;
}

std::vector<std::int64_t> toIntegers(vtkDataArray& array) {
    std::vector<std::int64_t> values(static_cast<std::size_t>(array.GetNumberOfTuples()));
    if (array.GetDataTypeSize() == sizeof(std::int64_t) && !values.empty()) {
        std::memcpy(values.data(), array.GetVoidPointer(0), values.size() * sizeof(std::int64_t));
    } else {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = static_cast<std::int64_t>(array.GetComponent(static_cast<vtkIdType>(i), 0));
        }
    }
    return values;
}

void readArrays(vtkDataSetAttributes& source, const std::string& where, Arrays& arrays) {
    arrays.where = where;
    for (int i = 0; i < source.GetNumberOfArrays(); ++i) {
        vtkDataArray* array = source.GetArray(i);
        if (!array || !array->GetName()) continue;
        const std::string name = array->GetName();
        const bool floating = array->GetDataType() == VTK_DOUBLE || array->GetDataType() == VTK_FLOAT;
        const int components = array->GetNumberOfComponents();
        if (floating && components == 1) {
            auto& values = arrays.scalars[name];
            values.resize(static_cast<std::size_t>(array->GetNumberOfTuples()));
            copyDoubles(*array, values.data());
        } else if (floating && components == 3) {
            arrays.vectors[name] = toVectors(*array);
        } else if (!floating && components == 1) {
            arrays.integers[name] = toIntegers(*array);
        } else {
            arrays.others[name] = fmt::format("has {} {} each", components, floating ? "components" : "integers");
        }
    }
}

// The points of each cell. fail(text) makes the exception for a cell that names none.
template <class F>
std::vector<std::vector<int>> toCells(vtkCellArray& source, std::size_t pointCount, F&& fail) {
    std::vector<std::vector<int>> all;
    const auto cells = vtk::TakeSmartPointer(source.NewIterator());
    for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell()) {
        vtkIdType count = 0;
        const vtkIdType* corners = nullptr;
        cells->GetCurrentCell(count, corners);
        auto& cell = all.emplace_back();
        for (int i = 0; i < count; ++i) {
            if (corners[i] < 0 || corners[i] >= static_cast<vtkIdType>(pointCount))
                throw fail(fmt::format("cell {} names point {} of {}.", all.size() - 1, corners[i], pointCount));
            cell.push_back(static_cast<int>(corners[i]));
        }
    }
    return all;
}

// VTK reports a cut file only where an array runs short; the closing tag says it for every file.
void checkWhole(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        throw Failure(ExitCode::io, fmt::format("{}: there is no such file.", path.string()));
    }
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        throw Failure(ExitCode::io,
                      fmt::format("{}: the file cannot be opened; check its permissions.", path.string()));
    const auto size = static_cast<std::streamoff>(file.tellg());
    const std::streamoff tail = std::min<std::streamoff>(size, 64);
    std::string end(static_cast<std::size_t>(tail), ' ');
    file.seekg(size - tail);
    file.read(end.data(), tail);
    if (end.find("</VTKFile>") == std::string::npos) {
        throw Failure(ExitCode::io, fmt::format("{}: the file is cut off or no VTK XML file ({} bytes, without its "
                                                "closing </VTKFile>); write it again.",
                                                path.string(), size));
    }
}

void append(Arrays& all, const Arrays& piece, const std::string& where) {
    auto join = [](auto& target, const auto& source) {
        for (const auto& [name, values] : source) target[name].insert(target[name].end(), values.begin(), values.end());
    };
    join(all.scalars, piece.scalars);
    join(all.vectors, piece.vectors);
    join(all.integers, piece.integers);
    all.others.insert(piece.others.begin(), piece.others.end());
    all.where = where;
}

}  // namespace

PolyData readVtp(const std::filesystem::path& path) {
    checkWhole(path);
    VtkMessages messages;
    vtkNew<vtkXMLPolyDataReader> reader;
    const auto fail = [&](const std::string& what) -> Failure {
        return {ExitCode::io, fmt::format("{}: {}", path.string(), what)};
    };
    if (!reader->CanReadFile(path.c_str())) throw fail("the file is no VTK XML PolyData (.vtp).");
    reader->SetFileName(path.c_str());
    try {
        reader->Update();
    } catch (const std::bad_alloc&) {
        throw fail("the file is corrupt: a block claims more memory than there is.");
    }
    if (messages.any() || reader->GetErrorCode() != 0)
        throw fail(messages.any() ? messages.first() : "the file cannot be read.");
    vtkPolyData* poly = reader->GetOutput();

    PolyData data;
    if (poly->GetPoints()) data.points = toVectors(*poly->GetPoints()->GetData());
    if (poly->GetNumberOfStrips() > 0) throw fail("only points, triangles and lines are read, the file has strips.");
    if (poly->GetNumberOfLines() > 0 && poly->GetNumberOfPolys() > 0)
        throw fail("triangles or lines are read, the file has both.");
    data.lines = toCells(*poly->GetLines(), data.points.size(), fail);
    for (const std::vector<int>& corners : toCells(*poly->GetPolys(), data.points.size(), fail)) {
        if (corners.size() != 3)
            throw fail(
                fmt::format("cell {} has {} corners; only triangles are read.", data.triangles.size(), corners.size()));
        data.triangles.push_back({corners[0], corners[1], corners[2]});
    }
    readArrays(*poly->GetPointData(), path.string() + ": point array", data.point);
    if (poly->GetNumberOfVerts() > 0 && poly->GetCellData()->GetNumberOfArrays() > 0) {
        throw fail("arrays on vertex cells are not read; put them on the points.");
    }
    readArrays(*poly->GetCellData(), path.string() + ": cell array", data.cell);
    vtkFieldData* field = poly->GetFieldData();
    for (int i = 0; i < field->GetNumberOfArrays(); ++i) {
        vtkDataArray* array = field->GetArray(i);
        if (array && array->GetName() && array->GetNumberOfValues() == 1)
            data.field[array->GetName()] = array->GetComponent(0, 0);
        auto* text = vtkStringArray::SafeDownCast(field->GetAbstractArray(i));
        if (text && text->GetName() && text->GetNumberOfValues() == 1) data.texts[text->GetName()] = text->GetValue(0);
    }
    return data;
}

PolyData readPvtp(const std::filesystem::path& path) {
    checkWhole(path);
    VtkMessages messages;
    const auto root = vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    vtkXMLDataElement* pieces = root ? root->FindNestedElementWithName("PPolyData") : nullptr;
    if (!pieces)
        throw Failure(ExitCode::io, fmt::format("{}: the file is no VTK XML PPolyData (.pvtp).", path.string()));

    PolyData all;
    for (int i = 0; i < pieces->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* element = pieces->GetNestedElement(i);
        const char* source = element->GetAttribute("Source");
        if (std::strcmp(element->GetName(), "Piece") != 0 || !source) continue;
        const PolyData piece = readVtp(path.parent_path() / source);
        const int first = static_cast<int>(all.points.size());
        all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
        for (const auto& t : piece.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        for (std::vector<int> line : piece.lines) {
            for (int& corner : line) corner += first;
            all.lines.push_back(std::move(line));
        }
        append(all.point, piece.point, path.string() + ": point array");
        append(all.cell, piece.cell, path.string() + ": cell array");
        all.field.insert(piece.field.begin(), piece.field.end());
    }
    return all;
}

}  // namespace corpuscle::io
