#include <fmt/format.h>

#include <numeric>
#include <stdexcept>

#include "core/communicator.hpp"
#include "core/startMpi.hpp"
#include "core/together.hpp"
#include "io/checkpointFile.hpp"
#include "io/checksum.hpp"
#include "io/contents.hpp"
#include "io/hdf5Handle.hpp"
#include "io/publish.hpp"

namespace corpuscle::io {
namespace {

template <class T>
void writeAttribute(hid_t object, const std::string& name, T value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "scalar space");
    const Handle attribute(H5Acreate2(object, name.c_str(), fileType<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                           fmt::format("attribute '{}'", name));
    checked(H5Awrite(attribute, memoryType<T>(), &value), fmt::format("attribute '{}'", name));
}

// Objects made with these properties have their links and attributes in their headers, which HDF5 verifies before it
// reads them. Longer lists would go into structures of their own, which it verifies too late (CheckpointAccess).
void keepInHeader(hid_t creation) {
    constexpr unsigned most = 65535;
    checked(H5Pset_link_phase_change(creation, most, 0), "storage of links");
    checked(H5Pset_attr_phase_change(creation, most, 0), "storage of attributes");
}

}  // namespace

struct CheckpointWriter::File {
    MPI_Comm comm;
    int rank = 0, size = 1;
    std::filesystem::path path, temporary;
    QuietHdf5 quiet;
    Handle file, attributes;
    Contents contents;
    std::uintmax_t extent = 0;  // bytes of data so far; the file is longer by its structures

    File(MPI_Comm c, const std::filesystem::path& p) : comm(c), path(p), temporary(temporaryName(p)) {
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &size);
        onRoot(comm, [&] {
            if (path.has_parent_path()) makeFolder(path.parent_path());
        });
        attempt([&] {
            const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
            checked(H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL), "parallel file access");
            // The file format of 1.10 has checksums in all its own structures.
            checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "file format");
            const Handle ofFile(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file"),
                ofGroup(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "group");
            keepInHeader(ofFile), keepInHeader(ofGroup);
            file = Handle(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, ofFile, access), H5Fclose, "new file");
            attributes = Handle(H5Gcreate2(file, checkpoint::attributeGroup, H5P_DEFAULT, ofGroup, H5P_DEFAULT),
                                H5Gclose, "attribute group");
            writeAttribute(file, checkpoint::ranksName, static_cast<std::int64_t>(size));
            contents.ranks(size);
        });
    }

    ~File() {
        // HDF5 closes the file together with the last of these two handles.
        const herr_t first = attributes.close(), last = file.close();
        if (first < 0 || last < 0) leaveMpiOpen();
        std::error_code ignored;
        if (rank == 0) std::filesystem::remove(temporary, ignored);
    }

    // Runs work() on all ranks. The reason of a failure is asked from the system where possible, since HDF5 does not
    // report limits or full disks.
    template <class Work>
    void attempt(Work&& work) {
        together(comm, [&] {
            try {
                std::forward<Work>(work)();
            } catch (const Failure& failure) {
                throw notWritten(path, temporary, failure.what(), extent);
            }
        });
    }

    // Rows [first, first + values.size()/components) of `total` from this rank.
    template <class T>
    void write(const std::string& name, std::span<const T> values, int components, hsize_t first, hsize_t total) {
        const std::string what = fmt::format("dataset '{}'", name);
        const std::uint64_t mine = checksum(values, first * static_cast<hsize_t>(components));
        std::uint64_t sum = 0;
        MPI_Allreduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, comm);
        contents.dataset(name, std::is_same_v<T, double>, total, static_cast<std::uint64_t>(components), sum);

        Handle dataset, fileSpace, memorySpace, transfer;
        extent += total * static_cast<hsize_t>(components) * sizeof(T);
        const hsize_t count[2] = {values.size() / static_cast<std::size_t>(components),
                                  static_cast<hsize_t>(components)};
        attempt([&] {
            const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
            checked(H5Pset_create_intermediate_group(links, 1), what);
            const hsize_t shape[2] = {total, static_cast<hsize_t>(components)};
            fileSpace = Handle(H5Screate_simple(2, shape, nullptr), H5Sclose, what);
            memorySpace = Handle(H5Screate_simple(2, count, nullptr), H5Sclose, what);
            dataset = Handle(H5Dcreate2(file, name.c_str(), fileType<T>(), fileSpace, links, H5P_DEFAULT, H5P_DEFAULT),
                             H5Dclose, what);
            writeAttribute(dataset, checkpoint::checksumName, sum);
            transfer = Handle(H5Pcreate(H5P_DATASET_XFER), H5Pclose, what);
            checked(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), what);
            const hsize_t start[2] = {first, 0};
            if (count[0] > 0) {
                checked(H5Sselect_hyperslab(fileSpace, H5S_SELECT_SET, start, nullptr, count, nullptr), what);
            } else {
                checked(H5Sselect_none(fileSpace), what);
                checked(H5Sselect_none(memorySpace), what);
            }
        });
        if (total == 0) return;
        attempt([&] {
            checked(H5Dwrite(dataset, memoryType<T>(), memorySpace, fileSpace, transfer, values.data()), what);
        });
    }

    template <class T>
    void replicated(const std::string& name, std::span<const T> values) {
        std::uint64_t total = values.size();
        MPI_Bcast(&total, 1, MPI_UINT64_T, 0, comm);
        write(name, rank == 0 ? values : std::span<const T>(), 1, 0, total);
    }

    template <class T>
    void distributed(const std::string& name, std::span<const T> values, int components) {
        together(comm, [&] {
            if (components < 1 || values.size() % static_cast<std::size_t>(components) != 0) {
                throw std::invalid_argument(
                    fmt::format("checkpoint dataset '{}': {} values in rows of {}", name, values.size(), components));
            }
        });
        const auto mine = static_cast<std::int64_t>(values.size() / static_cast<std::size_t>(components));
        std::vector<std::int64_t> rows(static_cast<std::size_t>(size));
        MPI_Allgather(&mine, 1, MPI_INT64_T, rows.data(), 1, MPI_INT64_T, comm);
        const auto first = std::accumulate(rows.begin(), rows.begin() + rank, std::int64_t{0});
        const auto total = std::accumulate(rows.begin(), rows.end(), std::int64_t{0});
        write(fmt::format("{}/{}", checkpoint::dataGroup, name), values, components, static_cast<hsize_t>(first),
              static_cast<hsize_t>(total));
        replicated(fmt::format("{}/{}", checkpoint::rowsGroup, name), std::span<const std::int64_t>(rows));
    }
};

