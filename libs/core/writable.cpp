#include "core/writable.hpp"

#include <algorithm>
#include <string>

#include "core/together.hpp"
#include "core/writeFailure.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// Creates missing folders. Returns those created, the deepest first.
std::vector<fs::path> makeFolders(const fs::path& folder) {
    std::vector<fs::path> made;
    std::error_code error;
    for (fs::path missing = folder; !missing.empty() && !fs::exists(missing, error); missing = missing.parent_path()) {
        if (error && error != std::errc::no_such_file_or_directory) break;
        made.push_back(missing);
    }
    for (std::size_t i = made.size(); i-- > 0;) {
        const fs::path folder = made[i];
        if (fs::create_directory(folder, error) || !error) continue;
        const int reason = error.value();
        for (std::size_t above = i + 1; above < made.size(); ++above) fs::remove(made[above], error);
        throw writeFailure(folder, reason);
    }
    return made;
}

std::string whyNot(const fs::path& file) {
    std::vector<fs::path> made;
    std::string text;
    try {
        if (file.has_parent_path()) made = makeFolders(file.parent_path());
        if (const int reason = tryWriting(file)) text = writeFailure(file, reason).what();
    } catch (const Failure& failure) {
        text = failure.what();
    }
    std::error_code ignored;
    for (const fs::path& folder : made) fs::remove(folder, ignored);
    return text;
}

}  // namespace

void requireWritable(const Communicator& communicator, const std::vector<fs::path>& files) {
    onRoot(communicator.handle(), [&] {
        std::vector<std::string> faults;
        for (const fs::path& file : files) {
            const std::string text = whyNot(file);
            if (!text.empty() && std::find(faults.begin(), faults.end(), text) == faults.end()) faults.push_back(text);
        }
        if (!faults.empty()) throw Failure(ExitCode::io, joinWords(faults, "\n"));
    });
}

}  // namespace corpuscle
