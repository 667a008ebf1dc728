#include "io/checkpointAccess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace corpuscle::io {
namespace {

const char* typeName(bool isDouble) { return isDouble ? "floating-point numbers" : "integers"; }

template <class T>
T readAttribute(hid_t object, const std::string& name, const std::string& what) {
    const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, what);
    const Handle type(H5Aget_type(attribute), H5Tclose, what);
    const H5T_class_t kind = H5Tget_class(type);
    if constexpr (std::is_same_v<T, std::string>) {
        if (kind != H5T_STRING) throw Failure(ExitCode::io, what);
        std::string text(H5Tget_size(type), '\0');
        checked(H5Aread(attribute, type, text.data()), what);
        text.resize(std::min(text.find('\0'), text.size()));
        return text;
    } else {
        if (kind != (std::is_same_v<T, double> ? H5T_FLOAT : H5T_INTEGER)) throw Failure(ExitCode::io, what);
        T value{};
        checked(H5Aread(attribute, memoryType<T>(), &value), what);
        return value;
    }
}

// HDF5 1.10 frees uninitialised memory where a list of links or attributes that is too long for the header of its
// object is damaged. The writer keeps them all in headers; a file in which they are elsewhere is not read. Returns the
// address of the object.
haddr_t requireInHeader(hid_t object, const std::string& what) {
    H5G_info_t links{};
    checked(H5Gget_info(object, &links), what);
    H5O_info_t info{};
    checked(H5Oget_info2(object, &info, H5O_INFO_BASIC | H5O_INFO_META_SIZE), what);
    const H5_ih_info_t& attributes = info.meta_size.attr;
    if (links.storage_type != H5G_STORAGE_TYPE_COMPACT || attributes.index_size > 0 || attributes.heap_size > 0)
        throw Failure(ExitCode::io, what +
                                        " (its lists are not in the headers of the groups: it is damaged, or was "
                                        "written by an earlier version)");
    return info.addr;
}

// Adds the datasets below a group, as paths from its top. seen: addresses of the groups before. Each group has one
// link: groups with eight links to the next one, eight levels deep, would otherwise be seventeen million.
void addDatasets(hid_t group, const std::string& path, const std::string& what, std::set<haddr_t>& seen,
                 std::vector<std::string>& datasets) {
    if (!seen.insert(requireInHeader(group, what)).second)
        throw Failure(ExitCode::io, what + " (more than one link leads to a group)");
    std::vector<std::string> links;
    const auto visit = [](hid_t, const char* name, const H5L_info_t* info, void* list) -> herr_t {
        if (info->type == H5L_TYPE_HARD) static_cast<std::vector<std::string>*>(list)->push_back(name);
        return 0;
    };
    checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &links), what);
    for (const std::string& name : links) {
        const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose, what);
        const H5I_type_t type = H5Iget_type(object);
        if (type == H5I_DATASET) datasets.push_back(path + name);
        if (type == H5I_GROUP) addDatasets(object, path + name + "/", what, seen, datasets);
    }
}

bool contains(const std::vector<std::string>& sorted, const std::string& name) {
    return std::binary_search(sorted.begin(), sorted.end(), name);
}

}  // namespace

CheckpointAccess::CheckpointAccess(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path_, error)) {
        throw Failure(ExitCode::io, fmt::format("{}: there is no such checkpoint.", path_.string()));
    }
    const std::string what = fmt::format("{}: the file is corrupt or no checkpoint.", path_.string());
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
    checked(H5Pset_file_locking(access, false, true), what);
    file_ = Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access), H5Fclose, what);
    requireInHeader(Handle(H5Gopen2(file_, "/", H5P_DEFAULT), H5Gclose, what), what);
    ranksWritten_ = readAttribute<std::int64_t>(file_, checkpoint::ranksName, what);
    names_ = namesBelow(checkpoint::dataGroup);
    distributed_ = namesBelow(checkpoint::rowsGroup);
    if (H5Aexists(file_, checkpoint::contentsName) <= 0)
        throw Failure(
            ExitCode::io,
            fmt::format(
                "{}: the file has no checksum of its contents: it is damaged, or was written by an earlier version.",
                path_.string()));
    if (contents().sum() != readAttribute<std::uint64_t>(file_, checkpoint::contentsName, what))
        throw Failure(
            ExitCode::io,
            fmt::format("{}: the file is corrupt: its attributes and datasets do not agree with their checksum.",
                        path_.string()));
}

