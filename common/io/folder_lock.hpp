#pragma once
// One run writes into a folder at a time.
#include <filesystem>

namespace softgrain {

/// Held by the process until the object is gone; the system gives it back if the process is killed. No file
/// is left. On file systems without locks of folders nothing is held.
class FolderLock {
  public:
    /// Throws InputError if another process holds the folder.
    explicit FolderLock(const std::filesystem::path& folder);
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock();

  private:
    int descriptor_;
};

}  // namespace softgrain