CheckpointWriter::CheckpointWriter(MPI_Comm comm, const std::filesystem::path& path)
    : file_(std::make_unique<File>(comm, path)) {}
CheckpointWriter::~CheckpointWriter() = default;

void CheckpointWriter::writeDistributed(const std::string& name, std::span<const double> values, int components) {
    file_->distributed(name, values, components);
}
void CheckpointWriter::writeDistributed(const std::string& name, std::span<const std::int64_t> values, int components) {
    file_->distributed(name, values, components);
}
void CheckpointWriter::writeReplicated(const std::string& name, std::span<const double> values) {
    file_->replicated(fmt::format("{}/{}", checkpoint::dataGroup, name), values);
}
void CheckpointWriter::writeReplicated(const std::string& name, std::span<const std::int64_t> values) {
    file_->replicated(fmt::format("{}/{}", checkpoint::dataGroup, name), values);
}

void CheckpointWriter::attribute(const std::string& name, double value) {
    MPI_Bcast(&value, 1, MPI_DOUBLE, 0, file_->comm);
    file_->contents.attribute(name, value);
    file_->attempt([&] { writeAttribute(file_->attributes, name, value); });
}
void CheckpointWriter::attribute(const std::string& name, std::int64_t value) {
    MPI_Bcast(&value, 1, MPI_INT64_T, 0, file_->comm);
    file_->contents.attribute(name, value);
    file_->attempt([&] { writeAttribute(file_->attributes, name, value); });
}
void CheckpointWriter::attribute(const std::string& name, const std::string& value) {
    const std::string text = Communicator(file_->comm).broadcast(value);
    file_->contents.attribute(name, text);
    const std::string what = fmt::format("attribute '{}'", name);
    file_->attempt([&] {
        const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, what);
        checked(H5Tset_size(type, text.size() + 1), what);
        const Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
        const Handle attribute(H5Acreate2(file_->attributes, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, what);
        checked(H5Awrite(attribute, type, text.c_str()), what);
    });
}

void CheckpointWriter::finish() {
    const std::string what = "end of the file";
    file_->attempt([&] {
        writeAttribute(file_->file, checkpoint::contentsName, file_->contents.sum());
        checked(H5Fflush(file_->file, H5F_SCOPE_GLOBAL), what);
        checked(file_->attributes.close(), what);
        if (const herr_t closed = file_->file.close(); closed < 0) {
            leaveMpiOpen();
            checked(closed, what);
        }
    });
    onRoot(file_->comm, [&] { publish(file_->temporary, file_->path, Sync::disk); });
}

}  // namespace corpuscle::io