Contents CheckpointAccess::contents() const {
    Contents all;
    all.ranks(ranksWritten_);
    const std::string what = fmt::format("{}: the attributes are corrupt.", path_.string());
    const Handle group(H5Gopen2(file_, checkpoint::attributeGroup, H5P_DEFAULT), H5Gclose, what);
    requireInHeader(group, what);
    std::vector<std::string> names;
    const auto visit = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->push_back(name);
        return 0;
    };
    checked(H5Aiterate2(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names), what);
    for (const std::string& name : names) {
        const Handle attribute(H5Aopen(group, name.c_str(), H5P_DEFAULT), H5Aclose, what);
        const Handle type(H5Aget_type(attribute), H5Tclose, what);
        const H5T_class_t kind = H5Tget_class(type);
        if (kind == H5T_STRING)
            all.attribute(name, readAttribute<std::string>(group, name, what));
        else if (kind == H5T_FLOAT)
            all.attribute(name, readAttribute<double>(group, name, what));
        else
            all.attribute(name, readAttribute<std::int64_t>(group, name, what));
    }
    const auto add = [&](const char* of, const std::vector<std::string>& datasets) {
        for (const std::string& name : datasets) {
            const std::string full = fmt::format("{}/{}", of, name);
            const Dataset dataset = openFull(full, name);
            all.dataset(full, dataset.isDouble, dataset.rows, dataset.components, dataset.sum);
        }
    };
    add(checkpoint::dataGroup, names_);
    add(checkpoint::rowsGroup, distributed_);
    return all;
}

Failure CheckpointAccess::corrupt(const std::string& dataset) const {
    return {ExitCode::io, fmt::format("{}: dataset '{}' is corrupt.", path_.string(), dataset)};
}

std::vector<std::string> CheckpointAccess::namesBelow(const char* group) const {
    const std::string what = fmt::format("{}: the list of datasets is corrupt.", path_.string());
    std::vector<std::string> names;
    if (checked(H5Lexists(file_, group, H5P_DEFAULT), what) == 0) return names;
    const Handle id(H5Gopen2(file_, group, H5P_DEFAULT), H5Gclose, what);
    std::set<haddr_t> seen;
    addDatasets(id, "", what, seen, names);
    std::sort(names.begin(), names.end());
    return names;
}

CheckpointAccess::Dataset CheckpointAccess::open(const std::string& name) const {
    if (!contains(names_, name)) {
        throw Failure(ExitCode::io, fmt::format("{}: dataset '{}' is missing; there are: {}.{}", path_.string(), name,
                                                joinWords(names_), didYouMean(name, names_)));
    }
    return openFull(fmt::format("{}/{}", checkpoint::dataGroup, name), name);
}

CheckpointAccess::Dataset CheckpointAccess::openFull(const std::string& fullName, const std::string& name) const {
    const std::string what = corrupt(name).what();
    Dataset dataset;
    dataset.name = name;
    dataset.id = Handle(H5Dopen2(file_, fullName.c_str(), H5P_DEFAULT), H5Dclose, what);
    const Handle type(H5Dget_type(dataset.id), H5Tclose, what);
    const Handle space(H5Dget_space(dataset.id), H5Sclose, what);
    hsize_t shape[2] = {0, 0};
    if (H5Sget_simple_extent_ndims(space) != 2) throw corrupt(name);
    checked(H5Sget_simple_extent_dims(space, shape, nullptr), what);
    dataset.isDouble = H5Tget_class(type) == H5T_FLOAT;
    dataset.rows = shape[0];
    dataset.components = shape[1];
    dataset.sum = readAttribute<std::uint64_t>(dataset.id, checkpoint::checksumName, what);
    return dataset;
}

template <class T>
void CheckpointAccess::require(const Dataset& dataset, int components) const {
    if (dataset.isDouble == std::is_same_v<T, double> && dataset.components == static_cast<hsize_t>(components)) return;
    throw Failure(ExitCode::io, fmt::format("{}: dataset '{}' holds {} in rows of {}; {} in rows of {} are needed.",
                                            path_.string(), dataset.name, typeName(dataset.isDouble),
                                            dataset.components, typeName(std::is_same_v<T, double>), components));
}

