// Writing a file so that a reader sees either the old content or all of the new one, whatever happens.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace granvof {

// Writes `content` beside `path`, flushes it to the disk and renames it over `path`.
// Throws OutputError (disk full, no permission, a device or a pipe in its place, ...); what was there before
// then stays as it was.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

// The same in two steps, for a caller that has something to do between them.
void write_beside(const std::filesystem::path& path, std::string_view content);  // writes path.tmp
void rename_into_place(const std::filesystem::path& path);                       // path.tmp -> path

// The last resort of a full disk: the content goes over that of an existing file, which needs no new room
// where it is about as long. Where there is no room for all of it the file stays as it is. A kill meanwhile
// leaves neither. Throws OutputError.
void overwrite_file(const std::filesystem::path& path, std::string_view content);

// Throws OutputError ("cannot ACTION ...") where `path` is there and no file: opening a pipe waits for its
// other end, a device may have none.
void require_file(const std::filesystem::path& path, const std::string& action = "read");

// Before something is written under a name that a user gives: throws OutputError where a device is there, or
// a file that is not empty and does not begin so: it is somebody's, perhaps what is just being read.
void require_own_file(const std::filesystem::path& path, std::string_view beginning);

// Whole content of a file. Throws OutputError.
std::string read_file(const std::filesystem::path& path);

// An open file descriptor, closed at the end of its scope.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }
  int release();
  void close();

 private:
  int fd_ = -1;
};

// Writes all of `content` to `fd`; throws OutputError naming `path`.
void write_all(const Descriptor& file, std::string_view content, const std::filesystem::path& path);
// Flushes to the disk; throws OutputError naming `path`.
void sync(const Descriptor& file, const std::filesystem::path& path);

}  // namespace granvof
