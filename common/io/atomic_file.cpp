#include "common/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "common/errors.hpp"

namespace softgrain {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view action, int error) {
    const std::string_view cure = cure_of(error);
    throw OutputError(fmt::format("{}: cannot {}: {}{}{}", path.string(), action, std::strerror(error),
                                  cure.empty() ? "" : "; ", cure));
}

/// A descriptor that is closed, and its file removed, unless the write is completed.
class FileAside {
  public:
    FileAside(const std::filesystem::path& path, std::string_view name) : path_(path), name_(name) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
        if (descriptor_ < 0) fail(name_, "create the file", errno);
    }
    FileAside(const FileAside&) = delete;
    FileAside& operator=(const FileAside&) = delete;
    ~FileAside() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!completed_) ::unlink(path_.c_str());
    }

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail(name_, "write", errno);
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }
    void flush() {
        if (::fsync(descriptor_) != 0) fail(name_, "flush to the disk", errno);
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) fail(name_, "close", errno);
    }
    /// Of a file that was flushed.
    void rename_to(const std::filesystem::path& target) {
        if (::rename(path_.c_str(), target.c_str()) != 0) fail(name_, "rename", errno);
        completed_ = true;
    }

  private:
    std::filesystem::path path_;
    std::filesystem::path name_;
    int descriptor_ = -1;
    bool completed_ = false;
};

/// Makes a rename survive a power cut. Some file systems do not know fsync of a folder: no error then.
void flush_directory(const std::filesystem::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    const int flushed = ::fsync(descriptor);
    const int error = errno;
    ::close(descriptor);
    if (flushed != 0 && error != EINVAL && error != ENOTSUP) fail(directory, "flush to the disk", error);
}

}  // namespace

std::string_view cure_of(int error) {
    switch (error) {
        case ENOSPC:
            return "make room on the disk";
        case EDQUOT:
            return "make room within your quota";
        case EFBIG:
            return "allow larger files (ulimit -f)";
        case EROFS:
        case EACCES:
        case EPERM:
            return "choose a folder that can be written";
        case ENOENT:
            return "the folder was removed or never there";
        default:
            return "";
    }
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           const std::filesystem::path& old_file_to) {
    const std::filesystem::path aside = path.string() + ".part";
    FileAside file(aside, path.string());
    file.write(bytes);
    file.flush();
    if (!old_file_to.empty() && ::rename(path.c_str(), old_file_to.c_str()) != 0 && errno != ENOENT)
        fail(path, "rename", errno);
    file.rename_to(path);
    flush_directory(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
}

void make_directories(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!error && !std::filesystem::is_directory(path, error))
        error = std::make_error_code(std::errc::not_a_directory);
    if (!error) return;
    const std::string_view cure = cure_of(error.value());
    throw OutputError(fmt::format("{}: cannot make the folder: {}{}{}", path.string(), error.message(),
                                  cure.empty() ? "" : "; ", cure));
}

}  // namespace softgrain