template <class T>
std::vector<T> CheckpointAccess::slab(const Dataset& dataset, hsize_t first, hsize_t count, std::uint64_t& sum) const {
    std::vector<T> values(count * dataset.components);
    if (!values.empty()) {
        const std::string what = corrupt(dataset.name).what();
        const hsize_t start[2] = {first, 0}, extent[2] = {count, dataset.components};
        const Handle fileSpace(H5Dget_space(dataset.id), H5Sclose, what);
        const Handle memorySpace(H5Screate_simple(2, extent, nullptr), H5Sclose, what);
        checked(H5Sselect_hyperslab(fileSpace, H5S_SELECT_SET, start, nullptr, extent, nullptr), what);
        checked(H5Dread(dataset.id, memoryType<T>(), memorySpace, fileSpace, H5P_DEFAULT, values.data()), what);
    }
    sum = checksum(std::span<const T>(values), first * dataset.components);
    return values;
}

template <class T>
std::vector<T> CheckpointAccess::whole(const Dataset& dataset) const {
    std::uint64_t sum = 0;
    auto values = slab<T>(dataset, 0, dataset.rows, sum);
    if (sum != dataset.sum) throw corrupt(dataset.name);
    return values;
}

std::pair<hsize_t, hsize_t> CheckpointAccess::share(const Dataset& dataset, int rank, int ranks) const {
    const auto part = [&](int r) { return dataset.rows * static_cast<hsize_t>(r) / static_cast<hsize_t>(ranks); };
    if (ranksWritten_ != ranks || !contains(distributed_, dataset.name))
        return {part(rank), part(rank + 1) - part(rank)};
    const auto rows =
        whole<std::int64_t>(openFull(fmt::format("{}/{}", checkpoint::rowsGroup, dataset.name), dataset.name));
    if (rows.size() != static_cast<std::size_t>(ranks)) throw corrupt(dataset.name);
    const auto first = std::accumulate(rows.begin(), rows.begin() + rank, std::int64_t{0});
    return {static_cast<hsize_t>(first), static_cast<hsize_t>(rows[static_cast<std::size_t>(rank)])};
}

template <class T>
T CheckpointAccess::attribute(const std::string& name) const {
    const std::string what = fmt::format("{}: attribute '{}' is missing or of another type.", path_.string(), name);
    const Handle group(H5Gopen2(file_, checkpoint::attributeGroup, H5P_DEFAULT), H5Gclose, what);
    return readAttribute<T>(group, name, what);
}

void CheckpointAccess::verify() const {
    constexpr hsize_t block = 1 << 18;
    for (const auto& name : names_) {
        const Dataset dataset = open(name);
        std::uint64_t sum = 0;
        for (hsize_t first = 0; first < dataset.rows; first += block) {
            const hsize_t count = std::min(block, dataset.rows - first);
            std::uint64_t part = 0;
            if (dataset.isDouble) {
                slab<double>(dataset, first, count, part);
            } else {
                slab<std::int64_t>(dataset, first, count, part);
            }
            sum += part;
        }
        if (sum != dataset.sum) throw corrupt(name);
    }
    for (const auto& name : distributed_)
        whole<std::int64_t>(openFull(fmt::format("{}/{}", checkpoint::rowsGroup, name), name));
}

template void CheckpointAccess::require<double>(const Dataset&, int) const;
template void CheckpointAccess::require<std::int64_t>(const Dataset&, int) const;
template std::vector<double> CheckpointAccess::slab(const Dataset&, hsize_t, hsize_t, std::uint64_t&) const;
template std::vector<std::int64_t> CheckpointAccess::slab(const Dataset&, hsize_t, hsize_t, std::uint64_t&) const;
template std::vector<double> CheckpointAccess::whole(const Dataset&) const;
template std::vector<std::int64_t> CheckpointAccess::whole(const Dataset&) const;
template double CheckpointAccess::attribute(const std::string&) const;
template std::int64_t CheckpointAccess::attribute(const std::string&) const;
template std::string CheckpointAccess::attribute(const std::string&) const;

}  // namespace corpuscle::io
