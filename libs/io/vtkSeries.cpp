#include "io/vtkSeries.hpp"

#include <fmt/format.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/atomicFile.hpp"
#include "core/communicator.hpp"
#include "core/error.hpp"
#include "core/together.hpp"
#include "io/publish.hpp"
#include "io/vtkMessages.hpp"

namespace corpuscle::io {
namespace {

constexpr double slack = 1e-9;  // relative to a time

constexpr const char* headerText =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
    "compressor=\"vtkLZ4DataCompressor\">\n";

std::string arrayTags(const Arrays& arrays) {
    constexpr const char* tag = "      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n";
    std::string text;
    for (const auto& item : arrays.scalars) text += fmt::format(tag, "Float64", item.first, 1);
    for (const auto& item : arrays.vectors) text += fmt::format(tag, "Float64", item.first, 3);
    for (const auto& item : arrays.integers) text += fmt::format(tag, "Int64", item.first, 1);
    return text;
}

// "stream_000012.pvtp" -> 12
int entryNumber(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    return std::atoi(stem.substr(stem.rfind('_') + 1).c_str());
}

}  // namespace

std::vector<SeriesEntry> readPvd(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        throw Failure(ExitCode::io, fmt::format("{}: there is no such file.", path.string()));
    }
    VtkMessages messages;
    const auto root = vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!collection)
        throw Failure(ExitCode::io, fmt::format("{}: the file is no ParaView collection (.pvd).", path.string()));
    std::vector<SeriesEntry> entries;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* element = collection->GetNestedElement(i);
        const char* file = element->GetAttribute("file");
        double time = 0;
        if (!file || element->GetScalarAttribute("timestep", time) != 1) {
            throw Failure(ExitCode::io, fmt::format("{}: entry {} has no file or no timestep.", path.string(), i + 1));
        }
        entries.push_back({time, path.parent_path() / file});
    }
    return entries;
}

void writePvd(const std::filesystem::path& path, const std::vector<SeriesEntry>& entries) {
    std::string text = fmt::format(headerText, "Collection") + "  <Collection>\n";
    for (const auto& entry : entries) {
        text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}/{}\"/>\n", entry.time,
                            path.stem().string(), entry.file.filename().string());
    }
    writeFileAtomically(path, text + "  </Collection>\n</VTKFile>\n");
}

bool isReservedStream(std::string_view name) {
    return name == "fluid" || name == "walls" || name == "bodies" || name == "holes" || name == "fault" ||
           name.starts_with("fault_");
}

VtkSeries::VtkSeries(MPI_Comm comm, const std::filesystem::path& caseDir, std::string stream, int keep,
                     double startTime)
    : comm_(comm), results_(caseDir / "results"), stream_(std::move(stream)), keep_(keep), startTime_(startTime) {
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
}

std::string VtkSeries::stepName(int number) const { return fmt::format("{}_{:06d}", stream_, number); }

void VtkSeries::removeFiles(const SeriesEntry& entry) const {
    std::error_code ignored;
    std::filesystem::remove(entry.file, ignored);
    auto pieces = entry.file;
    std::filesystem::remove_all(pieces.replace_extension(), ignored);
}

void VtkSeries::start() {
    if (started_) return;
    onRoot(comm_, [&] {
        const auto index = results_ / (stream_ + ".pvd");
        if (!std::filesystem::exists(index)) return;
        entries_ = readPvd(index);
        keepBefore(startTime_ - slack * std::abs(startTime_));
    });
    MPI_Bcast(&number_, 1, MPI_INT, 0, comm_);
    started_ = true;
}

void VtkSeries::goBack(double time) {
    if (!started_) return;
    onRoot(comm_, [&] {
        const double last = time + slack * std::abs(time);
        if (!entries_.empty()) keepBefore(std::nextafter(last, std::numeric_limits<double>::infinity()));
    });
    MPI_Bcast(&number_, 1, MPI_INT, 0, comm_);
}

void VtkSeries::keepBefore(double limit) {
    std::vector<SeriesEntry> kept, dropped;
    for (SeriesEntry& entry : entries_) (entry.time < limit ? kept : dropped).push_back(std::move(entry));
    entries_ = std::move(kept);
    writeIndex();
    for (const auto& entry : dropped) removeFiles(entry);
    number_ = entries_.empty() ? 0 : entryNumber(entries_.back().file) + 1;
}

Cells VtkSeries::agreeOnCells(const PolyData& piece) const {
    const Cells mine = !piece.lines.empty()                              ? Cells::lines
                       : !piece.triangles.empty() || !piece.cell.empty() ? Cells::triangles
                                                                         : Cells::vertices;
    auto agreed = static_cast<int>(mine);
    MPI_Allreduce(MPI_IN_PLACE, &agreed, 1, MPI_INT, MPI_MAX, comm_);
    return static_cast<Cells>(agreed);
}

void VtkSeries::writeIndex() const { writePvd(results_ / (stream_ + ".pvd"), entries_); }

void VtkSeries::write(double time, std::optional<double> strain, const PolyData& piece) {
    std::map<std::string, double> field = piece.field;
    field["TimeValue"] = time;
    if (strain) field["strain"] = *strain;
    start();
    const std::string name = stepName(number_);
    const auto folder = results_ / stream_;
    const std::string arrays = "    <PPointData>\n" + arrayTags(piece.point) + "    </PPointData>\n    <PCellData>\n" +
                               arrayTags(piece.cell) + "    </PCellData>\n";
    const Cells cells = agreeOnCells(piece);

    onRoot(comm_, [&] { makeFolder(folder / name); });
    try {
        together(comm_, [&] { writeVtp(folder / name / fmt::format("{}_{}.vtp", name, rank_), piece, cells, field); });
    } catch (const Failure&) {
        // No index names these pieces, and on a full disk their space is needed.
        std::error_code ignored;
        if (rank_ == 0) std::filesystem::remove_all(folder / name, ignored);
        throw;
    }

    const std::string rootArrays = Communicator(comm_).broadcast(arrays);
    throwTogether(comm_, arrays != rootArrays,
                  fmt::format("stream '{}': rank {} has other arrays than rank 0", stream_, rank_));

    onRoot(comm_, [&] {
        std::string text = fmt::format(headerText, "PPolyData") + "  <PPolyData GhostLevel=\"0\">\n" + arrays +
                           "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" "
                           "NumberOfComponents=\"3\"/>\n    </PPoints>\n";
        for (int rank = 0; rank < size_; ++rank)
            text += fmt::format("    <Piece Source=\"{0}/{0}_{1}.vtp\"/>\n", name, rank);
        writeFileAtomically(folder / (name + ".pvtp"), text + "  </PPolyData>\n</VTKFile>\n");
        entries_.push_back({time, folder / (name + ".pvtp")});
        std::vector<SeriesEntry> old;
        if (keep_ > 0 && entries_.size() > static_cast<std::size_t>(keep_)) {
            const auto first = entries_.end() - keep_;
            old.assign(entries_.begin(), first);
            entries_.erase(entries_.begin(), first);
        }
        writeIndex();
        for (const auto& entry : old) removeFiles(entry);
    });
    ++number_;
}

}  // namespace corpuscle::io
