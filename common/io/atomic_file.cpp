#include "common/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "common/errors.hpp"

namespace softgrain {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what) {
    throw OutputError(fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(errno)));
}

void sync(const std::filesystem::path& path, int flags) {
    const int file = ::open(path.c_str(), flags);
    if (file < 0) fail(path, "open to sync");
    const int failed = ::fsync(file);
    ::close(file);
    if (failed != 0) fail(path, "sync");
}

}  // namespace

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write) {
    std::filesystem::path aside = path;
    aside += ".part";
    try {
        write(aside);
        sync(aside, O_RDONLY);
    } catch (...) {
        ::unlink(aside.c_str());
        throw;
    }
    if (::rename(aside.c_str(), path.c_str()) != 0) fail(path, "rename into place");
    sync(path.has_parent_path() ? path.parent_path() : ".", O_RDONLY | O_DIRECTORY);
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
    write_atomically(path, [&](const std::filesystem::path& aside) {
        errno = 0;
        std::ofstream file(aside, std::ios::binary);
        file.write(text.data(), static_cast<std::streamsize>(text.size()));
        file.close();
        if (!file) fail(path, "write");
    });
}

void make_folder(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error)
        throw OutputError(fmt::format("{}: cannot make this folder: {}", path.string(), error.message()));
}

}  // namespace softgrain
