#include "solver/output/atomic_file.hpp"

#include <cerrno>
#include <new>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "solver/output/open_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof {

namespace {

constexpr std::uintmax_t largest_whole = std::uintmax_t{1} << 31U;  // [bytes] of a file read at once
constexpr std::size_t read_block = std::size_t{1} << 16U;

std::string reason(int error) {
  return std::generic_category().message(error);
}

std::filesystem::path temporary(const std::filesystem::path& path) {
  return std::filesystem::path(path).concat(".tmp");
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    close();
    fd_ = other.release();
  }
  return *this;
}

Descriptor::~Descriptor() {
  close();
}

int Descriptor::release() {
  const int fd = fd_;
  fd_ = -1;
  return fd;
}

void Descriptor::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

void write_all(const Descriptor& file, std::string_view content, const std::filesystem::path& path) {
  while (!content.empty()) {
    const ssize_t written = ::write(file.get(), content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw OutputError("write", path, reason(errno));
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void sync(const Descriptor& file, const std::filesystem::path& path) {
  // EINVAL: a device without a disk behind it, such as a pipe; there is nothing to flush.
  if (::fsync(file.get()) != 0 && errno != EINVAL) throw OutputError("write", path, reason(errno));
}

void write_beside(const std::filesystem::path& path, std::string_view content) {
  require_file(path, "write");  // the rename would put a file in the place of a device, such as /dev/null
  const auto draft = temporary(path);
  // What has the draft's name is of a run that was killed, or a link to somebody's file: never written into.
  ::unlink(draft.c_str());
  Descriptor file(::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.valid()) throw OutputError("write", path, reason(errno));
  try {
    write_all(file, content, path);
    sync(file, path);
  } catch (...) {
    file.close();
    ::unlink(draft.c_str());
    throw;
  }
}

void rename_into_place(const std::filesystem::path& path) {
  if (::rename(temporary(path).c_str(), path.c_str()) != 0) throw OutputError("write", path, reason(errno));
  // The new name is safe against a power cut only once the directory is flushed; file systems that cannot are
  // let off.
  const auto parent = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const Descriptor directory(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.valid()) ::fsync(directory.get());
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  write_beside(path, content);
  try {
    rename_into_place(path);
  } catch (...) {
    ::unlink(temporary(path).c_str());
    throw;
  }
}

void overwrite_file(const std::filesystem::path& path, std::string_view content) {
  require_file(path, "write");  // opening a pipe waits for its other end
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
  if (!file.valid()) throw OutputError("write", path, reason(errno));
  // Half of the new content would be worse than the old one: room for all of it comes first.
  if (const int error = ::posix_fallocate(file.get(), 0, static_cast<off_t>(content.size())); error != 0)
    throw OutputError("write", path, reason(error));
  write_all(file, content, path);
  if (::ftruncate(file.get(), static_cast<off_t>(content.size())) != 0)
    throw OutputError("write", path, reason(errno));
  sync(file, path);
}

void require_file(const std::filesystem::path& path, const std::string& action) {
  std::error_code unknown;
  const std::filesystem::file_status status = std::filesystem::status(path, unknown);
  if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) return;
  throw OutputError(action, path,
                    std::filesystem::is_directory(status) ? reason(EISDIR) : "it is a device or a pipe");
}

void require_own_file(const std::filesystem::path& path, std::string_view beginning) {
  require_file(path, "write");
  if (!std::filesystem::exists(path)) return;
  const std::string content = read_file(path);
  if (!content.empty() && !content.starts_with(beginning))
    throw OutputError("write", path, "it is there and holds something else; give another name");
}

std::string read_file(const std::filesystem::path& path) {
  // A file with holes takes no room where it lies, and all of it here.
  const Descriptor file = open_file(path, largest_whole);
  std::string content;
  try {
    for (std::vector<char> block(read_block);;) {
      const ssize_t size = ::read(file.get(), block.data(), block.size());
      if (size == 0) return content;
      if (size > 0) {
        content.append(block.data(), static_cast<std::size_t>(size));
      } else if (errno != EINTR) {
        throw OutputError("read", path, reason(errno));
      }
    }
  } catch (const std::bad_alloc&) {
    throw OutputError("read", path, "there is no memory for it");
  }
}

}  // namespace granvof
